"""GoPro HERO11 Black, Wide, 8:7, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO11 Black_Wide_8by7.json.
"""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_FISHEYE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 5312, 4648
own.fx, own.fy, own.skew = 2357.117118952398, 2356.1435657849593, 0
own.cx, own.cy = 2676.846267472544, 2319.609149363389
own.k1, own.k2 = 0.03139553973504779, 0.05974110122697331
own.k3, own.k4 = -0.043366819910340776, 0.009924139209409393
