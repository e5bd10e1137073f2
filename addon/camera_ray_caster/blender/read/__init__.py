"""Blender in, plain records out. The scene is as it was afterwards."""

from .scene import read_camera, read_scene, read_shapes

__all__ = ["read_camera", "read_scene", "read_shapes"]
