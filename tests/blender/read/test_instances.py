"""Instances and what is hidden: against scenes set up by hand, and against what a render's own depsgraph hands over."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_shapes

from .scene_parts import ADD, ball, counts, geometry_nodes, in_a_render, mesh_of, new_collection, new_object, plain

ULP = float(np.finfo(np.float32).eps)


@pytest.fixture
def scene():
    return bpy.context.scene


def triangle():
    mesh = bpy.data.meshes.new("Triangle")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (0, 1, 0.5)], [], [(0, 1, 2)])
    return mesh


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
    for x in (10, 20):
        empty = new_object("Empty")
        empty.instance_type, empty.instance_collection, empty.location = "COLLECTION", outer, (x, 0, 0)
    shapes = read_shapes(scene)
    assert counts(shapes) == counts(in_a_render(scene)) == {"Deep": 2, "Shallow": 2}
    deep = [center for center, index in zip(shapes.center, shapes.name_index, strict=True)
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

    material = plain("Paint", (0.25, 0.5, 0.75, 1), 3)
    geometry_nodes(new_object("Objects", mesh_of((1, 0, 0), (2, 0, 0))), objects)
    other = new_object("Geometry", mesh_of((3, 0, 0)))
    other.location = 0, 0, 5
    geometry_nodes(other, geometry)
    shapes = read_shapes(scene)
    assert counts(shapes) == counts(in_a_render(scene)) == {"Prototype": 2, "Geometry": 1}
    order = np.argsort(shapes.center[:, 0])
    np.testing.assert_array_equal(shapes.center[order], [(1, 0, 0), (2, 0, 0), (3, 0, 5)])
    np.testing.assert_array_equal(shapes.object_index[order], [7, 7, 0])
    np.testing.assert_array_equal(shapes.material_index[order], [0, 0, 3])
    np.testing.assert_array_equal(shapes.color[order][2], (0.25, 0.5, 0.75, 1))
    np.testing.assert_allclose(shapes.axes[order][0], np.diag([0.5, 0.5, 2]), atol=4 * ULP)


def test_instances_on_vertices_and_their_instancer(scene):
    for name, shown in (("Shown", True), ("Hidden", False)):
        parent = ball(name, subdivisions=1)
        parent.instance_type, parent.show_instancer_for_render = "VERTS", shown
        child = ball(f"{name} child")
        child.parent = parent
    parent.show_instancer_for_viewport = False
    expected = {"Shown": 1, "Shown child": 12, "Hidden child": 12}
    shapes = read_shapes(scene)
    assert counts(shapes) == counts(in_a_render(scene)) == expected
    assert shapes.left_out == ()


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
    cube.camera_ray_caster.primitive = "IGNORE"
    bpy.data.objects.remove(bpy.context.object)
    for _ in range(4):
        empty = new_object("Empty")
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
    ((name, reason),) = read_shapes(scene).left_out
    assert (name, reason.endswith("(4 instances)")) == (cube.name, True)


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


@pytest.mark.parametrize("kind", ["VERTS", "FACES"])
@pytest.mark.parametrize("hide", ["hide_render", "hide_viewport"])
def test_the_collection_of_an_instanced_child_is_hidden(scene, kind, hide):
    parent = new_object("Parent", triangle())
    parent.instance_type, parent.show_instancer_for_render = kind, False
    hidden = new_collection("Hidden", scene.collection)
    child = new_object("Child", triangle(), hidden)
    child.parent = parent
    setattr(hidden, hide, True)
    shapes, rendered = read_shapes(scene), in_a_render(scene)
    assert counts(shapes) == {}
    assert counts(rendered) == ({} if hide == "hide_render" else {"Child": {"VERTS": 3, "FACES": 1}[kind]})
    assert [name for name, _ in shapes.left_out] == ([] if hide == "hide_render" else ["Child"])
    assert rendered.left_out == ()


def test_an_object_in_an_instanced_collection_that_the_viewport_hides_is_named(scene):
    collection = new_collection("Collection")
    ball("Shown", collection)
    ball("Not in the viewport", collection).hide_viewport = True
    empty = new_object("Empty")
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    shapes, rendered = read_shapes(scene), in_a_render(scene)
    assert counts(shapes) == {"Shown": 1}
    assert [name for name, _ in shapes.left_out] == ["Not in the viewport"]
    assert counts(rendered) == {"Shown": 1, "Not in the viewport": 1}


def test_an_object_in_a_hidden_and_a_shown_collection_is_shown(scene):
    hidden = new_collection("Hidden", scene.collection)
    hidden.hide_render = True
    hidden.objects.link(ball("Both"))
    assert counts(read_shapes(scene)) == counts(in_a_render(scene)) == {"Both": 1}


def test_a_background_set_is_shown_with_the_layer_that_it_renders(scene):
    ball("Front")
    behind = bpy.data.scenes.new("Behind")
    ball("Back", behind.collection)
    ball("Not rendered", behind.collection).hide_render = True
    aside = bpy.data.collections.new("Aside")
    behind.collection.children.link(aside)
    ball("Excluded", aside)
    behind.view_layers[0].use = False
    behind.view_layers.new("Rendered").layer_collection.children["Aside"].exclude = True
    scene.background_set = behind
    assert counts(read_shapes(scene)) == counts(in_a_render(scene)) == {"Front": 1, "Back": 1}


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
    np.testing.assert_array_equal(shapes.color, [(0, 0, 0, 0)])


def test_a_holdout_that_is_instanced_is_one_if_its_instancer_is(scene):
    """As Cycles has it, whose pictures decided."""
    parts = bpy.data.collections.new("Parts")
    ball("Part", parts).is_holdout = True
    for name in ("Seen", "Hole"):
        owner = bpy.data.objects.new(name, None)
        owner.instance_type, owner.instance_collection, owner.is_holdout = "COLLECTION", parts, name == "Hole"
        scene.collection.objects.link(owner)
    assert sorted(read_shapes(scene).color[:, 3]) == [0, 1]
