"""The nodes of materials and worlds that give numbers, and the expressions that are made of them."""

from functools import partial

import numpy as np

from ...core.materials import operations as do
from ...core.materials.textures import MISSING, Texture, UnreadTexture
from ...core.materials.values import DIRECTION, OBJECT, UV, Coordinates, Layer, Value, channel, constant, function_of
from .nodes import Node, Nodes, Unread, own_value
from .texels import Unreadable, image_of

TABLE_ENTRIES = 256
"""Entries of color ramps and curves, as in Cycles."""

GENERATED = "generated"
"""Name of the layer of texture space coordinates; those of UV maps and attributes begin with "uv:" and "color:"."""


ENVIRONMENT = "environment"
"""What is noted in ``Nodes.needs`` of an environment image."""


def _image(nodes: Nodes, node: Node, output) -> Value:
    if node.projection != "FLAT":
        raise node.unread(f"projection {node.projection.lower()}")
    vector = node.input("Vector") if node.is_linked("Vector") else Coordinates(UV)
    return _texture(node, output, vector, node.extension)


def _texture(node: Node, output, vector: Value, extension: str) -> Value:
    if not node.nodes.reads_images:
        return UnreadTexture()
    try:
        image = None if node.image is None else image_of(node.image)
    except Unreadable as error:
        raise Unread(f"node {node.name!r}: {error}") from error
    if image is None:
        node.nodes.missing.add("" if node.image is None else node.image.name)
        return constant(*MISSING[:3]) if output.name == "Color" else constant(MISSING[3])
    divides = "Alpha" in node.outputs and node.outputs["Alpha"].is_linked
    return Texture(image, vector, extension, node.interpolation != "Closest", divides, output.name == "Alpha")


def _environment(nodes: Nodes, node: Node, output) -> Value:
    if node.projection != "EQUIRECTANGULAR":
        raise node.unread("mirror ball projection")
    nodes.needs.add(ENVIRONMENT)
    vector = node.input("Vector") if node.is_linked("Vector") else Coordinates(DIRECTION)
    return _texture(node, output, function_of(_equirectangular, vector), "REPEAT")


def _equirectangular(direction: np.ndarray) -> np.ndarray:
    """Return the place of directions in an equirectangular image, as in Cycles: -Y in the middle of the left half."""
    x, y, z = direction
    u = 0.5 - np.arctan2(y, x) / (2 * np.pi)
    return np.array(np.broadcast_arrays(u, np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5, 0.0))


def _coordinates(nodes: Nodes, node: Node, output) -> Value:
    if node.from_instancer and output.name in {"Generated", "UV"}:
        raise node.unread("From Instancer")
    if output.name == "UV":
        return Coordinates(UV)
    if output.name == "Generated":
        return _layer(nodes, GENERATED, 3)
    if output.name == "Object" and node.object is None:
        nodes.needs.add(OBJECT)
        return Coordinates(OBJECT)
    raise node.unread(f"output {output.name}")


def _world_coordinates(nodes: Nodes, node: Node, output) -> Value:
    if output.name != "Generated":
        raise node.unread(f"output {output.name}")
    return Coordinates(DIRECTION)


def _map(nodes: Nodes, node: Node, output) -> Value:
    if node.from_instancer:
        raise node.unread("From Instancer")
    return _layer(nodes, f"uv:{node.uv_map}", 3) if node.uv_map else Coordinates(UV)


def _attribute(nodes: Nodes, node: Node, output) -> Value:
    if node.attribute_type != "GEOMETRY":
        raise node.unread(f"attribute type {node.attribute_type.lower()}")
    if output.name in {"Color", "Alpha"}:
        return _color_layer(nodes, node.attribute_name, output.name)
    vector = _color_layer(nodes, node.attribute_name, "Color")
    if output.name == "Vector":
        return vector
    return function_of(lambda values: values.mean(axis=0, keepdims=True), vector)


def _color_layer(nodes: Nodes, name: str, output_name: str) -> Value:
    rgba = _layer(nodes, f"color:{name}", 4)
    return channel(rgba, 3) if output_name == "Alpha" else function_of(lambda values: values[:3], rgba)


def _layer(nodes: Nodes, name: str, channels: int) -> Value:
    nodes.needs.add(name)
    return Layer(name, channels)


def _light_path(nodes: Nodes, node: Node, output) -> Value:
    """What a camera ray has: it is a camera ray and nothing else, without any bounce."""
    if output.name == "Ray Length":
        raise node.unread("output Ray Length")
    return constant(1.0 if output.name == "Is Camera Ray" else 0.0)


def _mix(nodes: Nodes, node: Node, output) -> Value:
    if node.data_type == "RGBA":
        return _blended(node, *(node.input(key) for key in ("Factor_Float", "A_Color", "B_Color")), node.clamp_result)
    if node.data_type not in {"FLOAT", "VECTOR"}:
        raise node.unread(f"data type {node.data_type.lower()}")
    kind = node.data_type.title()
    uniform = kind == "Float" or node.factor_mode == "UNIFORM"
    factor = node.input("Factor_Float" if uniform else "Factor_Vector")
    if node.clamp_factor:
        factor = function_of(do.saturated, factor)
    return function_of(do.mix, factor, node.input(f"A_{kind}"), node.input(f"B_{kind}"))


def _mix_rgb(nodes: Nodes, node: Node, output) -> Value:
    return _blended(node, *map(node.input, ("Fac", "Color1", "Color2")), node.use_clamp)


def _blended(node: Node, factor: Value, first: Value, second: Value, clamps: bool) -> Value:
    blend = do.BLENDS.get(node.blend_type)
    if blend is None:
        raise node.unread(f"blend type {node.blend_type.lower()}")
    if getattr(node.node, "clamp_factor", True):
        factor = function_of(do.saturated, factor)
    blended = function_of(lambda f, a, b: do.mix(f, a, blend(a, b)), factor, first, second)
    return function_of(do.saturated, blended) if clamps else blended


def _ramp(nodes: Nodes, node: Node, output) -> Value:
    ramp = node.color_ramp
    table = np.array([ramp.evaluate(k / (TABLE_ENTRIES - 1)) for k in range(TABLE_ENTRIES)]).T
    rows = table[3:] if output.name == "Alpha" else table[:3]
    return function_of(partial(do.looked_up, rows, ramp.interpolation != "CONSTANT"), node.input("Fac"))


def _checker(nodes: Nodes, node: Node, output) -> Value:
    position = node.input("Vector") if node.is_linked("Vector") else _layer(nodes, GENERATED, 3)
    first = function_of(do.checker, position, node.input("Scale"))
    if output.name != "Color":
        return first
    return function_of(do.mix, first, node.input("Color2"), node.input("Color1"))


def _math(nodes: Nodes, node: Node, output) -> Value:
    how = do.MATHS.get(node.operation)
    if how is None:
        raise node.unread(f"operation {node.operation.lower()}")
    result = function_of(how, *(node.input(k) for k in range(3)))
    return function_of(do.saturated, result) if node.use_clamp else result


def _vector_math(nodes: Nodes, node: Node, output) -> Value:
    if node.operation == "SCALE":
        return function_of(lambda a, b: a * b, node.input(0), node.input("Scale"))
    how = do.VECTOR_MATHS.get(node.operation)
    if how is None:
        raise node.unread(f"operation {node.operation.lower()}")
    return function_of(how, *(node.input(k) for k in range(3)))


def _mapping(nodes: Nodes, node: Node, output) -> Value:
    none = constant(0, 0, 0)
    location = node.input("Location") if node.vector_type in {"POINT", "TEXTURE"} else none
    return function_of(partial(do.mapped, node.vector_type), node.input("Vector"), location, node.input("Rotation"),
                       node.input("Scale"))  # fmt: skip


def _map_range(nodes: Nodes, node: Node, output) -> Value:
    if node.interpolation_type != "LINEAR" or node.data_type != "FLOAT":
        raise node.unread("other than linear, of a value")
    names = "Value", "From Min", "From Max", "To Min", "To Max"
    inputs = [node.input(name) for name in names]
    mapped = function_of(do.map_range, *inputs)
    if not node.clamp:
        return mapped
    return function_of(lambda x, a, b: np.clip(x, np.minimum(a, b), np.maximum(a, b)), mapped, *inputs[3:])


def _clamp(nodes: Nodes, node: Node, output) -> Value:
    inputs = [node.input(name) for name in ("Value", "Min", "Max")]
    if node.clamp_type == "RANGE":
        return function_of(lambda x, a, b: np.clip(x, np.minimum(a, b), np.maximum(a, b)), *inputs)
    return function_of(lambda x, a, b: np.minimum(np.maximum(x, a), b), *inputs)


def _separate(nodes: Nodes, node: Node, output) -> Value:
    if getattr(node.node, "mode", "RGB") != "RGB":
        raise node.unread(f"mode {node.mode}")
    index = [socket.identifier for socket in node.outputs].index(output.identifier)
    return channel(node.input(0), index)


def _combine(nodes: Nodes, node: Node, output) -> Value:
    if getattr(node.node, "mode", "RGB") != "RGB":
        raise node.unread(f"mode {node.mode}")
    return function_of(lambda *parts: np.concatenate(np.broadcast_arrays(*parts)), *(node.input(k) for k in range(3)))


def _curve(nodes: Nodes, node: Node, output) -> Value:
    """RGB Curves: the combined curve, then that of each channel, as Cycles tabulates them: between the outermost points
    of the four curves. Beyond these the tables go on as lines, or as constants.
    """
    mapping = node.mapping
    mapping.initialize()
    ends = [(curve.points[0].location[0], curve.points[-1].location[0]) for curve in mapping.curves]
    low, high = min(first for first, _ in ends), max(last for _, last in ends)
    *channels, combined = mapping.curves
    between = [mapping.evaluate(combined, x) for x in np.linspace(low, high, TABLE_ENTRIES)]
    tables = [np.array([[mapping.evaluate(curve, x) for x in between]]) for curve in channels]
    goes_on = mapping.extend == "EXTRAPOLATED"

    def curved(color: np.ndarray) -> np.ndarray:
        places = (color - low) / (high - low)
        return np.concatenate([
            do.looked_up(table, True, places[k : k + 1], goes_on) for k, table in enumerate(tables)
        ])  # fmt: skip

    color = node.input("Color")
    return function_of(do.mix, node.input(0), color, function_of(curved, color))


READ = {
    "ShaderNodeRGB": lambda nodes, node, output: own_value(output),
    "ShaderNodeValue": lambda nodes, node, output: own_value(output),
    "ShaderNodeTexImage": _image,
    "ShaderNodeTexChecker": _checker,
    "ShaderNodeTexCoord": _coordinates,
    "ShaderNodeUVMap": _map,
    "ShaderNodeVertexColor": lambda nodes, node, output: _color_layer(nodes, node.layer_name, output.name),
    "ShaderNodeAttribute": _attribute,
    "ShaderNodeLightPath": _light_path,
    "ShaderNodeMix": _mix,
    "ShaderNodeMixRGB": _mix_rgb,
    "ShaderNodeValToRGB": _ramp,
    "ShaderNodeMath": _math,
    "ShaderNodeVectorMath": _vector_math,
    "ShaderNodeMapping": _mapping,
    "ShaderNodeMapRange": _map_range,
    "ShaderNodeClamp": _clamp,
    "ShaderNodeSeparateColor": _separate,
    "ShaderNodeSeparateXYZ": _separate,
    "ShaderNodeCombineColor": _combine,
    "ShaderNodeCombineXYZ": _combine,
    "ShaderNodeRGBCurve": _curve,
    "ShaderNodeRGBToBW": lambda nodes, node, output: node.input("Color", "VALUE"),
    "ShaderNodeGamma": lambda nodes, node, output: function_of(do.gamma, node.input("Color"), node.input("Gamma")),
    "ShaderNodeInvert": lambda nodes, node, output: function_of(
        lambda factor, color: do.mix(factor, color, 1 - color), node.input("Fac"), node.input("Color")
    ),
    "ShaderNodeBrightContrast": lambda nodes, node, output: function_of(
        do.bright_contrast, *map(node.input, ("Color", "Bright", "Contrast"))
    ),
    "ShaderNodeHueSaturation": lambda nodes, node, output: function_of(
        do.hue_saturation, *map(node.input, ("Color", "Hue", "Saturation", "Value", "Fac"))
    ),
}
"""The nodes of materials that give numbers and are read, by type."""

READ_OF_WORLDS = READ | {"ShaderNodeTexCoord": _world_coordinates, "ShaderNodeTexEnvironment": _environment}
"""Those of worlds."""
