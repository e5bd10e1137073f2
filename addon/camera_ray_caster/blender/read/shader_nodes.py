"""The shader nodes of materials: their transparency and their colors.

A shader is a sum of parts with weights: Mix Shader weights two by its factor, Add Shader adds. Transparency is the sum
of the weighted colors of Transparent BSDFs and of what the alpha of Principled BSDFs leaves; alpha is 1 less its mean,
as in Cycles. The colors of the other parts are weighted sums over alpha: the surface that is hit is shown unblended.
"""

from typing import NamedTuple

from ...core.materials.operations import saturated
from ...core.materials.values import Constant, Value, constant, function_of, mean
from .nodes import Node, Nodes, Unread

COLORS = {
    "ShaderNodeBsdfDiffuse": "Color",
    "ShaderNodeBsdfAnisotropic": "Color",
    "ShaderNodeBsdfGlass": "Color",
    "ShaderNodeBsdfRefraction": "Color",
    "ShaderNodeBsdfTranslucent": "Color",
    "ShaderNodeBsdfToon": "Color",
    "ShaderNodeBsdfSheen": "Color",
    "ShaderNodeBsdfMetallic": "Base Color",
    "ShaderNodeSubsurfaceScattering": "Color",
}
"""Shaders that show one color in light, by type, and the name of its socket."""

EMISSIONS = {"ShaderNodeEmission", "ShaderNodeBackground"}
PRINCIPLED, TRANSPARENT, HOLDOUT = "ShaderNodeBsdfPrincipled", "ShaderNodeBsdfTransparent", "ShaderNodeHoldout"
MIX, ADD = "ShaderNodeMixShader", "ShaderNodeAddShader"
SHADERS = {*COLORS, *EMISSIONS, PRINCIPLED, TRANSPARENT, HOLDOUT, MIX, ADD}
"""The nodes that give shaders and are read, by type."""


class ShaderParts(NamedTuple):
    """Weighted sums of the parts of a shader; None for 0."""

    lit: Value | None = None
    """Color in light."""
    emission: Value | None = None
    """Color of emission, before its strength."""
    glow: Value | None = None
    """Emission."""


def transparency(nodes: Nodes, socket, groups: tuple) -> Value | None:
    """Return what the shader at a socket lets through, three channels or one; None for nothing. Raises Unread."""
    source, output, groups = nodes.source(socket, groups)
    if source is None or output.type != "SHADER":
        return None
    node = Node(nodes, source, groups)
    return nodes.once(node, "transparency", lambda: _transparency(nodes, node))


def _transparency(nodes: Nodes, node: Node) -> Value | None:
    kind = node.bl_idname
    if kind == TRANSPARENT:
        return node.input("Color")
    if kind == PRINCIPLED:
        alpha = node.input("Alpha")
        transmission = function_of(lambda values: 1 - saturated(values), alpha)
        return None if isinstance(transmission, Constant) and not transmission.values.any() else transmission
    if kind in {MIX, ADD}:
        parts = [transparency(nodes, node.inputs[k], node.groups) for k in shaders(kind)]
        return None if parts == [None, None] else _combined(node, *parts)
    if kind in {"ShaderNodeGroup", "ShaderNodeCustomGroup", "ShaderNodeBsdfRayPortal", "ShaderNodeShaderToRGB"}:
        raise Unread(f"node {node.name!r} ({node.bl_rna.name})")
    return None


def colors(nodes: Nodes, socket, groups: tuple, weighs: bool) -> ShaderParts:
    """Return the colors of the shader at a socket. ``weighs``: whether the alpha of Principled BSDFs weights theirs.
    Raises Unread.
    """
    source, output, inner = nodes.source(socket, groups)
    if output.type != "SHADER":  # Cycles lets it emit
        value = nodes.value(socket, groups, "RGBA")
        return ShaderParts(None, value, value)
    if source is None:
        return ShaderParts()
    node = Node(nodes, source, inner)
    return nodes.once(node, f"colors {weighs}", lambda: _colors(nodes, node, weighs))


def _colors(nodes: Nodes, node: Node, weighs: bool) -> ShaderParts:
    kind = node.bl_idname
    if kind in {TRANSPARENT, HOLDOUT}:
        return ShaderParts()
    if kind == PRINCIPLED:
        return _principled(node, weighs)
    if kind in COLORS:
        if getattr(node.node, "fresnel_type", "F82") != "F82":
            raise node.unread("physical conductor")
        return ShaderParts(node.input(COLORS[kind]))
    if kind in EMISSIONS:
        color = node.input("Color")
        return ShaderParts(None, color, function_of(lambda a, b: a * b, color, node.input("Strength")))
    if kind in {MIX, ADD}:
        first, second = (colors(nodes, node.inputs[k], node.groups, weighs) for k in shaders(kind))
        return ShaderParts(*(None if color is other_color is None else _combined(node, color, other_color)
                       for color, other_color in zip(first, second, strict=True)))  # fmt: skip
    raise Unread(f"node {node.name!r} ({node.bl_rna.name})")


def _principled(node: Node, weighs: bool) -> ShaderParts:
    alpha, strength = node.input("Alpha") if weighs else constant(1), node.input("Emission Strength")
    parts = [node.input("Base Color"), None]
    if not (isinstance(strength, Constant) and not strength.values.any()):
        parts[1] = function_of(lambda a, b: a * b, node.input("Emission Color"), strength)
    if not (isinstance(alpha, Constant) and (alpha.values >= 1).all()):
        parts = [color and function_of(lambda a, b: a * saturated(b), color, alpha) for color in parts]
    return ShaderParts(parts[0], None, parts[1])


def shaders(kind: str) -> tuple[int, int]:
    """Return the places of the shaders among the inputs of a Mix or an Add Shader."""
    return (1, 2) if kind == MIX else (0, 1)


def _combined(node: Node, first: Value | None, second: Value | None) -> Value:
    """Return the sum of two values, weighted by the factor of a Mix Shader; None counts as 0."""
    first, second = first or constant(0), second or constant(0)
    if node.bl_idname == ADD:
        return function_of(lambda a, b: a + b, first, second)
    return function_of(lambda f, a, b: (1 - saturated(f)) * a + saturated(f) * b, node.input("Fac"), first, second)


def alpha_of(through: Value) -> Value:
    """Return the alpha of a surface that lets this part of the light through."""
    return mean(function_of(lambda values: saturated(1 - values), through))
