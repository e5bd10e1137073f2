"""The preview's light against Cycles' own, on a diffuse wall that no shadow reaches."""

import bpy as bpy_module
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from .cycles import cycles_passes
from .test_alpha import material, plane, scene  # noqa: F401

TOLERANCE = 0.01
"""Of the brightest pixel. A lamp of 0.05 at a distance of 2 is nearly a point: where Cycles' one sample is in it moves
the light by 0.01.
"""


def lamp(kind, **settings):
    data = bpy_module.data.lights.new(kind, kind)
    item = bpy_module.data.objects.new(kind, data)
    bpy_module.context.scene.collection.objects.link(item)
    item.location, item.rotation_euler = (0.7, -0.3, 2), (0.3, 0.2, 0.5)
    for key, value in settings.items():
        setattr(data, key, value)
    return item


LAMPS = {
    "spot": ("SPOT", {"energy": 200, "spot_size": 1.0, "spot_blend": 0.3, "shadow_soft_size": 0, "color": (1, 0.5, 0)}),
    "wide spot": ("SPOT", {"energy": 100, "spot_size": 2.4, "spot_blend": 1.0, "shadow_soft_size": 0.0}),
    "area": ("AREA", {"energy": 100, "size": 0.05}),
    "disk": ("AREA", {"energy": 100, "size": 0.02, "shape": "DISK", "exposure": 1.0}),
    "point": ("POINT", {"energy": 100, "shadow_soft_size": 0.0}),
}


def white(item):
    new, link, out, _ = material(item)
    node = new("ShaderNodeBsdfDiffuse")
    node.inputs[0].default_value = 1, 1, 1, 1
    link(node.outputs[0], out)


FIRST = "spot", "area"


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in FIRST else pytest.mark.full) for name in LAMPS]
)
def test_a_lamp_lights_a_wall_as_in_cycles(scene, name):  # noqa: F811
    white(plane("Wall", 0, 20, 1))
    kind, settings = LAMPS[name]
    lamp(kind, **settings)
    image = cast(read_camera(scene), read_shapes(scene), passes="combined")["combined"][..., :3]
    combined, _ = cycles_passes(scene)
    assert combined.max() > 0.1
    np.testing.assert_allclose(image, combined, atol=TOLERANCE * combined.max())


def with_nodes(item, strength):
    """Give a lamp nodes that emit a color and a strength."""
    data = item.data
    data.use_nodes = True
    nodes, links = data.node_tree.nodes, data.node_tree.links
    nodes.clear()
    output, emission = nodes.new("ShaderNodeOutputLight"), nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value, emission.inputs["Strength"].default_value = (1, 0.5, 0.25, 1), strength
    links.new(emission.outputs[0], output.inputs[0])
    return emission, nodes, links


def test_the_nodes_of_a_lamp_are_read_or_named(scene):  # noqa: F811
    white(plane("Wall", 0, 20, 1))
    item = lamp("POINT", energy=10, shadow_soft_size=0.0)
    emission, nodes, links = with_nodes(item, 7.0)
    image = cast(read_camera(scene), read_shapes(scene), passes="combined")["combined"][..., :3]
    combined, _ = cycles_passes(scene)
    np.testing.assert_allclose(image, combined, atol=TOLERANCE * combined.max())
    links.new(nodes.new("ShaderNodeLightFalloff").outputs[0], emission.inputs["Strength"])
    shapes = read_shapes(scene)
    ((name, reason),) = shapes.lights.left_out
    assert name == "POINT"
    assert "Light Falloff" in reason


def environment(scene, **settings):  # noqa: F811
    """A world with an image of different colors in all directions, turned by a Mapping node."""
    texels = np.ones((16, 32, 4), np.float32)
    y, x = np.mgrid[:16, :32]
    texels[..., 0], texels[..., 1], texels[..., 2] = x / 32, y / 16, (x + y) % 2
    image = bpy_module.data.images.new("sky", 32, 16, float_buffer=True)
    image.pixels.foreach_set(texels.ravel())
    image.pack()
    world = scene.world = bpy_module.data.worlds.new("World")
    if bpy_module.app.version < (5, 0):
        world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    kinds = "OutputWorld", "Background", "TexEnvironment", "Mapping", "TexCoord"
    output, back, texture, mapping, coordinate = (nodes.new(f"ShaderNode{kind}") for kind in kinds)
    texture.image, back.inputs["Strength"].default_value = image, 0.5
    mapping.inputs["Rotation"].default_value = 0.1, 0.2, 0.7
    links.new(coordinate.outputs["Generated"], mapping.inputs[0])
    links.new(mapping.outputs[0], texture.inputs[0])
    links.new(texture.outputs[0], back.inputs[0])
    links.new(back.outputs[0], output.inputs[0])


@pytest.mark.full
def test_an_environment_image_is_seen_as_in_cycles(scene):  # noqa: F811
    """In all directions; and a surface has the mean of its light from all sides."""
    environment(scene)
    camera = scene.camera.data
    camera.type, camera.panorama_type = "PANO", "EQUIRECTANGULAR"
    scene.camera.rotation_euler = 1.2, 0.3, 0.4
    scene.render.resolution_x, scene.render.resolution_y = 96, 48
    shapes = read_shapes(scene)
    image = cast(read_camera(scene), shapes, passes="combined")["combined"]
    combined, _ = cycles_passes(scene)
    np.testing.assert_allclose(image[..., :3], combined, atol=2e-3)
    assert (image[..., 3] == 1).all()
    np.testing.assert_allclose(shapes.world_color[:3], (0.242, 0.234, 0.25), atol=0.01)


def test_a_world_that_is_not_read_is_named(scene):  # noqa: F811
    environment(scene)
    nodes, links = scene.world.node_tree.nodes, scene.world.node_tree.links
    back = next(node for node in nodes if node.bl_idname == "ShaderNodeBackground")
    links.new(nodes.new("ShaderNodeTexSky").outputs[0], back.inputs[0])
    scene.world.color = 0.25, 0.5, 0.75
    shapes = read_shapes(scene)
    assert shapes.world_color == (0.25, 0.5, 0.75, 1)
    ((name, reason),) = shapes.lights.left_out
    assert name == "World"
    assert "Sky Texture" in reason
