"""How rays change from pixel to pixel, and pixels with points: of every model, against differences of 60 digits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mpmath import mpf

from camera_ray_caster.core import memory
from camera_ray_caster.core.camera import pixel_coordinates
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import BORDER, EXAMPLES, TURNED, camera, raw_of
from ..truth import truth
from ..truth.differences import derivatives, moved, unit_ray

ROUNDED = 16 * EPS
"""Of the lengths of vectors (for an origin's, its direction's included), beside what a moved pixel makes; measured over
all examples is 10.
"""

NOTHING = mpf(10) ** -30
"""What differences leave of a derivative that is 0."""

STEP = 2.0**-20
"""Pixels: their square is beyond 1e-9 of them."""

SHEARED = np.array(TURNED) @ [[1, 0.5, 0, 0], [0, 2, 0.3, 0], [0.1, 0, -1, 0], [0, 0, 0, 1]]
"""Sheared, stretched and mirrored."""

KEYS = [model.key for model in MODELS if model.differentiable]
each_model = pytest.mark.parametrize("key", KEYS)


def examples(key):
    """The model's examples, and the first one of a sheared camera."""
    return [*EXAMPLES[key], EXAMPLES[key][0] | {"matrix_world": SHEARED}]


def places(cam, count=2):
    """Pixel coordinates that have rays, beside pixel centers: no kink of an example lies there."""
    rng = np.random.default_rng(17)
    rows, columns = np.argwhere(cam.rays().valid)[rng.integers(0, cam.rays().valid.sum(), count)].T
    off_x, off_y = rng.uniform(-0.4, 0.4, (2, count))
    return cam.raster.columns()[0, columns] + off_x, cam.raster.rows()[rows, 0] + off_y


def rounding(cam, x, y):
    """By how much rounding moves a pixel, in x and y, pixel by pixel."""
    return np.transpose([np.broadcast_to(array, x.shape) for array in cam.model.pixel_rounding(x, y)])


@each_model
def test_how_rays_change_is_what_sixty_digits_say(key):
    for settings in examples(key):
        cam, raw = camera(key, settings), raw_of(key, settings)
        x, y = places(cam)
        jacobian, compared = cam.rays_jacobian_at(x, y), 0
        for k, pixel in enumerate(rounding(cam, x, y)):
            exact = derivatives(lambda x, y: unit_ray(raw, x, y), x[k], y[k])  # noqa: B023
            if exact is None:
                continue
            for axis, (by, second) in enumerate(zip(*exact, strict=True)):
                for rows, of_rays in ((slice(3), jacobian.origins), (slice(3, 6), jacobian.directions)):
                    off = truth.norm(truth.minus(truth.exact(of_rays[k, :, axis]), by[rows]))
                    size = truth.norm(by) if rows.start is None else truth.norm(by[rows])
                    assert off <= ROUNDED * size + moved([rows_of[rows] for rows_of in second], pixel) + NOTHING
            compared += 1
        assert compared


@each_model
def test_how_a_pixel_moves_with_its_point_is_the_inverse_of_how_the_point_moves_with_the_pixel(key):
    """At the pixel that was found and the ray's own t: the rows times the three ways to move the point are 0 or 1."""
    compared = 0
    for settings in examples(key):
        cam, raw = camera(key, settings), raw_of(key, settings)
        x, y = places(cam, 1)
        rays = cam.rays_at(x, y)
        points = rays.origins + 10 ** np.random.default_rng(5).uniform(-0.3, 2) * rays.directions
        seen, jacobian = cam.project(points, jacobian=True)
        np.testing.assert_array_equal(seen, cam.project(points))
        ray, point = unit_ray(raw, *map(mpf, seen[0])), truth.exact(points[0])
        if ray is None:  # the rim, to rounding
            continue
        t = truth.dot(truth.minus(point, ray[:3]), ray[3:])
        exact = derivatives(lambda x, y: spot(unit_ray(raw, x, y), t), *seen[0])  # noqa: B023
        if exact is None:
            continue
        ways, turns = [*exact[0], ray[3:]], [*exact[1], exact[0]]
        amplified = ROUNDED * (truth.norm(point) + truth.norm(ray[:3])) / t
        for i, row in enumerate(map(truth.exact, jacobian[0])):
            for j, (way, turn) in enumerate(zip(ways, turns, strict=True)):
                allowed = amplified * truth.norm(way) + moved(turn, rounding(cam, *seen.T)[0])
                assert abs(truth.dot(row, way) - (i == j)) <= truth.norm(row) * allowed
        compared += 1
    assert compared >= 3


def spot(ray, t):
    """The point at t of a ray, where there is one."""
    return ray and truth.along(ray[:3], ray[3:], t)


def test_a_pinhole_s_derivatives_by_hand():
    """18 mm behind a lens of 18 mm: X = (x - 48) / 48, and pixel x of a point is 48 + 48 p_x / depth."""
    cam = camera("PERSP", {"lens": 18.0})
    pixel, jacobian = cam.project([1.0, -2.0, -4.0], jacobian=True)
    assert pixel == pytest.approx((60, 3), rel=4 * EPS)
    np.testing.assert_allclose(jacobian, [[12, 0, 3], [0, 12, -6]], rtol=8 * EPS)
    slope = 0.25  # of the ray through x = 60, y = 27; its length is L
    length = np.hypot(1, slope)
    by_x, by_y = cam.rays_jacobian_at(60.0, 27.0).directions.T
    np.testing.assert_allclose(by_x, np.array((1, 0, slope)) / 48 / length**3, rtol=8 * EPS)
    np.testing.assert_allclose(by_y, np.array((0, 1, 0)) / 48 / length, rtol=8 * EPS)


@pytest.mark.parametrize("key", ["FISHEYE_EQUIDISTANT", "FISHEYE_LENS_POLYNOMIAL", "OPENCV_FISHEYE", "MIRRORBALL"])
def test_the_middle_of_a_fisheye_is_no_singular_place(key):
    """The radius is 0 there, and its own derivative has no number."""
    odd = {"resolution_x": 33, "resolution_y": 33, "cx": 16.0, "cy": 16.0, "fisheye_polynomial_k0": 0.0}
    cam = camera(key, odd)
    by_x, by_y = np.moveaxis(cam.rays_jacobian_at(16.5, 16.5).directions, -1, 0)
    assert by_x[0] > 0
    assert by_y[1] > 0
    assert abs(by_x[1:]).max() == abs(by_y[[0, 2]]).max() == 0
    beside = cam.rays_at([16.5 + STEP, 16.5], [16.5, 16.5 + STEP]).directions
    np.testing.assert_allclose([by_x[0], by_y[1]], [beside[0, 0] / STEP, beside[1, 1] / STEP], rtol=1e-9)


def test_a_middle_row_is_no_kink_of_a_measured_lens():
    """Its constant turns the ray at the very axis, and only there."""
    cam = camera("FISHEYE_LENS_POLYNOMIAL", {"resolution_y": 55, "fisheye_polynomial_k0": 1e-3})
    middle = cam.rays_jacobian_at(20.5, 27.5).directions
    beside = cam.rays_jacobian_at(20.5, 27.5 + 1e-9).directions
    np.testing.assert_allclose(middle, beside, atol=1e-10)


@each_model
def test_a_picture_has_the_derivatives_of_its_pixels(key):
    cam = camera(key, EXAMPLES[key][-1])
    rays, change = cam.rays(), cam.rays_jacobian()
    x, y = (grid.ravel() for grid in np.meshgrid(cam.raster.columns(), cam.raster.rows()))
    alone = cam.rays_jacobian_at(x, y)
    assert change.directions.shape == change.origins.shape == (*rays.valid.shape, 3, 2)
    np.testing.assert_array_equal(change.directions.reshape(-1, 3, 2), alone.directions)
    np.testing.assert_array_equal(change.origins.reshape(-1, 3, 2), alone.origins)
    np.testing.assert_array_equal(np.isnan(change.directions), np.isnan(rays.directions)[..., None].repeat(2, axis=-1))
    if cam.model.central:
        assert not change.origins.any()
    else:
        np.testing.assert_array_equal(np.isnan(change.origins), np.isnan(change.directions))


@pytest.mark.parametrize("key", ["EQUIRECTANGULAR", "CROSS_SLIT"])
def test_a_picture_of_several_blocks_and_threads_and_windows_on_top_of_each_other(key, monkeypatch):
    monkeypatch.setattr(pixel_coordinates, "SHARED_PIXELS", 1 << 10)
    cam = camera(key, {"resolution_x": 300, "resolution_y": 170})
    whole = cam.rays_jacobian()
    x, y = cam.raster.columns(), cam.raster.rows()
    stacked = cam.rays_jacobian_at(np.stack((x[:, :100], x[:, 200:])), np.stack((y, y)))
    for columns, part_directions in zip((slice(100), slice(200, 300)), stacked.directions, strict=True):
        np.testing.assert_array_equal(whole.directions[:, columns], part_directions)


@each_model
def test_a_border_cuts_and_moves_nothing(key):
    full, cut = camera(key), camera(key, BORDER)
    window = np.s_[cut.raster.y0 : cut.raster.y1, cut.raster.x0 : cut.raster.x1]
    np.testing.assert_array_equal(cut.rays_jacobian().directions, full.rays_jacobian().directions[window])


@pytest.mark.parametrize("key", ["PERSP", "ORTHO", "EQUIRECTANGULAR"])
def test_what_has_no_ray_or_no_pixel_has_no_derivatives(key):
    cam = camera(key)
    jacobian = cam.rays_jacobian_at([np.nan, np.inf, 1.0], [1.0, 1.0, 1.0])
    assert np.isnan(jacobian.directions[:2]).all()
    assert np.isfinite(jacobian.directions[2]).all()
    pixel, moves = cam.project([[np.nan, 0, -1], [0.1, np.inf, -1], [0.1, 0.1, -1]], jacobian=True)
    assert np.isnan(pixel[:2]).all()
    assert np.isnan(moves[:2]).all()
    assert np.isfinite(moves[2]).all()
    assert cam.project(np.zeros((0, 4, 3)), jacobian=True)[1].shape == (0, 4, 2, 3)


def test_what_cannot_be_asked_is_refused_in_one_line(monkeypatch):
    cam = camera("ORTHO", {"resolution_x": 1 << 16, "resolution_y": 1 << 16})
    monkeypatch.setattr(memory, "available", lambda: 1 << 30)
    for ask, words in (
        (lambda: cam.rays_jacobian(), "the derivatives of the rays of 65536 x 65536 pixels take 384 GiB"),
        (lambda: cam.rays_jacobian_at([1.0, 2.0], [1.0, 2.0, 3.0]), "give shapes that broadcast"),
        (lambda: cam.project(np.broadcast_to(1.0, (1 << 26, 3)), jacobian=True), "project fewer points"),
        (lambda: cam.project([0, 0, 0], jacobian=2), "jacobian is 2: it must be True, False or 'settings'"),
        (lambda: cam.project([0, 0], jacobian=True), "cannot be projected"),
    ):
        with pytest.raises(InputError, match=words) as caught:
            ask()
        assert "\n" not in str(caught.value)


class Sliding:
    """A camera that moves 0.1 a frame along X and turns no more."""

    def __init__(self, cam):
        self.cam = cam

    def camera_at(self, frame):
        return replace(self.cam, pose=replace(self.cam.pose, eye=np.array((0.1 * frame, 0, 0))))


def test_pixels_with_their_own_times_have_the_camera_s_own_derivatives():
    """A pixel has one time all over; a point's pixel depends on how fast the camera moves, which is refused."""
    rows = {"time_mode": "ROWS", "time_start": 1.0, "time_end": 20.0, "time_tolerance": 0.1, "time_evaluations": 9}
    for key in ("PERSP", "STRIP"):
        plain, still = camera(key), camera(key, rows)
        points = plain.rays().origins[3, 5] + 3 * plain.rays().directions[3, 5]
        assert still.pixel_time is not None
        moving = replace(still, motion=Sliding(plain))
        for cam in (still, moving):
            jacobian = cam.rays_jacobian()
            np.testing.assert_array_equal(jacobian.directions, plain.rays_jacobian().directions)
            np.testing.assert_array_equal(jacobian.origins, plain.rays_jacobian().origins)
        for ours, other in zip(still.project(points, jacobian=True), plain.project(points, jacobian=True), strict=True):
            np.testing.assert_array_equal(ours, other)
        with pytest.raises(InputError, match=r"camera\.at\(frame\)\.project") as caught:
            moving.project(points, jacobian=True)
        assert "\n" not in str(caught.value)
        assert moving.at(1.0).project(points, jacobian=True)[1].shape == (2, 3)
