"""Verification: a camera's rays compared with Blender's own answers."""
