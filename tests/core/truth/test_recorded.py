"""Formulas that are recorded and evaluated with mpmath: against formulas written anew, more digits, and numpy."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import asin, atan2, mp, mpf, sqrt

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.maths.inversion import Inverse
from camera_ray_caster.core.maths.recording import DOMAIN, record
from camera_ray_caster.core.maths.recording.record import NUMERIC

from ..cameras.model_examples import EXAMPLES, camera, raw_of
from . import truth
from .recorded import MPMATH, lens_of

KEYS = [model.key for model in MODELS]
ANEW = sorted(truth.formulas()[0])
DIGITS = mpf(10) ** -55
"""What 60 digits keep after some dozen operations, of origins and directions of size 1 to 100."""

BINARY = {
    "resolution_x": 64, "resolution_y": 32, "lens": 32.0, "sensor_width": 64.0, "ortho_scale": 8.0, "shift_x": 0.25,
    "shift_y": -0.125, "obscura_width": 4.0, "interocular_distance": 0.5, "latitude_bottom": 0.0,
    "slit_1": ((0, 0, 0), (1, 0, 0)), "slit_2": ((0, 0, 0.5), (0, 1, 0.5)), "twist": 0.25,
    "ray_1": (-0.125, -0.125, -0.5, -0.25), "ray_2": (0.125, -0.125, 0.5, -0.25), "ray_3": (-0.125, 0.125, -0.5, 0.5),
}  # fmt: skip
"""Settings of which float64 keeps every constant of these models, so that only the formulas may differ."""
EXACT = (
    "PERSP", "ORTHO", "MIRRORBALL", "CAMERA_OBSCURA", "GENERAL_LINEAR", "CROSS_SLIT", "PUSHBROOM", "PENCIL",
    "TWISTED_ORTHOGRAPHIC", "STRIP",
)  # fmt: skip

each_model = pytest.mark.parametrize("key", KEYS)


def places(cam, count=6):
    """Pixel coordinates all over a picture."""
    columns, rows = cam.raster.columns()[0], cam.raster.rows()[:, 0]
    x, y = np.meshgrid(columns[:: max(1, len(columns) // count)], rows[:: max(1, len(rows) // count)])
    return x.ravel(), y.ravel()


def off(left, right):
    """The distance between two rays' origins, and between their directions."""
    return tuple(truth.norm(truth.minus(a, b)) for a, b in zip(left, right, strict=True))


@each_model
def test_a_record_has_a_ray_where_numpy_has_one_and_as_many_digits_as_it_is_asked_for(key):
    for settings in EXAMPLES[key]:
        cam, (lens, _) = camera(key, settings), lens_of(raw_of(key, settings))
        x, y = places(cam)
        valid = cam.rays_at(x, y).valid
        for k in range(len(x)):
            ray = lens(x[k], y[k])
            assert (ray is not None) == valid[k]
            with mp.workdps(80):
                finer = lens(x[k], y[k])
            assert (finer is not None) == valid[k]
            assert ray is None or max(off(ray, finer)) <= DIGITS


@pytest.mark.parametrize("key", ANEW)
def test_a_record_gives_the_ray_of_the_formula_that_is_written_anew(key):
    """But for the rounding of the model's constants, which is a part of what the rays' error bound allows."""
    for settings in EXAMPLES[key]:
        raw, cam = raw_of(key, settings), camera(key, settings)
        x, y = places(cam)
        with np.errstate(all="ignore"):
            bounds = world_rays(cam, x, y)
        allowed = [np.broadcast_to(error, x.shape) for error in (bounds.origin_error, bounds.direction_error)]
        for k in range(len(x)):
            recorded, expected = truth.recorded_ray(raw, x[k], y[k]), truth.ray(raw, x[k], y[k])
            assert (recorded is None) == (expected is None)
            if recorded is not None:
                away = off((recorded.origin, recorded.direction), (expected.origin, expected.direction))
                assert away[0] <= allowed[0][k]
                assert away[1] <= allowed[1][k]


@pytest.mark.parametrize("key", EXACT)
def test_where_no_constant_is_rounded_the_two_are_one(key):
    raw, cam = raw_of(key, BINARY), camera(key, BINARY)
    for x, y in zip(*places(cam), strict=True):
        recorded, expected = truth.recorded_ray(raw, x, y), truth.ray(raw, x, y)
        assert (recorded is None) == (expected is None)
        if recorded is not None:
            assert max(off((recorded.origin, recorded.direction), (expected.origin, expected.direction))) <= DIGITS


def test_every_formula_that_is_written_anew_is_a_model_s():
    assert set(ANEW) <= set(KEYS)


@pytest.mark.parametrize("settings", EXAMPLES["OPENCV_PINHOLE"])
def test_iterated_directions_are_distorted_to_their_pixels_with_all_digits(settings):
    cam, (lens, _) = camera("OPENCV_PINHOLE", settings), lens_of(raw_of("OPENCV_PINHOLE", settings))
    for x, y in zip(*places(cam), strict=True):
        ray = lens(x, y)
        if ray is not None:
            u, v = cam.model.window.plane_from_pixels(mpf(x), mpf(y))
            sensor = u, -v, mpf(1)
            if cam.model.tilt:
                sensor = [truth.dot(row, sensor) for row in cam.model.tilt._inverse.tolist()]
            there = cam.model.distortion.distort(ray[1][0], -ray[1][1])
            assert truth.norm(truth.minus(there, (sensor[0] / sensor[2], sensor[1] / sensor[2]))) <= DIGITS


@pytest.mark.parametrize("settings", EXAMPLES["OPENCV_FISHEYE"])
def test_iterated_angles_are_distorted_to_their_radii_with_all_digits(settings):
    cam, (lens, _) = camera("OPENCV_FISHEYE", settings), lens_of(raw_of("OPENCV_FISHEYE", settings))
    for x, y in zip(*places(cam), strict=True):
        ray = lens(x, y)
        if ray is not None:
            a, b = cam.model.window.plane_from_pixels(mpf(x), mpf(y))
            right, up, back = ray[1]
            theta = atan2(sqrt(right * right + up * up), -back)
            assert abs(cam.model.distorted(theta) - sqrt(a * a + b * b)) <= DIGITS


@pytest.mark.parametrize("target", [0.0, 1e-30, 1e-3, 0.7, 1.0, -1e-16, 1 + 1e-15, -0.1, 1.1, float("nan")])
def test_an_inverse_has_all_digits_and_an_end_where_its_function_is_flat(target):
    """Of 1 - (1 - x)^2, whose slope is 0 at x = 1, where half of the digits are to be had."""
    inverse = Inverse(lambda x: x * (2 - x), lambda x: 2 - 2 * x, 0.0, 1.0)
    (value,) = record(lambda y: [inverse(y)], 1).evaluate(MPMATH, (mpf(target),))
    assert mp.isnan(value) == np.isnan(inverse(np.array([target]))[0])
    if not mp.isnan(value):
        goal = min(max(mpf(target), 0), 1)
        exact = goal / (1 + sqrt(1 - goal))
        assert abs(value - exact) <= (DIGITS if target < 1 else mpf(10) ** -25) * exact


@pytest.mark.parametrize("name", sorted(NUMERIC))
def test_an_operation_gives_what_numpy_gives_and_no_number_where_numpy_has_none(name):
    ufunc = getattr(np, name)
    numbers = [-2.5, -1.0, -0.5, 0.0, 0.3, 0.5, 1.0, 1.5, 2.0, float("nan")]
    rule = DOMAIN.get(name, lambda *_: True)
    for operands in np.array(np.meshgrid(*[numbers] * ufunc.nin)).reshape(ufunc.nin, -1).T.tolist():
        (value,) = record(lambda *x: [ufunc(*x)], ufunc.nin).evaluate(MPMATH, [mpf(x) for x in operands])
        with np.errstate(all="ignore"):
            expected = float(ufunc(*operands))
        spread = any(map(np.isnan, operands))  # though numpy has nan ** 0 = 1
        assert mp.isnan(value) == (spread or not np.isfinite(expected)) == (spread or not rule(*operands))
        assert mp.isnan(value) or float(value) == pytest.approx(expected, rel=1e-15, abs=1e-300)


def test_what_is_no_number_spreads_compares_as_false_and_does_no_harm_where_it_is_not_taken():
    def function(x):
        beyond = np.arcsin(x)
        return [np.where(x > 1, 7.0, beyond), np.where(beyond > 0, 1.0, 0.0), 0 * beyond + 1, np.isnan(beyond) + 0.0]

    taken = record(function, 1)
    assert taken.evaluate(MPMATH, (mpf(1) / 2,)) == (asin(mpf(1) / 2), 1, 1, 0)
    seven, compared, spread, is_none = taken.evaluate(MPMATH, (mpf(2),))
    assert (seven, compared, is_none) == (7, 0, 1)
    assert mp.isnan(spread)
