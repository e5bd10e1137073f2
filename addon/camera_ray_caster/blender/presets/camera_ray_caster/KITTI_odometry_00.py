"""Left gray camera of KITTI odometry sequences 00 to 02, rectified: A. Geiger et al., CVPR 2012, 00/calib.txt."""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_PINHOLE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 1241, 376
own.fx, own.fy, own.cx, own.cy, own.skew = 718.856, 718.856, 607.1928, 185.2157, 0
own.k1 = own.k2 = own.p1 = own.p2 = own.k3 = own.k4 = own.k5 = own.k6 = own.s1 = 0
own.s2 = own.s3 = own.s4 = own.tau_x = own.tau_y = 0
