"""A theater with a dome tilted by 30 degrees, like many theaters."""

from math import radians

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "OMNIMAX"
settings.tilt = radians(30)
