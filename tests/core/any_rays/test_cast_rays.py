"""Rays given as arrays: beside the pictures of cameras that have them, and beside a plain test of every triangle."""

import gc
import math
import weakref
from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc

PASSES = ("depth", "distance", "position", "normal", "uv", "shape_index", "face_index", "object_index", "valid")
BOUND = {"distance": "distance_bound", "position": "position_bound", "normal": "normal_bound"}


def scene():
    """A ball, a squeezed ball, a floor and a bumpy mesh of 1,800 triangles."""
    x, y = (grid.ravel() for grid in np.meshgrid(np.linspace(-3, 3, 31), np.linspace(-3, 3, 31)))
    heights = 0.3 * np.sin(3 * x) * np.cos(2 * y) - 1
    corner = (np.arange(30)[:, None] * 31 + np.arange(30)).ravel()
    faces = np.concatenate([[corner, corner + 1, corner + 32], [corner, corner + 32, corner + 31]], axis=1).T
    return crc.join(
        crc.spheres([[0.0, 0.5, 0.5], [1.5, 1.0, 0.2]], [0.7, 0.4], object_index=3),
        crc.planes([0.0, 0.0, -2.0], [[4, 0], [0, 4], [0, 0]], object_index=4),
        crc.mesh(np.stack((x, y, heights), axis=1), faces, object_index=5),
    )


CAMERAS = {
    "PERSP": dict(lens=30.0),
    "ORTHO": dict(ortho_scale=5.0),
    "EQUIRECTANGULAR": {},
    "OPENCV_FISHEYE": dict(fx=30.0, fy=30.0, cx=40.0, cy=30.0),
}


@pytest.mark.parametrize("key", CAMERAS)
def test_rays_of_a_camera_see_what_it_sees(key):
    shapes = scene()
    pose = crc.look_at((3.0, -4.0, 3.0), (0.0, 0.0, 0.0))
    camera = crc.camera(key, (80, 60), pose=pose, clip_start=1e-3, **CAMERAS[key])
    passes = (*PASSES, *BOUND.values())
    picture = crc.cast(camera, shapes, passes=passes, dtype=np.float64)
    rays = camera.rays()
    hits = crc.cast_rays(rays.origins, rays.directions, shapes, passes=passes, near=1e-3)
    for name in ("shape_index", "face_index", "object_index", "valid"):
        assert (hits[name] == picture[name]).mean() > 0.999, name  # pixels nearer to an edge than the bounds
    same = (hits["shape_index"] == picture["shape_index"]) & (picture["shape_index"] >= 0)
    same &= hits["face_index"] == picture["face_index"]
    for name, bound in BOUND.items():
        off = np.abs(hits[name][same] - picture[name][same])
        off = off.max(axis=-1) if off.ndim > 1 else off
        assert (off <= hits[bound][same] + picture[bound][same] + 1e-13).all(), name  # the rays' own rounding


def plain_test(corners, origin, direction):
    """The nearest triangle and its t, by Cramer's rule for each pair of ray and triangle; inf for none."""
    first, second = corners[1] - corners[0], corners[2] - corners[0]
    p = np.cross(direction[:, None], second[None])
    volume = (p * first).sum(-1)
    s = origin[:, None] - corners[0][None]
    u, q = (s * p).sum(-1) / volume, np.cross(s, np.broadcast_to(first, s.shape))
    v, t = (direction[:, None] * q).sum(-1) / volume, (second * q).sum(-1) / volume
    t = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0), t, np.inf)
    return t.argmin(axis=1), t.min(axis=1)


@pytest.mark.parametrize("spread", [2.0, 0.01])
def test_random_rays_beside_a_plain_test_of_each_triangle(spread):
    random = np.random.default_rng(7)
    middle = random.uniform(-1, 1, (300, 1, 3))
    corners = middle + random.normal(0, 0.2, (300, 3, 3))
    shapes = crc.mesh(corners.reshape(-1, 3), np.arange(900).reshape(-1, 3))
    origin, direction = random.uniform(-spread, spread, (4000, 3)), random.normal(size=(4000, 3))
    face, t = plain_test(corners.swapaxes(0, 1), origin, direction)
    hits = crc.cast_rays(origin, direction, shapes, passes=("depth", "face_index"))
    hit = np.isfinite(t)
    assert hit.sum() > 400
    assert (np.isfinite(hits["depth"]) == hit).all()
    assert (hits["face_index"][hit] == face[hit]).all()
    np.testing.assert_allclose(hits["depth"][hit], t[hit], rtol=1e-9)


def test_a_ray_is_the_same_in_any_company():
    shapes, random = scene(), np.random.default_rng(2)
    origin, direction = random.uniform(-3, 3, (3000, 3)), random.normal(size=(3000, 3))
    whole = crc.cast_rays(origin, direction, shapes, passes=PASSES)
    order = random.permutation(3000)
    mixed = crc.cast_rays(origin[order], direction[order], shapes, passes=PASSES)
    few = crc.cast_rays(origin[:7], direction[:7], shapes, passes=PASSES)
    for name in PASSES:
        assert whole[name][order].tobytes() == mixed[name].tobytes(), name
        assert whole[name][:7].tobytes() == few[name].tobytes(), name


def test_many_rays_from_one_point_are_those_from_many_points():
    """Triangles are prepared for many rays from one point, also for rays through vertices and along edges."""
    shapes, eye = scene(), np.array([0.3, -0.2, 0.1])
    places = shapes.meshes[0].vertices.T
    random = np.random.default_rng(9)
    along = places[random.integers(0, len(places), 500)] * [1, 0, 1] + [0, eye[1], 0]
    directions = np.concatenate([places - eye, along - eye, random.normal(size=(2000, 3))])
    hits = crc.cast_rays(eye, directions, shapes, passes=PASSES)
    other = np.concatenate([directions, [[0, 0, 1.0]]])
    many = crc.cast_rays(
        np.concatenate([np.tile(eye, (len(directions), 1)), [[9.0, 9, 9]]]), other, shapes, passes=PASSES
    )
    assert (hits["face_index"] >= 0).sum() > 1000
    for name in PASSES:
        assert hits[name].tobytes() == many[name][:-1].tobytes(), name


def test_directions_of_any_length_and_shapes_that_broadcast():
    shapes = crc.spheres([[0.0, 0.0, -5.0]], 1.0)
    directions = [[[0, 0, -2.0]], [[0, 0, 1.0]], [[np.nan, 0, 1]]]
    hits = crc.cast_rays([0.0, 0.0, 0.0], directions, shapes, passes=("depth", "distance", "valid"))
    assert hits["depth"].tolist() == [[2.0], [math.inf], [math.inf]]
    assert hits["distance"].tolist() == [[4.0], [math.inf], [math.inf]]
    assert hits["valid"].tolist() == [[True], [True], [False]]


def test_hits_count_from_near_to_far():
    shapes = crc.spheres([[0.0, 0.0, -5.0]], 1.0)

    def depth(**span):
        return float(crc.cast_rays([0.0, 0, 0], [0.0, 0, -1], shapes, passes=("depth",), **span)["depth"])

    assert depth(near=4.0) == 4.0
    assert depth(near=4.1) == 6.0
    assert depth(near=4.1, far=5.9) == math.inf


def test_all_hits_come_by_ray_and_distance():
    shapes = crc.join(crc.spheres([[0.0, 0.0, -5.0]], 1.0), crc.planes([0.0, 0.0, -8.0], [[9, 0], [0, 9], [0, 0]]))
    hits = crc.cast_rays(
        [[0.0, 0, 0], [0, 5, 0], [0, 0, 0]], [[0.0, 0, -1], [0, 0, -1], [0, 0, 1]], shapes,
        passes=("distance", "shape_index"), all_hits=True,
    )  # fmt: skip
    assert hits["distance"].tolist() == [4.0, 6.0, 8.0, 8.0]
    assert hits["shape_index"].tolist() == [0, 0, 1, 1]
    assert hits["ray"].tolist() == [0, 0, 0, 1]
    assert hits["count"].tolist() == [3, 1, 0]


def test_all_hits_of_many_rays_begin_with_the_nearest():
    shapes, random = scene(), np.random.default_rng(5)
    origin, direction = random.uniform(-3, 3, (2000, 3)), random.normal(size=(2000, 3))
    nearest = crc.cast_rays(origin, direction, shapes, passes=("depth",))["depth"]
    every = crc.cast_rays(origin, direction, shapes, passes=("depth",), all_hits=True)
    first = np.full(2000, np.inf)
    np.minimum.at(first, every["ray"], every["depth"])
    assert (first == nearest).all()
    assert every["count"].sum() == len(every["depth"])


def test_a_segment_is_open_at_both_ends():
    shapes = crc.join(crc.spheres([[0.0, 0.0, 0.0]], 1.0), scene())
    ball = crc.spheres([[0.0, 0.0, 0.0]], 1.0)
    assert crc.occluded([[0.0, 0, 3], [0, 0, 3], [2, 0, 3]], [[0.0, 0, -3], [0, 0, 1], [2, 0, -3]], ball).tolist() == [
        True, False, False,
    ]  # fmt: skip
    random = np.random.default_rng(4)
    camera = crc.camera("PERSP", (60, 40), pose=crc.look_at((4.0, -5.0, 3.0), (0.0, 0.0, 0.0)), lens=35.0)
    images = crc.cast(camera, shapes, passes=("position", "shape_index"), dtype=np.float64)
    points = images["position"][images["shape_index"] >= 0]
    assert not crc.occluded(camera.pose.eye, points, shapes).any()  # each is what its pixel sees
    behind = points + 1e-6 * (points - camera.pose.eye)
    assert crc.occluded(camera.pose.eye, behind, shapes).all()
    assert not crc.occluded(points[:5], points[:5], shapes).any()
    assert crc.occluded(random.normal(size=(3, 1, 3)), random.normal(size=(4, 3)), ball).shape == (3, 4)


class Falling:
    """A ball that falls by 1 a frame."""

    def shapes_at(self, frame):
        return crc.spheres([[0.0, -frame, -5.0]], 1.0)


def test_each_ray_meets_the_shapes_at_its_own_time():
    shapes = replace(Falling().shapes_at(0.0), motion=Falling())
    times = np.array([0.0, 2.0, 2.0, 0.5])
    origin = np.array([[0.0, 0, 0], [0, 0, 0], [0, -2, 0], [0, -0.5, 0]])
    distances = crc.cast_rays(origin, [0.0, 0, -1], shapes, passes=("distance",), times=times)["distance"]
    np.testing.assert_allclose(distances, [4.0, math.inf, 4.0, 4.0], rtol=1e-15)
    every = crc.cast_rays(origin, [0.0, 0, -1], shapes, passes=("distance",), times=times, all_hits=True)
    assert every["count"].tolist() == [2, 0, 2, 2]
    np.testing.assert_allclose(every["distance"], [4.0, 6.0] * 3, rtol=1e-15)
    assert crc.occluded(origin, origin - [0, 0, 9], shapes, times=times).tolist() == [True, False, True, True]
    still = replace(shapes, motion=None)
    assert crc.cast_rays(origin, [0.0, 0, -1], still, passes=("valid",), times=times)["valid"].all()


def test_an_infinite_plane_along_an_axis_warns_of_nothing():
    """Its bounds are infinite on both sides along two axes."""
    ground = crc.planes((0.0, 0.0, -3.0), infinite=True)
    assert crc.cast_rays([0.0, 0, 0], [0.0, 0, -1], ground, passes="distance")["distance"] == 3.0


@pytest.mark.parametrize("moving", [False, True])
def test_shapes_that_have_gone_are_not_kept(moving):
    shapes = crc.spheres([[0.0, 0.0, -5.0]], 1.0)
    times = 1.5 if moving else None
    if moving:
        shapes = replace(shapes, motion=Falling())
    for all_hits in (False, True):
        crc.cast_rays([0.0, 0, 0], [0.0, 0, -1], shapes, times=times, all_hits=all_hits)
    crc.occluded([0.0, 0, 0], [0.0, 0, -9], shapes, times=times)
    left = weakref.ref(shapes)
    del shapes
    gc.collect()
    assert left() is None


SPHERE = dict(origins=[0.0, 0, 0], directions=[0.0, 0, -1])


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (dict(origins=[0.0, 0]), r"origins have shape \(2,\)"),
        (dict(directions=[0.0, 0, 0]), "directions are 0 for ray 0"),
        (dict(directions=[math.inf, 0, 0]), "directions hold infinite numbers"),
        (dict(directions=[0, 0, -1e-101]), "directions are shorter than 1e-100 for ray 0"),
        (dict(directions=[0, 0, -1e101]), "directions hold numbers beyond 1e.100"),
        (dict(origins=[0, 0, 1e200]), "origins hold numbers beyond 1e.100"),
        (dict(origins=np.zeros((2, 3)), directions=np.ones((3, 3))), "do not broadcast"),
        (dict(passes="solid_angle"), "solid_angle needs a pixel"),
        (dict(passes="dept"), "dept"),
        (dict(near=2.0, far=1.0), "near = 2 to far = 1"),
        (dict(near=-1.0), "near = -1"),
        (dict(far=10**400), "far is 10"),
        (dict(times=math.nan), "times hold NaN"),
        (dict(times=[1.0, 2.0]), "times of shape"),
        (dict(origins=np.broadcast_to(0.0, (10**10, 3))), "cast the rays in parts"),
    ],
)
def test_bad_input_is_refused_in_one_line(change, words):
    with pytest.raises(crc.InputError, match=words) as refusal:
        crc.cast_rays(**(SPHERE | dict(shapes=crc.spheres([[0.0, 0.0, -5.0]], 1.0)) | change))
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("length", [1e-99, 1e-40, 1e40, 1e99])
def test_short_and_long_directions_reach_as_far(length):
    expected = crc.cast_rays([0.0, 0, 0], [0, 0, -1.0], scene(), passes="distance")["distance"]
    for count in (1, 5000):
        directions = np.tile([0.0, 0.0, -length], (count, 1))
        hits = crc.cast_rays([0.0, 0, 0], directions, scene(), passes=("depth", "distance", "normal"))
        np.testing.assert_allclose(hits["distance"], expected)
        np.testing.assert_allclose(hits["depth"] * length, hits["distance"])


def test_nothing_to_see_and_no_rays():
    empty = crc.join()
    assert crc.cast_rays([0.0, 0, 0], [0.0, 0, 1], empty, passes=("shape_index",))["shape_index"] == -1
    assert crc.cast_rays(np.zeros((0, 3)), np.ones((0, 3)), scene(), passes=("distance",))["distance"].shape == (0,)
    assert not crc.occluded([0.0, 0, 0], [0.0, 0, 1], empty)
