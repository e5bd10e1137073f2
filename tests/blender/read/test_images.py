"""Images of materials as files may have them: each is read or named, and read once."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read import images
from camera_ray_caster.blender.read.scene import read_shapes
from camera_ray_caster.core.records import MESH, PLANE, SPHERE

from .scene_parts import ball
from .test_nodes import shown


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


def as_data(image):
    image.pack()  # another color space is loaded anew
    image.colorspace_settings.name = "Non-Color"


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
        ({}, as_data, (0.5, 0.25, 1), ""),
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
