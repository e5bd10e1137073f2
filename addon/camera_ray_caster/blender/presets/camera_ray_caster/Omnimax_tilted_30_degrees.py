"""A theater whose dome is tilted by 30 degrees, as many are."""

from math import radians

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "OMNIMAX"
own.tilt = radians(30)
