"""A dome that reaches 15 degrees below the horizon, like the Satosphere in Montreal.

Source: TouchDesigner's documentation, Palette:domeViewer.
"""

from math import radians

import bpy

own = bpy.context.camera.camera_ray_caster
own.model = "DOME_MASTER"
own.fov, own.tilt = radians(210), 0
