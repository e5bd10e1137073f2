"""Left camera of the TUM VI datasets at 512 x 512: D. Schubert et al., IROS 2018, file camchain.yaml."""

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OPENCV_FISHEYE"
settings.calibration_file = ""
settings.calibration_unit = "PIXELS"
settings.calibration_width, settings.calibration_height = 512, 512
settings.fx, settings.fy, settings.skew = 190.97847715128717, 190.9733070521226, 0
settings.cx, settings.cy = 254.93170605935475, 256.8974428996504
settings.k1, settings.k2 = 0.0034823894022493434, 0.0007150348452162257
settings.k3, settings.k4 = -0.0020532361418706202, 0.00020293673591811182
