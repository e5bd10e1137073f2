"""GoPro HERO10 Black, Linear, 16:9, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO10 Black_Linear_16by9.json.
"""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_FISHEYE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 5312, 2988
settings.fx, settings.fy, settings.skew = 2532.6119178833487, 2537.18863370454, 0
settings.cx, settings.cy = 2658.3123813506386, 1501.139080101295
settings.k1, settings.k2 = 0.35029706500201957, 0.03071782327101835
settings.k3, settings.k4 = 0.2982002626114863, -0.1590018195047331
