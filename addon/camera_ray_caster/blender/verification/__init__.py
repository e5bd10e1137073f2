"""A camera held against Blender's own answers."""
