"""Optical flow: points moved as the shapes say and looked for with 60 digits, and pictures worked out by hand."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from mpmath import mpf

from camera_ray_caster.core import cast as caster
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.casting.pixels import passes_at
from camera_ray_caster.core.motion.evaluations import resolve
from camera_ray_caster.core.records import PLANE, SPHERE, InputError

from ..camera.test_pixel_time import ROWS, SHUTTER, turn
from ..camera.test_pixel_time import camera as timed_camera
from ..cameras.model_examples import TURNED, raw_of
from ..shapes import meshes
from ..truth import differences, truth
from .neighbors import at_rest, with_motion, with_others
from .test_cast import camera_at, random_rows, random_shapes, shapes_of

cast = partial(caster.cast, dtype=float)
SIZE = {"resolution_x": 64, "resolution_y": 48}
PIXEL = 1e-9
"""Pixels to which every model's inverse is right, wherever the point is."""


def moved_matrix(matrix, angle=0.02, step=(0.05, -0.03, 0.02)):
    """A camera's matrix a little later."""
    moved = np.array(matrix, float)
    moved[:3, :3] = turn(angle) @ turn(angle, 1) @ moved[:3, :3]
    moved[:3, 3] += step
    return moved


def moved_shapes(shapes, rng):
    """Shapes that have turned and gone on, but for one that stands still."""
    turns = np.array([turn(angle, k % 3) for k, angle in enumerate(rng.uniform(-0.1, 0.1, len(shapes)))])
    center, axes = shapes.center + rng.uniform(-0.2, 0.2, shapes.center.shape), turns @ shapes.axes
    center[0], axes[0] = shapes.center[0], shapes.axes[0]
    return replace(shapes, center=center, axes=axes)


def exactly_moved(before, after, k, point):
    """Where a point on shape k is when the shape has moved, with 60 digits."""
    inner = truth.times(truth.to_shape(before, k), truth.minus(point, truth.exact(before.center[k])))
    return truth.along(truth.exact(after.center[k]), truth.times(truth.exact(after.axes[k]), inner), 1)


def pixels_beside(raw, pixel, point):
    """How far a pixel is from the one whose exact ray meets a point: a step of Newton's method with 60 digits."""

    def off(x, y):
        ray = truth.ray(raw, x, y)
        towards = ray and truth.minus(point, ray.origin)
        return ray and truth.minus([d / ray.length for d in ray.direction], [t / truth.norm(towards) for t in towards])

    (along_x, along_y), _ = differences.derivatives(off, *pixel)
    rest = off(*map(mpf, map(float, pixel)))
    a, b, d = truth.dot(along_x, along_x), truth.dot(along_x, along_y), truth.dot(along_y, along_y)
    e, f = truth.dot(along_x, rest), truth.dot(along_y, rest)
    return truth.norm([(d * e - b * f) / (a * d - b * b), (a * f - b * e) / (a * d - b * b)])


@pytest.mark.parametrize("model", [model for model in MODELS if model.differentiable], ids=lambda model: model.key)
def test_each_point_is_where_60_digits_see_it_and_hidden_where_they_hide_it(model):
    """Within the bound of its position, as the picture enlarges it, and that of the model's inverse."""
    rng = np.random.default_rng(3)
    raw = raw_of(model.key, SIZE | {"matrix_world": TURNED})
    later = raw_of(model.key, SIZE | {"matrix_world": moved_matrix(TURNED)})
    shapes = shapes_of(*random_rows(rng, 8), (SPHERE, (0, 0, 0), 30.0))  # the last is all around
    shapes = replace(shapes, center=shapes.center + np.array(TURNED)[:3, 3])
    after = moved_shapes(shapes, rng)
    camera, shapes = with_others(camera_from(raw), shapes, camera_from(later), after)
    columns, rows = np.array([20, 33]), np.array([14, 25])
    passes = "flow_forward", "flow_hidden", "shape_index", "position_bound"
    found = passes_at(camera, shapes, columns, rows, passes)
    answers = {True: 0, False: 0}
    for j, i in np.ndindex(2, 2):
        hit = truth.ray(raw, columns[i] + 0.5, rows[j] + 0.5)
        hit = hit and truth.nearest(shapes, hit, camera.clip_start, camera.clip_end)
        flow, hidden = found["flow_forward"][j, i], found["flow_hidden"][j, i, 0]
        if hit is None:
            assert np.isnan(flow).all()
            assert not hidden
            continue
        point = exactly_moved(shapes, after, hit.shape, hit.position)
        place, jacobian = camera.next.project(np.array(point, float), jacobian=True)
        if np.isnan(flow).any():
            assert not ((place > 0) & (place < (64, 48))).all()
            assert not hidden
            continue
        pixel = flow + np.array((columns[i] + 0.5, rows[j] + 0.5))
        allowed = PIXEL + 2 * np.linalg.norm(jacobian) * found["position_bound"][j, i]
        assert pixels_beside(later, pixel, point) <= allowed
        ray = truth.ray(later, *pixel)
        towards = truth.minus(point, ray.origin)
        distance = truth.norm(towards)
        aimed = truth.Ray(ray.origin, [part / distance for part in towards])
        before = [t for k in range(len(after)) for t in truth.crossings(after, k, aimed)[0]
                  if camera.clip_start < t < distance * (1 - mpf(10) ** -12)]  # fmt: skip
        assert hidden == bool(before)
        answers[hidden] += 1
    assert sum(answers.values()) > 1


def test_nothing_moves_in_a_scene_that_stands_still():
    """And no surface hides itself, however its points are rounded."""
    shapes = random_shapes(np.random.default_rng(5), 60)
    for camera in (camera_at(), camera_at(type="ORTHO", ortho_scale=12.0), camera_from(raw_of("CROSS_SLIT", SIZE))):
        images = cast(*at_rest(camera, shapes), passes=("flow_forward", "flow_hidden", "shape_index"))
        flow, hit = images["flow_forward"], images["shape_index"] >= 0
        assert np.abs(flow[~np.isnan(flow)]).max() < PIXEL
        assert (np.isnan(flow).any(axis=-1) == ~hit).all()
        assert not images["flow_hidden"].any()


@pytest.mark.parametrize("key", ["OMNIDIRECTIONAL_STEREO", "STRIP"])
def test_a_point_that_is_seen_twice_is_followed_where_it_is(key):
    """By both eyes in one picture, and from a path that comes back: not to the other picture of it."""
    both = {"OMNIDIRECTIONAL_STEREO": {"eye": "TOP_BOTTOM"}, "STRIP": {"path": ((-2, 0, 0), (2, 0, 0), (-2, 0, 0.5))}}
    camera = camera_from(raw_of(key, SIZE | both[key]))
    shapes = shapes_of((SPHERE, (0, 0, 0), 6.0))
    images = cast(*at_rest(camera, shapes), passes=("flow_forward", "flow_hidden", "position", "shape_index"))
    hit = images["shape_index"] >= 0
    own = np.argwhere(hit)[:, ::-1] + 0.5
    assert np.abs(camera.project(images["position"][hit]) - own).max(axis=1).mean() > 5
    assert np.abs(images["flow_forward"][hit]).max() < PIXEL
    assert not images["flow_hidden"].any()


def test_a_mesh_hides_its_own_back_and_never_the_point_that_is_seen():
    """A smooth ball of flat triangles turns: what goes behind its rim is hidden, and it alone."""
    ball = meshes.ball(40, 60)
    camera, still = camera_at(resolution_x=200, resolution_y=200), meshes.shapes_of((ball, (0, 0, -4), 1.0))
    images = cast(*at_rest(camera, still), passes=("flow_hidden", "shape_index"))
    assert (images["shape_index"] == 0).sum() > 1000
    assert not images["flow_hidden"].any()
    turned = replace(still, axes=turn(0.3, 1)[None])
    images = cast(*with_others(camera, still, camera, turned), passes=("flow_hidden", "position", "shape_index"))
    there = (images["position"] - still.center[0]) @ turn(0.3, 1).T + still.center[0]
    facing = ((there - still.center[0]) * there).sum(axis=-1)
    hit, hidden = images["shape_index"] == 0, images["flow_hidden"][..., 0]
    assert hidden[hit & (facing > 0.5)].all()
    assert not hidden[hit & (facing < -0.5)].any()
    assert 50 < hidden.sum() < hit.sum() / 2


def test_a_picture_warped_by_its_flow_is_the_next_one():
    """Object indices and uv of the next frame, looked up where the flow leads, where nothing hides it."""
    rng = np.random.default_rng(1)
    size = {"resolution_x": 160, "resolution_y": 120}
    shapes = random_shapes(rng, 30)
    after = moved_shapes(shapes, rng)
    for key in ("PERSP", "FISHEYE_EQUIDISTANT", "EQUIRECTANGULAR", "CROSS_SLIT"):
        camera = camera_from(raw_of(key, size))
        later = camera_from(raw_of(key, size | {"matrix_world": moved_matrix(np.eye(4))}))
        passes = "flow_forward", "flow_hidden", "shape_index", "uv"
        now = cast(*with_others(camera, shapes, later, after), passes=passes)
        then = cast(later, after, passes=("shape_index", "uv"))
        x, y = np.meshgrid(np.arange(160) + 0.5, np.arange(120) + 0.5)
        target = now["flow_forward"] + np.stack((x, y), axis=-1)
        seen = ~np.isnan(target[..., 0]) & ~now["flow_hidden"][..., 0]
        column, row = np.minimum(np.floor(target[seen]), (159, 119)).astype(int).T
        same = then["shape_index"][row, column] == now["shape_index"][seen]
        assert same.mean() > 0.97  # the rest lies within a pixel of an edge
        finite = same & (now["shape_index"][seen] < 30)  # the uv of the infinite plane has no end
        apart = np.abs(then["uv"][row, column] - now["uv"][seen])[finite].max(axis=1, initial=0.0)
        assert np.median(apart) < 0.02
        returned = cast(*with_others(later, after, camera, shapes), passes=("flow_backward",))["flow_backward"]
        assert np.nanmedian(np.abs(returned[row, column] + now["flow_forward"][seen])) < 0.2


def test_flow_is_from_pixel_to_pixel_with_y_up():
    """One Blender unit is 16 pixels in this orthographic camera: what goes right goes to larger columns."""
    camera = timed_camera({})
    shapes = shapes_of((SPHERE, (0, 0, -5), 1.0))
    after = replace(shapes, center=shapes.center + np.array((0.25, 0.125, -1.0)))
    flow = cast(*with_others(camera, shapes, camera, after), passes=("flow_forward",))["flow_forward"]
    assert flow[24, 32] == pytest.approx((4.0, 2.0), abs=1e-12)
    assert np.isnan(flow[0, 0]).all()


def test_what_leaves_the_full_frame_has_no_flow_and_a_border_is_no_end():
    camera = timed_camera({}, use_border=True, border_min_x=0.25, border_max_x=0.75)
    shapes = shapes_of((PLANE, (0, 0, -5), 9.0))
    after = replace(shapes, center=shapes.center + np.array((1.5, 0, 0)))
    flow = cast(*with_others(camera, shapes, camera, after), passes=("flow_forward",))["flow_forward"]
    assert flow.shape == (48, 32, 2)
    assert flow[:, :24, 0] == pytest.approx(24, abs=1e-12)
    assert np.isnan(flow[:, 24:]).all()


def test_a_wall_hides_and_so_does_the_clip_range():
    camera = timed_camera({})
    shapes = shapes_of((PLANE, (0, 0, -5), 0.5), (PLANE, (9, 0, -3), 1.0))
    hidden = replace(shapes, center=np.array([(0, 0, -5), (0.75, 0, -3.0)]))
    images = cast(*with_others(camera, shapes, camera, hidden), passes=("flow_forward", "flow_hidden"))
    assert images["flow_hidden"][24, 24:40, 0].tolist() == [False] * 4 + [True] * 12
    assert (images["flow_forward"][24, 24:40] == 0).all()
    clipped = replace(camera, clip_end=4.0)
    images = cast(*with_others(camera, shapes, clipped, shapes), passes=("flow_hidden",))
    assert images["flow_hidden"][24, 24:40].all()


def test_deforming_meshes_are_followed_by_their_triangles():
    """A sheet that is stretched to the right: each point goes as far as its place says."""
    sheet = meshes.grid(4, 4, lambda u, v: (2 * u - 1, 2 * v - 1, 0 * u))
    wide = replace(sheet, vertices=sheet.vertices * np.float32([[1.5], [1], [1]]))
    camera = timed_camera({})
    now, after = meshes.shapes_of((sheet, (0, 0, -5), 1.0)), meshes.shapes_of((wide, (0, 0, -5), 1.0))
    images = cast(*with_others(camera, now, camera, after), passes=("flow_forward", "position", "flow_hidden"))
    seen = ~np.isnan(images["flow_forward"][..., 0])
    assert images["flow_forward"][seen][:, 0] == pytest.approx(images["position"][seen][:, 0] * 0.5 * 16, abs=1e-10)
    assert not images["flow_hidden"].any()
    flat = meshes.shapes_of((sheet, (0, 0, -5), np.diag([1.0, 1.0, 0.0])))
    gone = replace(flat, center=flat.center + np.array((0.25, 0, 0)), axes=np.diag([1.0, 1.0, 0.0])[None])
    flow = cast(*with_others(camera, flat, camera, gone), passes=("flow_forward",))["flow_forward"]
    assert flow[24, 32] == pytest.approx((4, 0), abs=1e-12)


def test_times_of_an_image_at_which_no_point_is_left_to_follow():
    """The sheet is met at the first of two times. It goes right by 0.25 units, which are 4 pixels."""
    times = np.zeros((48, 64))
    times[0, 63] = 1.0  # beside the sheet
    camera = timed_camera(ROWS | {"time_mode": "IMAGE", "time_image": times})
    sheet = meshes.grid(4, 4, lambda u, v: (2 * u - 1, 2 * v - 1, 0 * u))
    now, after = (meshes.shapes_of((sheet, (x, 0, -5), 1.0)) for x in (0.0, 0.25))
    motion = resolve(lambda time: (camera, now), camera.pixel_time.first, camera.pixel_time.last, 0.01, 64)
    pair = with_others(*with_motion(camera, now, motion), camera, after)
    flow = cast(*pair, passes=("flow_forward",))["flow_forward"]
    assert flow[24, 16:48] == pytest.approx(np.broadcast_to((4.0, 0.0), (32, 2)), abs=1e-9)


def test_a_rolling_shutter_sees_a_point_at_the_time_of_its_row():
    """A wall goes right at 0.5 a frame and up at 1: the flow is one frame's way, 8 and 16 pixels of 16 a unit, but for
    the rows between, which are cast 0.25 / 48 of a frame earlier each: v (1 - 16 k / 48 ...) solved by hand.
    """
    speed = np.array([0.5, 1.0, 0.0])

    def at(frame):
        settings = SHUTTER | {"frame": frame}

        def evaluate(time):
            return timed_camera(settings), shapes_of((PLANE, speed * (time - 5) + (0, 0, -5), 20.0))

        camera, shapes = evaluate(frame)
        motion = resolve(evaluate, camera.pixel_time.first, camera.pixel_time.last, 0.01, 64)
        return with_motion(camera, shapes, motion)

    camera, shapes = with_others(*at(5.0), *at(6.0))
    images = cast(camera, shapes, passes=("flow_forward", "flow_hidden"))
    # time falls by 0.5 / 48 a row, so dt = 1 - 0.5 / 48 dy and dy = 16 dt
    time = 1 / (1 + 16 * 0.5 / 48)
    flow = images["flow_forward"][:20, :50]
    assert flow == pytest.approx(np.broadcast_to((8 * time, 16 * time), flow.shape), abs=1e-9)
    assert not images["flow_hidden"].any()


def test_a_frame_that_was_not_read_is_named():
    with pytest.raises(InputError, match=r"flow_forward.* next frame, which was not read: .*with_timeline.next="):
        cast(camera_at(), shapes_of((SPHERE, (0, 0, -5), 1.0)), passes=("depth", "flow_forward"))
