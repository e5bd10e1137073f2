"""The hemisphere above a level planetarium, on a square frame."""

from math import pi

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "DOME_MASTER"
own.fov, own.tilt = pi, 0
