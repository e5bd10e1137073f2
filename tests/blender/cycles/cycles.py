"""Cycles as a witness: what the primary ray of every pixel is and meets, read back from a shader that emits it.

One sample is taken exactly at the pixel's center. Values are emitted in 0 .. 1 and stored as float32, so that one of
``reach`` comes back to reach x 2^-24; black is what no ray or no surface gives.
"""

from pathlib import Path

import addon_utils
import bpy
import numpy as np

from ...exr import read_exr

WIRE = 4.0
"""Pixels."""


def cycles_directions(scene, suffix=""):
    """Return the world directions of the primary rays of the render window, (h, w, 3); NaN where there is no ray.

    suffix: of a view's files, where there are several.
    """
    return _render(scene, "Incoming", 1.0, sky=True, suffix=suffix) * -1


def cycles_surface(scene, output, reach):
    """Return "Position", "Normal" or "UV", (h, w, 3), or "View Z Depth" three times, where a surface is met; else NaN.

    ``reach`` is more than the largest magnitude of a component.
    """
    return _render(scene, output, reach, sky=False)


def cycles_passes(scene):
    """Return the combined pass, (h, w, 3), and the material index, (h, w), of the scene as it is."""
    _prepare(scene)
    layer, settings = scene.view_layers[0], scene.render.image_settings
    layer.use_pass_material_index = True
    if bpy.app.version >= (5, 0):
        settings.media_type, settings.use_exr_interleave = "MULTI_LAYER_IMAGE", True
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    bpy.ops.render.render(write_still=True, scene=scene.name)
    channels = read_exr(Path(scene.render.filepath))
    (index,) = (name for name in channels if "Index" in name)
    return np.stack([channels[f"{layer.name}.Combined.{color}"] for color in "RGB"], axis=-1), channels[index]


def cycles_wires(scene):
    """Return which pixels show an edge of a triangle, drawn WIRE pixels wide, (h, w) bool."""
    return _render(scene, "Fac", 1.0, sky=False)[..., 0] > 0.5


def cycles_colors(scene):
    """Return what the camera's shader lets through of a white world, (h, w, 3) float64."""
    _prepare(scene)
    scene.world = bpy.data.worlds.new("White")
    nodes = _nodes(scene.world)
    next(node for node in nodes if node.type == "BACKGROUND").inputs["Color"].default_value = (1, 1, 1, 1)
    return _colors(scene)


def _render(scene, output, reach, sky, suffix=""):
    show(scene, output, reach, sky)
    return shown(_colors(scene, suffix), reach)


def _colors(scene, suffix=""):
    bpy.ops.render.render(write_still=True, scene=scene.name)
    path = Path(scene.render.filepath)
    channels = read_exr(path.with_stem(path.stem + suffix))  # Blender 4.5 cannot read what it writes of one eye alone
    return np.stack([channels[name] for name in "RGB"], axis=-1).astype(np.float64)


def shown(colors, reach):
    """Return what was emitted, from the colors of a picture of ``show``; NaN where nothing is seen."""
    values = colors.copy()
    values[(values == 0).all(axis=-1)] = np.nan
    return (values - 0.5) * (2 * reach)


def show(scene, output, reach, sky=False):
    """Let surfaces, or surfaces and sky, emit what a shader node puts out, and let Cycles render pixel centers."""
    _prepare(scene)
    scene.world = bpy.data.worlds.new("Witness")
    scene.world.cycles.sampling_method = "NONE"
    if sky:
        _emit(scene.world, "ShaderNodeBackground", "ShaderNodeOutputWorld", output, reach)
    else:
        _nodes(scene.world).clear()
    material = bpy.data.materials.new("Witness")
    _emit(material, "ShaderNodeEmission", "ShaderNodeOutputMaterial", output, reach)
    for layer in scene.view_layers:
        layer.material_override = material


def _emit(block, shader, target, output, reach):
    """Give a world or material the shader that emits what a node puts out, brought to 0 .. 1."""
    others = {
        "View Z Depth": "ShaderNodeCameraData", "UV": "ShaderNodeTexCoord", "Object Index": "ShaderNodeObjectInfo",
        "Fac": "ShaderNodeWireframe",
    }  # fmt: skip
    source = others.get(output, "ShaderNodeNewGeometry")
    nodes, links = _nodes(block), block.node_tree.links
    nodes.clear()
    source, scaled, shader, target = (nodes.new(name) for name in (source, "ShaderNodeVectorMath", shader, target))
    if output == "Fac":
        source.use_pixel_size, source.inputs[0].default_value = True, WIRE
    scaled.operation = "MULTIPLY_ADD"
    scaled.inputs[1].default_value = [0.5 / reach] * 3
    scaled.inputs[2].default_value = [0.5] * 3
    links.new(source.outputs[output], scaled.inputs[0])
    links.new(scaled.outputs[0], shader.inputs["Color"])
    links.new(shader.outputs[0], target.inputs["Surface"])


def _nodes(block):
    """Return the nodes of a world or material, which every one has from Blender 5.0 on."""
    if bpy.app.version < (5, 0):
        block.use_nodes = True
    return block.node_tree.nodes


def _prepare(scene):
    """Set Cycles to one sample at the center of each pixel of the render window, written as float32."""
    addon_utils.enable("cycles", default_set=True)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.filepath = bpy.app.tempdir + "witness.exr"
    render.use_crop_to_border = True
    render.use_compositing = render.use_sequencer = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "ZIP"
    render.image_settings.color_mode = "RGB"
    cycles.device = "CPU"
    cycles.samples, cycles.max_bounces = 1, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.filter_width = 0.01


def cycles_truth(scene):
    """Return Cycles' own passes of the scene as it is, at pixel centers, by our names: (h, w) or (h, w, 3) float64, the
    depth 1e10 where nothing is met.
    """
    _prepare(scene)
    layer, settings = scene.view_layers[0], scene.render.image_settings
    for name in ("z", "position", "normal", "uv", "object_index", "material_index"):
        setattr(layer, f"use_pass_{name}", True)
    if bpy.app.version >= (5, 0):
        settings.media_type, settings.use_exr_interleave = "MULTI_LAYER_IMAGE", True
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    bpy.ops.render.render(write_still=True, scene=scene.name)
    channels = read_exr(Path(scene.render.filepath))

    def pass_channels(letters, *names):
        """Return the channels of these letters of a pass, which has a longer name from Blender 5.0 on."""
        (name,) = {name.rpartition(".")[0] for name in channels} & {f"{layer.name}.{name}" for name in names}
        return np.stack([channels[f"{name}.{letter}"] for letter in letters], axis=-1).astype(np.float64)

    uv = pass_channels("UV", "UV")
    return {
        "depth": pass_channels("Z", "Depth")[..., 0],
        "position": pass_channels("XYZ", "Position"),
        "normal": pass_channels("XYZ", "Normal"),
        "uv": np.dstack((uv, np.zeros(uv.shape[:2]))),
        "object_index": np.rint(pass_channels("X", "IndexOB", "Object Index")[..., 0]),
        "material_index": np.rint(pass_channels("X", "IndexMA", "Material Index")[..., 0]),
    }
