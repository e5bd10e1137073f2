"""RGB camera at 2880 x 2880 of one Project Aria device: the first calibration in projectaria_tools,
data/mps_sample/trajectory/online_calibration.jsonl. Each device has its settings.
"""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "FISHEYE624"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 2880, 2880
settings.fx = settings.fy = 1220.01943882295
settings.cx, settings.cy, settings.skew = 1461.091249679011, 1447.087207987354, 0
settings.k1, settings.k2, settings.k3 = 0.411035882200732, -0.456468282322496, 0.038303075146701
settings.k4, settings.k5, settings.k6 = 1.298336637403988, -1.770471163632234, 0.654993502244781
settings.p1, settings.p2 = 4.4207001233e-05, -7.9203062637e-05  # the file's p1 and p0
settings.s1, settings.s2, settings.s3, settings.s4 = (
    -0.000587384169463,
    0.00056439365081,
    0.000515794638327,
    0.000235027249453,
)
