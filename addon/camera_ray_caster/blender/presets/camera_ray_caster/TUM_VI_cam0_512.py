"""Left camera of the TUM VI datasets at 512 x 512: D. Schubert et al., IROS 2018, file camchain.yaml."""

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OPENCV_FISHEYE"
own.calibration_file = ""
own.calibration_unit = "PIXELS"
own.calibration_width, own.calibration_height = 512, 512
own.fx, own.fy, own.skew = 190.97847715128717, 190.9733070521226, 0
own.cx, own.cy = 254.93170605935475, 256.8974428996504
own.k1, own.k2 = 0.0034823894022493434, 0.0007150348452162257
own.k3, own.k4 = -0.0020532361418706202, 0.00020293673591811182
