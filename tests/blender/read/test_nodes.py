"""Every shader node of Blender is either read or named; and node trees as files may have them."""

import re
from pathlib import Path

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read import images, materials
from camera_ray_caster.blender.read.scene import read_camera, read_shapes
from camera_ray_caster.blender.read.shader_nodes import SHADERS
from camera_ray_caster.blender.read.value_nodes import READ
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import MESH, PLANE, SPHERE

from .scene_parts import ball, new_object

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


@pytest.fixture
def surface():
    """The nodes, the function that links, the output and the material of a square with a UV map that is seen."""
    mesh = bpy.data.meshes.new("Square")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new().uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
    new_object("Square", mesh)
    scene = bpy.context.scene
    scene.camera = new_object("Camera", bpy.data.cameras.new("Camera"))
    scene.camera.location.z = 3
    scene.render.resolution_x = scene.render.resolution_y = 16
    made = bpy.data.materials.new("Paint")
    if bpy.app.version < (5, 0):
        made.use_nodes = True
    made.diffuse_color = 0.25, 0.5, 0.75, 1
    made.node_tree.nodes.clear()
    mesh.materials.append(made)
    new, link = made.node_tree.nodes.new, made.node_tree.links.new
    return new, link, new("ShaderNodeOutputMaterial"), made


def shown():
    """The albedo in the middle of the picture, and the names and reasons of what is left out."""
    shapes = read_shapes(bpy.context.scene)
    image = cast(read_camera(bpy.context.scene), shapes, "albedo")["albedo"]
    return image[8, 8], (*shapes.left_out, *shapes.unread)


def names_of(kinds):
    known = (getattr(bpy.types, kind, None) for kind in kinds)
    return {NAMES.get(one.bl_rna.name, one.bl_rna.name) for one in known if one is not None}


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
        for one in list(made.node_tree.nodes):
            if one != out:
                made.node_tree.nodes.remove(one)
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


def textured(surface, image):
    new, link, out, _ = surface
    node, shader = new("ShaderNodeTexImage"), new("ShaderNodeBsdfDiffuse")
    node.image = image
    link(node.outputs[0], shader.inputs["Color"])
    link(shader.outputs[0], out.inputs["Surface"])
    return node


def new_image(size=4, color=(0.5, 0.25, 1.0, 1.0), **options):
    image = bpy.data.images.new("Image", size, size, **options)
    image.pixels.foreach_set(np.tile(np.float32(color), size * size))
    image.update()
    return image


VIEWPORT, MAGENTA = (0.25, 0.5, 0.75), (1, 0, 1)


def removed(image):
    image.source, image.filepath = "FILE", "//nowhere.png"


def not_finite(image):
    image.pixels.foreach_set(np.tile(np.float32([np.nan, 0.25, np.inf, 1]), 16))
    image.update()


@pytest.mark.parametrize(
    ("options", "change", "expected", "word"),
    [
        ({"float_buffer": True}, None, (0.5, 0.25, 1), ""),
        ({"float_buffer": True}, not_finite, (0, 0.25, 0), ""),
        ({}, removed, MAGENTA, "missing"),
        ({}, lambda image: setattr(image, "source", "MOVIE"), VIEWPORT, "movie"),
        ({}, lambda image: setattr(image, "source", "SEQUENCE"), VIEWPORT, "sequence"),
        ({}, lambda image: setattr(image, "source", "TILED"), VIEWPORT, "UDIM"),
        ({}, lambda image: setattr(image.colorspace_settings, "name", "Non-Color"), (0.5, 0.25, 1), ""),
    ],
    ids=["float", "texels that are not finite", "missing", "movie", "sequence", "tiles", "data"],
)
def test_an_image_of_any_kind_is_read_or_named(surface, options, change, expected, word):
    image = new_image(**options)
    textured(surface, image)
    if change:
        change(image)
    color, left_out = shown()
    np.testing.assert_allclose(color, expected, atol=1 / 255)
    assert word in " ".join(reason for _, reason in left_out)
    assert bool(left_out) == bool(word)


def test_an_image_of_too_many_texels_is_named_and_not_read(surface, monkeypatch):
    monkeypatch.setattr(images, "MOST_TEXELS", 15)
    textured(surface, new_image())
    color, left_out = shown()
    np.testing.assert_allclose(color, VIEWPORT, atol=1e-6)
    ((name, reason),) = left_out
    assert name == "Paint"
    assert "'Image' has 16 texels" in reason


def test_an_image_without_memory_is_named(surface, monkeypatch):
    monkeypatch.setattr(images.memory, "available", lambda: 100)
    monkeypatch.setattr(images.memory, "ALWAYS_THERE", 0)
    textured(surface, new_image())
    shapes = read_shapes(bpy.context.scene)
    assert "GiB of memory" in dict(shapes.unread)["Paint"]


def test_a_painted_image_is_read_again_and_others_once(surface, monkeypatch):
    read, found = [], images._read
    monkeypatch.setattr(images, "_read", lambda image: read.append(image.name) or found(image))
    image = new_image()
    image.pack()
    textured(surface, image)
    first = [shown()[0][0] for _ in range(2)]
    assert first[0] == first[1]
    assert read == ["Image"]
    image.pixels.foreach_set(np.tile(np.float32([1, 1, 1, 1]), 16))
    image.update()
    assert shown()[0][0] == 1
    image.pack()
    assert shown()[0][0] == 1


def test_two_materials_share_the_texels_of_an_image(surface):
    """Also of a node that asks for alpha."""
    node = textured(surface, new_image())
    item = bpy.data.objects["Square"]
    other = item.copy()
    other.data = item.data.copy()
    bpy.context.scene.collection.objects.link(other)
    other.data.materials[0] = surface[3].copy()
    shapes = read_shapes(bpy.context.scene)
    assert node.image is not None
    first, second = (surface.lit.inputs[0].inputs[0].image for surface in shapes.surfaces)
    assert first is second


def test_a_uv_map_that_was_deleted_is_zero(surface):
    """The corner of the image, as in Cycles; the same without any map."""
    new, link, _, _ = surface
    image = new_image()
    pixels = np.tile(np.float32([0, 0, 0, 1]), (16, 1))
    pixels[[0, 3, 12, 15]] = 0.5, 0.25, 1, 1
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    node, uv = textured(surface, image), new("ShaderNodeUVMap")
    uv.uv_map = "Deleted"
    link(uv.outputs[0], node.inputs["Vector"])
    linear = ((np.array([127 / 255, 64 / 255, 1]) + 0.055) / 1.055) ** 2.4
    np.testing.assert_allclose(shown()[0], linear, atol=0.01)
    surface[3].node_tree.links.remove(node.inputs["Vector"].links[0])
    layers = bpy.data.objects["Square"].data.uv_layers
    layers.remove(layers[0])
    bpy.data.objects["Square"].data.update()
    np.testing.assert_allclose(shown()[0], linear, atol=0.01)


def test_what_a_material_needs_decides_whether_a_shape_stays_exact(surface):
    """The render UV map is there on exact shapes; color attributes only on meshes."""
    new, link, _, made = surface
    item = ball("Ball")
    item.data.uv_layers.remove(item.data.uv_layers[0])
    node = textured(surface, new_image())
    item.data.materials.append(made)
    assert set(read_shapes(bpy.context.scene).kind) == {PLANE, SPHERE}
    link(new("ShaderNodeVertexColor").outputs[0], node.outputs[0].links[0].to_socket)
    assert set(read_shapes(bpy.context.scene).kind) == {MESH}


def test_many_nodes_in_a_row_and_shaders_that_share_their_parts_are_read_in_no_time(surface):
    """Forty Mix Shaders, each of the one before twice; and more nodes in a row than are followed are named."""
    new, link, out, _ = surface
    last = new("ShaderNodeBsdfDiffuse")
    last.inputs["Color"].default_value = 0.5, 0.25, 0.125, 1
    for _ in range(40):
        mix = new("ShaderNodeMixShader")
        for place in (1, 2):
            link(last.outputs[0], mix.inputs[place])
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


def test_an_image_that_is_missing_is_named_where_its_alpha_decides_what_is_hit(surface):
    """Also without any pass of colors."""
    new, link, out, _ = surface
    node, shader = new("ShaderNodeTexImage"), new("ShaderNodeBsdfPrincipled")
    node.image = new_image()
    removed(node.image)
    link(node.outputs["Alpha"], shader.inputs["Alpha"])
    link(shader.outputs[0], out.inputs["Surface"])
    shapes = read_shapes(bpy.context.scene)
    assert shapes.left_out == (("Paint", "its image 'Image' is missing: its alpha is 1"),)
    assert not shapes.unread
