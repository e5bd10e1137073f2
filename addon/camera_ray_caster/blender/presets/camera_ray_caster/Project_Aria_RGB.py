"""RGB camera at 2880 x 2880 of one Project Aria device: the first calibration in projectaria_tools,
data/mps_sample/trajectory/online_calibration.jsonl. Each device has its own.
"""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "FISHEYE624"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 2880, 2880
own.fx = own.fy = 1220.01943882295
own.cx, own.cy, own.skew = 1461.091249679011, 1447.087207987354, 0
own.k1, own.k2, own.k3 = 0.411035882200732, -0.456468282322496, 0.038303075146701
own.k4, own.k5, own.k6 = 1.298336637403988, -1.770471163632234, 0.654993502244781
own.p1, own.p2 = 4.4207001233e-05, -7.9203062637e-05  # the file's p1 and p0
own.s1, own.s2, own.s3, own.s4 = -0.000587384169463, 0.00056439365081, 0.000515794638327, 0.000235027249453
