"""The ray caster. It imports only numpy and the standard library, so it runs without Blender."""
