"""The hemisphere above a level planetarium, on a square frame."""

from math import pi

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "DOME_MASTER"
settings.fov, settings.tilt = pi, 0
