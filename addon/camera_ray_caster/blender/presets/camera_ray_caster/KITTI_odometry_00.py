"""Left gray camera of KITTI odometry sequences 00 to 02, rectified: A. Geiger et al., CVPR 2012, 00/calib.txt."""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_PINHOLE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 1241, 376
settings.fx, settings.fy, settings.cx, settings.cy, settings.skew = 718.856, 718.856, 607.1928, 185.2157, 0
settings.k1 = settings.k2 = settings.p1 = settings.p2 = settings.k3 = settings.k4 = settings.k5 = settings.k6 = (
    settings.s1
) = 0
settings.s2 = settings.s3 = settings.s4 = settings.tau_x = settings.tau_y = 0
