"""The animation of a shader's inputs: keyframes, which Blender evaluates without the add-on."""

from collections.abc import Mapping

import bpy

from ...core.shaders.camera_shader import CameraShader

CURVES = 'cycles_custom["'
"""Prefix of the data paths of the inputs' curves."""


def insert_keyframes(camera, shaders: Mapping[float, CameraShader]) -> None:
    """Insert keyframes with linear interpolation at times of the action, for the inputs that differ."""
    first, *others = (shader.values for shader in shaders.values())
    moving = [name for name in first if any(values[name] != first[name] for values in others)]
    for name in moving:
        for frame, shader in shaders.items():
            camera.cycles_custom[name] = shader.values[name]
            camera.keyframe_insert(f'{CURVES}{name}"]', frame=frame)
    for bag in channel_bags(camera):
        for curve in bag.fcurves:
            if curve.data_path.startswith(CURVES):
                for key in curve.keyframe_points:
                    key.interpolation = "LINEAR"


def remove_keyframes(camera) -> None:
    """Remove the animation of the inputs, and the action if nothing else is left in it and nothing else uses it."""
    for bag in channel_bags(camera):
        for curve in [each for each in bag.fcurves if each.data_path.startswith(CURVES)]:
            bag.fcurves.remove(curve)
            if not bag.fcurves and camera.animation_data.action.users == 1:
                bpy.data.actions.remove(camera.animation_data.action)
                return


def channel_bags(camera) -> list:
    """Return the channel bags, which hold the curves of a camera's action."""
    animation = camera.animation_data
    if animation is None or animation.action is None or animation.action_slot is None:
        return []
    strips = (strip for layer in animation.action.layers for strip in layer.strips)
    bags = (strip.channelbag(animation.action_slot) for strip in strips)
    return [bag for bag in bags if bag is not None]


def is_animated(item) -> bool:
    """Whether an ID has an action, drivers or NLA tracks."""
    animation = item.animation_data
    return animation is not None and bool(animation.action or animation.drivers or animation.nla_tracks)
