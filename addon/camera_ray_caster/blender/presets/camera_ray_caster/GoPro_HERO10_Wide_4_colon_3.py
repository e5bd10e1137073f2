"""GoPro HERO10 Black, Wide, 4:3, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO10 Black_Wide_4by3.json.
"""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_FISHEYE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 5312, 3984
settings.fx, settings.fy, settings.skew = 2373.2470636178646, 2374.1609863200747, 0
settings.cx, settings.cy = 2685.6542811339464, 1992.6176578749173
settings.k1, settings.k2 = 0.032857643499943856, 0.05573728082764548
settings.k3, settings.k4 = -0.038398907176739244, 0.006864853954539248
