"""The ray caster itself: numpy and the standard library only, so that it runs where no Blender is installed."""
