"""GoPro HERO10 Black, Wide, 16:9, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO10 Black_Wide_16by9.json.
"""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_FISHEYE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 3840, 2160
own.fx, own.fy, own.skew = 1796.3208206894308, 1797.22277342282, 0
own.cx, own.cy = 1919.372365976781, 1063.171593155705
own.k1, own.k2 = 0.034213889574164644, 0.06767320765357862
own.k3, own.k4 = -0.07408969996955275, 0.029944425249175583
