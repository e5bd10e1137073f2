"""Sigma 8 mm F3.5 EX DG circular fisheye on 36 x 24 mm: equisolid, 180 degrees, by the manufacturer's data."""

from math import pi

import bpy

camera = bpy.context.camera
camera.camera_ray_caster.model = "BLENDER"
camera.type, camera.panorama_type = "PANO", "FISHEYE_EQUISOLID"
camera.fisheye_lens, camera.fisheye_fov = 8, pi
camera.sensor_fit, camera.sensor_width, camera.sensor_height = "AUTO", 36, 24
