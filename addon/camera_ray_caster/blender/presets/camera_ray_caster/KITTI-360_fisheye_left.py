"""Left fisheye of KITTI-360: Y. Liao et al., PAMI 2022, file calibration/image_02.yaml."""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "UCM"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 1400, 1400
own.fx, own.fy, own.skew = 1336.3220825849971, 1335.7883350012958, 0
own.cx, own.cy = 716.94323510126321, 705.76498308221585
own.unified_xi = 2.2134047507854890
own.k1, own.k2 = 0.016798235660113681, 1.6548773243373522
own.p1, own.p2 = 0.00042223943394772046, 0.00042462134260997584
