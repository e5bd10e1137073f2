"""Shapes from arrays: what geometry by hand says of them, one record of several, and refusals in one line."""

from dataclasses import fields, replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.records import Lights, Shapes, Slots, no_shapes

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


@pytest.fixture
def camera():
    """Down along -z from 10, 2 units to a pixel of the width."""
    return crc.camera("ORTHO", (41, 41), crc.look_at((0, 0, 10), (0, 0, 0), up=(0, 1, 0)), ortho_scale=8.2)


def cast(camera, shapes, *passes):
    """Cast in double precision."""
    return crc.cast(camera, shapes, passes=passes, dtype=np.float64)


def test_spheres_are_where_they_are_put(camera):
    shapes = crc.spheres([(0, 0, 1), (2, 0, 0)], [1, 0.5], object_index=[7, 8], color=[(1, 0, 0), (0, 1, 0)])
    images = cast(camera, shapes, "depth", "object_index", "shape_index", "combined")
    assert images["depth"][20, 20] == pytest.approx(8, abs=1e-14)
    assert images["depth"][20, 30] == pytest.approx(9.5, abs=1e-14)
    assert images["object_index"][20, [20, 30]].tolist() == [7, 8]
    assert images["shape_index"][20, [20, 30, 40]].tolist() == [0, 1, -1]
    assert images["combined"][20, 20, 0] > 0 == images["combined"][20, 20, 1]
    ellipsoid = crc.spheres((0, 0, 0), axes=np.diag([1, 2, 3]))
    depth = cast(camera, ellipsoid, "depth")["depth"]
    assert depth[20, 20] == pytest.approx(7, abs=1e-14)
    assert np.isfinite(depth).sum(axis=0)[20] == pytest.approx(20, abs=1)


def test_planes_end_at_their_sides_or_nowhere(camera):
    axes = [[1, 0], [0, 2], [0, 0]]
    depth = cast(camera, crc.planes((0, 0, 1), axes), "depth")["depth"]
    assert set(depth[np.isfinite(depth)]) == {9.0}
    assert [np.isfinite(depth).any(axis=k).sum() for k in (0, 1)] == pytest.approx([10, 20], abs=1)
    assert np.isfinite(cast(camera, crc.planes((0, 0, 1), axes, infinite=True), "depth")["depth"]).all()
    slanted = crc.planes((0, 0, 0), [[1, 0, 0], [0, 1, 0], [1, 0, 1]])
    assert cast(camera, slanted, "depth")["depth"][20, 20] == 10


def test_a_mesh_of_quads_is_a_cube(camera):
    pose = [np.eye(4), [[1, 0, 0, 2.5], [0, 0.5, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]]
    shapes = crc.mesh(CUBE, QUADS, pose=pose, object_index=[1, 2], name="cube")
    images = cast(camera, shapes, "depth", "face_index", "normal", "shape_index", "object_index")
    assert images["depth"][20, [20, 32]].tolist() == pytest.approx([9, 8], abs=1e-14)
    assert set(images["face_index"][images["shape_index"] >= 0]) == {5}
    assert images["normal"][20, 20].tolist() == [0, 0, 1]
    assert images["object_index"][20, [20, 32]].tolist() == [1, 2]
    assert len(shapes.meshes[0]) == 12
    triangles = [(q[0], q[k], q[k + 1]) for q in QUADS for k in (1, 2)]
    same = cast(camera, crc.mesh(CUBE, np.array(triangles)), "depth")["depth"]
    np.testing.assert_array_equal(same, cast(camera, crc.mesh(CUBE, QUADS), "depth")["depth"])


def test_vertices_keep_their_type_and_their_digits(camera):
    third = np.float64(1) / 3
    depth = cast(camera, crc.mesh([(-1, -1, third), (1, -1, third), (0, 1, third)], [(0, 1, 2)]), "depth")["depth"]
    assert depth[20, 20] == pytest.approx(10 - third, abs=1e-14)
    assert crc.mesh(CUBE.astype(np.float32), QUADS).meshes[0].vertices.dtype == np.float32


def test_a_mesh_does_not_change_with_the_arrays_it_was_made_of():
    vertices = np.asfortranarray(CUBE, float)
    shapes = crc.mesh(vertices, QUADS)
    vertices += 1
    np.testing.assert_array_equal(shapes.meshes[0].vertices.T, CUBE)


@pytest.mark.parametrize("by_corner", [False, True])
def test_normals_and_uv_are_interpolated(camera, by_corner):
    corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, -5)])  # the last one is nobody's
    normals, uv = 3.0 * np.array([(-1, 0, 1), (1, 0, 1), (1, 0, 1), (-1, 0, 1), (0, 0, 1)]), corners[:, :2] / 2 + 0.5
    some = slice(0, 4 if by_corner else 5)
    shapes = crc.mesh(corners, [(0, 1, 2, 3)], normals=normals[some], uv=uv[some])
    images = cast(camera, shapes, "normal", "uv")
    x = (np.arange(41) - 20) * 0.2
    inside = np.abs(x) < 0.95
    np.testing.assert_allclose(images["uv"][20, inside, 0], x[inside] / 2 + 0.5, atol=1e-7)
    expected = np.stack((x[inside], 0 * x[inside], np.ones(inside.sum())), axis=-1)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    np.testing.assert_allclose(images["normal"][20, inside], expected, atol=1e-6)


def test_several_records_are_one(camera):
    parts = (
        crc.spheres([(0, 0, 1), (2, 0, 0)], [1, 0.5], name=("a", "b"), object_index=3),
        crc.mesh(CUBE, QUADS, pose=[np.eye(4), np.eye(4)], name="cube"),
        crc.planes((0, 0, -3), infinite=True, name="ground"),
        crc.mesh(CUBE * 0.5, QUADS, name="small"),
    )
    joined = crc.join(*parts)
    assert len(joined) == 6
    assert [joined.names[k] for k in joined.name_index] == ["a", "b", "cube", "cube", "ground", "small"]
    assert joined.mesh.tolist() == [-1, -1, 0, 0, -1, 1]
    whole, least = cast(camera, joined, "depth")["depth"], np.full((41, 41), np.inf)
    for shapes in parts:
        least = np.minimum(least, cast(camera, shapes, "depth")["depth"])
    np.testing.assert_array_equal(whole, least)
    np.testing.assert_array_equal(cast(camera, crc.join(parts[0], no_shapes()), "depth")["depth"],
                                  cast(camera, parts[0], "depth")["depth"])  # fmt: skip
    assert len(crc.join()) == 0


def test_joining_forgets_no_field():
    """Each of two records has something in every field: what is lost would have a field's default again."""

    def full(k):
        mesh, lamps = crc.mesh(CUBE, QUADS), k * (k > 1)
        return replace(
            mesh, instanced=(True,), materials=((k, f"material {k}"),), left_out=((f"object {k}", "reason"),),
            unread=((f"material {k}", "reason"),),
            lights=Lights(np.ones((k, 3)), np.ones(k, bool), np.ones((k, 3)), np.ones((lamps, 3)), np.ones((lamps, 2)),
                          left_out=((f"lamp {k}", "reason"),)),
            slots=Slots(np.zeros(1, int), np.arange(k), np.ones((k, 4)), np.zeros(k, int)), world_color=(k, 0, 0, 1),
            background=f"world {k}", identity=np.array([k]),
            shared=np.ones(1, bool), exact=((f"ball {k}", 1e-3),), notes=((f"object {k}", "note"),),
            surfaces=(f"surface {k}",), surface=np.zeros(1, np.int32), uv=np.ones((1, 2, 3)),
        )  # fmt: skip

    joined = crc.join(full(1), full(2))
    assert joined.surface.tolist() == joined.mesh.tolist() == joined.name_index.tolist() == [0, 1]
    assert [field.name for field in fields(Lights)] == ["position", "is_sun", "color", "axis", "cone", "left_out"]
    assert [len(getattr(joined.lights, field.name)) for field in fields(Lights)] == [3, 3, 3, 3, 3, 2]
    assert joined.world.color == (1, 0, 0, 1)
    assert joined.world.background == "world 1"
    for group in (joined.geometry, joined.looks, joined.remarks):
        for field in fields(group):
            value = getattr(group, field.name)
            assert value is getattr(joined, field.name), field.name
            if field.name == "slots":
                assert [field.name for field in fields(Slots)] == ["first", "material_index", "color", "surface"]
                assert value.first.tolist() == [0, 1]
                assert value.material_index.tolist() == [0, 0, 1]
                assert value.surface.tolist() == [0, 1, 1]
            else:
                assert len(value) == 2, field.name


def test_groups_and_values_by_name_are_two_ways_to_the_same():
    """``Shapes`` and ``replace`` take a group, values by name, or both: the values go before those of the group."""
    ball = crc.spheres((0, 0, -5), name="ball")
    far = np.array([(0, 0, -9.0)])
    moved = replace(ball, center=far, world_color=(1, 0, 0, 1), left_out=(("rope", "hidden"),))
    assert moved.geometry.center is moved.center is far
    assert moved.looks is ball.looks
    assert moved.color is ball.color
    assert moved.world.color == moved.world_color == (1, 0, 0, 1)
    assert moved.remarks.left_out == (("rope", "hidden"),)
    again = Shapes(geometry=ball.geometry, looks=moved.looks, world=moved.world, center=far)
    assert (again.center is far, again.world_color, again.left_out) == (True, (1, 0, 0, 1), ())
    with pytest.raises(TypeError, match="Shapes has no colour, radius"):
        replace(ball, colour=None, radius=1)
    with pytest.raises(TypeError, match="axes"):
        Shapes(ball.kind, ball.center)
    with pytest.raises(AttributeError):
        ball.center = far


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: crc.spheres([(0, 0)]), r"centers are of shape \(1, 2\)"),
        (lambda: crc.spheres([(0, 0, np.nan)]), r"centers are of shape \(1, 3\), with NaN or infinite numbers: they"),
        (lambda: crc.spheres([(0, 0, 0)], -1), r"radii of spheres are -1\.0 or more: they must be above 0"),
        (lambda: crc.spheres([(0, 0, 0)], [1, 2]), r"radii is of shape \(2,\)"),
        (lambda: crc.spheres((0, 0, 0), axes=np.diag([1, 1, 0])), "row 0"),
        (lambda: crc.spheres((0, 0, 0), color="red"), "color"),
        (lambda: crc.spheres((0, 0, 0), object_index=1.5), "whole numbers"),
        (lambda: crc.spheres((0, 0, 0), object_index=2**40), "32 bits"),
        (lambda: crc.spheres((0, 0, 0), name=("a", "b")), "2 names are given for 1 shapes"),
        (lambda: crc.spheres((0, 0, 0), name="\udc80"), "without halves of characters"),
        (lambda: crc.planes((0, 0, 0), [[1, 1], [0, 0], [0, 0]]), "row 0"),
        (lambda: crc.planes((0, 0, 0), infinite=1), "infinite"),
        (lambda: crc.mesh([(0, 0)], [(0, 0, 0)]), r"vertices are of shape \(1, 2\)"),
        (lambda: crc.mesh(CUBE, [(0, 1, 8)]), "there are only 0 to 7"),
        (lambda: crc.mesh(CUBE, [(0, 1, -1)]), "vertices -1 to 1"),
        (lambda: crc.mesh(CUBE, [(0, 1)]), "face 0 has 2 corners"),
        (lambda: crc.mesh(CUBE, [(0.0, 1.0, 2.0)]), "whole numbers"),
        (lambda: crc.mesh(CUBE, 3), "faces cannot be read"),
        (lambda: crc.mesh(CUBE, QUADS, normals=np.ones((7, 3))), r"\(8, 3\), one per vertex, or \(24, 3\)"),
        (lambda: crc.mesh(CUBE, QUADS, normals=np.zeros((8, 3))), "length 0"),
        (lambda: crc.mesh(CUBE, QUADS, uv=np.full((8, 2), np.inf)), "uv"),
        (lambda: crc.mesh(CUBE, QUADS, pose=np.eye(3)), r"pose is of shape \(1, 3, 3\)"),
    ],
)
def test_what_no_shape_can_be_is_one_line(make, message):
    with pytest.raises(crc.InputError, match=message) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_an_empty_list_is_no_shape(camera):
    for shapes in crc.spheres([]), crc.spheres([], []), crc.planes([]), crc.planes([], infinite=True):
        assert len(shapes) == 0
        assert np.isinf(cast(camera, shapes, "depth")["depth"]).all()


def test_a_mesh_without_faces_is_no_shape():
    assert len(crc.mesh(np.zeros((0, 3)), np.zeros((0, 3), int))) == 0


def test_a_scene_is_camera_and_shapes(camera):
    shapes = crc.spheres((0, 0, 1))
    depth = crc.cast(crc.Scene(camera, shapes), passes=("depth",))["depth"]
    np.testing.assert_array_equal(depth, crc.cast(camera, shapes, passes=("depth",))["depth"])
    with pytest.raises(TypeError, match=r"a scene and all else by name, not Camera and NoneType$"):
        crc.cast(camera, passes=("depth",))
    with pytest.raises(TypeError, match=r"not Camera and list; make one of several shapes: join\(\*shapes\)$"):
        crc.cast(camera, [shapes, shapes])
    with pytest.raises(TypeError, match=r"not Shapes and Camera$"):
        crc.cast(crc.Scene(shapes, camera))
    with pytest.raises(TypeError, match=r"one by one, as join\(\*shapes\), not list$"):
        crc.join([shapes, shapes])


def test_what_was_not_cast_and_what_is_no_number_is_named(camera):
    shapes = crc.spheres((0, 0, 1))
    with pytest.raises(KeyError, match="no pass 'uv' was cast: name it in passes=; there are depth, normal"):
        crc.cast(camera, shapes)["uv"]
    with pytest.raises(KeyError, match="no pass 'uv' was cast: name it in passes=; there are distance"):
        crc.cast_rays((0, 0, 9), (0, 0, -1), shapes, passes="distance")["uv"]
    with pytest.raises(crc.InputError, match=r"color is 'red': it must be real numbers$"):
        crc.spheres((0, 0, 1), color="red")
    with pytest.raises(crc.InputError, match=r"color is of shape \(2, 3\): it must be \(3,\) or \(1, 3\)"):
        crc.spheres((0, 0, 1), color=np.ones((2, 3)))
    with pytest.raises(crc.InputError, match=r"^list has no vertices and faces: give mesh"):
        crc.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
