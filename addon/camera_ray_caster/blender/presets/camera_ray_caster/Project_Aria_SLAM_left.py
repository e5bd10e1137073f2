"""Left SLAM camera of one Project Aria device: the first calibration in projectaria_tools,
data/mps_sample/trajectory/online_calibration.jsonl. Each device has its own.
"""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "FISHEYE624"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 640, 480
own.fx = own.fy = 241.74642944335938
own.cx, own.cy, own.skew = 320.6287536621094, 242.64068603515625, 0
own.k1, own.k2, own.k3 = -0.02694184333086, 0.103186674416065, -0.072545729577541
own.k4, own.k5, own.k6 = 0.01231786981225, 0.001513113966211, -0.000479895825264
own.p1, own.p2 = 0.001900697243399, 0.001933769090101  # the file's p1 and p0
own.s1, own.s2, own.s3, own.s4 = -0.003100696252658, -0.000324406602885, -0.002613446209579, 1.6337084161e-05
