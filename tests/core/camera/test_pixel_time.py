"""Pictures whose pixels have each their own time: against still pictures, and motion worked out by hand."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core import tuning
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.motion.evaluations import measured, resolve
from camera_ray_caster.core.records import PLANE, SPHERE, BlenderCamera, InputError, Shapes

from ..casting.neighbors import with_motion

EFFORT = {"time_tolerance": 0.1, "time_evaluations": 256}
ROWS = EFFORT | {"time_mode": "ROWS", "time_start": 10.0, "time_end": 20.0}
SHUTTER = EFFORT | {
    "time_mode": "ROLLING_SHUTTER", "frame": 5.0, "motion_blur_shutter": 0.5, "motion_blur_position": "CENTER",
    "rolling_shutter_duration": 0.0, "readout": "TOP_TO_BOTTOM",
}  # fmt: skip


def turn(angle, axis=2):
    """A rotation about z, or about another axis."""
    matrix = np.eye(3)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    matrix[i, i] = matrix[j, j] = np.cos(angle)
    matrix[i, j], matrix[j, i] = -np.sin(angle), np.sin(angle)
    return matrix


def shapes(*spheres, kind=SPHERE):
    """Shapes from (center, axes) pairs."""
    n = len(spheres)
    ones = np.ones(n, np.int32)
    axes = np.array([np.eye(3) * a if np.ndim(a) == 0 else a for _, a in spheres], float)
    center = np.array([c for c, _ in spheres], float)
    color = np.ones((n, 4), np.float32)
    names = tuple("abcdefgh"[:n])
    return Shapes(np.full(n, kind, np.uint8), center, axes, ones, ones, color, np.arange(n, dtype=np.int32), names)


def camera(settings, matrix=None, **raw):
    """A camera of 64 x 48 pixels; one Blender unit is 16 pixels in the orthographic one."""
    raw = {"type": "ORTHO", "ortho_scale": 4.0, "resolution_x": 64, "resolution_y": 48} | raw
    matrix = np.eye(4) if matrix is None else matrix
    return camera_from(BlenderCamera("Camera", matrix_world=matrix, settings=settings, **raw))


def test_rows_columns_and_images_have_their_times():
    rows = camera(ROWS).rays().time
    assert rows.shape == (48, 64)
    assert rows[:, 3] == pytest.approx(10 + (np.arange(48) + 0.5) / 48 * 10, rel=1e-14)
    columns = camera(ROWS | {"time_mode": "COLUMNS"}).rays().time
    assert columns[3] == pytest.approx(10 + (np.arange(64) + 0.5) / 64 * 10, rel=1e-14)
    gray = np.array([[0.0, 0.2], [1.0, 0.6]])
    image = camera(ROWS | {"time_mode": "IMAGE", "time_image": gray}).rays().time
    assert image[0, 0] == 10
    assert image[0, 63] == 12
    assert image[47, 0] == 20
    assert image[47, 63] == 16
    assert camera({}).rays().time is None


@pytest.mark.parametrize(("position", "begin"), [("START", 5.0), ("CENTER", 4.75), ("END", 4.5)])
@pytest.mark.parametrize("duration", [0.0, 0.25])
def test_the_rolling_shutter_goes_by_row_index_from_the_top(position, begin, duration):
    settings = SHUTTER | {"motion_blur_position": position, "rolling_shutter_duration": duration}
    row = np.arange(48)
    expected = begin + 0.5 * ((48 - row) / 48 * (1 - duration) + duration / 2)
    assert camera(settings).rays().time[:, 0] == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("settings", [ROWS, ROWS | {"time_mode": "COLUMNS"}, SHUTTER,
                                      ROWS | {"time_mode": "IMAGE", "time_image": np.eye(8)}])  # fmt: skip
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_of_a_still_scene_it_is_the_plain_picture(settings, kind):
    still = shapes(((0.3, 0.1, -5), 1.0), ((-0.5, 0.2, -6), turn(0.3) * 0.8))
    passes = ("depth", "normal", "shape_index", "combined", "valid")
    plain = cast(camera({}, type=kind), still, passes=passes)
    timed = cast(camera(settings, type=kind), still, passes=passes)
    for name in passes:
        assert np.array_equal(plain[name], timed[name]), name
    again = cast(camera(settings, type=kind), still, passes=("combined",), samples=4)["combined"]
    assert np.array_equal(again, cast(camera({}, type=kind), still, passes=("combined",), samples=4)["combined"])


def moving(evaluate, first, last, tolerance=0.05, most=400):
    """Camera and shapes that know their motion."""
    motion = resolve(evaluate, first, last, tolerance, most)
    cam, still = evaluate(first)
    return *with_motion(cam, still, motion), motion


def test_each_pixel_shows_the_time_that_an_image_gives_it(monkeypatch):
    """And nothing of the other times, though the passes of each are made of whole parts of the picture."""
    monkeypatch.setattr(tuning, "BLOCK_PIXELS", 500)
    image = ROWS | {"time_mode": "IMAGE", "time_image": np.eye(8)}
    cam, scene, motion = moving(lambda f: (camera(image), shapes(((0.1 * (f - 15), 0, -5), 1.2))), 10, 20)
    passes = ("depth", "normal", "object_index", "position", "combined")
    timed, time = cast(cam, scene, passes=passes), cam.rays().time
    assert len(np.unique(time)) > 1
    for frame in np.unique(time):
        still = cast(*motion.at(frame), passes=passes)
        for name in passes:
            assert np.array_equal(timed[name][time == frame], still[name][time == frame]), name


def test_a_sphere_at_constant_speed_is_a_sheared_ellipse():
    """x moves by 0.1 a frame and the frame by 10 / 48 a row: row y sees the disc displaced by 0.1 (t - 15)."""
    cam, scene, motion = moving(lambda f: (camera(ROWS), shapes(((0.1 * (f - 15), 0, -5), 1.2))), 10, 20)
    assert motion.estimated < 1e-9
    hit = cast(cam, scene, passes=("shape_index",))["shape_index"] == 0
    x = (np.arange(64) + 0.5 - 32)[None] / 16
    y = (np.arange(48) + 0.5 - 24)[:, None] / 16
    displaced = 0.1 * (10 + (np.arange(48) + 0.5) / 48 * 10 - 15)[:, None]
    assert np.array_equal(hit, (x - displaced) ** 2 + y**2 <= 1.44)


def test_a_moving_camera_is_where_it_was_at_each_row():
    def evaluate(frame):
        matrix = np.eye(4)
        matrix[:3, 3] = 0.2 * (frame - 15), 0, 0
        return camera(ROWS, matrix), shapes(((0, 0, -5), 1.0))

    cam, scene, _ = moving(evaluate, 10, 20)
    rays = cam.rays()
    assert rays.origins[:, 0, 0] == pytest.approx((32 * -1 + 0.5) / 16 + 0.2 * (rays.time[:, 0] - 15), abs=1e-12)
    pixel = cam.project(np.array([[0.3, 0.4, -5.0], [0.0, 50.0, -5.0]]))
    assert np.isnan(pixel[1]).all()
    through = cam.rays_at(pixel[:, 0], pixel[:, 1])
    assert through.origins[0, :2] == pytest.approx((0.3, 0.4), abs=1e-9 / 16)
    assert np.isnan(through.origins[1]).all()
    x, y = np.meshgrid(np.arange(64) + 0.5, np.arange(48) + 0.5)
    assert np.array_equal(cam.rays_at(x.ravel(), y.ravel()).origins.reshape(48, 64, 3), rays.origins)
    assert cast(cam, scene, passes=("depth",))["depth"].min() == pytest.approx(
        4.0, abs=1e-3
    )  # half a pixel off the pole


def test_turning_things_turn_and_are_not_squeezed():
    """A bar turning at constant speed by 0.2 a frame: interpolated as a rotation two evaluations a sixth turn do."""
    bar = np.diag([1.2, 0.2, 0.2])
    evaluate = lambda f: (camera(ROWS), shapes(((0, 0, -5), turn(0.2 * f) @ bar)))  # noqa: E731
    _, scene, motion = moving(evaluate, 10, 20)
    assert len(motion.states) <= 40
    for frame in (10.0, 13.3, 17.77):
        assert scene.at(frame).axes[0] == pytest.approx(turn(0.2 * frame) @ bar, abs=1e-9)


def test_curved_motion_is_evaluated_until_the_tolerance_holds_and_the_estimate_is_honest():
    """On a circle of 16 pixels at two turns in ten frames a chord of angle a is off by 16 (1 - cos(a / 2))."""
    evaluate = lambda f: (  # noqa: E731
        camera(ROWS),
        shapes(((np.cos(0.4 * np.pi * f), np.sin(0.4 * np.pi * f), -5), 0.3)),
    )
    counts = []
    for tolerance in (0.5, 0.05, 0.005):
        _, _, motion = moving(evaluate, 10, 20, tolerance)
        assert not motion.unresolved
        off = measured(motion, evaluate, np.random.default_rng(1).uniform(10, 20, 50)).measured
        assert motion.estimated <= tolerance
        assert off <= 1.5 * tolerance
        counts.append(len(motion.states))
    assert counts[2] > counts[1] > counts[0]
    assert counts[2] < 8 * counts[0]  # third order: a hundred times as exact for some five times as many


@pytest.mark.full
@pytest.mark.parametrize("turns", [1, 7, 24, 100])
def test_a_fan_at_many_turns_a_frame_does_not_alias(turns):
    """Whole turns a frame look like rest at every frame; they are resolved, or said not to be."""
    blade = np.diag([1.2, 0.3, 0.1])
    evaluate = lambda f: (camera(SHUTTER), shapes(((0, 0, -5), turn(2 * np.pi * turns * f) @ blade), kind=PLANE))  # noqa: E731
    _, scene, motion = moving(evaluate, 4.75, 5.25, tolerance=0.1, most=300)
    if motion.unresolved:
        assert turns > 20
        return
    assert len(motion.states) > 3 * turns
    assert measured(motion, evaluate, np.random.default_rng(2).uniform(4.75, 5.25, 50)).measured <= 0.15
    hit = cast(replace(camera(SHUTTER), motion=motion), scene, passes=("shape_index",))["shape_index"]
    time = camera(SHUTTER).rays().time
    x, y = (np.arange(64) + 0.5 - 32)[None] / 16, (np.arange(48) + 0.5 - 24)[:, None] / 16
    angle = 2 * np.pi * turns * time
    along, across = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    clear = np.maximum(np.abs(along) - 1.2, np.abs(across) - 0.3)
    sure = np.abs(clear) > 0.02  # a third of a pixel from the edge
    assert np.array_equal((hit == 0)[sure], (clear < 0)[sure])


def test_what_the_budget_leaves_is_named():
    evaluate = lambda f: (camera(ROWS), shapes(((np.sin(50 * f), 0, -5), 1.0)))  # noqa: E731
    _, _, motion = moving(evaluate, 10, 20, tolerance=0.01, most=30)
    assert len(motion.states) <= 30
    assert motion.unresolved


def test_shapes_that_come_and_go_are_never_mixed():
    def evaluate(frame):
        return camera(ROWS), shapes(((0, 0, -5), 1.0)) if frame < 15.3 else shapes(((0, 0, -5), 1.0), ((1, 1, -5), 1.0))

    _, scene, motion = moving(evaluate, 10, 20, most=100)
    assert not motion.unresolved
    for frame, count in ((12.0, 1), (15.3 - 2**-10, 1), (15.3 + 2**-10, 2), (18.0, 2)):
        assert len(scene.at(frame)) == count


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (ROWS | {"time_end": 10.0}, "time_start and time_end.*both 10: set them apart"),
        (ROWS | {"time_end": 3.4e38}, "time_end .*3.4e.38: it must be from -1048574 to 1048574"),
        (ROWS | {"time_start": float("nan")}, "time_start .*nan"),
        (ROWS | {"time_mode": "DIAGONAL"}, "DIAGONAL.*ROWS"),
        (ROWS | {"time_mode": "IMAGE"}, "image"),
        (
            ROWS | {"time_mode": "IMAGE", "time_image": np.array([[0.0, np.nan], [np.inf, 1.0]])},
            "time_image of camera .* 2 of 4 pixels are NaN or infinite: choose another image",
        ),
        (ROWS | {"time_tolerance": 0.0}, "time_tolerance"),
        (ROWS | {"time_evaluations": 1}, "time_evaluations"),
        (SHUTTER | {"motion_blur_shutter": 0.0}, "motion_blur_shutter .* is 0: it must be above 0"),
        (
            SHUTTER | {"motion_blur_shutter": 1e20},
            "frames -4.79167e.19 to 5e.19: keep them between -1048574 and 1048574",
        ),
        (SHUTTER | {"frame": 1048574.0}, "to 1.04857e.06: keep them between"),
        (SHUTTER | {"rolling_shutter_duration": 2.0}, "rolling_shutter_duration .* is 2: it must be from 0 to 1"),
    ],
)
def test_times_without_meaning_are_refused(settings, message):
    with pytest.raises(InputError, match=message):
        camera(settings)


def test_a_zoom_is_interpolated():
    """A lens that zooms from 20 to 60 mm: a point at the slope 1/4 stands lens / 36 x 64 / 4 pixels from the middle."""
    zoom = lambda f: 20 + 4 * (f - 10)  # noqa: E731
    evaluate = lambda f: (  # noqa: E731
        camera(ROWS, type="PERSP", lens=zoom(f), sensor_width=36.0),
        shapes(((1.0, 0, -4), 0.1)),
    )
    cam, _, motion = moving(evaluate, 10, 20)
    assert not motion.unresolved
    assert len(motion.states) < 40
    for frame in (10.7, 13.33, 19.1):
        pixels = motion.camera_at(frame).project(np.array([1.0, 0.0, -4.0]))
        assert pixels == pytest.approx([32 + zoom(frame) / 36 * 16, 24], abs=0.05)
    assert np.isfinite(cam.rays().directions).all()


@pytest.mark.parametrize("settings", [ROWS, ROWS | {"time_mode": "COLUMNS"},
                                      ROWS | {"time_mode": "IMAGE", "time_image": np.eye(8)}])  # fmt: skip
@pytest.mark.filterwarnings("error")
def test_places_that_are_not_numbers_have_no_ray_and_warn_of_nothing(settings):
    def evaluate(frame):
        matrix = np.eye(4)
        matrix[0, 3] = np.sin(frame)
        return camera(settings, matrix), shapes(((0, 0, -5), 1.0))

    cam, _, _ = moving(evaluate, 10, 20)
    known = cam.rays_at(3.5, 4.5).origins
    x, y = np.array([np.nan, 3.5, 3.5]), np.array([4.5, np.nan, 4.5])
    for rays in (cam.rays_at(x, y), cam.rays_jacobian_at(x, y)):
        assert np.isnan(rays.directions[:2]).all()
        assert np.isfinite(rays.directions[2]).all()
    assert np.array_equal(cam.rays_at(x, y).valid, [False, False, True])
    grid = cam.rays_at(x[None], y[:, None])
    assert np.array_equal(grid.valid, np.outer([True, False, True], [False, True, True]))
    assert np.array_equal(grid.origins[2, 2], known)


@pytest.mark.parametrize(("mode", "axis"), [("ROWS", 1), ("COLUMNS", 0)])
@pytest.mark.filterwarnings("error")
def test_beyond_the_frame_the_time_is_that_of_its_edge(mode, axis):
    """The edges have the frames 10 and 20; the camera is where it is then, at any distance."""
    settings = ROWS | {"time_mode": mode}

    def evaluate(frame):
        matrix = np.eye(4)
        matrix[2, 3] = np.sin(frame)
        return camera(settings, matrix), shapes(((0, 0, -5), 1.0))

    cam, _, motion = moving(evaluate, 10 + 5 / (64, 48)[axis], 20 - 5 / (64, 48)[axis])
    assert not motion.unresolved
    for far, frame in ((0.0, 10), (-1.0, 10), (-1e6, 10), ((64, 48)[axis], 20), (1e6, 20)):
        pixel = [7.5, 7.5]
        pixel[axis] = far
        rays = cam.rays_at(*pixel)
        assert rays.time == pytest.approx(frame, rel=1e-14)
        assert rays.origins[2] == pytest.approx(np.sin(frame), abs=0.01)
    for far in (np.inf, -np.inf):
        assert not cam.rays_at(7.5, far).valid
        assert not cam.rays_at(far, 7.5).valid
