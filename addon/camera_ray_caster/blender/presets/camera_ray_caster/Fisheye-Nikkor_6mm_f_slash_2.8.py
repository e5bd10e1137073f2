"""Fisheye-Nikkor 6 mm f/2.8: equidistant, 220 degrees, by its manual; its image circle of 23 mm fills the frame."""

from math import radians

import bpy

camera = bpy.context.camera
camera.camera_ray_caster.model = "BLENDER"
camera.type, camera.panorama_type = "PANO", "FISHEYE_EQUIDISTANT"
camera.fisheye_fov = radians(220)
