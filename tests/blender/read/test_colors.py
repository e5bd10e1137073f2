"""Colors, indices, lights and the world, against scenes set up by hand."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.records import AREA, EVERYWHERE, MESH, PLANE, SPHERE

from .scene_parts import ball, geometry_nodes, new_object, plain

ULP = float(np.finfo(np.float32).eps)


@pytest.fixture
def scene():
    return bpy.context.scene


def test_color_and_indices_come_from_the_first_faces_material(scene):
    bare, first, second, by_object = ball("Bare"), ball("First"), ball("Second"), ball("Own")
    bare.color = 0.5, 0.25, 0, 1  # the viewport's
    red, green = plain("Red", (1, 0, 0, 1), 1), plain("Green", (0, 1, 0, 0.5), 2)
    for item in (first, second):
        item.data.materials.append(red)
        item.data.materials.append(green)
    for polygon in second.data.polygons:
        polygon.material_index = 1
    by_object.data.materials.append(red)
    by_object.material_slots[0].link = "OBJECT"
    by_object.material_slots[0].material = green
    shapes = read_shapes(scene)
    looks = {
        shapes.names[name]: (index, tuple(color))
        for name, index, color in zip(shapes.name_index, shapes.material_index, shapes.color, strict=True)
    }
    red, green = (1, (1, 0, 0, 1)), (2, (0, 1, 0, 0.5))
    assert looks == {"Bare": (0, (np.float32(0.8),) * 3 + (1,)), "First": red, "Second": green, "Own": green}


def test_a_ball_or_floor_of_several_materials_is_cast_as_its_mesh(scene):
    """Unless its setting says which shape it is; a slot beyond the last one is the last one."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=2, y_subdivisions=1, size=2)
    floor, painted, forced = bpy.context.object, ball("Painted"), ball("Forced")
    forced.camera_ray_caster.primitive = "SPHERE"
    for item in (floor, painted, forced):
        for _ in range(2):
            item.data.materials.append(bpy.data.materials.new("Material"))
        item.data.polygons[0].material_index = 9
    shapes = read_shapes(scene)
    kinds = {shapes.names[name]: kind for name, kind in zip(shapes.name_index, shapes.kind, strict=True)}
    assert kinds == {"Grid": MESH, "Painted": MESH, "Forced": SPHERE}
    painted.data.polygons[0].material_index = 2**15 - 1  # Blender's largest
    assert set(read_shapes(scene).kind) == {MESH, SPHERE}
    for item in (floor, painted):
        for polygon in item.data.polygons:
            polygon.material_index = 1 + polygon.index
    assert set(read_shapes(scene).kind) == {PLANE, SPHERE}


def test_a_ball_that_nodes_make_has_the_slots_that_cycles_counts(scene):
    """In Blender 5.2 those of the mesh that is seen, of which it has none; in earlier versions those of the object."""
    source, item = ball("Source"), ball("Nodes")
    for polygon in source.data.polygons:
        polygon.material_index = polygon.index % 2
    for _ in range(2):
        item.data.materials.append(bpy.data.materials.new("Material"))

    def build(new, link, mesh):
        info = new("GeometryNodeObjectInfo")
        info.inputs["Object"].default_value = source
        return info.outputs["Geometry"]

    geometry_nodes(item, build)
    shapes = read_shapes(scene)
    kinds = {shapes.names[name]: kind for name, kind in zip(shapes.name_index, shapes.kind, strict=True)}
    assert kinds == {"Source": SPHERE, "Nodes": MESH if bpy.app.version < (5, 2, 0) else SPHERE}


def principled(color=None):
    """A material with nodes, green in the viewport, and its Principled BSDF."""
    material = bpy.data.materials.new("Material")
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    material.diffuse_color = 0, 1, 0, 0.5
    node = next(node for node in material.node_tree.nodes if node.bl_idname == "ShaderNodeBsdfPrincipled")
    if color:
        node.inputs["Base Color"].default_value = color
    return material, node


def mixed(material, node):
    """Put another shader between the node and the output."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    mix = nodes.new("ShaderNodeMixShader")
    links.new(node.outputs[0], mix.inputs[1])
    links.new(mix.outputs[0], nodes["Material Output"].inputs["Surface"])


def textured(material, node):
    """Let a texture give the color."""
    noise = material.node_tree.nodes.new("ShaderNodeTexNoise")
    material.node_tree.links.new(noise.outputs["Color"], node.inputs["Base Color"])


def turned_off(material, node):
    """Leave the nodes aside, which Blender can up to 4.5."""
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = False
    else:
        material.node_tree.links.clear()


GOLD, GREEN, GRAY = (1, 0.5, 0.125, 1), (0, 1, 0, 0.5), (0.8, 0.8, 0.8, 0.5)
OFF = GREEN if bpy.app.version < (5, 0, 0) else (0, 0, 0, 0.5)


@pytest.mark.parametrize(
    ("color", "change", "expected"),
    [
        (GOLD, None, (*GOLD[:3], 0.5)),
        (None, None, GRAY),
        (GOLD, mixed, (0.5, 0.25, 0.0625, 0.5)),
        (GOLD, textured, GREEN),
        (GOLD, turned_off, OFF),
    ],
    ids=["changed", "as it was made", "mixed", "textured", "turned off"],
)
def test_a_plain_base_color_is_the_color(scene, color, change, expected):
    material, node = principled(color)
    if change:
        change(material, node)
    ball("Ball").data.materials.append(material)
    np.testing.assert_allclose(read_shapes(scene).color, [expected], atol=ULP)


def test_a_base_color_that_is_animated_is_that_of_the_frame(scene):
    material, node = principled(GOLD)
    node.inputs["Base Color"].driver_add("default_value", 0).driver.expression = "frame / 8"
    ball("Ball").data.materials.append(material)
    reds = [read_shapes(scene, frame=frame).color[0, 0] for frame in (2, 4)]
    np.testing.assert_allclose(reds, [0.25, 0.5], atol=ULP)


def test_lights_are_those_of_the_scene(scene):
    for kind in ("SUN", "POINT", "SPOT", "AREA"):
        light = new_object(kind.title(), bpy.data.lights.new(kind, kind))
        light.data.energy, light.data.color, light.location = 4, (1, 0.5, 0.25), (1, 2, 3)
        light.rotation_euler, light.scale = (np.pi / 2, 0, 0), (3, 3, 3)
    bpy.data.lights["POINT"].exposure = 1
    new_object("Off", bpy.data.lights.new("Off", "SUN")).hide_render = True
    shapes = read_shapes(scene)
    lights = shapes.lights
    columns = (column.tolist() for column in (lights.is_sun, lights.position, lights.color, lights.cone))
    rows = sorted(zip(*columns, strict=True))
    edge = np.cos(bpy.data.lights["SPOT"].spot_size / 2)
    assert [(is_sun, color) for is_sun, _, color, _ in rows] == [(False, [4, 2, 1])] * 2 + [
        (False, [8, 4, 2]), (True, [4, 2, 1])
    ]  # fmt: skip
    assert sorted(cone for *_, cone in rows) == sorted([
        [*AREA], [*EVERYWHERE], [*EVERYWHERE], [edge, (1 - edge) * bpy.data.lights["SPOT"].spot_blend]
    ])  # fmt: skip
    np.testing.assert_allclose([position for _, position, _, _ in rows], [(1, 2, 3)] * 3 + [(0, -1, 0)], atol=4 * ULP)
    shines = np.where((lights.cone == EVERYWHERE).all(axis=1)[:, None], 0, (0, 1, 0))
    np.testing.assert_allclose(lights.axis, shines, atol=4 * ULP)
    assert not lights.left_out


def test_a_light_whose_nodes_give_nothing_is_dark(scene):
    light = new_object("Lamp", bpy.data.lights.new("Lamp", "SUN")).data
    light.use_nodes = True
    light.node_tree.nodes.clear()
    assert read_shapes(scene).lights.color.tolist() == [[0, 0, 0]]


@pytest.mark.parametrize("strength", [np.nan, np.inf])
def test_a_light_of_no_finite_strength_is_left_out(scene, strength):
    new_object("Lamp", bpy.data.lights.new("Lamp", "POINT")).data.energy = strength
    shapes = read_shapes(scene)
    assert len(shapes.lights.is_sun) == 0
    assert [(name, reason[:36]) for name, reason in shapes.lights.left_out] == [
        ("Lamp", "its strength or color is not finite:")
    ]


def test_a_color_that_is_not_finite_is_black(scene):
    ball("Ball").data.materials.append(plain("Paint", (np.nan, 0.5, 0.5, 1)))
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = np.nan, 0.5, 0.5
    if bpy.app.version >= (5, 0, 0):
        scene.world.node_tree.nodes.clear()
    shapes = read_shapes(scene)
    has_nodes = bpy.app.version >= (5, 0, 0)  # whose colors lose the component
    assert shapes.color.tolist() == [[0, 0.5, 0.5, 1] if has_nodes else [0, 0, 0, 1]]
    assert shapes.world_color == (0, 0, 0, 1)


def test_the_worlds_color_is_what_its_background_emits(scene):
    assert read_shapes(scene).world_color == (0, 0, 0, 1)
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = 0.25, 0.5, 0.75
    if bpy.app.version < (5, 0, 0):
        assert read_shapes(scene).world_color == (0.25, 0.5, 0.75, 1)
        scene.world.use_nodes = True
    background = next(node for node in scene.world.node_tree.nodes if node.bl_idname == "ShaderNodeBackground")
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (0.5, 0.25, 1, 1), 2
    assert read_shapes(scene).world_color == (1, 0.5, 2, 1)
    sky = scene.world.node_tree.nodes.new("ShaderNodeTexCoord")
    scene.world.node_tree.links.new(sky.outputs[0], background.inputs["Color"])
    assert read_shapes(scene).world_color == (0.25, 0.5, 0.75, 1)
    scene.world.node_tree.nodes.clear()
    assert read_shapes(scene).world_color == (0, 0, 0, 1)
    scene.render.film_transparent = True
    assert read_shapes(scene).world_color == (0, 0, 0, 0)


def test_an_empty_scene_is_an_empty_record(scene):
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert shapes.axes.shape == (0, 3, 3)
    assert shapes.color.shape == (0, 4)


def test_the_reader_needs_no_registration(scene):
    import camera_ray_caster

    ball()
    camera_ray_caster.unregister()
    try:
        assert len(read_shapes(scene)) == 1
    finally:
        camera_ray_caster.register()
