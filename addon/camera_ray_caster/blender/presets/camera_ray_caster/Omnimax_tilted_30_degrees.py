"""A theater with a dome tilted by 30 degrees, like many theaters."""

from math import radians

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OMNIMAX"
own.tilt = radians(30)
