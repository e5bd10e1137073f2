"""What is read of a mesh or point cloud, and where it is, against scenes set up by hand."""

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from camera_ray_caster.blender.read import geometry
from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE

from .scene_parts import ADD, ball, counts, geometry_nodes, mesh_of, new_object

ULP = float(np.finfo(np.float32).eps)


@pytest.fixture
def scene():
    return bpy.context.scene


@pytest.mark.parametrize("segments", [(6, 4), (7, 5), (8, 3), (32, 16), (48, 24), (200, 100)])
def test_blenders_uv_spheres_are_spheres(scene, segments):
    ADD.primitive_uv_sphere_add(segments=segments[0], ring_count=segments[1], radius=2.5, location=(1, 2, 3))
    bpy.context.object.data.shade_smooth()
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([SPHERE], ())
    np.testing.assert_array_equal(shapes.center, [(1, 2, 3)])
    np.testing.assert_allclose(shapes.axes[0], 2.5 * np.eye(3), atol=2.5 * ULP)


@pytest.mark.parametrize("subdivisions", [1, 2, 3, 4, 5, 6])
def test_blenders_ico_spheres_are_spheres(scene, subdivisions):
    ball(subdivisions=subdivisions, radius=0.25)
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([SPHERE], ())
    np.testing.assert_array_equal(shapes.center, [(0, 0, 0)])
    np.testing.assert_allclose(shapes.axes[0], 0.25 * np.eye(3), atol=0.25 * ULP)


@pytest.mark.parametrize("name", ["plane", "grid"])
def test_blenders_planes_are_planes(scene, name):
    getattr(ADD, f"primitive_{name}_add")(size=6, location=(0, 0, -1))
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([PLANE], ())
    np.testing.assert_array_equal(shapes.center, [(0, 0, -1)])
    np.testing.assert_array_equal(shapes.axes[0, :, :2], [(3, 0), (0, 3), (0, 0)])


@pytest.mark.parametrize("index", [-1, 10**6, 2**31 - 1])
@pytest.mark.parametrize("name", ["vertex_index", "edge_index"])
def test_a_corrupt_mesh_is_left_out_by_name(scene, name, index):
    ADD.primitive_uv_sphere_add()
    mesh = bpy.context.object.data
    values = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get(name, values)
    values[3] = index
    mesh.loops.foreach_set(name, values)
    for setting in ("AUTOMATIC", "MESH"):
        bpy.context.object.camera_ray_caster.primitive = setting
        (left,) = read_shapes(scene).left_out
        assert left[0] == bpy.context.object.name
        assert "corrupt" in left[1]
        assert "mesh.validate()" in left[1]
    mesh.validate()
    assert "corrupt" not in str(read_shapes(scene).left_out)


def test_a_scale_that_an_operator_applies_makes_an_ellipsoid(scene):
    ADD.primitive_uv_sphere_add(scale=(1, 2, 3))
    shapes = read_shapes(scene)
    np.testing.assert_allclose(shapes.axes[0], np.diag([1, 2, 3]), atol=3 * 10 * ULP)


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
        np.testing.assert_allclose(read_shapes(scene, frame=frame).center[:, 0], [x, x], rtol=4 * ULP)
        assert (scene.frame_current, scene.frame_subframe) == (3, 0.5)


@pytest.mark.parametrize("scale", [(float("inf"), 1, 1), (float("nan"), 1, 1)])
def test_a_matrix_that_is_not_finite_is_named(scene, scale):
    ball("Good")
    bad = ball("Bad")
    bad.parent = new_object("Parent")
    bad.scale = bad.parent.scale = scale  # Blender keeps the largest float32 for an infinity: twice that is infinite
    shapes = read_shapes(scene)
    assert counts(shapes) == {"Good": 1}
    assert [name for name, _ in shapes.left_out] == ["Bad"]
    assert "size is zero" in shapes.left_out[0][1]


@pytest.mark.parametrize(
    ("setting", "kind", "center", "axes"),
    [
        ("SPHERE", SPHERE, (0, 0, 0), np.sqrt(14) * np.eye(3)),
        ("PLANE", PLANE, (0, 0, 0), np.diag([1, 2, 1])),
        ("INFINITE_PLANE", INFINITE_PLANE, (0, 0, 0), np.eye(3)),
    ],
)
def test_a_setting_makes_a_shape_of_any_mesh(scene, setting, kind, center, axes):
    ADD.primitive_cube_add(size=2, scale=(1, 2, 3))
    bpy.context.object.camera_ray_caster.primitive = setting
    shapes = read_shapes(scene)
    assert (list(shapes.kind), shapes.left_out) == ([kind], ())
    np.testing.assert_array_equal(shapes.center, [center])
    np.testing.assert_allclose(shapes.axes[0], axes, rtol=ULP)


def test_a_setting_keeps_what_is_recognized(scene):
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
    assert read_shapes(scene).left_out == (("Thing", "its Cast As setting is Ignore"),)


def test_a_setting_belongs_to_the_object_not_to_the_mesh(scene):
    first = ball("First")
    new_object("Second", first.data).camera_ray_caster.primitive = "PLANE"
    assert sorted(read_shapes(scene).kind) == [SPHERE, PLANE]


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
    np.testing.assert_array_equal(shapes.center, [(10, 0, 0), (11, -4, 12)])
    np.testing.assert_array_equal(shapes.axes, [np.diag([0.25, -0.5, 1])] * 2)
    np.testing.assert_array_equal(shapes.object_index, [5, 5])
    assert counts(shapes) == {"Cloud": 2}


@pytest.mark.parametrize("kind", [PLANE, 7])  # 7: any kind that is neither a sphere nor a plane
def test_a_cloud_that_is_cast_as_another_kind_is_one_shape(scene, monkeypatch, kind):
    monkeypatch.setitem(geometry.FORCED, "PLANE", kind)
    item = new_object("Cloud", mesh_of((0, 0, 0), (2, 6, 0)))
    item.camera_ray_caster.primitive = "PLANE"
    points(item, radius=0.25)
    shapes = read_shapes(scene)
    assert shapes.kind.tolist() == [kind]
    np.testing.assert_array_equal(shapes.center, [(1, 3, 0)])


def test_points_without_a_radius_are_as_large_as_cycles_makes_them(scene):
    points(new_object("Cloud", mesh_of((0, 0, 0))), radius=1, remove=True)
    np.testing.assert_allclose(read_shapes(scene).axes, [0.01 * np.eye(3)], rtol=ULP)


def test_points_that_are_too_small_to_be_are_counted(scene):
    points(new_object("Cloud", mesh_of((0, 0, 0), (1, 0, 0))), radius=0)
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert shapes.left_out[0][1].startswith("2 of its points have a radius that is not above zero")


def test_the_materials_that_shapes_have_are_known_by_their_pass_indices(blender, camera_scene):
    for name, index in (("Red", 3), ("Blue", 0), ("Unused", 9)):
        blender.data.materials.new(name).pass_index = index
    for name in ("Red", "Blue", "Red"):
        blender.ops.mesh.primitive_cube_add()
        blender.context.object.data.materials.append(blender.data.materials[name])
    blender.ops.mesh.primitive_cube_add()
    assert sorted(read_shapes(camera_scene).materials) == [(0, "Blue"), (3, "Red")]
