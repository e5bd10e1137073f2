"""Whether points are seen: by hand, behind what pixels see, and on surfaces that must not hide themselves."""


import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting import aimed
from camera_ray_caster.core.casting.visibility import Visibility, visible
from camera_ray_caster.core.exports.camera_json import camera_to_json
from camera_ray_caster.core.motion.evaluations import resolve
from camera_ray_caster.core.records import PLANE, SPHERE, InputError, no_shapes

from ..camera.test_pixel_time import SHUTTER
from ..camera.test_pixel_time import camera as timed_camera
from ..cameras.model_examples import raw_of
from ..shapes import meshes
from .neighbors import with_motion
from .test_cast import camera_at, pose, random_shapes, shapes_of

OUTSIDE, HIDDEN, SEEN = Visibility
SIZE = {"resolution_x": 64, "resolution_y": 48}


def test_a_point_whose_distance_overflows_is_outside():
    points = [(1e308, 1e308, 1e308), (0.0, 0.0, -2.0)]
    assert visible(camera_at(), no_shapes(), points).tolist() == [OUTSIDE, SEEN]


def test_by_hand():
    camera, ball = camera_at(clip_end=20.0), shapes_of((SPHERE, (0, 0, -5), 1.0))
    points = [
        [(0, 0, -3), (0, 0, -4), (0, 0, -4.5), (0, 0, -7), (0, 0, -21)],
        [(0, 0, 1), (9, 0, -5), *[(0, 0, np.nan)] * 3],
    ]
    expected = [[SEEN, SEEN, HIDDEN, HIDDEN, OUTSIDE], [OUTSIDE] * 5]
    assert visible(camera, ball, points).tolist() == expected
    assert visible(camera, ball, (0, 0, -4.5), tolerance=0.1).item() == HIDDEN
    assert visible(camera, ball, (0, 0, -4.5), tolerance=0.6).item() == SEEN
    assert visible(camera, ball, np.zeros((0, 3))).shape == (0,)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_what_pixels_see_is_seen_what_is_behind_is_hidden_and_what_is_before_is_seen(model):
    camera = camera_from(raw_of(model.key, SIZE))
    shapes = random_shapes(np.random.default_rng(0), 40)
    rays, images = camera.rays(), cast(camera, shapes, passes=("distance", "distance_bound"), dtype=float)
    hit = np.isfinite(images["distance"]) & (images["distance"] < camera.clip_end / 1.01)
    assert hit.sum() > 50
    origins, directions, distance = rays.origins[hit], rays.directions[hit], images["distance"][hit]
    for share, expected in ((0.999, SEEN), (1.0, SEEN), (1.001, HIDDEN)):
        points = origins + share * distance[:, None] * directions
        is_visible = visible(camera, shapes, points)
        back = camera.project(points)
        elsewhere = np.linalg.norm(back - np.argwhere(hit)[:, ::-1] - 0.5, axis=1) > 1e-6  # another pixel sees it, too
        assert (elsewhere.mean() < 0.05) or not camera.model.smooth
        wrong = (is_visible != expected) & ~elsewhere & ~np.isnan(back[:, 0])
        behind = distance * abs(share - 1) > 4 * images["distance_bound"][hit]
        assert not (wrong & (behind | (share == 1))).any()


def test_no_vertex_of_a_mesh_is_hidden_by_the_triangles_that_it_is_a_corner_of():
    """All vertices of a ball's near half, grazing ones too, from an eye that float32 does not know exactly."""
    ball = meshes.ball(60, 90)
    camera = camera_at(pose(np.eye(3), (0.1, 0.2, 0.3)))
    shapes = meshes.shapes_of((ball, (1 / 3, -0.2, -4.1), 1.0))
    points = (ball.vertices - ball.middle[:, None]).T + shapes.center[0]
    normal = points - shapes.center[0]
    towards = ((points - camera.pose.eye) * normal).sum(axis=1) / np.linalg.norm(points - camera.pose.eye, axis=1)
    is_visible = visible(camera, shapes, points)
    assert (is_visible[towards < -0.02] == SEEN).all()
    assert (is_visible[towards > 0.1] == HIDDEN).all()


def test_many_points_in_one_pixel_are_each_asked_for_themselves(monkeypatch):
    """However crowded, and in however many parts."""
    camera, wall = camera_at(**SIZE), shapes_of((PLANE, (0, 0, -5), 9.0))
    rng = np.random.default_rng(0)
    points = np.concatenate((rng.normal(0, 1e-4, (700, 3)), rng.uniform(-1, 1, (300, 3)))) + np.array((0, 0, -5))
    expected = np.where(points[:, 2] < -5, HIDDEN, SEEN)
    for points_at_once, cells in ((1 << 15, 1 << 19), (123, 1 << 19), (1 << 15, 200)):
        monkeypatch.setattr(aimed, "POINTS", points_at_once)
        monkeypatch.setattr(aimed, "CELLS", cells)
        assert (visible(camera, wall, points) == expected).all()


def test_a_rolling_shutter_is_asked_at_the_time_of_the_row():
    """A wall passes before a point while rows are read: it hides it in those that are read then."""

    def evaluate(frame):
        return timed_camera(SHUTTER), shapes_of((PLANE, (7.9 * (frame - 5), 0, -3), 1.0))

    camera, shapes = evaluate(5.0)
    motion = resolve(evaluate, 4.75, 5.25, 0.01, 64)
    camera, shapes = with_motion(camera, shapes, motion)
    y = (np.arange(48) + 0.5 - 24) / 16
    points = np.stack((0 * y, y, np.full(48, -5.0)), axis=1)
    time = camera.rays().time[:, 0]
    expected = np.where((abs(7.9 * (time - 5)) < 1) & (abs(y) < 1), HIDDEN, SEEN)
    assert visible(camera, shapes, points).tolist() == expected.tolist()
    assert 0 < (expected == HIDDEN).sum() < 32


@pytest.mark.parametrize(("points", "tolerance", "words"), [
    ([(1, 2)], 0.0, "x, y, z"), ("here", 0.0, "points"),
    ([(0, 0, 0)], -1.0, "tolerance"), ([(0, 0, 0)], "x", "tolerance"),
    (np.ones((2, 3), complex), 0.0, "points .* real numbers"), (np.ones((2, 3), "datetime64[s]"), 0.0, "real numbers"),
    (np.ma.masked_less(np.ones((2, 3)), 2), 0.0, "without a mask"),
])  # fmt: skip
def test_bad_input_is_named(points, tolerance, words):
    with pytest.raises(InputError, match=words):
        visible(camera_at(), shapes_of((SPHERE, (0, 0, -5), 1.0)), points, tolerance=tolerance)


def test_what_is_no_camera_or_no_shapes_is_refused():
    for camera, shapes in ((None, shapes_of()), (camera_at(), None), (shapes_of(), camera_at())):
        with pytest.raises(TypeError, match="visible takes a camera and shapes"):
            visible(camera, shapes, [(0, 0, 0)])
    with pytest.raises(TypeError, match="camera_to_json takes a camera"):
        camera_to_json(None)
