"""Images of materials as files may have them: each is read or named, and read once."""

import tracemalloc

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.engine.job import Job
from camera_ray_caster.blender.read import texels
from camera_ray_caster.blender.read.scene_reader import read_shapes
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
    monkeypatch.setattr(texels, "MOST_TEXELS", 15)
    textured(surface, new_image())
    color, left_out = shown()
    np.testing.assert_allclose(color, VIEWPORT, atol=1e-6)
    ((name, reason),) = left_out
    assert name == "Paint"
    assert "'Image' has 16 texels" in reason


def test_an_image_without_memory_is_named(surface, monkeypatch):
    monkeypatch.setattr(texels.memory, "available", lambda: 100)
    monkeypatch.setattr(texels.memory, "ALWAYS_THERE", 0)
    textured(surface, new_image())
    shapes = read_shapes(bpy.context.scene)
    assert "GiB of memory" in dict(shapes.unread)["Paint"]


@pytest.mark.parametrize("alpha", ["STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE"])
@pytest.mark.parametrize("is_packed", [False, True])
def test_the_texels_of_a_file_are_blenders_pixels(tmp_path, alpha, is_packed):
    """Also where they come from the file, past Blender's pixels; rows and columns are of different numbers."""
    made, path = bpy.data.images.new("Made", 7, 5, alpha=True), tmp_path / "image.png"
    made.pixels.foreach_set(np.random.default_rng(1).random(7 * 5 * 4, np.float32))
    made.filepath_raw, made.file_format = str(path), "PNG"
    made.save()
    image = bpy.data.images.load(str(path), check_existing=False)
    if is_packed:
        image.pack()
    image.alpha_mode = alpha
    pixels = np.array(image.pixels).reshape(5, 7, 4)
    if alpha == "NONE":
        pixels[..., 3] = 1
    if alpha in {"STRAIGHT", "PREMUL"}:
        pixels[..., :3] *= pixels[..., 3:]
    np.testing.assert_array_equal(texels.image_of(image).texels, np.rint(pixels * 255))


def test_reading_an_image_takes_the_memory_that_it_asks_for(tmp_path, monkeypatch):
    asked, size = [], 1024
    monkeypatch.setattr(texels.memory, "require", lambda needed, *_: asked.append(needed))
    monkeypatch.setattr(texels, "STRIP", 1 << 12)
    made, path = bpy.data.images.new("Made", size, size, alpha=True), tmp_path / "image.png"
    made.filepath_raw, made.file_format = str(path), "PNG"
    made.save()
    image = bpy.data.images.load(str(path), check_existing=False)
    tracemalloc.start()
    try:
        image_bytes = texels.image_of(image).texels.nbytes
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    outside = 4 * size**2 if texels.HAS_BYTES else 0  # Blender's loader, which Python does not see
    strips = 64 * texels.STRIP + (1 << 16)
    assert image_bytes == 4 * size**2
    assert asked == [(8 if texels.HAS_BYTES else 16) * size**2]
    assert asked[0] <= peak + outside + strips
    assert peak + outside <= asked[0] + strips


def test_images_are_read_where_a_pass_shows_them_or_they_decide_what_is_hit(surface, monkeypatch):
    read, original = [], texels._read
    monkeypatch.setattr(texels, "_read", lambda image: read.append(image.name) or original(image))
    new, link, out, _ = surface
    shader = new("ShaderNodeBsdfPrincipled")
    for name, socket in (("Color", "Base Color"), ("Alpha", "Alpha")):
        node = new("ShaderNodeTexImage")
        node.image = new_image(color=(1, 0.5, 0.25, 0.75))
        node.image.name = name
        link(node.outputs[name], shader.inputs[socket])
    link(shader.outputs[0], out.inputs["Surface"])
    world = bpy.context.scene.world = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0):
        world.use_nodes = True
    sky = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    sky.image = new_image()
    sky.image.name = "Sky"
    world.node_tree.links.new(sky.outputs[0], world.node_tree.nodes["Background"].inputs["Color"])

    def images_of(*passes):
        read.clear()
        texels.forget()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        job = Job.read(depsgraph, bpy.context.scene.camera, passes)
        cast, report = job.cast()
        assert not report.left_out
        return sorted(read), cast

    names, alone = images_of("depth", "uv", "shape_index")
    assert names == ["Alpha"]
    for passes in (("albedo",), ("depth", "combined", "uv", "shape_index"), ()):
        names, others = images_of(*passes)
        assert names == ["Alpha", "Color", "Sky"]
    names, others = images_of("depth", "combined", "uv", "shape_index")
    for name in alone:
        np.testing.assert_array_equal(alone[name], others[name])


def test_a_painted_image_is_read_again_and_others_once(surface, monkeypatch):
    read, original = [], texels._read
    monkeypatch.setattr(texels, "_read", lambda image: read.append(image.name) or original(image))
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
