"""What the output of a material has beside its surface: a volume, a displacement, and bumps."""

from collections.abc import Iterator

from ...core.materials.values import function_of
from ...core.shapes.mesh.displaced import Displacement
from .nodes import Node, Nodes, Output, Unread
from .value_nodes import READ

BUMPS = {"ShaderNodeBump", "ShaderNodeNormalMap", "ShaderNodeBevel"}
"""The nodes that change normals, by type."""

SHIFTS = {"ShaderNodeDisplacement": "Height", "ShaderNodeVectorDisplacement": "Vector"}
"""The nodes that displace, by type, and their input."""


def is_volume_alone(output: Output) -> bool:
    """Return whether a material's output has a volume and no surface. Cycles' rays pass through such a material."""
    nodes = Nodes({})
    volume, surface = (nodes.source(*output[name])[0] for name in ("Volume", "Surface"))
    return volume is not None and surface is None


def displacement_of(material, output: Output) -> tuple[Displacement | None, frozenset[str]]:
    """Return the true displacement of a material, None without one, and what it needs of the mesh: see ``Nodes.needs``.

    Raises Unread. Camera rays, which a Light Path node could ask for, have no part in a displacement.
    """
    nodes = Nodes({kind: how for kind, how in READ.items() if kind != "ShaderNodeLightPath"})
    source, _, groups = nodes.source(*output["Displacement"])
    if source is None or material.displacement_method == "BUMP":
        return None, frozenset()
    node = Node(nodes, source, groups)
    if node.bl_idname not in SHIFTS:
        raise Unread(f"node {node.name!r} ({node.bl_rna.name})")
    if node.space != "OBJECT":
        raise node.unread(f"{node.space.lower()} space")
    if "Normal" in node.inputs and node.is_linked("Normal"):
        raise node.unread("a normal of its own")
    inputs = (node.input(name) for name in (SHIFTS[node.bl_idname], "Midlevel", "Scale"))
    offset = function_of(lambda offset, middle, scale: (offset - middle) * scale, *inputs)
    return Displacement(offset, material.displacement_method == "DISPLACEMENT"), frozenset(nodes.needs)


def has_bump(material, output: Output) -> bool:
    """Return whether a material changes the normals of its surface: by its nodes, or by a displacement that is bump."""
    bumps = material.displacement_method != "DISPLACEMENT" and output["Displacement"][0].is_linked
    nodes = (node for node in _nodes(material.node_tree, set()) if node.bl_idname in BUMPS and not node.mute)
    return bumps or any(socket.is_linked for node in nodes for socket in node.outputs)


def _nodes(tree, known: set) -> Iterator:
    """Yield the nodes of a tree, and once those of the groups in it."""
    known.add(tree)
    for node in tree.nodes:
        yield node
        inner = node.node_tree if node.type == "GROUP" else None
        if inner is not None and inner not in known:
            yield from _nodes(inner, known)
