"""GoPro HERO10 Black, Wide, 16:9, stabilization off, as measured for Gyroflow: lens_profiles,
GoPro/GoPro_HERO10 Black_Wide_16by9.json.
"""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_FISHEYE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 3840, 2160
settings.fx, settings.fy, settings.skew = 1796.3208206894308, 1797.22277342282, 0
settings.cx, settings.cy = 1919.372365976781, 1063.171593155705
settings.k1, settings.k2 = 0.034213889574164644, 0.06767320765357862
settings.k3, settings.k4 = -0.07408969996955275, 0.029944425249175583
