"""Left camera of the EuRoC micro aerial vehicle datasets, M. Burri et al., IJRR 2016: file cam0/sensor.yaml."""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_PINHOLE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 752, 480
own.fx, own.fy, own.cx, own.cy, own.skew = 458.654, 457.296, 367.215, 248.375, 0
own.k1, own.k2, own.p1, own.p2 = -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05
own.k3 = own.k4 = own.k5 = own.k6 = own.s1 = own.s2 = own.s3 = own.s4 = own.tau_x = own.tau_y = 0
