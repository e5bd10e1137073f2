"""Reading of Blender's scenes as plain records. The scene is restored afterwards."""

from .scene_reader import read_camera, read_scene, read_shapes

__all__ = ["read_camera", "read_scene", "read_shapes"]
