"""Lenses that change between evaluations, against the same lens read at each frame."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.motion.evaluations import UNRESOLVED, resolve
from camera_ray_caster.core.motion.interpolation import TimeInterval
from camera_ray_caster.core.records import no_shapes

from ..cameras.model_examples import camera

WIDTH, HEIGHT = 96, 64
PICTURE = {
    "resolution_x": WIDTH, "resolution_y": HEIGHT, "calibration_width": WIDTH, "calibration_height": HEIGHT,
    "cx": WIDTH / 2 - 0.5, "cy": HEIGHT / 2 - 0.5,
}  # fmt: skip
FRAMES = 0.0, 0.3, 0.7, 1.0


def focal(length):
    return {"fx": length, "fy": length}


CHANGES = [
    ("UCM", lambda u: focal(10.0) | {"unified_xi": 0.7 + 0.6 * u}),  # no rim up to 1
    ("EUCM", lambda u: focal(10.0) | {"unified_alpha": 0.3 + 0.4 * u}),  # no rim up to 1/2
    ("DOUBLE_SPHERE", lambda u: focal(10.0) | {"unified_xi": -0.2, "unified_alpha": 0.4 + 0.3 * u}),
    ("RADIAL_POLYNOMIAL", lambda u: focal(20.0) | {"radial_polynomial": f"0 1 {-0.1 * u} {-0.02 - 0.01 * u}"}),
    ("DIVISION", lambda u: focal(20.0) | {"division_lambda": -0.2 + 0.8 * u}),  # no rim up to 0
    ("FOV", lambda u: focal(15.0) | {"fov_omega": 0.6 + 1.4 * u}),
    ("OPENCV_FISHEYE", lambda u: focal(15.0) | {"k1": -0.08 - 0.04 * u, "k2": 0.0045}),  # the rim jumps at -0.1
    ("FISHEYE624", lambda u: focal(15.0) | {"k1": 0.05 - 0.15 * u, "p1": 0.03 * u, "s1": 0.01}),
    ("FTHETA", lambda u: {"ftheta_angle_to_radius": f"0 18 0 {2 - 4 * u!r}", "ftheta_max_angle": 2.4 - u}),
    ("OCAM", lambda u: {"ocam_polynomial": f"-20 0 {0.02 - 0.05 * u!r}"}),
    (
        "FISHEYE_LENS_POLYNOMIAL",
        lambda u: {"fisheye_polynomial_k1": -0.05 - 0.15 * u, "fisheye_fov": 4.0, "sensor_width": 36.0},
    ),
]


@pytest.mark.parametrize(("key", "at"), CHANGES, ids=[key for key, _ in CHANGES])
def test_the_picture_ends_where_that_of_the_lens_at_the_frame_does(key, at):
    """Coefficients change evenly, so that interpolation is exact; where the picture ends, does not follow evenly."""
    read = lambda u: camera(key, PICTURE | at(u))  # noqa: E731
    interval = TimeInterval.of({u: (read(u), no_shapes()) for u in FRAMES}, FRAMES)
    counts = set()
    for u in (0.11, 0.42, 0.53, 0.64, 0.93):
        mixed, there = interval.camera_at(u), read(u)
        between, true = mixed.rays(), there.rays()
        assert np.array_equal(between.valid, true.valid), u
        np.testing.assert_allclose(between.directions[true.valid], true.directions[true.valid], atol=1e-9)
        assert np.abs(np.linalg.norm(between.directions[between.valid], axis=-1) - 1).max() < 1e-12
        points = there.pose.eye + true.directions[true.valid]
        np.testing.assert_allclose(mixed.project(points), there.project(points), atol=1e-6)
        counts.add(np.count_nonzero(true.valid))
    assert len(counts) > 1  # the edge moves within the frame


def seen_by(key, at, first=0.0, last=4.0):
    """The motion of a camera with a changing lens and nothing to see, and the function that reads the lens."""
    evaluate = lambda frame: (camera(key, PICTURE | at(frame)), no_shapes())  # noqa: E731
    return resolve(evaluate, first, last, 0.1, 1000), evaluate


EDGES = [
    ("FTHETA", lambda f: {"ftheta_angle_to_radius": "0 18", "ftheta_max_angle": 1.2 + 0.4 * np.sin(5 * f)}),
    ("FISHEYE_EQUISOLID", lambda f: {"fisheye_lens": 8.0, "fisheye_fov": 2.4 + 0.8 * np.sin(5 * f)}),
]


@pytest.mark.parametrize(("key", "at"), EDGES)
def test_the_edge_of_the_picture_is_within_the_tolerance_where_only_the_edge_moves(key, at):
    """Counted along rows and columns of a static read: where the edge crosses them, rays begin or end there.

    It is followed as closely as 1.5 times the tolerance, as places are.
    """
    motion, evaluate = seen_by(key, at)
    assert not motion.unresolved
    assert motion.estimated > 0.01
    fine = np.arange(0.0, WIDTH, 0.02)
    for frame in np.linspace(0.03, 3.97, 31):
        is_in, true = (
            cam.rays_at(fine, HEIGHT / 2 + 3.3).valid for cam in (motion.camera_at(frame), evaluate(frame)[0])
        )
        assert true.any()
        assert not true.all()
        assert np.count_nonzero(is_in != true) * 0.02 <= 0.15 + 0.02, frame


@pytest.mark.parametrize(("cx", "cy"), [(WIDTH / 2 - 0.5, HEIGHT / 2 - 0.5), (4.0, HEIGHT - 6.0), (-6.0, 20.0)])
def test_a_small_image_circle_is_followed_wherever_it_is(cx, cy):
    """A circle with a radius of 9 pixels, less than the distance of fixed places in the frame, whose content zooms."""

    def at(frame):
        scale = float(1 + 0.3 * np.sin(5 * frame))  # whose text is plain with any numpy
        return {"ftheta_angle_to_radius": f"0 {12 * scale!r}", "ftheta_max_angle": 0.75 / scale, "cx": cx, "cy": cy}

    motion, evaluate = seen_by("FTHETA", at)
    assert not motion.unresolved
    assert len(motion.states) > 20
    angle, turn = np.meshgrid((0.2, 0.4, 0.55), np.arange(0, 2 * np.pi, 0.3))
    points = np.stack((np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), -np.cos(angle)), axis=-1)
    off = [
        np.hypot(*(motion.camera_at(frame).project(points) - evaluate(frame)[0].project(points)).T).max()
        for frame in np.linspace(0.03, 3.97, 31)
    ]
    assert max(off) <= 0.15


def test_a_camera_without_any_ray_is_at_rest():
    motion, _ = seen_by("FTHETA", lambda _: {"ftheta_angle_to_radius": "0 1", "ftheta_max_angle": 0.5, "cx": -40.0})
    assert not motion.unresolved
    assert motion.estimated == 0


def test_what_is_measured_beyond_the_tolerance_is_said_as_clearly_as_what_is_not_resolved():
    motion, _ = seen_by(*EDGES[0])
    assert len(motion.in_words()) == 1
    for off in (0.2, np.inf):
        lines = replace(motion, measured=off).in_words()
        assert any(line.startswith(UNRESOLVED) and f"off by {off} pixels" in line for line in lines)


def test_a_lens_that_rests_is_one_lens_at_all_frames():
    """So that its tables are computed once, not at each pixel's time."""

    def evaluate(frame):
        matrix = np.eye(4)
        matrix[0, 3] = np.sin(frame)
        return camera("OPENCV_FISHEYE", PICTURE | focal(15.0) | {"matrix_world": matrix}), no_shapes()

    motion = resolve(evaluate, 0.0, 4.0, 0.1, 100)
    assert len({id(motion.camera_at(frame).model) for frame in np.linspace(0, 4, 30)}) == 1
