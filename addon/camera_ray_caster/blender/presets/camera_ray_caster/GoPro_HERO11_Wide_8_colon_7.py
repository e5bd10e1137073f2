"""GoPro HERO11 Black, Wide, 8:7, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO11 Black_Wide_8by7.json.
"""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_FISHEYE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 5312, 4648
settings.fx, settings.fy, settings.skew = 2357.117118952398, 2356.1435657849593, 0
settings.cx, settings.cy = 2676.846267472544, 2319.609149363389
settings.k1, settings.k2 = 0.03139553973504779, 0.05974110122697331
settings.k3, settings.k4 = -0.043366819910340776, 0.009924139209409393
