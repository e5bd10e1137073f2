"""Left camera of the EuRoC micro aerial vehicle datasets, M. Burri et al., IJRR 2016: file cam0/sensor.yaml."""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_PINHOLE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 752, 480
settings.fx, settings.fy, settings.cx, settings.cy, settings.skew = 458.654, 457.296, 367.215, 248.375, 0
settings.k1, settings.k2, settings.p1, settings.p2 = -0.28340811, 0.07395907, 0.00019359, 1.76187114e-05
settings.k3 = settings.k4 = settings.k5 = settings.k6 = settings.s1 = settings.s2 = settings.s3 = settings.s4 = (
    settings.tau_x
) = settings.tau_y = 0
