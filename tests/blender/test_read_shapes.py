"""The shapes that are read against scenes set up by hand, and against what a render's own depsgraph hands over."""

from collections import Counter

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from camera_ray_caster.blender.read import read_shapes, shapes_record
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE

ULP = float(np.finfo(np.float32).eps)
ADD = bpy.ops.mesh


@pytest.fixture
def scene():
    return bpy.context.scene


def new_object(name, data=None, collection=None):
    item = bpy.data.objects.new(name, data)
    (collection or bpy.context.scene.collection).objects.link(item)
    return item


def ball(name="Ball", collection=None, **options):
    """Return an object whose mesh is Blender's ico sphere."""
    ADD.primitive_ico_sphere_add(**options)
    made = bpy.context.object
    item = new_object(name, made.data, collection)
    bpy.data.objects.remove(made)
    return item


def new_collection(name, *parents):
    collection = bpy.data.collections.new(name)
    for parent in parents:
        parent.children.link(collection)
    return collection


def geometry_nodes(item, build):
    """Give an object a geometry nodes modifier; ``build(nodes, link, mesh)`` returns the socket of the result."""
    tree = bpy.data.node_groups.new("Geometry", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    mesh, result = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    tree.links.new(build(tree.nodes.new, tree.links.new, mesh.outputs[0]), result.inputs[0])
    item.modifiers.new("Geometry", "NODES").node_group = tree


def mesh_of(*vertices):
    mesh = bpy.data.meshes.new("Vertices")
    mesh.from_pydata(vertices, [], [])
    return mesh


def counts(shapes):
    return Counter(shapes.names[index] for index in shapes.name_index)


def in_a_render(scene):
    """Return what a render's depsgraph gives."""
    found = []

    class Engine(bpy.types.RenderEngine):
        bl_idname, bl_label = "READ_SHAPES_TEST", "Test"

        def render(self, depsgraph):
            found.append(shapes_record(depsgraph))

    scene.camera = scene.camera or new_object("Camera", bpy.data.cameras.new("Camera"))
    scene.render.resolution_x = scene.render.resolution_y = 8
    bpy.utils.register_class(Engine)
    try:
        scene.render.engine = Engine.bl_idname
        bpy.ops.render.render()
    finally:
        scene.render.engine = "CYCLES" if "CYCLES" in dir(scene) else "BLENDER_WORKBENCH"
        bpy.utils.unregister_class(Engine)
    return found[0]


# What is a shape


@pytest.mark.parametrize("segments", [(6, 4), (7, 5), (8, 3), (32, 16), (48, 24), (200, 100)])
def test_blenders_uv_spheres_are_spheres(scene, segments):
    ADD.primitive_uv_sphere_add(segments=segments[0], ring_count=segments[1], radius=2.5, location=(1, 2, 3))
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([SPHERE], ())
    np.testing.assert_array_equal(shapes.centre, [(1, 2, 3)])
    np.testing.assert_allclose(shapes.axes[0], 2.5 * np.eye(3), atol=2.5 * ULP)


@pytest.mark.parametrize("subdivisions", [1, 2, 3, 4, 5, 6])
def test_blenders_ico_spheres_are_spheres(scene, subdivisions):
    ADD.primitive_ico_sphere_add(subdivisions=subdivisions, radius=0.25)
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([SPHERE], ())
    np.testing.assert_array_equal(shapes.centre, [(0, 0, 0)])
    np.testing.assert_allclose(shapes.axes[0], 0.25 * np.eye(3), atol=0.25 * ULP)


@pytest.mark.parametrize("name", ["plane", "grid"])
def test_blenders_planes_are_planes(scene, name):
    getattr(ADD, f"primitive_{name}_add")(size=6, location=(0, 0, -1))
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([PLANE], ())
    np.testing.assert_array_equal(shapes.centre, [(0, 0, -1)])
    np.testing.assert_array_equal(shapes.axes[0, :, :2], [(3, 0), (0, 3), (0, 0)])


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("cube", "cut deep"),
        ("cylinder", "cut deep"),
        ("cone", "cut deep"),
        ("torus", "not on one sphere"),
        ("monkey", "not on one sphere"),
    ],
)
def test_blenders_other_primitives_are_named_with_the_reason(scene, name, reason):
    getattr(ADD, f"primitive_{name}_add")()
    bpy.context.object.name = "Thing"
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert [item for item, _ in shapes.left_out] == ["Thing"]
    assert reason in shapes.left_out[0][1]


def test_a_disc_is_flat_with_the_wrong_outline(scene):
    ADD.primitive_circle_add(fill_type="NGON")
    assert "outline has 32 corners" in read_shapes(scene).left_out[0][1]


def test_a_scale_that_an_operator_applies_makes_an_ellipsoid(scene):
    ADD.primitive_uv_sphere_add(scale=(1, 2, 3))
    shapes = read_shapes(scene)
    np.testing.assert_allclose(shapes.axes[0], np.diag([1, 2, 3]), atol=3 * 10 * ULP)


@pytest.mark.parametrize("add", ["curve.primitive_bezier_circle_add", "object.text_add", "object.metaball_add"])
def test_surfaces_that_are_no_mesh_are_named_once(scene, add):
    group, operator = add.split(".")
    getattr(getattr(bpy.ops, group), operator)()
    bpy.context.object.name = "Thing"
    if "curve" in add:
        bpy.context.object.data.bevel_depth = 0.1
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert [item for item, _ in shapes.left_out] == ["Thing"]


def test_hair_and_hair_curves_are_named(scene):
    emitter = ball("Emitter")
    emitter.modifiers.new("Fur", "PARTICLE_SYSTEM").particle_system.settings.type = "HAIR"
    new_object("Curves", bpy.data.hair_curves.new("Curves"))
    shapes = read_shapes(scene)
    assert counts(shapes) == {"Emitter": 1}
    assert {name for name, _ in shapes.left_out} == {"Emitter", "Curves"}
    assert "hair 'Fur'" in dict(shapes.left_out)["Emitter"]


def test_what_has_no_surface_is_passed_without_a_word(scene):
    for data in (None, bpy.data.cameras.new("x"), bpy.data.armatures.new("x"), bpy.data.speakers.new("x"),
                 bpy.data.lightprobes.new("x", "SPHERE"), bpy.data.lattices.new("x"), bpy.data.meshes.new("x"),
                 mesh_of((0, 0, 0), (1, 1, 1)), bpy.data.curves.new("x", "CURVE")):  # fmt: skip
        new_object("Thing", data)
    shapes = read_shapes(scene)
    assert (len(shapes), shapes.left_out) == (0, ())


# Where it is


def test_any_affine_matrix_holds(scene):
    matrix = Matrix(((1, 0.5, 0, 3), (0, -2, 0.25, 0), (0.125, 0, 0.5, -1), (0, 0, 0, 1)))
    parent = ball("Parent")
    parent.scale = 1, 3, 1
    child = ball("Child")
    child.parent, child.rotation_euler = parent, (0, 0, np.pi / 6)
    sheared = ball("Sheared")
    sheared.parent = new_object("Empty")
    sheared.matrix_parent_inverse = matrix
    shapes = read_shapes(scene)
    axes = dict(zip((shapes.names[index] for index in shapes.name_index), shapes.axes, strict=True))
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    np.testing.assert_allclose(axes["Child"], [(c, -s, 0), (3 * s, 3 * c, 0), (0, 0, 1)], atol=8 * ULP)
    np.testing.assert_allclose(axes["Sheared"], np.array(matrix)[:3, :3], atol=8 * ULP)
    assert counts(shapes) == {"Parent": 1, "Child": 1, "Sheared": 1}


def test_constraints_drivers_and_subframes_move_shapes_and_the_frame_is_put_back(scene):
    item, follower = ball("Item"), ball("Follower")
    item.driver_add("location", 0).driver.expression = "frame * 2"
    follower.constraints.new("COPY_LOCATION").target = item
    scene.frame_set(3, subframe=0.5)
    for frame, x in ((None, 7), (1, 2), (4.25, 8.5)):
        np.testing.assert_allclose(read_shapes(scene, frame).centre[:, 0], [x, x], rtol=4 * ULP)
        assert (scene.frame_current, scene.frame_subframe) == (3, 0.5)


def test_modifiers_are_applied(scene):
    item = ball()
    modifier = item.modifiers.new("Array", "ARRAY")
    modifier.count = 2
    assert "not on one sphere" in read_shapes(scene).left_out[0][1]
    modifier.count = 1
    assert len(read_shapes(scene)) == 1


@pytest.mark.parametrize("scale", [(0, 0, 0), (1, 0, 1), (float("inf"), 1, 1), (float("nan"), 1, 1)])
def test_a_matrix_without_size_is_named(scene, scale):
    ball("Good")
    bad = ball("Bad")
    bad.parent = new_object("Parent")
    bad.scale = bad.parent.scale = scale  # Blender keeps the largest float32 for an infinity: twice that is infinite
    shapes = read_shapes(scene)
    assert counts(shapes) == {"Good": 1}
    assert [name for name, _ in shapes.left_out] == ["Bad"]
    assert "size is zero" in shapes.left_out[0][1]


# Instances


def test_a_collection_instance_holds_what_its_collection_renders(scene):
    inner = new_collection("Inner")
    ball("Deep", inner).location = 0, 0, 1
    outer = new_collection("Outer")
    ball("Shallow", outer)
    ball("Not rendered", outer).hide_render = True
    hidden = new_collection("Hidden", outer)
    hidden.hide_render = True
    ball("In a hidden collection", hidden)
    nest = new_object("Nest", None, outer)
    nest.instance_type, nest.instance_collection, nest.location = "COLLECTION", inner, (1, 0, 0)
    for place in (10, 20):
        empty = new_object("Empty")
        empty.instance_type, empty.instance_collection, empty.location = "COLLECTION", outer, (place, 0, 0)
    shapes = read_shapes(scene)
    assert counts(shapes) == counts(in_a_render(scene)) == {"Deep": 2, "Shallow": 2}
    deep = [centre for centre, index in zip(shapes.centre, shapes.name_index, strict=True)
            if shapes.names[index] == "Deep"]  # fmt: skip
    assert sorted(map(tuple, deep)) == [(11, 0, 1), (21, 0, 1)]


def test_instances_of_objects_and_of_geometry_by_geometry_nodes(scene):
    prototype = ball("Prototype")
    prototype.hide_render = True  # as one does with a prototype
    prototype.pass_index = 7

    def objects(new, link, mesh):
        info, scatter = new("GeometryNodeObjectInfo"), new("GeometryNodeInstanceOnPoints")
        info.inputs["Object"].default_value = prototype
        info.inputs["As Instance"].default_value = True
        link(mesh, scatter.inputs["Points"])
        link(info.outputs["Geometry"], scatter.inputs["Instance"])
        scatter.inputs["Scale"].default_value = 0.5, 0.5, 2
        return scatter.outputs[0]

    def geometry(new, link, mesh):
        sphere, scatter = new("GeometryNodeMeshUVSphere"), new("GeometryNodeInstanceOnPoints")
        paint = new("GeometryNodeSetMaterial")
        paint.inputs["Material"].default_value = material
        link(mesh, scatter.inputs["Points"])
        link(sphere.outputs[0], paint.inputs[0])
        link(paint.outputs[0], scatter.inputs["Instance"])
        return scatter.outputs[0]

    material = bpy.data.materials.new("Paint")
    material.diffuse_color, material.pass_index = (0.25, 0.5, 0.75, 1), 3
    geometry_nodes(new_object("Objects", mesh_of((1, 0, 0), (2, 0, 0))), objects)
    other = new_object("Geometry", mesh_of((3, 0, 0)))
    other.location = 0, 0, 5
    geometry_nodes(other, geometry)
    shapes = read_shapes(scene)
    assert counts(shapes) == counts(in_a_render(scene)) == {"Prototype": 2, "Geometry": 1}
    order = np.argsort(shapes.centre[:, 0])
    np.testing.assert_array_equal(shapes.centre[order], [(1, 0, 0), (2, 0, 0), (3, 0, 5)])
    np.testing.assert_array_equal(shapes.object_index[order], [7, 7, 0])
    np.testing.assert_array_equal(shapes.material_index[order], [0, 0, 3])
    np.testing.assert_array_equal(shapes.colour[order][2], (0.25, 0.5, 0.75, 1))
    np.testing.assert_allclose(shapes.axes[order][0], np.diag([0.5, 0.5, 2]), atol=4 * ULP)


def test_instances_on_vertices_and_their_instancer(scene):
    for name, shown in (("Shown", True), ("Hidden", False)):
        parent = ball(name, subdivisions=1)
        parent.instance_type, parent.show_instancer_for_render = "VERTS", shown
        child = ball(f"{name} child")
        child.parent = parent
    expected = {"Shown": 1, "Shown child": 12, "Hidden child": 12}
    assert counts(read_shapes(scene)) == counts(in_a_render(scene)) == expected


def test_particles_show_their_object_and_their_emitter_as_set(scene):
    prototype = ball("Prototype")
    prototype.location = 100, 0, 0
    for name, shown in (("Shown", True), ("Hidden", False)):
        emitter = ball(name)
        emitter.show_instancer_for_render = shown
        settings = emitter.modifiers.new("System", "PARTICLE_SYSTEM").particle_system.settings
        settings.count, settings.frame_start, settings.frame_end, settings.lifetime = 5, 1, 1, 100
        settings.render_type, settings.instance_object, settings.particle_size = "OBJECT", prototype, 0.25
    scene.frame_set(2)
    shapes = read_shapes(scene)
    assert counts(shapes) == counts(in_a_render(scene)) == {"Prototype": 11, "Shown": 1}
    radii = np.cbrt(np.abs(np.linalg.det(shapes.axes)))
    assert np.count_nonzero(np.abs(radii - 0.25) < 4 * ULP) == 10


def test_what_cannot_be_cast_is_named_once_however_often_it_is_instanced(scene):
    collection = new_collection("Collection")
    ADD.primitive_cube_add()
    cube = new_object("Cube of many", bpy.context.object.data, collection)
    bpy.data.objects.remove(bpy.context.object)
    for _ in range(4):
        empty = new_object("Empty")
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
    ((name, reason),) = read_shapes(scene).left_out
    assert (name, reason.endswith("(4 instances)")) == (cube.name, True)


# What is hidden


def test_what_a_render_hides_is_left_out_and_what_only_it_shows_is_named(scene):
    ball("Shown")
    ball("Not rendered").hide_render = True
    ball("Not in the viewport").hide_viewport = True
    ball("Closed eye").hide_set(True)
    hidden, excluded = new_collection("Hidden", scene.collection), new_collection("Excluded", scene.collection)
    ball("In a hidden collection", hidden)
    ball("In an excluded collection", excluded)
    hidden.hide_render = True
    bpy.context.view_layer.layer_collection.children["Excluded"].exclude = True
    shapes = read_shapes(scene)
    assert counts(shapes) == {"Shown": 1}
    assert [name for name, _ in shapes.left_out] == ["Closed eye", "Not in the viewport"]
    assert all("hidden in the viewport" in reason for _, reason in shapes.left_out)
    rendered = in_a_render(scene)
    assert counts(rendered) == {"Shown": 1, "Not in the viewport": 1, "Closed eye": 1}
    assert rendered.left_out == ()


def test_an_object_in_a_hidden_and_a_shown_collection_is_shown(scene):
    hidden = new_collection("Hidden", scene.collection)
    hidden.hide_render = True
    hidden.objects.link(ball("Both"))
    assert counts(read_shapes(scene)) == counts(in_a_render(scene)) == {"Both": 1}


def test_what_the_camera_does_not_see_is_named(scene):
    ball("No camera rays").visible_camera = False
    indirect, holdout = new_collection("Indirect", scene.collection), new_collection("Holdout", scene.collection)
    ball("Indirect", indirect)
    ball("Hole", holdout)
    layers = bpy.context.view_layer.layer_collection.children
    layers["Indirect"].indirect_only, layers["Holdout"].holdout = True, True
    shapes = read_shapes(scene)
    assert counts(shapes) == {"Hole": 1}
    assert {name for name, _ in shapes.left_out} == {"No camera rays", "Indirect"}
    np.testing.assert_array_equal(shapes.colour, [(0, 0, 0, 0)])


# What an object's own setting makes of it


@pytest.mark.parametrize(
    ("setting", "kind", "centre", "axes"),
    [
        ("SPHERE", SPHERE, (0, 0, 0), np.sqrt(14) * np.eye(3)),
        ("PLANE", PLANE, (0, 0, 0), np.diag([1, 2, 1])),
        ("INFINITE_PLANE", INFINITE_PLANE, (0, 0, 0), np.eye(3)),
    ],
)
def test_a_setting_makes_a_shape_of_any_mesh(scene, setting, kind, centre, axes):
    ADD.primitive_cube_add(size=2, scale=(1, 2, 3))
    bpy.context.object.camera_ray_caster.primitive = setting
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([kind], ())
    np.testing.assert_array_equal(shapes.centre, [centre])
    np.testing.assert_allclose(shapes.axes[0], axes, rtol=ULP)


def test_a_setting_keeps_what_is_recognised(scene):
    ADD.primitive_plane_add(size=4, rotation=(np.pi / 2, 0, 0))
    bpy.ops.object.transform_apply(rotation=True)
    bpy.context.object.camera_ray_caster.primitive = "INFINITE_PLANE"
    ball().camera_ray_caster.primitive = "SPHERE"
    shapes = read_shapes(scene)
    assert sorted(shapes.kind) == [SPHERE, INFINITE_PLANE]
    normal = shapes.axes[shapes.kind == INFINITE_PLANE][0, :, 2]
    np.testing.assert_allclose(normal / np.linalg.norm(normal), (0, -1, 0), atol=2 * ULP)


def test_what_is_set_to_be_ignored_is_named(scene):
    ball("Thing").camera_ray_caster.primitive = "IGNORE"
    assert read_shapes(scene).left_out == (("Thing", "it is ignored by its own setting"),)


def test_a_setting_belongs_to_the_object_not_to_the_mesh(scene):
    first = ball("First")
    new_object("Second", first.data).camera_ray_caster.primitive = "PLANE"
    assert sorted(read_shapes(scene).kind) == [SPHERE, PLANE]


# Point clouds


def points(item, radius=None, remove=False):
    def build(new, link, mesh):
        convert, strip = new("GeometryNodeMeshToPoints"), new("GeometryNodeRemoveAttribute")
        strip.inputs["Name"].default_value = "radius" if remove else "nothing"
        if radius is not None:
            convert.inputs["Radius"].default_value = radius
        link(mesh, convert.inputs[0])
        link(convert.outputs[0], strip.inputs[0])
        return strip.outputs[0]

    geometry_nodes(item, build)


def test_the_points_of_a_cloud_are_spheres_under_the_objects_matrix(scene):
    item = new_object("Cloud", mesh_of((0, 0, 0), (1, 2, 3)))
    item.location, item.scale, item.pass_index = (10, 0, 0), (1, -2, 4), 5
    points(item, radius=0.25)
    shapes = read_shapes(scene)
    np.testing.assert_array_equal(shapes.centre, [(10, 0, 0), (11, -4, 12)])
    np.testing.assert_array_equal(shapes.axes, [np.diag([0.25, -0.5, 1])] * 2)
    np.testing.assert_array_equal(shapes.object_index, [5, 5])
    assert counts(shapes) == {"Cloud": 2}


def test_points_without_a_radius_are_as_large_as_cycles_makes_them(scene):
    points(new_object("Cloud", mesh_of((0, 0, 0))), radius=1, remove=True)
    np.testing.assert_allclose(read_shapes(scene).axes, [0.01 * np.eye(3)], rtol=ULP)


def test_points_that_are_too_small_to_be_are_counted(scene):
    points(new_object("Cloud", mesh_of((0, 0, 0), (1, 0, 0))), radius=0)
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert shapes.left_out[0][1].startswith("2 of its points have no radius")


# What it looks like


def test_colour_and_indices_come_from_the_first_faces_material(scene):
    plain, first, second, own = ball("Plain"), ball("First"), ball("Second"), ball("Own")
    plain.color = 0.5, 0.25, 0, 1
    red, green = bpy.data.materials.new("Red"), bpy.data.materials.new("Green")
    red.diffuse_color, red.pass_index = (1, 0, 0, 1), 1
    green.diffuse_color, green.pass_index = (0, 1, 0, 0.5), 2
    for item in (first, second):
        item.data.materials.append(red)
        item.data.materials.append(green)
    second.data.polygons[0].material_index = 1
    own.data.materials.append(red)
    own.material_slots[0].link = "OBJECT"
    own.material_slots[0].material = green
    shapes = read_shapes(scene)
    looks = {
        shapes.names[name]: (index, tuple(colour))
        for name, index, colour in zip(shapes.name_index, shapes.material_index, shapes.colour, strict=True)
    }
    red, green = (1, (1, 0, 0, 1)), (2, (0, 1, 0, 0.5))
    assert looks == {"Plain": (0, (0.5, 0.25, 0, 1)), "First": red, "Second": green, "Own": green}


def test_sun_and_point_lights_are_used_and_others_named(scene):
    for kind in ("SUN", "POINT", "SPOT", "AREA"):
        light = new_object(kind.title(), bpy.data.lights.new(kind, kind))
        light.data.energy, light.data.color, light.location = 4, (1, 0.5, 0.25), (1, 2, 3)
        light.rotation_euler, light.scale = (np.pi / 2, 0, 0), (3, 3, 3)
    bpy.data.lights["POINT"].exposure = 1
    new_object("Off", bpy.data.lights.new("Off", "SUN")).hide_render = True
    shapes = read_shapes(scene)
    rows = sorted(
        zip(shapes.lights.is_sun, shapes.lights.position.tolist(), shapes.lights.colour.tolist(), strict=True)
    )
    assert [(is_sun, colour) for is_sun, _, colour in rows] == [(False, [8, 4, 2]), (True, [4, 2, 1])]
    np.testing.assert_allclose([place for _, place, _ in rows], [(1, 2, 3), (0, -1, 0)], atol=4 * ULP)
    assert {name for name, _ in shapes.left_out} == {"Area", "Spot"}


def test_the_worlds_colour_is_what_its_background_emits(scene):
    assert read_shapes(scene).world_colour == (0, 0, 0, 1)
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = 0.25, 0.5, 0.75
    if bpy.app.version < (5, 0, 0):
        assert read_shapes(scene).world_colour == (0.25, 0.5, 0.75, 1)
        scene.world.use_nodes = True
    background = next(node for node in scene.world.node_tree.nodes if node.bl_idname == "ShaderNodeBackground")
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (0.5, 0.25, 1, 1), 2
    assert read_shapes(scene).world_colour == (1, 0.5, 2, 1)
    sky = scene.world.node_tree.nodes.new("ShaderNodeTexCoord")
    scene.world.node_tree.links.new(sky.outputs[0], background.inputs["Color"])
    assert read_shapes(scene).world_colour == (0.25, 0.5, 0.75, 1)
    scene.render.film_transparent = True
    assert read_shapes(scene).world_colour == (0, 0, 0, 0)


def test_an_empty_scene_is_an_empty_record(scene):
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert shapes.axes.shape == (0, 3, 3)
    assert shapes.colour.shape == (0, 4)


def test_the_reader_needs_no_registration(scene):
    import camera_ray_caster

    ball()
    camera_ray_caster.unregister()
    try:
        assert len(read_shapes(scene)) == 1
    finally:
        camera_ray_caster.register()
