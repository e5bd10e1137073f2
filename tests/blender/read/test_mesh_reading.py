"""Meshes that are cast as triangles: which objects have some, where they are, and what is left out."""

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.records import MESH, PLANE, SPHERE

from .scene_parts import ADD, ball, counts, geometry_nodes, in_a_render, mesh_of, new_collection, new_object

ULP = float(np.finfo(np.float32).eps)


@pytest.fixture
def scene():
    return bpy.context.scene


def add(operator, **options):
    group, name = operator.split(".")
    getattr(getattr(bpy.ops, group), name)(**options)
    return bpy.context.object


def in_world(shapes, row):
    """The vertices of a row, (v, 3), by the record's own sentence."""
    mesh = shapes.meshes[shapes.mesh[row]]
    return shapes.center[row] + (mesh.vertices.T - mesh.middle) @ shapes.axes[row].T


def witness(name):
    """The vertices of an object in the world and its count of triangles, as Blender converts it to a mesh."""
    item = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = item.to_mesh()
    mesh.calc_loop_triangles()
    matrix = np.array(item.matrix_world, np.float64)
    vertices = np.array([tuple(vertex.co) for vertex in mesh.vertices], np.float64)
    count = len(mesh.loop_triangles)
    item.to_mesh_clear()
    return vertices @ matrix[:3, :3].T + matrix[:3, 3], count


SURFACES = {
    "cube": lambda: add("mesh.primitive_cube_add"),
    "disc": lambda: add("mesh.primitive_circle_add", fill_type="NGON"),
    "monkey": lambda: add("mesh.primitive_monkey_add"),
    "text": lambda: add("object.text_add"),
    "metaball": lambda: add("object.metaball_add"),
    "surface": lambda: add("surface.primitive_nurbs_surface_torus_add"),
}


@pytest.mark.parametrize("kind", SURFACES)
def test_every_surface_is_the_mesh_that_blender_makes_of_it(scene, kind):
    item = SURFACES[kind]()
    item.name, item.pass_index, item.location = "Thing", 5, (1, 2, 3)
    item.rotation_euler, item.scale = (0.3, 0.2, 0.1), (1, -2, 0.5)
    shapes = read_shapes(scene)
    assert (list(shapes.kind), list(shapes.mesh), shapes.left_out) == ([MESH], [0], ())
    assert (shapes.names, list(shapes.object_index)) == (("Thing",), [5])
    vertices, count = witness("Thing")
    assert len(shapes.meshes[0]) == count
    np.testing.assert_allclose(in_world(shapes, 0), vertices, atol=1e-12)
    rendered = in_a_render(scene)
    np.testing.assert_array_equal(rendered.center, shapes.center)
    assert len(rendered.meshes[0]) >= count  # a metaball is finer there


def test_a_curve_with_a_bevel_is_a_surface_and_one_without_is_none(scene):
    item = add("curve.primitive_bezier_circle_add")
    assert (len(read_shapes(scene)), read_shapes(scene).left_out) == (0, ())
    item.data.bevel_depth = 0.1
    shapes = read_shapes(scene)
    assert list(shapes.kind) == [MESH]
    assert len(shapes.meshes[0]) == witness(item.name)[1] > 0


def test_what_has_no_faces_is_no_surface(scene):
    new_object("Empty mesh", bpy.data.meshes.new("x"))
    new_object("Vertices", mesh_of((0, 0, 0), (1, 1, 1)))
    line = bpy.data.meshes.new("x")
    line.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    new_object("Line", line)
    assert (len(read_shapes(scene)), read_shapes(scene).left_out) == (0, ())


def test_modifiers_are_applied(scene):
    item = add("mesh.primitive_cube_add")
    item.modifiers.new("Bevel", "BEVEL")
    shapes = read_shapes(scene)
    assert len(shapes.meshes[0]) == witness(item.name)[1] > 12


def test_a_mesh_that_is_being_edited_is_as_the_window_shows_it(scene):
    add("mesh.primitive_cube_add")
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    assert len(read_shapes(scene).meshes[0]) == 6 * 4 * 2
    bpy.ops.mesh.subdivide()
    assert len(read_shapes(scene).meshes[0]) == 6 * 16 * 2
    bpy.ops.object.mode_set(mode="OBJECT")


def test_the_same_triangles_are_one_record_and_what_may_deform_apart_is_numbered_apart(scene):
    """One mesh of two objects, a copy of it, and the same by a modifier; a fifth object differs in one vertex."""
    first = add("mesh.primitive_monkey_add")
    new_object("Second", first.data)
    new_object("Copy", first.data.copy())
    modified = new_object("Modified", first.data.copy())
    modified.modifiers.new("Triangulate", "TRIANGULATE").min_vertices = 5  # there are none
    other = new_object("Other", first.data.copy())
    other.data.vertices[3].co.x += 0.125
    shapes = read_shapes(scene)
    number = dict(zip((shapes.names[k] for k in shapes.name_index), shapes.mesh.tolist(), strict=True))
    assert number["Suzanne"] == number["Second"]
    assert len(set(number.values())) == len(shapes.meshes) == 4
    records = {name: shapes.meshes[k] for name, k in number.items()}
    assert records["Suzanne"] is records["Copy"] is records["Modified"] is not records["Other"]


def test_any_affine_matrix_holds_mirrored_sheared_and_flat(scene):
    item = add("mesh.primitive_monkey_add")
    item.parent = new_object("Parent")
    for matrix in (
        ((-1, 0.5, 0, 3), (0, -2, 0.25, 0), (0.125, 0, 0.5, -1), (0, 0, 0, 1)),
        ((1, 0, 0, 0), (0, 0, 0, 2), (0, 0, 1, 0), (0, 0, 0, 1)),
        ((0, 0, 0, 1), (0, 0, 0, 2), (0, 0, 0, 3), (0, 0, 0, 1)),
    ):
        item.matrix_parent_inverse = Matrix(matrix)
        shapes = read_shapes(scene)
        assert (list(shapes.kind), shapes.left_out) == ([MESH], ())
        np.testing.assert_array_equal(shapes.axes[0], np.array(matrix, np.float32)[:3, :3])
        np.testing.assert_allclose(in_world(shapes, 0), witness(item.name)[0], atol=1e-12)


def test_a_matrix_that_is_not_finite_is_named(scene):
    item = add("mesh.primitive_monkey_add")
    item.parent = new_object("Parent")
    item.scale.x = item.parent.scale.x = float("nan")
    assert [name for name, _ in read_shapes(scene).left_out] == ["Suzanne"]


@pytest.mark.parametrize("make", [ball, lambda: add("mesh.primitive_plane_add")])
def test_an_exact_shape_that_is_flattened_is_cast_as_its_triangles(scene, make):
    """Blender shows a disc of a sphere that is scaled to nothing along one axis."""
    make()
    flat = make()
    flat.name, flat.scale, flat.rotation_euler = "Flat", (0, 1, 1), (0.3, 0.2, 0.1)
    shapes = read_shapes(scene)
    kinds = dict(zip((shapes.names[k] for k in shapes.name_index), shapes.kind.tolist(), strict=True))
    assert kinds["Flat"] == MESH
    assert sorted(kinds.values())[0] in (SPHERE, PLANE)
    np.testing.assert_allclose(in_world(shapes, list(shapes.kind).index(MESH)), witness("Flat")[0], atol=1e-12)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_vertices_that_are_not_finite_are_named_in_one_line(scene, value):
    item = add("mesh.primitive_monkey_add")
    vertices = np.array([vertex.co for vertex in item.data.vertices], np.float32)
    vertices[7, 1] = value
    item.data.vertices.foreach_set("co", vertices.ravel())  # what is set one by one Blender brings within its range
    ((name, reason),) = read_shapes(scene).left_out
    assert (name, reason) == ("Suzanne", "its vertices are not all finite")


def test_only_hair_volumes_and_grease_pencil_are_left_out(scene):
    ADD.primitive_cube_add()
    bpy.context.object.modifiers.new("Fur", "PARTICLE_SYSTEM").particle_system.settings.type = "HAIR"
    new_object("Curves", bpy.data.hair_curves.new("Curves"))
    new_object("Volume", bpy.data.volumes.new("Volume"))
    bpy.ops.object.grease_pencil_add(type="MONKEY")
    pencil = bpy.context.object.name
    shapes = read_shapes(scene)
    assert counts(shapes) == {"Cube": 1}
    assert {name for name, _ in shapes.left_out} == {"Cube", "Curves", "Volume", pencil}
    assert "hair 'Fur'" in dict(shapes.left_out)["Cube"]


def test_surfaces_that_only_a_render_shows_are_named(scene):
    for kind in ("text", "metaball", "surface", "cube"):
        item = SURFACES[kind]()
        item.name = kind
        item.hide_set(True)
    path = add("curve.primitive_bezier_circle_add")
    path.hide_set(True)
    assert {name for name, _ in read_shapes(scene).left_out} == {"text", "metaball", "surface", "cube"}
    path.data.extrude = 1
    assert path.name in {name for name, _ in read_shapes(scene).left_out}


def test_instances_of_all_kinds(scene):
    """By a collection, on vertices, by particles, of objects and of geometry by geometry nodes."""
    collection = new_collection("Collection")
    cube = bpy.data.meshes.new("Cube")
    cube.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
    new_object("Inside", cube, collection)
    for offset in (10, 20):
        empty = new_object("Empty")
        empty.instance_type, empty.instance_collection, empty.location = "COLLECTION", collection, (offset, 0, 0)
    points = new_object("Points", mesh_of((30, 0, 0), (31, 0, 0)))
    points.instance_type = "VERTS"
    new_object("Child", cube).parent = points

    def scatter(new, link, mesh):
        cone, scattered = new("GeometryNodeMeshCone"), new("GeometryNodeInstanceOnPoints")
        link(mesh, scattered.inputs["Points"])
        link(cone.outputs[0], scattered.inputs["Instance"])
        scattered.inputs["Scale"].default_value = 1, -1, 2
        return scattered.outputs[0]

    geometry_nodes(new_object("Scattered", mesh_of((40, 0, 0), (41, 0, 0), (42, 0, 0))), scatter)
    shapes = read_shapes(scene)
    assert counts(shapes) == counts(in_a_render(scene)) == {"Inside": 2, "Child": 2, "Scattered": 3}
    assert shapes.left_out == ()
    assert len(shapes.meshes) == 2
    x = {name: [] for name in counts(shapes)}
    for row, index in enumerate(shapes.name_index):
        x[shapes.names[index]].append(float(in_world(shapes, row)[:, 0].min()))
    assert sorted(x["Inside"]) == [10, 20]
    assert sorted(x["Child"]) == [30, 31]
    np.testing.assert_allclose(sorted(x["Scattered"]), [39, 40, 41], atol=4 * ULP)
    np.testing.assert_allclose(np.linalg.det(shapes.axes[shapes.mesh == shapes.mesh[-1]]), -2, rtol=4 * ULP)
