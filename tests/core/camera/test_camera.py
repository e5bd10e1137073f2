"""The rays of whole pictures, large enough for polynomials: those of their pixels, and the exact ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.maths.panels import SMALLEST_SIZE

from ..cameras.model_examples import EXAMPLES, camera, raw_of
from ..truth import truth
from .test_spherical_stereo import eye

LARGE = {"resolution_x": 1100, "resolution_y": 800, "calibration_width": 96, "calibration_height": 54}
SAME = 16 * EPS
"""Of a unit direction, or of the farthest origin: each of the two has some, of angles of up to two turns."""

WIDER = {"FISHEYE_EQUIDISTANT": 20 * EPS, "FISHEYE624": 32 * EPS, "THIN_PRISM_FISHEYE": 40 * EPS}
"""The equidistant fisheye's factors are as large as half the field of view, 3.1, and so is their rounding; of the other
two functions are inverted, each to some EPS over its slope, which sinks towards the rim: rays' own bounds are 30 to 70
there.
"""

ROUNDED = 8 * EPS
"""What polynomials and world coordinates add to a ray's own bound."""

BY_POLYNOMIALS = {
    "FISHEYE_EQUIDISTANT", "FISHEYE_LENS_POLYNOMIAL", "OPENCV_PINHOLE", "OPENCV_FISHEYE", "UCM", "EUCM",
    "DOUBLE_SPHERE", "FISHEYE624", "THIN_PRISM_FISHEYE", "FOV", "DIVISION", "RADIAL_POLYNOMIAL", "FTHETA", "OCAM",
    "OMNIMAX", "DOME_MASTER", "STEREOGRAPHIC_PANORAMA", "EQUIANGULAR_CUBEMAP_FACE", "GENERAL_LINEAR", "CROSS_SLIT",
    "PUSHBROOM", "PENCIL", "TWISTED_ORTHOGRAPHIC", "REAL_LENS",
}  # fmt: skip
"""Models that give the rays of whole pictures by polynomials."""

each_model = pytest.mark.parametrize("key", [model.key for model in MODELS])


def tolerance(key: str, settings: dict, cam):
    """What the rays of a picture may differ by from those of its pixels: a number, or one for each ray, (n, 1)."""
    same = WIDER.get(key, SAME)
    if settings.get("port_inside", 1.0) <= settings.get("port_medium", 1.0):
        return same
    # Towards the critical angle a ray turns with the square root of the pixel: by 4,700 EPS, a sixth of both bounds.
    bounds = world_rays(cam, cam.raster.columns(), cam.raster.rows())
    turned = bounds.direction_error / np.linalg.norm(np.broadcast_arrays(*bounds.direction), axis=0)
    return np.fmax(same, turned).reshape(-1, 1)


def by_pixel(cam, x, y):
    """The rays through a row and a column of pixel coordinates, asked as a list of pixels."""
    x, y = np.broadcast_arrays(x, y)
    return cam.rays_at(x.ravel(), y.ravel())


def assert_same(rays, alone, same=SAME):
    """All pixels have rays in both or in neither, and these are the same to ``same``."""
    np.testing.assert_array_equal(rays.valid.ravel(), alone.valid)
    seen = alone.valid[:, None]
    turned = np.where(seen, rays.directions.reshape(-1, 3) - alone.directions, 0)
    assert (np.abs(turned) <= same).all()
    farthest = np.abs(alone.origins[alone.valid]).max(initial=0)
    moved = np.where(seen, rays.origins.reshape(-1, 3) - alone.origins, 0)
    assert (np.abs(moved) <= same * farthest).all()


@each_model
def test_a_picture_has_the_rays_of_its_pixels(key):
    """In every example that the cameras' contract is tested on."""
    differ = False
    for settings in EXAMPLES[key]:
        cam = camera(key, settings | LARGE)
        rays = cam.rays()
        assert (rays.valid.shape[0] >= SMALLEST_SIZE[0]) & (rays.valid.shape[1] >= SMALLEST_SIZE[1])
        alone = by_pixel(cam, cam.raster.columns(), cam.raster.rows())
        assert_same(rays, alone, tolerance(key, settings, cam))
        differ |= bool((rays.directions.reshape(-1, 3)[alone.valid] != alone.directions[alone.valid]).any())
    assert differ == (key in BY_POLYNOMIALS)


@pytest.mark.parametrize("key", ["FISHEYE_EQUIDISTANT", "OPENCV_FISHEYE", "GENERAL_LINEAR"])
def test_a_border_in_the_middle_of_panels_and_a_picture_of_several_blocks(key):
    border = {
        "use_border": True,
        "border_min_x": 0.11,
        "border_max_x": 0.93,
        "border_min_y": 0.013,
        "border_max_y": 0.97,
    }
    cam = camera(key, LARGE | {"resolution_x": 640, "resolution_y": 2600} | border)
    assert_same(cam.rays(), by_pixel(cam, cam.raster.columns(), cam.raster.rows()))


def test_a_panel_that_has_rays_beyond_its_nearest_point_is_no_empty_one():
    """Beside its axis the dome's edge leaves out pixels that are nearer to the middle than others with rays."""
    cam = camera("OMNIMAX", {"resolution_x": 3850, "resolution_y": 3000, "shift_x": 0.0020974, "shift_y": -0.0016})
    x, y = np.arange(3200, 3968)[None] + 0.5, np.arange(1008, 1224)[:, None] + 0.5
    assert_same(cam.rays_at(x, y), by_pixel(cam, x, y))


@pytest.mark.parametrize("key", ["PERSP", "EQUIRECTANGULAR", "MIRRORBALL", "FISHEYE_EQUIDISTANT", "FISHEYE_EQUISOLID"])
def test_a_picture_of_an_eye_of_spherical_stereo_has_the_rays_of_its_pixels(key):
    """Also where the offset is faded, with kinks; and far from the world's origin, which hides no error."""
    for settings in ({}, {"use_pole_merge": True}):
        cam = eye(key, resolution_x=1100, resolution_y=800, **settings)
        far = replace(cam, pose=replace(cam.pose, eye=cam.pose.eye + 1e9))
        rays, away = cam.rays(), far.rays()
        assert_same(rays, by_pixel(cam, cam.raster.columns(), cam.raster.rows()))
        np.testing.assert_array_equal(away.valid, rays.valid)
        np.testing.assert_allclose(away.directions, rays.directions, rtol=0, atol=SAME)


def test_a_fisheye_that_goes_around_more_than_once_has_all_its_rays():
    slope, half_fov = 0.3, 1.5 * np.pi
    settings = {"resolution_x": 600, "resolution_y": 600, "fisheye_fov": 2 * half_fov, "fisheye_polynomial_k1": -slope}
    rays = camera("FISHEYE_LENS_POLYNOMIAL", settings).rays()
    a, b = np.meshgrid(*2 * [(np.arange(600) - 299.5) * 0.06], sparse=True)  # 36 mm wide
    r = np.hypot(a, b)
    theta = slope * r
    np.testing.assert_array_equal(rays.valid, theta <= half_fov)
    exact = np.stack((a / r * np.sin(theta), b / r * np.sin(theta), -np.cos(theta)), axis=-1)
    rounded = 5 * half_fov * EPS  # 2 of each of the two angles, and what polynomials add
    np.testing.assert_allclose(rays.directions[rays.valid], exact[rays.valid], rtol=0, atol=rounded)


@pytest.mark.parametrize("key", ["PERSP", "FISHEYE_EQUIDISTANT", "EQUIRECTANGULAR", "PUSHBROOM"])
def test_many_scattered_pixels_and_points_are_those_of_their_parts(key):
    """Far more than a block that a thread takes at once, of any shape; one is not finite."""
    cam = camera(key, LARGE)
    x, y = np.random.default_rng(0).uniform(0, 1000, (2, 3, 60_000))
    x[1, 40_000] = np.nan
    rays = cam.rays_at(x, y)
    points = rays.origins + 7 * rays.directions
    pixels = cam.project(points)
    for window in (np.s_[0, :100], np.s_[1, 39_950:40_050], np.s_[2, -100:]):
        alone = cam.rays_at(x[window], y[window])
        for name in ("origins", "directions", "valid"):
            np.testing.assert_array_equal(getattr(alone, name), getattr(rays, name)[window])
        np.testing.assert_array_equal(cam.project(points[window]), pixels[window])
    assert not rays.valid[1, 40_000]


@pytest.mark.parametrize("key", ["PERSP", "MIRRORBALL", "FISHEYE_EQUIDISTANT", "PUSHBROOM"])
def test_windows_on_top_of_each_other_have_the_rays_of_each(key):
    cam = camera(key, {})
    x, y = np.arange(40.0).reshape(2, 1, 20), np.arange(300.0).reshape(2, 150, 1) / 6
    rays = cam.rays_at(x, y)
    for k in range(2):
        window_rays = cam.rays_at(x[k], y[k])
        np.testing.assert_array_equal(rays.directions[k], window_rays.directions)
        np.testing.assert_array_equal(rays.origins[k], window_rays.origins)


def test_a_bend_between_columns_is_in_its_columns():
    """A path makes a detour of six columns, and heads on as before."""
    u = 4 / 1100
    a = 593 * u - 2
    bend = (
        (-2, 0, 0),
        (a - 0.4 * u, 0, 0),
        (a, 0, 0),
        (a + u, 0, -2 * u),
        (a + 2 * u, 0, 0),
        (a + 2.4 * u, 0, 0),
        (2, 0, 0),
    )
    cam = camera("STRIP", {"resolution_x": 1100, "resolution_y": 200, "path": bend, "follow_path": True})
    assert_same(cam.rays(), by_pixel(cam, cam.raster.columns(), cam.raster.rows()))


@each_model
def test_the_rays_of_a_picture_are_within_their_bounds(key):
    """Against 60 digits."""
    rng = np.random.default_rng(11)
    for settings in EXAMPLES[key]:
        raw, cam = raw_of(key, settings | LARGE), camera(key, settings | LARGE)
        rays = cam.rays()
        at = tuple(rng.integers(0, size, 12) for size in rays.valid.shape)
        x, y = cam.raster.columns()[0, at[1]], cam.raster.rows()[at[0], 0]
        bounds = world_rays(cam, x, y)
        length = np.linalg.norm(np.broadcast_arrays(x, *bounds.direction)[1:], axis=0)
        turned = bounds.direction_error / length + ROUNDED
        moved = np.broadcast_to(bounds.origin_error + ROUNDED * np.nanmax(np.abs(rays.origins)), x.shape)
        for k in range(12):
            exact = truth.ray(raw, x[k], y[k])
            assert (exact is not None) == rays.valid[at][k]
            if exact is not None:
                size = truth.norm(exact.direction)
                assert off(rays.directions[at][k], [number / size for number in exact.direction]) <= turned[k]
                assert off(rays.origins[at][k], exact.origin) <= moved[k]


def off(rounded, exact):
    """The distance between a vector and the exact one."""
    return truth.norm([truth.mpf(f) - e for f, e in zip(rounded, exact, strict=True)])
