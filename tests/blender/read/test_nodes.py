"""Every shader node of Blender is either read or named; and node trees as files may have them."""

import re
from pathlib import Path

import bpy
import numpy as np

from camera_ray_caster.blender.read import materials
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.blender.read.shader_nodes import SHADERS
from camera_ray_caster.blender.read.value_nodes import READ
from camera_ray_caster.core.cast import cast

PAGE = Path(materials.__file__).with_name("README.md")

NODES = sorted(
    name for name in dir(bpy.types)
    if name.startswith("ShaderNode") and name not in {"ShaderNode", "ShaderNodeTree", "ShaderNodeCustomGroup"}
    and not name.startswith("ShaderNodeOutput")
)  # fmt: skip

OTHERWISE = {"ShaderNodeGroup"}
"""What is followed, and gives nothing by itself."""

NAMES = {"RGB": "Color"}
"""Names in Blender 4.5 that are others in the page."""


def shown():
    """The albedo in the middle of the picture, and the names and reasons of what is left out."""
    shapes = read_shapes(bpy.context.scene)
    image = cast(read_camera(bpy.context.scene), shapes, passes="albedo")["albedo"]
    return image[8, 8], (*shapes.left_out, *shapes.unread)


def names_of(kinds):
    known = (getattr(bpy.types, kind, None) for kind in kinds)
    return {NAMES.get(item.bl_rna.name, item.bl_rna.name) for item in known if item is not None}


def test_the_page_lists_what_is_read():
    rows = re.findall(r"^\| ([^|]+) \|", PAGE.read_text(), re.MULTILINE)
    listed = {name for row in rows for name in row.split(", ")} - {"node"}
    assert listed == names_of({*READ, *SHADERS})


def test_every_node_is_read_or_named(surface):
    """In the place of a shader, or as the color of one, with what its first output gives."""
    new, link, out, made = surface
    unclear = []
    for kind in NODES:
        try:
            node = new(kind)
        except RuntimeError:
            continue  # of no use in a material
        target = out.inputs["Surface"]
        if node.outputs and node.outputs[0].type != "SHADER":
            shader = new("ShaderNodeBsdfDiffuse")
            link(shader.outputs[0], target)
            target = shader.inputs["Color"]
        if not node.outputs:
            continue
        link(node.outputs[0], target)
        _, left_out = shown()
        reasons = [reason for name, reason in left_out if name == "Paint"]
        is_named = any(f"({node.bl_rna.name})" in reason or "missing" in reason for reason in reasons)
        if is_named == (kind in READ or kind in SHADERS) and kind not in {*OTHERWISE, "ShaderNodeTexImage"}:
            unclear.append((kind, reasons))
        for old_node in list(made.node_tree.nodes):
            if old_node != out:
                made.node_tree.nodes.remove(old_node)
    assert not unclear


def test_a_loop_of_nodes_is_named(surface):
    new, link, out, _ = surface
    shader, first, second = new("ShaderNodeBsdfDiffuse"), new("ShaderNodeGamma"), new("ShaderNodeInvert")
    link(shader.outputs[0], out.inputs["Surface"])
    link(first.outputs[0], shader.inputs["Color"])
    link(second.outputs[0], first.inputs["Color"])
    link(first.outputs[0], second.inputs["Color"])
    color, left_out = shown()
    np.testing.assert_allclose(color, (0.25, 0.5, 0.75), atol=1e-6)
    ((name, reason),) = left_out
    assert (name, "loop" in reason) == ("Paint", True)


def test_reroutes_muted_nodes_and_unlinked_inputs_of_groups_are_followed(surface):
    new, link, out, _ = surface
    tree = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    tree.interface.new_socket("Color", in_out="INPUT", socket_type="NodeSocketColor")
    tree.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
    inside, outside = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    tree.links.new(inside.outputs[0], outside.inputs[0])
    group, muted, reroute, shader = (
        new(kind) for kind in ("ShaderNodeGroup", "ShaderNodeGamma", "NodeReroute", "ShaderNodeBsdfDiffuse")
    )
    group.node_tree, muted.mute, muted.inputs["Gamma"].default_value = tree, True, 3.0
    group.inputs[0].default_value = 0.5, 0.25, 0.125, 1
    link(group.outputs[0], muted.inputs["Color"])
    link(muted.outputs[0], reroute.inputs[0])
    link(reroute.outputs[0], shader.inputs["Color"])
    link(shader.outputs[0], out.inputs["Surface"])
    color, left_out = shown()
    np.testing.assert_allclose(color, (0.5, 0.25, 0.125), atol=1e-6)
    assert not left_out


def test_many_nodes_in_a_row_and_shaders_that_share_their_parts_are_read_in_no_time(surface):
    """Forty Mix Shaders, each of the one before twice; and more nodes in a row than are followed are named."""
    new, link, out, _ = surface
    last = new("ShaderNodeBsdfDiffuse")
    last.inputs["Color"].default_value = 0.5, 0.25, 0.125, 1
    for _ in range(40):
        mix = new("ShaderNodeMixShader")
        for number in (1, 2):
            link(last.outputs[0], mix.inputs[number])
        last = mix
    link(last.outputs[0], out.inputs["Surface"])
    color, left_out = shown()
    np.testing.assert_allclose(color, (0.5, 0.25, 0.125), atol=1e-6)
    assert not left_out
    shader = last = new("ShaderNodeBsdfDiffuse")
    for _ in range(300):
        node = new("ShaderNodeGamma")
        link(node.outputs[0], last.inputs["Color"])
        last = node
    link(shader.outputs[0], out.inputs["Surface"])
    ((_, reason),) = shown()[1]
    assert "more than 100 nodes in a row" in reason
