"""Which meshes are cast as the exact shape that they stand for, and which as triangles."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.records import MESH, PLANE, SPHERE

from .scene_parts import ADD, ball, mesh_of, new_object


@pytest.fixture
def scene():
    return bpy.context.scene


@pytest.mark.parametrize(
    ("subdivisions", "smooth", "kind"),
    [(1, False, MESH), (2, False, MESH), (3, False, SPHERE), (4, False, SPHERE), (1, True, SPHERE), (2, True, SPHERE)],
)
def test_a_coarse_ball_with_flat_faces_is_a_solid_of_its_own(scene, subdivisions, smooth, kind):
    item = ball(subdivisions=subdivisions)
    if not smooth:
        item.data.shade_flat()
    assert list(read_shapes(scene).kind) == [kind]


def test_one_flat_face_makes_a_coarse_ball_a_solid(scene):
    item = ball(subdivisions=2)
    item.data.polygons[7].use_smooth = False
    assert list(read_shapes(scene).kind) == [MESH]


@pytest.mark.parametrize("subdivisions", [2, 3, 4])
def test_how_far_shape_and_mesh_are_apart(scene, subdivisions):
    """Against the lowest face, by Blender's own normals and middles of faces."""
    item = ball(subdivisions=subdivisions, radius=2.5)
    ((name, apart),) = read_shapes(scene).exact
    lowest = min(face.normal.dot(face.center) for face in item.data.polygons)
    assert name == item.name
    assert apart == pytest.approx(1 - lowest / 2.5, abs=1e-6)


def test_a_plane_is_not_apart_and_triangles_are_no_exact_shape(scene):
    ADD.primitive_plane_add(size=6)
    ADD.primitive_monkey_add()
    shapes = read_shapes(scene)
    assert sorted(shapes.kind) == [PLANE, MESH]
    assert shapes.exact == (("Plane", 0.0),)


@pytest.mark.parametrize("with_add_on", [True, False])
def test_without_exact_shapes_meshes_are_triangles_but_where_an_object_says_what_it_is(scene, with_add_on, unregister):
    names = {}
    for setting in ("AUTOMATIC", "SPHERE", "PLANE", "INFINITE_PLANE", "MESH"):
        item = ball(subdivisions=3)
        item.camera_ray_caster.primitive = setting
        names[item.name] = setting
    scene.camera_ray_caster.exact_shapes = False
    if not with_add_on:
        unregister()
    shapes = read_shapes(scene)
    kinds = {names[shapes.names[k]]: kind for k, kind in zip(shapes.name_index, shapes.kind.tolist(), strict=True)}
    assert kinds == {"AUTOMATIC": MESH, "SPHERE": SPHERE, "PLANE": PLANE, "INFINITE_PLANE": 2, "MESH": MESH}


def test_a_ball_and_a_plane_are_triangles_where_they_are_set_to(scene):
    for make in (lambda: ball(subdivisions=3), lambda: ADD.primitive_plane_add() and bpy.context.object):
        made = make()
        (made if isinstance(made, bpy.types.Object) else bpy.context.object).camera_ray_caster.primitive = "MESH"
    shapes = read_shapes(scene)
    assert list(shapes.kind) == [MESH, MESH]
    assert sorted(len(mesh) for mesh in shapes.meshes) == [2, 320]


def test_large_meshes_are_told_from_shapes_by_some_of_their_vertices(scene):
    """A dent in one vertex of many makes no sphere: the first look lets it pass, the second does not."""
    ADD.primitive_uv_sphere_add(segments=128, ring_count=64)
    sphere = bpy.context.object
    ADD.primitive_grid_add(x_subdivisions=80, y_subdivisions=80)
    assert sorted(read_shapes(scene).kind) == [SPHERE, PLANE]
    sphere.data.vertices[4000].co *= 1.01
    assert sorted(read_shapes(scene).kind) == [PLANE, MESH]


def test_points_are_spheres_with_every_setting_of_the_scene(scene):
    scene.camera_ray_caster.exact_shapes = False
    item = new_object("Cloud", mesh_of((0, 0, 0), (1, 2, 3)))
    with bpy.context.temp_override(object=item, active_object=item, selected_editable_objects=[item]):
        bpy.ops.object.convert(target="POINTCLOUD")
    assert set(read_shapes(scene).kind) == {SPHERE}
    np.testing.assert_array_equal(read_shapes(scene).center[:, 0], [0, 1])
