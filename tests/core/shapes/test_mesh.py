"""Hits of meshes against every triangle tested in long double, and their values against hand geometry."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core import memory
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.plan import make_plan
from camera_ray_caster.core.casting.request import Request
from camera_ray_caster.core.records import InputError, Slots

from ..cameras.model_examples import EXAMPLES, camera
from ..casting.test_cast import camera_at
from .meshes import ball, every_hit, grid, mesh_of, shapes_of, soup

SMALL = {"resolution_x": 48, "resolution_y": 36}
BOUNDS = "distance", "position", "distance_bound", "shape_index", "face_index"
each_model = pytest.mark.parametrize("key", [model.key for model in MODELS])


def examples(key):
    """Cameras of a model whose pixels have one time, small."""
    cameras = (camera(key, settings | SMALL) for settings in EXAMPLES[key])
    return [cam for cam in cameras if cam.pixel_time is None]


def assert_nearest(cam, shapes, clip_start=0.0):
    """Each pixel has the nearest triangle of all, at its distance to the bound, where no edge is within rounding."""
    images = cast(cam, shapes, passes=BOUNDS, dtype=np.float64)
    rays = cam.rays()
    shape = rays.valid.shape
    origins = np.broadcast_to(rays.origins, (*shape, 3))[rays.valid]
    directions = rays.directions[rays.valid]
    nearest, face, row = np.full(len(origins), np.inf), *np.full((2, len(origins)), -1)
    sure = np.ones(len(origins), bool)
    for k in range(len(shapes)):
        t, inside = every_hit(shapes, k, origins, directions)
        t[t < clip_start] = np.inf
        sure &= (np.abs(inside) > 1e-9).all(axis=1)
        best = t.argmin(axis=1)
        closest = t[np.arange(len(t)), best]
        nearer = closest < nearest
        nearest[nearer], face[nearer], row[nearer] = closest[nearer], best[nearer], k
    assert sure.mean() > 0.9
    distance, bound, nearest = (
        a[sure] for a in (*(images[b][rays.valid] for b in ("distance", "distance_bound")), nearest)
    )
    np.testing.assert_array_equal(images["shape_index"][rays.valid][sure], row[sure])
    np.testing.assert_array_equal(images["face_index"][rays.valid][sure], face[sure])
    met = np.isfinite(distance)
    assert (np.abs(distance[met] - nearest[met]) <= bound[met]).all()
    assert (images["distance_bound"][~np.isfinite(images["distance"])] == 0).all()
    return images


@each_model
def test_each_pixel_sees_the_nearest_triangle(key):
    """Of a soup of triangles of all sizes all around, two balls that one mesh gives, and a flattened mirrored one."""
    rng = np.random.default_rng(3)
    sphere = ball(5, 9)
    shapes = shapes_of(
        (soup(rng, 60), (0.3, -0.2, -2), 1.5),
        (sphere, (1, 0, -5), 1.0),
        (sphere, (-2, 1, -3), rng.normal(size=(3, 3))),
        (grid(3, 4, lambda u, v: (8 * u - 4, 9 * v - 4, 0 * u)), (0.01, 0.01, -9), np.diag([1, -1, 0])),  # off the axes
    )
    seen = [assert_nearest(cam, shapes) for cam in examples(key)]
    assert max(np.isfinite(images["distance"]).mean() for images in seen) > 0.02


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_triangles_through_the_clip_start_and_the_eye_plane_are_cut_there(kind):
    """A tent over the camera, and a floor that begins behind it."""
    tent = mesh_of([(-4, -2, 3), (4, -2, 3), (0, 3, 2), (0, 1, -20), (0.2, -1, -20)], [(0, 1, 3), (1, 2, 4), (2, 0, 3)])
    shapes = shapes_of((tent, tent.middle, 1.0), (ball(6, 8), (0, 0, -1), 0.95))
    cam = camera_at(type=kind, ortho_scale=4.0, clip_start=0.6, **SMALL)
    rays = cam.rays()
    start = 0.6 / np.abs(rays.directions[..., 2])  # along the view
    images = cast(cam, shapes, passes=("depth", "distance", "face_index"), dtype=np.float64)
    hit = np.isfinite(images["depth"])
    assert hit.mean() > 0.4
    assert images["depth"].min() >= 0.6
    nearest = np.full(rays.valid.size, np.inf)
    for k in range(2):
        t, _ = every_hit(shapes, k, np.broadcast_to(rays.origins, (*rays.valid.shape, 3)).reshape(-1, 3),
                         rays.directions.reshape(-1, 3))  # fmt: skip
        t[t < start.reshape(-1, 1)] = np.inf
        nearest = np.minimum(nearest, t.min(axis=1))
    np.testing.assert_allclose(images["distance"].ravel(), nearest.astype(float), rtol=1e-12)


def test_a_triangle_that_reaches_behind_the_eye_is_seen_where_it_is():
    """One by one: in some rows of some of them all three edges leave the triangle on the same side."""
    cam, rng = camera_at(lens=15.0, clip_start=0.0, **SMALL), np.random.default_rng(5)
    for corners in rng.normal(size=(60, 3, 3)) * 4:
        triangle = mesh_of(corners, [(0, 1, 2)])
        assert_nearest(cam, shapes_of((triangle, triangle.middle, 1.0)))


def test_what_has_no_area_or_is_seen_edge_on_is_invisible_and_duplicates_are_the_first():
    """A point, a line, a triangle in a plane with the eye, and one that is there twice."""
    corners = [(0, 0, -1), (1, 0, -2), (0, 0, -3), (-1, -1, -5), (1, -1, -5), (0, 1, -5), (0, 0, -4)]
    mesh = mesh_of(corners, [(0, 0, 0), (0, 2, 2), (0, 2, 6), (0, 1, 2), (3, 4, 5), (3, 4, 5), (4, 3, 5)])
    images = cast(camera_at(), shapes_of((mesh, mesh.middle, 1.0)), passes=("depth", "face_index"), dtype=np.float64)
    assert set(np.unique(images["face_index"])) == {-1, 4}
    assert set(np.unique(images["depth"])) == {5.0, np.inf}


def test_a_quad_before_a_ball_of_triangles_of_the_same_depth_is_of_the_lower_row():
    """Two meshes at one depth, and one nearer: whatever their order."""
    quad = grid(1, 1, lambda u, v: (u - 0.5, v - 0.5, 0 * u))
    shapes = shapes_of((quad, (0.4, 0, -3), 2.0), (quad, (0, 0, -3), 2.0), (quad, (0, 0.3, -2), 0.5))
    images = cast(camera_at(), shapes, passes=("depth", "shape_index"), dtype=np.float64)
    assert images["shape_index"][16, 16] == 0
    assert images["shape_index"][16, 11] == 1
    assert images["shape_index"][18, 16] == 2
    assert images["depth"][16, 11] == pytest.approx(3, abs=1e-6)


def test_normals_are_of_the_side_that_is_hit_smooth_or_flat_and_right_to_their_bound():
    """Of a stretched, mirrored ball of smooth faces, from outside and from within; of a flat one each triangle's."""
    axes = np.array([[1, 0.2, 0], [0, -0.5, 0.1], [0.3, 0, 2]])
    smooth = ball(24, 32)
    cam = camera_at(resolution_x=48, resolution_y=48)
    for mesh, center in ((smooth, (0.1, 0, -4)), (smooth, (0, 0, 0)), (replace(smooth, normals=None), (0, 0.2, -4))):
        shapes = shapes_of((mesh, center, axes))
        images = cast(cam, shapes, passes=("normal", "normal_bound", "position", "face_index"), dtype=np.float64)
        hit = images["face_index"] >= 0
        assert hit.sum() > 20
        vertices = axes @ (mesh.vertices - mesh.middle[:, None]) + np.array(center)[:, None]
        a, b, c = (vertices[:, corner[images["face_index"][hit]]].T for corner in mesh.triangles)
        area = np.cross(b - a, c - a)
        toward = -np.sign((area * images["position"][hit]).sum(axis=1))[:, None]
        expected = area * toward
        if mesh.normals is not None:
            to_world = np.linalg.inv(axes).T * np.sign(np.linalg.det(axes))
            parts = [(mesh.normals[loop[images["face_index"][hit]]].astype(float) @ to_world.T) for loop in mesh.loops]
            parts = [normals / np.linalg.norm(normals, axis=1, keepdims=True) for normals in parts]
            square = (area * area).sum(axis=1)
            p = images["position"][hit]
            weights = [(np.cross(r - q, p - q) * area).sum(axis=1) / square for q, r in ((b, c), (c, a), (a, b))]
            expected = toward * sum(w[:, None] * normals for w, normals in zip(weights, parts, strict=True))
        expected = expected / np.linalg.norm(expected, axis=1, keepdims=True)
        error = np.linalg.norm(images["normal"][hit] - expected, axis=1)
        assert (error <= images["normal_bound"][hit]).all()
        assert np.median(images["normal_bound"][hit]) < 1e-11


def test_a_smooth_ball_that_is_flattened_to_a_disc_has_its_normal():
    """Also where the normals at corners lie in the disc's plane and vanish."""
    shapes = shapes_of((ball(8, 12), (0, 0, -3), np.diag([1.0, 1.0, 0.0])))
    images = cast(camera_at(), shapes, passes=("normal", "face_index"), dtype=np.float64)
    hit = images["face_index"] >= 0
    assert hit.sum() > 50
    np.testing.assert_allclose(images["normal"][hit], np.tile([0.0, 0, 1], (hit.sum(), 1)), atol=1e-15)


def test_normals_of_a_shared_mesh_are_interpolated_in_its_own_frame():
    """As Cycles does: under an uneven scale they differ from those of a mesh that one object shows."""
    tilted = np.float32([[0, -0.6, 0.6], [0, 0, 0], [1, 0.8, 0.8]])
    quad = mesh_of([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)], normals=tilted.T, loops=np.array([[0], [1], [2]]))
    scale = np.diag([1.0, 1.0, 4.0])
    alone, shared = (
        cast(
            camera_at(),
            shapes_of((quad, (0, 0, -3), scale), shared=np.array([both])),
            passes=("normal", "uv"),
            dtype=np.float64,
        )
        for both in (False, True)
    )
    assert (alone["uv"] == 0).all()
    weights = np.array([0.25, 0.25, 0.5])  # of the middle of the picture
    local = (weights * tilted).sum(axis=1) * [1, 1, 0.25]
    world = tilted * np.array([1, 1, 0.25])[:, None]
    world = (weights * world / np.linalg.norm(world, axis=0)).sum(axis=1)
    np.testing.assert_allclose(shared["normal"][16, 16], local / np.linalg.norm(local), atol=1e-7)
    np.testing.assert_allclose(alone["normal"][16, 16], world / np.linalg.norm(world), atol=1e-7)


def test_the_map_the_face_and_the_material_are_those_of_the_point():
    """A square of two triangles, one face; beside it one of another material."""
    mesh = grid(1, 2, lambda u, v: (2 * u - 1, v - 0.5, 0 * u))
    corners = mesh.vertices[:2, mesh.triangles].reshape(2, 3, 4)
    mesh = replace(
        mesh, polygon=np.array([7, 8, 7, 8], np.int32), slot=np.array([0, 1, 0, 1], np.int16),
        uv=np.float32([0.25 * corners[0] + 3, -corners[1]]).reshape(2, -1).T, loops=np.arange(12).reshape(3, 4),
    )  # fmt: skip
    slots = Slots(
        np.array([-1, 2]),
        np.int32([90, 91, 31, 32]),
        np.float32([[1, 1, 1, 1], [1, 1, 1, 1], [0, 0, 1, 0.3], [1, 0, 0, 0.4]]),
    )
    shapes = shapes_of((ball(4, 4), (0, 0, 9), 1.0), (mesh, (0, 0, -2), 1.0), slots=slots)
    passes = "position", "uv", "face_index", "material_index", "combined"
    images = cast(camera_at(), shapes, passes=passes, dtype=np.float64)
    hit = images["face_index"] >= 0
    x, y, _ = images["position"][hit].T
    np.testing.assert_allclose(images["uv"][hit], np.stack((0.25 * x + 3, -y, 0 * x), axis=1), atol=1e-14)
    np.testing.assert_array_equal(images["face_index"][hit], np.where(x <= 0, 7, 8))
    np.testing.assert_array_equal(images["material_index"][hit], np.where(x <= 0, 31, 32))
    assert (images["material_index"][~hit] == 0).all()
    assert (images["combined"][hit][:, 2] > 0).tolist() == (x <= 0).tolist()
    np.testing.assert_allclose(images["combined"][hit][:, 3], np.where(x <= 0, 0.3, 0.4), atol=1e-7)


def test_a_mesh_without_a_map_has_0_beside_one_with_a_map():
    bare = grid(1, 1, lambda u, v: (u - 0.5, v - 0.5, 0 * u))
    mapped = replace(bare, uv=np.full((4, 2), 0.25, np.float32), loops=bare.triangles)
    shapes = shapes_of((bare, (0.5, 0, -3), 1.0), (mapped, (-0.5, 0, -3), 1.0))
    images = cast(camera_at(), shapes, passes=("uv", "shape_index"))
    for shape, expected in enumerate(([0, 0, 0], [0.25, 0.25, 0])):
        uv = images["uv"][images["shape_index"] == shape]
        assert len(uv) > 10
        np.testing.assert_array_equal(uv, np.tile(np.float32(expected), (len(uv), 1)))


def test_the_grid_is_that_of_the_map_or_of_the_edges_of_faces():
    """Two squares of two triangles each, without the diagonals between these; with a map its lines, 24 and 12."""
    mesh = grid(1, 2, lambda u, v: (2 * u - 1, v - 0.5, 0 * u))
    faces = replace(mesh, polygon=np.array([0, 1, 0, 1], np.int32))
    mapped = replace(mesh, uv=np.float32(mesh.vertices[:2].T / 6), loops=mesh.triangles)
    cam = camera_at(resolution_x=201, resolution_y=101)
    for shown in (faces, mapped):
        images = cast(
            cam,
            shapes_of((shown, (0.0, 0.0, -1), 1.0)),
            passes=("combined", "position"),
            dtype=np.float64,
            shading="GRID",
        )
        hit = images["combined"][..., 3] > 0
        x, y, _ = images["position"][hit].T
        if shown is faces:
            expected = np.minimum(np.minimum(np.abs(x), 1 - np.abs(x)), 0.5 - np.abs(y)) < 0.06
            near = [np.abs(value - 0.06) for value in (np.abs(x), 1 - np.abs(x), 0.5 - np.abs(y))]
            sure = np.minimum.reduce(near) > 1e-9
        else:
            across = [np.abs(cells - np.rint(cells)) for cells in (24 * x / 6, 12 * y / 6)]
            expected = np.minimum(*across) < 0.06
            sure = np.minimum.reduce([np.abs(distance - 0.06) for distance in across]) > 1e-6
        headlight = 1 / np.sqrt(1 + x**2 + y**2)
        dark = images["combined"][hit][:, 2] < 0.5 * headlight
        np.testing.assert_array_equal(dark[sure], expected[sure])
        assert 0.1 < expected.mean() < 0.6


def test_more_triangles_than_the_memory_holds_are_refused_before_any_is_placed(monkeypatch):
    """A hundred million, of instances that share a mesh: one line that says what they take."""
    monkeypatch.setattr(memory, "available", lambda: 4 << 30)
    monkeypatch.setattr(np, "empty", None)
    many = shapes_of(*[(ball(100, 100), (0, 0, -5), 1.0)] * 5050)
    with pytest.raises(InputError, match=r"^99,990,000 triangles in view take .* GiB are available: show"):
        make_plan(camera_at(), many, Request(("depth",)))


def test_many_triangles_in_one_pixel_are_a_hit_of_the_nearest():
    """Forty thousand, a tenth of a pixel wide together, whose bounds hold a pixel's center."""
    images = cast(
        camera_at(), shapes_of((ball(100, 200), (0, 0, -5), 0.01)), passes=("depth", "shape_index"), dtype=np.float64
    )
    assert (images["shape_index"] >= 0).sum() == 1
    assert images["depth"][16, 16] == pytest.approx(4.99, abs=1e-5)


@pytest.mark.parametrize("away", [1e9, 1e17, 3e38])
def test_a_vertex_far_away_takes_no_digits_from_the_others(away):
    """Loose, or of a triangle of its own."""
    alone = grid(4, 5, lambda u, v: (2 * u - 1, 1.5 * v - 0.75, -3 - u * v))
    near, triangles = alone.vertices.T.tolist(), alone.triangles.T.tolist()
    beside = [(away, 0.0, -3.0), (away, away, -3.0), (away, 0.0, -away)]
    expected = cast(camera_at(**SMALL), shapes_of((alone, tuple(alone.middle), 1.0)), passes=BOUNDS, dtype=float)
    assert (expected["shape_index"] == 0).any()
    first = len(near)
    for others in ([], [(first, first + 1, first + 2)]):
        mesh = mesh_of(near + beside, triangles + others)
        shapes = shapes_of((mesh, tuple(mesh.middle), 1.0))
        images = cast(camera_at(**SMALL), shapes, passes=BOUNDS, dtype=float)
        np.testing.assert_array_equal(images["face_index"], expected["face_index"])
        hit = expected["shape_index"] == 0
        assert (np.abs(images["distance"][hit] - expected["distance"][hit]) <= images["distance_bound"][hit]).all()
        assert images["distance_bound"][hit].max() < 1e-12
