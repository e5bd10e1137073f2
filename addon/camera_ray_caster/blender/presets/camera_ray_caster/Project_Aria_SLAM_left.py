"""Left SLAM camera of one Project Aria device: the first calibration in projectaria_tools,
data/mps_sample/trajectory/online_calibration.jsonl. Each device has its settings.
"""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "FISHEYE624"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 640, 480
settings.fx = settings.fy = 241.74642944335938
settings.cx, settings.cy, settings.skew = 320.6287536621094, 242.64068603515625, 0
settings.k1, settings.k2, settings.k3 = -0.02694184333086, 0.103186674416065, -0.072545729577541
settings.k4, settings.k5, settings.k6 = 0.01231786981225, 0.001513113966211, -0.000479895825264
settings.p1, settings.p2 = 0.001900697243399, 0.001933769090101  # the file's p1 and p0
settings.s1, settings.s2, settings.s3, settings.s4 = (
    -0.003100696252658,
    -0.000324406602885,
    -0.002613446209579,
    1.6337084161e-05,
)
