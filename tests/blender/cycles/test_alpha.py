"""What materials leave transparent is not hit, as in the passes of Cycles: every pixel away from an alpha edge."""

from pathlib import Path

import bpy as bpy_module
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from ...exr import read_exr
from .cycles import _prepare

SIZE = 96
FROM_5_0 = bpy_module.app.version >= (5, 0)


@pytest.fixture
def scene(blender):
    """A camera at 5 above the origin, looking down."""
    scene = blender.context.scene
    scene.camera = blender.data.objects.new("Camera", blender.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.camera.location.z = 5
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    return scene


def cycles(scene, *names):
    """Yield passes of Cycles at pixel centers, (h, w, channels) each; Depth is inf where nothing is hit."""
    _prepare(scene)
    layer, settings = scene.view_layers[0], scene.render.image_settings
    for name in ("z", "position", "normal", "uv", "object_index", "diffuse_color", "glossy_color", "emit",
                 "transmission_color"):  # fmt: skip
        setattr(layer, f"use_pass_{name}", True)
    if FROM_5_0:
        settings.media_type, settings.use_exr_interleave = "MULTI_LAYER_IMAGE", True
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    bpy_module.ops.render.render(write_still=True, scene=scene.name)
    layers = {}
    for key, values in read_exr(Path(scene.render.filepath)).items():
        layers.setdefault(key.rsplit(".", 2)[-2], {})[key[-1]] = values
    kinds = {"IndexOB": "Object Index", "DiffCol": "Diffuse Color", "GlossCol": "Glossy Color", "Emit": "Emission",
             "TransCol": "Transmission Color"}  # fmt: skip
    layers = {kinds.get(key, key): values for key, values in layers.items()}
    for name in names:
        channels = layers[name]
        values = np.stack([channels[letter] for letter in sorted(channels, key="RGBAXYZUV".index)], axis=-1)
        yield np.where(values > 1e9, np.inf, values)


def plane(name, z, size, index=0):
    """A square with a UV map, at height z."""
    mesh = bpy_module.data.meshes.new(name)
    half = size / 2
    mesh.from_pydata([(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new().uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
    item = bpy_module.data.objects.new(name, mesh)
    item.pass_index = index
    bpy_module.context.scene.collection.objects.link(item)
    return item


def material(item, name="Material"):
    """An empty material with an output, its nodes and a function that links sockets."""
    made = bpy_module.data.materials.new(name)
    if not FROM_5_0:
        made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    item.data.materials.append(made)
    return tree.nodes.new, tree.links.new, tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"], made


def disc(name="disc", size=64, radius=20, space="sRGB"):
    """A green image with an opaque disc in its middle, packed."""
    image = bpy_module.data.images.new(name, size, size, alpha=True)
    image.colorspace_settings.name = space
    texels = np.zeros((size, size, 4), np.float32)
    y, x = np.mgrid[:size, :size] - (size - 1) / 2
    texels[..., 1], texels[..., 3] = 0.8, x * x + y * y < radius**2
    image.pixels.foreach_set(texels.ravel())
    image.pack()
    return image


def principled(new, link, out, alpha):
    """A Principled BSDF whose alpha is a number or a socket."""
    shader = new("ShaderNodeBsdfPrincipled")
    link(shader.outputs[0], out)
    if hasattr(alpha, "node"):
        link(alpha, shader.inputs["Alpha"])
    else:
        shader.inputs["Alpha"].default_value = alpha


def constant(item):
    principled(*material(item)[:3], 0.0)


def transparent(item):
    new, link, out, _ = material(item)
    link(new("ShaderNodeBsdfTransparent").outputs[0], out)


def texture(new, image):
    node = new("ShaderNodeTexImage")
    node.image = image
    return node


def image(item):
    new, link, out, _ = material(item)
    principled(new, link, out, texture(new, disc()).outputs["Alpha"])


def second_map(item):
    """Through a UV map that is not the active one, in which the image is four times as small."""
    item.data.uv_layers.new(name="Second").uv.foreach_set("vector", [-0.5, -0.5, 3.5, -0.5, 3.5, 3.5, -0.5, 3.5])
    new, link, out, _ = material(item)
    node, uv = texture(new, disc()), new("ShaderNodeUVMap")
    uv.uv_map, node.extension = "Second", "CLIP"
    link(uv.outputs[0], node.inputs["Vector"])
    principled(new, link, out, node.outputs["Alpha"])


def color_attribute(item):
    """Opaque on one side, transparent on the other."""
    item.data.color_attributes.new("Paint", "FLOAT_COLOR", "POINT").data.foreach_set(
        "color", [1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1]
    )
    new, link, out, _ = material(item)
    node = new("ShaderNodeVertexColor")
    node.layer_name = "Paint"
    steep = new("ShaderNodeMath")
    steep.operation, steep.inputs[1].default_value = "GREATER_THAN", 0.4
    link(node.outputs["Alpha"], steep.inputs[0])
    principled(new, link, out, steep.outputs[0])


def mixed(item):
    """Behind a Mix Shader, by the gray of an image turned by a Mapping node."""
    new, link, out, _ = material(item)
    node, mapping, uv = texture(new, disc(radius=12)), new("ShaderNodeMapping"), new("ShaderNodeTexCoord")
    mapping.inputs["Location"].default_value, mapping.inputs["Scale"].default_value = (0.3, 0.1, 0), (2, 1.5, 1)
    mapping.inputs["Rotation"].default_value[2] = 0.5
    link(uv.outputs["UV"], mapping.inputs[0])
    link(mapping.outputs[0], node.inputs[0])
    mix = new("ShaderNodeMixShader")
    link(node.outputs["Alpha"], mix.inputs[0])
    link(new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[1])
    link(new("ShaderNodeEmission").outputs[0], mix.inputs[2])
    link(mix.outputs[0], out)


def grouped(item):
    """A whole material inside a node group, whose input is the alpha."""
    tree = bpy_module.data.node_groups.new("Leaf", "ShaderNodeTree")
    tree.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    tree.interface.new_socket("Alpha", in_out="INPUT", socket_type="NodeSocketFloat")
    inside, outside = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    principled(tree.nodes.new, tree.links.new, outside.inputs[0], inside.outputs[0])
    new, link, out, _ = material(item)
    group = new("ShaderNodeGroup")
    group.node_tree = tree
    link(texture(new, disc()).outputs["Alpha"], group.inputs[0])
    link(group.outputs[0], out)


def glass(item):
    """What is only dyed is opaque: 0.4 of the light passes through."""
    new, link, out, _ = material(item)
    node = new("ShaderNodeBsdfTransparent")
    node.inputs[0].default_value = 0.4, 0.4, 0.4, 1
    link(node.outputs[0], out)


def added(item):
    """A flame: emission added to what is transparent is not hit."""
    new, link, out, _ = material(item)
    add = new("ShaderNodeAddShader")
    link(new("ShaderNodeBsdfTransparent").outputs[0], add.inputs[0])
    link(new("ShaderNodeEmission").outputs[0], add.inputs[1])
    link(add.outputs[0], out)


def generated(item):
    """By an image in the texture space of the object."""
    new, link, out, _ = material(item)
    node = texture(new, disc(radius=25))
    link(new("ShaderNodeTexCoord").outputs["Generated"], node.inputs[0])
    principled(new, link, out, node.outputs["Alpha"])


def in_object(item):
    """By an image in the object's space, repeated from -1 to 1."""
    new, link, out, _ = material(item)
    node = texture(new, disc(radius=25))
    link(new("ShaderNodeTexCoord").outputs["Object"], node.inputs[0])
    principled(new, link, out, node.outputs["Alpha"])


full = pytest.mark.full
MATERIALS = [
    image, pytest.param(constant, marks=full), pytest.param(transparent, marks=full), second_map, mixed, grouped,
    color_attribute, pytest.param(glass, marks=full), pytest.param(added, marks=full),
    pytest.param(generated, marks=full), pytest.param(in_object, marks=full),
]  # fmt: skip


def near_edge(index):
    """Pixels that touch another object's pixel."""
    edge = np.zeros(index.shape, bool)
    edge[1:] |= index[1:] != index[:-1]
    edge[:-1] |= index[1:] != index[:-1]
    edge[:, 1:] |= index[:, 1:] != index[:, :-1]
    edge[:, :-1] |= index[:, 1:] != index[:, :-1]
    return edge


def assert_as_cycles(scene):
    """Depth, place and index are those of Cycles, but for pixels at an edge; return the indices."""
    images = cast(read_camera(scene), read_shapes(scene), passes=("depth", "position", "object_index", "uv"))
    depth, position, index = cycles(scene, "Depth", "Position", "Object Index")
    away = ~near_edge(index[..., 0]) & ~near_edge(images["object_index"])
    assert away.mean() > 0.8
    np.testing.assert_array_equal(images["object_index"][away], index[..., 0][away])
    np.testing.assert_allclose(images["depth"][away], depth[..., 0][away], rtol=1e-5)
    np.testing.assert_allclose(images["position"][away], position[away], atol=1e-4)
    return images["object_index"]


@pytest.mark.parametrize("paint", MATERIALS, ids=lambda paint: paint.__name__)
def test_a_card_before_a_wall(scene, paint):
    paint(plane("Card", 0, 2, 1))
    plane("Wall", -2, 20, 2)
    index = assert_as_cycles(scene)
    assert (index == 2).any()
    assert (index == 1).any() != (paint in {constant, transparent, added})
    assert not read_shapes(scene).left_out


@pytest.mark.parametrize("threshold", [0.0, 0.2, 0.8])
def test_the_threshold_of_the_view_layer_decides(scene, threshold):
    """At 0 every surface is hit; at others an alpha of 0.5 is compared, of a stained glass."""
    card = plane("Card", 0, 2, 1)
    new, link, out, _ = material(card)
    node = new("ShaderNodeBsdfTransparent")
    node.inputs[0].default_value = (0.5, 0.5, 0.5, 1) if threshold else (1, 1, 1, 1)
    link(node.outputs[0], out)
    plane("Wall", -2, 20, 2)
    scene.view_layers[0].pass_alpha_threshold = threshold
    assert (assert_as_cycles(scene) == 1).any() == (threshold < 0.5)


def test_a_surface_that_is_partly_transparent_and_hit_is_noted(scene):
    for alpha in (1.0, 0.7, 0.3):
        new, link, out, _ = material(plane(f"Card {alpha}", 0, 2), f"Alpha {alpha}")
        node = new("ShaderNodeBsdfPrincipled")
        node.inputs["Alpha"].default_value = alpha
        link(node.outputs[0], out)
    ((name, note),) = read_shapes(scene).notes
    assert (name, note) == ("Alpha 0.7", "where its alpha is less than 1, but at least 0.5, it is cast as opaque")


def test_many_layers_of_leaves_and_slots(scene):
    """Five cards one behind the other, turned, of two materials by face; the last is behind them."""
    for k in range(5):
        card = plane(f"Card {k}", 0, 3, k + 1)
        card.location.z, card.rotation_euler[2], card.rotation_euler[0] = -0.5 * k, 0.3 * k, 0.1 * k
        second_map(card)
        image(card)
        card.data.polygons[0].material_index = k % 2
    plane("Wall", -4, 30, 9)
    assert len(np.unique(assert_as_cycles(scene))) == 5  # one is hidden


def test_what_cannot_be_read_is_opaque_and_named(scene):
    card = plane("Card", 0, 2, 1)
    new, link, out, _ = material(card, "Smoke")
    principled(new, link, out, new("ShaderNodeTexNoise").outputs[0])
    shapes = read_shapes(scene)
    assert len(shapes) == 1
    ((name, reason),) = shapes.left_out
    assert name == "Smoke"
    assert "alpha" in reason
    assert "Noise Texture" in reason
