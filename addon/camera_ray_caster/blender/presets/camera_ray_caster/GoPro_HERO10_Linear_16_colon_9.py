"""GoPro HERO10 Black, Linear, 16:9, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO10 Black_Linear_16by9.json.
"""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_FISHEYE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 5312, 2988
own.fx, own.fy, own.skew = 2532.6119178833487, 2537.18863370454, 0
own.cx, own.cy = 2658.3123813506386, 1501.139080101295
own.k1, own.k2 = 0.35029706500201957, 0.03071782327101835
own.k3, own.k4 = 0.2982002626114863, -0.1590018195047331
