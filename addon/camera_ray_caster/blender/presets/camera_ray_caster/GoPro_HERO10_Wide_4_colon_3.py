"""GoPro HERO10 Black, Wide, 4:3, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO10 Black_Wide_4by3.json.
"""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_FISHEYE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 5312, 3984
own.fx, own.fy, own.skew = 2373.2470636178646, 2374.1609863200747, 0
own.cx, own.cy = 2685.6542811339464, 1992.6176578749173
own.k1, own.k2 = 0.032857643499943856, 0.05573728082764548
own.k3, own.k4 = -0.038398907176739244, 0.006864853954539248
