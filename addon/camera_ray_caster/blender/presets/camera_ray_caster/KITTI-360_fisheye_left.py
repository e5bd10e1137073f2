"""Left fisheye of KITTI-360: Y. Liao et al., PAMI 2022, file calibration/image_02.yaml."""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "UCM"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 1400, 1400
settings.fx, settings.fy, settings.skew = 1336.3220825849971, 1335.7883350012958, 0
settings.cx, settings.cy = 716.94323510126321, 705.76498308221585
settings.unified_xi = 2.2134047507854890
settings.k1, settings.k2 = 0.016798235660113681, 1.6548773243373522
settings.p1, settings.p2 = 0.00042223943394772046, 0.00042462134260997584
