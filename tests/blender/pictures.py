"""The passes of renders: ticked, read back from the files that Blender writes, and as the caster returns them."""

import numpy as np

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.passes import PASSES

FAR = 1e10
"""Blender's depth of the background, from its own engines."""

LABELS = {
    "combined": ("Combined", "RGBA"),
    "albedo": ("Albedo", "RGB"),
    "depth": ("Depth", "Z"),
    "distance": ("Distance", "X"),
    "position": ("Position", "XYZ"),
    "normal": ("Normal", "XYZ"),
    "uv": ("UV", "UVA"),
    "object_index": ("Object Index", "X"),
    "material_index": ("Material Index", "X"),
    "shape_index": ("Shape Index", "X"),
    "face_index": ("Face Index", "X"),
    "valid": ("Valid", "X"),
    "ray_origin": ("Ray Origin", "XYZ"),
    "ray_direction": ("Ray Direction", "XYZ"),
    "solid_angle": ("Solid Angle", "X"),
    "footprint": ("Footprint", "X"),
    "flow_forward": ("Flow Forward", "XY"),
    "flow_backward": ("Flow Backward", "XY"),
    "flow_hidden": ("Flow Hidden", "XY"),
    "distance_bound": ("Distance Bound", "X"),
    "position_bound": ("Position Bound", "X"),
    "normal_bound": ("Normal Bound", "X"),
}
BEFORE_5_0 = {"object_index": ("IndexOB", "X"), "material_index": ("IndexMA", "X")}
WIDTH, HEIGHT = 40, 30
"""Of the pictures that the engine renders."""


def tick(scene, names):
    """Tick these passes in every view layer."""
    from camera_ray_caster.blender.properties import pass_properties

    for layer in scene.view_layers:
        pass_properties.tick(scene, layer, names)


def picture(channels, name, layer="ViewLayer"):
    """A pass out of an EXR's channels, (height, width[, channels])."""
    import bpy

    known = LABELS if bpy.app.version >= (5, 0, 0) else {**LABELS, **BEFORE_5_0}
    label, letters = known.get(name) or (name.replace("_", " ").title(), PASSES[name].letters)
    return np.stack([channels[f"{layer}.{label}.{letter}"] for letter in letters], axis=-1)


def expected(scene, name, **keywords):
    """A pass as the caster returns it, in the form in which Blender stores it."""
    from camera_ray_caster.blender.read.scene_reader import read_scene

    read = read_scene(scene, **keywords, passes=[name])
    camera = read.camera
    image = cast(camera, read.shapes, passes=[name])[name].astype(np.float32)
    if name == "depth":
        image[np.isinf(image)] = FAR
    return image.reshape(*camera.raster.shape, -1)
