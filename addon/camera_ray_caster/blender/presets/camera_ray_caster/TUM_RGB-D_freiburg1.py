"""Color camera of the freiburg1 sequences of TUM RGB-D: J. Sturm et al., IROS 2012, the calibration on its site."""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_PINHOLE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 640, 480
own.fx, own.fy, own.cx, own.cy, own.skew = 517.3, 516.5, 318.6, 255.3, 0
own.k1, own.k2, own.p1, own.p2, own.k3 = 0.2624, -0.9531, -0.0054, 0.0026, 1.1633
own.k4 = own.k5 = own.k6 = own.s1 = own.s2 = own.s3 = own.s4 = own.tau_x = own.tau_y = 0
