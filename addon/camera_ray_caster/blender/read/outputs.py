"""What the output of a material has beside its surface: a volume, and bumps."""

from collections.abc import Iterator

from .nodes import Nodes

BUMPS = {"ShaderNodeBump", "ShaderNodeNormalMap", "ShaderNodeBevel"}
"""The nodes that change normals, by type."""


def is_volume_alone(output) -> bool:
    """Return whether a material's output has a volume and no surface. Cycles' rays pass through such a material."""
    nodes = Nodes({})
    volume, surface = (nodes.source(output.inputs[name], ())[0] for name in ("Volume", "Surface"))
    return volume is not None and surface is None


def has_bump(material, output) -> bool:
    """Return whether a material changes the normals of its surface: by its nodes, or by a displacement that is bump."""
    bumps = material.displacement_method != "DISPLACEMENT" and output.inputs["Displacement"].is_linked
    return bumps or any(_in_use(node) for node in _nodes(material.node_tree, set()))


def _in_use(node) -> bool:
    return node.bl_idname in BUMPS and not node.mute and any(socket.is_linked for socket in node.outputs)


def _nodes(tree, known: set) -> Iterator:
    """Yield the nodes of a tree, and once those of the groups in it."""
    known.add(tree)
    for node in tree.nodes:
        yield node
        inner = node.node_tree if node.type == "GROUP" else None
        if inner is not None and inner not in known:
            yield from _nodes(inner, known)
