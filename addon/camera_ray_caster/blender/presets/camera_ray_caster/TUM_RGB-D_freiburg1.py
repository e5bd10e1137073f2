"""Color camera of the freiburg1 sequences of TUM RGB-D: J. Sturm et al., IROS 2012, the calibration on its site."""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_PINHOLE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 640, 480
settings.fx, settings.fy, settings.cx, settings.cy, settings.skew = 517.3, 516.5, 318.6, 255.3, 0
settings.k1, settings.k2, settings.p1, settings.p2, settings.k3 = 0.2624, -0.9531, -0.0054, 0.0026, 1.1633
settings.k4 = settings.k5 = settings.k6 = settings.s1 = settings.s2 = settings.s3 = settings.s4 = settings.tau_x = (
    settings.tau_y
) = 0
