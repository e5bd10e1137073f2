"""A dome that reaches 15 degrees below the horizon, like the Satosphere in Montreal.

Source: TouchDesigner's documentation, Palette:domeViewer.
"""

from math import radians

import bpy

settings = bpy.context.camera.camera_ray_caster
settings.model = "DOME_MASTER"
settings.fov, settings.tilt = radians(210), 0
