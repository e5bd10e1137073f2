"""A scanner that moves while it sweeps, past what moves: each beam at its own time, each point on its surface then."""

from dataclasses import replace

import numpy as np
import pytest
from mpmath import mp, mpf

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays.body_search import BodySearch
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.motion.evaluations import resolve
from camera_ray_caster.core.records import Pose

from ..casting.neighbors import with_motion

WALL, BALL, GROUND = 0, 1, 2
SPEED, WALL_SPEED = 1.5, 0.25
"""Of the scanner and of the wall, in units a frame."""
PASSES = "distance", "position", "normal", "shape_index", "position_bound", "ray_origin"


def shapes_at(frame):
    return crc.join(
        crc.planes((5.0 + WALL_SPEED * frame, 0.0, 1.5), [[0, 0], [3, 0], [0, 4]], name="wall"),
        crc.spheres([(-6.0, 2.0, 1.0)], 1.0, name="ball"),
        crc.planes((0.0, 0.0, 0.0), infinite=True, name="ground"),
    )


def moving(size=(360, 16), **settings):
    """A VLP-16 at 10 Hz and 100 frames a second, so that a sweep takes 10 frames; and what it sees."""
    still = crc.camera("SCANNER", size, crc.look_at((0, 0, 1.5), (1, 0, 1.5)), scanner_device="VLP_16",
                       time_mode="SWEEP", fps=100, frame=2.0, **settings)  # fmt: skip

    def evaluate(frame):
        eye = np.add(still.pose.eye, (0.0, SPEED * (frame - 2), 0.0))
        return replace(still, pose=Pose(eye, still.pose.basis)), shapes_at(frame)

    motion = resolve(evaluate, still.pixel_time.first, still.pixel_time.last, 0.1, 64)
    return with_motion(still, shapes_at(2.0), motion)


@pytest.fixture(scope="module")
def sweep():
    camera, shapes = moving()
    return camera, shapes, crc.cast(camera, shapes, passes=PASSES, dtype=np.float64)


def test_each_beam_leaves_from_where_the_scanner_is_when_it_fires(sweep):
    camera, _, images = sweep
    rays, beams = camera.rays(), camera.model.beams
    seconds = beams.delay[:, None] + 55.296e-6 * 1808 / 360 * np.arange(360)
    np.testing.assert_allclose(rays.time, 2.0 + 100 * seconds, rtol=0, atol=1e-12)
    np.testing.assert_allclose(rays.origins[..., 1], SPEED * 100 * seconds, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(images["ray_origin"], rays.origins)
    alone = camera.at(rays.time[7, 100])
    np.testing.assert_allclose(alone.rays_at(100.5, 7.5).directions, rays.directions[7, 100], rtol=0, atol=8 * EPS)


def test_beams_without_a_pass_are_not_cast(sweep):
    camera, shapes, images = sweep
    assert (images.rays, crc.cast(camera, shapes, passes=()).rays) == (360 * 16, 0)


def test_each_point_is_on_its_surface_at_its_time_to_the_stated_bound(sweep):
    camera, _, images = sweep
    rays, index = camera.rays(), images["shape_index"]
    on = {name: np.argwhere(index == name) for name in (WALL, BALL, GROUND)}
    assert all(len(places) > 50 for places in on.values())
    rng = np.random.default_rng(1)
    with mp.workdps(60):
        for name, places in on.items():
            for row, column in rng.permutation(places)[:334].tolist():
                x, y, z = map(mpf, images["position"][row, column].tolist())
                time, bound = mpf(float(rays.time[row, column])), images["position_bound"][row, column]
                off = {
                    WALL: x - (5 + WALL_SPEED * time),
                    BALL: mp.sqrt((x + 6) ** 2 + (y - 2) ** 2 + (z - 1) ** 2) - 1,
                    GROUND: z,
                }[name]
                assert abs(off) <= bound + 8 * EPS * 10 * (name == WALL)  # its place is interpolated


def test_the_points_are_those_of_a_cast_at_each_time(sweep):
    camera, shapes, images = sweep
    rays = camera.rays()
    for row, column in [(3, 10), (8, 90), (9, 95), (7, 200), (1, 350)]:
        then = shapes.at(float(rays.time[row, column]))
        hits = crc.cast_rays(
            rays.origins[row, column],
            rays.directions[row, column],
            then,
            passes=PASSES,
            times=None,
            near=0.5,
            far=100.0,
        )
        for name in PASSES:
            np.testing.assert_array_equal(hits[name], images[name][row, column])


def test_a_moving_wall_is_bent():
    """A level beam meets it farther away, the later it fires; in a picture of one time it is a plane."""
    camera, shapes = moving()
    now = replace(camera, pixel_time=None), shapes
    x = []
    for both in ((camera, shapes), now):
        images = crc.cast(*both, passes=("position", "shape_index"), dtype=np.float64)
        x.append(images["position"][8, images["shape_index"][8] == WALL, 0])
    assert (np.diff(x[0]) > 0).all()
    assert np.ptp(x[0]) > 0.2
    assert np.ptp(x[1]) < 1e-12


@pytest.mark.parametrize("mode", ["SWEEP", "COLUMNS", "ROWS"])
def test_where_nothing_moves_a_picture_with_times_is_cast_once(mode):
    """To the same bits; ``moments`` would make a plan for each column."""
    times = {} if mode == "SWEEP" else {"time_start": 1.0, "time_end": 9.0}
    camera = crc.camera("SCANNER", (90, 16), scanner_device="VLP_16", time_mode=mode, **times)
    shapes = shapes_at(1.0)
    motion = resolve(lambda frame: (camera, shapes), 1.0, 9.0, 0.1, 16)
    assert motion.is_still
    timed = crc.cast(*with_motion(camera, shapes, motion), passes=PASSES, dtype=np.float64)
    plain = crc.cast(crc.camera("SCANNER", (90, 16), scanner_device="VLP_16"), shapes, passes=PASSES, dtype=np.float64)
    for name in PASSES:
        np.testing.assert_array_equal(timed[name], plain[name])
    assert timed.camera.pixel_time is not None


def test_settings_that_change_during_a_sweep_are_refused():
    camera, _ = moving((90, 16))
    other = crc.camera("SCANNER", (90, 16), scanner_device="HDL_32E")
    states = dict(camera.motion.states)
    last = max(states)
    states[last] = replace(states[last][0], model=other.model), states[last][1]
    with pytest.raises(crc.InputError, match="change during the sweep"):
        replace(camera, motion=replace(camera.motion, states=states)).rays()


def test_rays_near_what_moves_are_found_whatever_it_is():
    """A box that turns and grows, a ball, a rectangle and an endless plane: beside a cast at the time of each ray."""
    corners = np.array([(a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)], float)
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]

    def at(frame):
        turn = np.array([[np.cos(frame), -np.sin(frame), 0], [np.sin(frame), np.cos(frame), 0], [0, 0, 1 + frame / 4]])
        return crc.join(
            crc.mesh(corners * (1, 0.3, 0.5) @ turn.T + (3 + frame, 0, 0.2), faces),
            crc.spheres([(-3, frame, 0.5), (0, -4, 0)], [0.7 + 0.1 * frame, 1.0]),
            crc.planes((0, 4, frame), [[1, 0], [0, 0.5], [0.2, 1]]),
            crc.planes((0, 0, -1 - 0.1 * frame), infinite=True),
        )

    first = at(0.0)
    state = crc.camera("PERSP", (8, 8))
    motion = resolve(lambda frame: (state, replace(at(frame), meshes=at(frame).meshes)), 0.0, 1.0, 0.1, 64)
    shapes = replace(first, motion=motion)
    rng = np.random.default_rng(5)
    times = np.round(rng.uniform(0, 1, 600), 2)
    rays = rng.normal(size=(600, 3)), rng.normal(size=(600, 3))
    hits = crc.cast_rays(*rays, shapes, passes=PASSES, times=times)
    assert set(hits["shape_index"].tolist()) == {-1, 0, 1, 2, 3, 4}
    for time in np.unique(times).tolist():
        some = times == time
        expected = crc.cast_rays(rays[0][some], rays[1][some], motion.shapes_at(time), passes=PASSES)
        for name in PASSES:
            np.testing.assert_array_equal(hits[name][some], expected[name])


def test_few_rays_without_a_tree_hit_what_many_hit_with_it():
    places = np.array([(x, y, np.sin(x + y)) for y in range(20) for x in range(20)], float)
    corner = np.array([20 * y + x for y in range(19) for x in range(19)])
    shapes = crc.mesh(places, np.stack((corner, corner + 1, corner + 21, corner + 20), axis=1))
    rng = np.random.default_rng(7)
    origin, direction = rng.uniform(0, 19, (3, 200)), rng.normal(size=(3, 200))
    few, many = BodySearch(shapes, 1), BodySearch(shapes)
    t, body = many.nearest(origin, direction, 0.0, np.inf)
    assert 20 < np.count_nonzero(body >= 0) < 180
    for ray in range(200):
        hit = few.nearest(origin[:, [ray]], direction[:, [ray]], 0.0, np.inf)
        assert (hit[0].tolist(), hit[1].tolist()) == ([t[ray]], [body[ray]])


def test_a_sweep_is_written_into_the_images_of_an_earlier_cast(sweep):
    camera, shapes = sweep[:2]
    passes = ("distance", "shape_index")
    images = crc.cast(camera, shapes, passes=passes)
    before = {name: images[name].copy() for name in passes}
    for name in passes:
        images[name].fill(7)
    again = crc.cast(camera, shapes, passes=passes, into=images)
    assert again is images
    for name in passes:
        np.testing.assert_array_equal(again[name], before[name])


@pytest.mark.parametrize("times", [1.99, 12.5, [2.0, 400.0]])
def test_times_beyond_the_frames_that_were_read_are_refused(sweep, times):
    shapes = sweep[1]
    with pytest.raises(crc.InputError, match=r"beyond the frames 2 to 11\.97"):
        crc.cast_rays([[0.0, 0, 1]] * 2, [1.0, 0, 0], shapes, passes="distance", times=times)


def test_no_rays_have_no_hits_at_any_time(sweep):
    none = np.zeros((0, 3))
    hits = crc.cast_rays(none, [1.0, 0, 0], sweep[1], passes="distance", times=3.0, all_hits=True)
    assert [hits[name].shape for name in ("distance", "ray", "count")] == [(0,)] * 3
