"""Calibrated lenses against OpenCV, and where their models end."""

import math

import cv2
import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras.parts.radial_tangential import RadialTangential
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.maths.panels import SMALLEST_SIZE

from .model_examples import camera

ORDER = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y")
K = np.array([[610.0, 0, 331.7], [0, 605.5, 236.2], [0, 0, 1]])
SIZE = {"resolution_x": 640, "resolution_y": 480, "fx": 610.0, "fy": 605.5, "cx": 331.7, "cy": 236.2}
LENSES = {
    "none": (),
    "barrel": (-0.28, 0.09, 0, 0, -0.01),
    "pincushion": (0.2, 0.03),
    "tangential": (-0.2, 0.05, 4e-3, -6e-3, 0.01),
    "rational": (8.2, 3.1, 1e-4, -2e-4, 0.12, 8.6, 5.0, 0.7),
    "thin prism": (-0.1, 0.02, 1e-3, 2e-3, 0, 0.05, 0, 0, 3e-3, -1e-3, -2e-3, 5e-4),
    "strongly tangential": (0.1, 0, 0.05, -0.08),
    "tilted": (0,) * 12 + (0.2, -0.1),
    "tilted, with all terms": (-0.1, 0.02, 1e-3, 2e-3, 0, 0.05, 0, 0, 3e-3, -1e-3, -2e-3, 5e-4, -0.3, 0.4),
}
FISHEYES = {
    "none": (),
    "usual": (-0.03, 0.004, -0.002, 0.0003),
    "wide": (0.08, -0.02, 0.007, -0.0009),
}
PROJECTION = 64 * EPS * 640
"""Pixels: some dozen operations on numbers of a few hundred, in OpenCV and here."""


def pinhole(*coefficients, **changes):
    return camera("OPENCV_PINHOLE", {**SIZE, **dict(zip(ORDER, coefficients, strict=False)), **changes})


def fisheye(*coefficients, **changes):
    names = ("k1", "k2", "k3", "k4")
    terms = dict(zip(names, coefficients, strict=False)) | changes
    return camera("OPENCV_FISHEYE", {**SIZE, "fx": 250.0, "fy": 245.0, **terms})


def bottom_up(pixels, height=480):
    """OpenCV's pixel coordinates, whose (0, 0) is the center of the top left pixel, in ours."""
    return np.stack((pixels[..., 0] + 0.5, height - (pixels[..., 1] + 0.5)), axis=-1)


def points_ahead(spread, count=400):
    """Points in the camera's frame, within ``spread`` (a tangent) of the viewing direction."""
    random = np.random.default_rng(11)
    depth = random.uniform(0.5, 50, count)
    return np.stack((*(random.uniform(-spread, spread, (2, count)) * depth), -depth), axis=-1)


OPENCV_FROM_CAMERA = np.array([1.0, -1, -1])


def opencv_pinhole(points, coefficients):
    """Where OpenCV projects points of the camera's frame, in our pixel coordinates; it wants 4 coefficients."""
    terms = np.array(coefficients if len(coefficients) > 4 else (*coefficients, 0, 0, 0, 0)[:4], float)
    pixels, _ = cv2.projectPoints(points * OPENCV_FROM_CAMERA, np.zeros(3), np.zeros(3), K, terms)
    return bottom_up(pixels[:, 0])


def opencv_fisheye(points, coefficients):
    """The same of its fisheye."""
    matrix = np.array([[250.0, 0, 331.7], [0, 245.0, 236.2], [0, 0, 1]])
    terms = np.array((*coefficients, 0, 0, 0, 0)[:4], float)
    ahead = (points * OPENCV_FROM_CAMERA)[:, None]
    pixels, _ = cv2.fisheye.projectPoints(ahead, np.zeros(3), np.zeros(3), matrix, terms)
    return bottom_up(pixels[:, 0])


@pytest.mark.parametrize("lens", LENSES)
def test_a_point_is_where_opencv_projects_it(lens):
    points = points_ahead(0.5, 10_000)
    pixels = pinhole(*LENSES[lens]).project(points)
    assert np.abs(pixels - opencv_pinhole(points, LENSES[lens])).max() < PROJECTION


@pytest.mark.parametrize("lens", FISHEYES)
def test_a_point_is_where_opencv_s_fisheye_projects_it(lens):
    points = points_ahead(3.0, 10_000)
    pixels = fisheye(*FISHEYES[lens]).project(points)
    assert np.abs(pixels - opencv_fisheye(points, FISHEYES[lens])).max() < PROJECTION


def by_camera_point(moved):
    """OpenCV's derivatives of pixels by its translation, (2 n, 3), as ours by the point in the camera's frame."""
    return moved.reshape(-1, 2, 3) * ((1,), (-1,)) * OPENCV_FROM_CAMERA


def assert_same_derivatives(derivatives, expected):
    """Each pixel's to some dozen operations."""
    size = np.linalg.norm(expected, axis=(1, 2), keepdims=True)
    assert (np.abs(derivatives - expected) / size).max() < 256 * EPS


@pytest.mark.parametrize("lens", LENSES)
def test_a_pixel_moves_with_its_point_as_opencv_says(lens):
    points, no_turn = points_ahead(0.4), np.zeros(3)
    _, jacobian = pinhole(*LENSES[lens]).project(points, jacobian=True)
    terms = np.resize(np.array(LENSES[lens] or [0.0]), 14) * (np.arange(14) < len(LENSES[lens]))
    _, by_all = cv2.projectPoints(points * OPENCV_FROM_CAMERA, no_turn, no_turn, K, terms)
    assert_same_derivatives(jacobian, by_camera_point(by_all[:, 3:6]))


@pytest.mark.parametrize("lens", FISHEYES)
def test_a_fisheye_s_pixel_moves_with_its_point_as_opencv_says(lens):
    points = points_ahead(2.0)
    _, jacobian = fisheye(*FISHEYES[lens]).project(points, jacobian=True)
    matrix, terms = np.array([[250.0, 0, 331.7], [0, 245.0, 236.2], [0, 0, 1]]), (*FISHEYES[lens], 0, 0, 0, 0)[:4]
    ahead = (points * OPENCV_FROM_CAMERA)[:, None]
    _, by_all = cv2.fisheye.projectPoints(ahead, np.zeros(3), np.zeros(3), matrix, np.array(terms, float))
    assert_same_derivatives(jacobian, by_camera_point(by_all[:, 11:14]))


@pytest.mark.parametrize("lens", LENSES)
def test_every_pixel_s_ray_is_the_one_that_opencv_projects_there(lens):
    rays = pinhole(*LENSES[lens]).rays()
    assert rays.valid.all()
    x, y = np.meshgrid(np.arange(640) + 0.5, np.arange(480) + 0.5)
    there = opencv_pinhole(rays.directions.reshape(-1, 3), LENSES[lens])
    assert np.abs(there - np.stack((x.ravel(), y.ravel()), axis=-1)).max() < 1e-9


def test_rays_are_found_where_the_terms_of_a_lens_cancel_each_other():
    """Near a pole, where the denominator's terms are up to a thousand times larger than their sum."""
    terms = {"k1": 0.3, "k4": 0.5, "k5": 0.1, "k6": -0.01, "s1": 1e-3, "s4": -2e-3}
    frame = {"fx": 60.0, "fy": 61.0, "cx": 48.0, "cy": 27.0}
    cam = camera("OPENCV_PINHOLE", {**terms, **frame, "resolution_x": 400, "resolution_y": 800})
    rays = cam.rays()
    assert rays.valid.all()
    assert cam.rays_at(399.5, 0.5).valid  # alone, as two numbers
    matrix = np.array([[60.0, 0, 48.0], [0, 61.0, 27.0], [0, 0, 1]])
    ahead = rays.directions.reshape(-1, 3) * OPENCV_FROM_CAMERA
    coefficients = np.array([terms.get(name, 0.0) for name in ORDER])
    pixels = cv2.projectPoints(ahead, np.zeros(3), np.zeros(3), matrix, coefficients)[0].reshape(800, 400, 2)
    column, row = np.meshgrid(np.arange(400), np.arange(800)[::-1])
    assert np.abs(pixels[..., 0] - column).max() < 1e-9
    assert np.abs(pixels[..., 1] - row).max() < 1e-9


@pytest.mark.parametrize("lens", FISHEYES)
def test_every_fisheye_pixel_s_ray_is_the_one_that_opencv_projects_there(lens):
    rays = fisheye(*FISHEYES[lens]).rays()
    ahead = rays.valid & (rays.directions[..., 2] < -0.01)  # OpenCV divides by the depth
    assert ahead.sum() > 150000
    x, y = np.meshgrid(np.arange(640) + 0.5, np.arange(480) + 0.5)
    there = opencv_fisheye(rays.directions[ahead], FISHEYES[lens])
    assert np.abs(there - np.stack((x[ahead], y[ahead]), axis=-1)).max() < 1e-9


def test_opencv_s_own_undistortion_agrees_as_far_as_it_goes():
    pixels = np.random.default_rng(3).uniform((0, 0), (639, 479), (200, 2))
    criteria = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 500, 1e-14)
    lens = np.array(LENSES["tangential"])
    undistort = getattr(cv2, "undistortPointsIter", cv2.undistortPoints)  # OpenCV 5 has one name for both
    plane = undistort(pixels[:, None], K, lens, R=None, P=None, criteria=criteria)[:, 0]
    at = bottom_up(pixels)
    directions = pinhole(*lens).rays_at(at[:, 0], at[:, 1]).directions
    slopes = directions[:, :2] / -directions[:, 2:] * (1, -1)
    np.testing.assert_allclose(slopes, plane, rtol=0, atol=1e-12)


def test_beyond_the_fold_there_is_neither_ray_nor_pixel():
    # r (1 - 0.3 r^2) grows up to r^2 = 1 / 0.9, where it is r 2/3
    limit = 1 / math.sqrt(0.9)
    edge = limit * 2 / 3 * 610.0
    cam = pinhole(-0.3, cx=100.0)
    rays = cam.rays()
    x = np.arange(640)
    row = rays.valid[480 - 1 - 236]
    np.testing.assert_array_equal(row, np.hypot((x - 100.0) / 610, -0.2 / 605.5) * 610 <= edge)
    assert not row.all()
    inside, outside = cam.project([[limit * 0.999, 0, -1], [limit * 1.001, 0, -1]])
    assert not np.isnan(inside).any()
    assert np.isnan(outside).all()
    angle = np.arctan2(np.hypot(rays.directions[..., 0], rays.directions[..., 1]), -rays.directions[..., 2])
    assert np.nanmax(angle) <= math.atan(limit)


def test_a_fisheye_goes_behind_the_eye_and_ends_where_its_polynomial_turns():
    cam = fisheye(resolution_x=2000, cx=999.5)
    np.testing.assert_allclose(cam.rays_at(1000 + 250 * math.radians(150), 480 - 236.7).directions, from_axis(150))
    assert not cam.rays_at(1000 + 250 * math.radians(181), 240).valid
    # theta (1 - theta^2 / 12) turns at theta = 2
    cam = fisheye(-1 / 12, resolution_x=2000, cx=999.5)
    edge = 250 * 2 * (1 - 4 / 12)
    assert cam.rays_at(1000 + edge - 1e-3, 480 - 236.7).valid
    assert not cam.rays_at(1000 + edge + 1e-3, 480 - 236.7).valid
    assert np.isnan(cam.project(from_axis(math.degrees(2.001)))).all()
    assert not np.isnan(cam.project(from_axis(math.degrees(1.999)))).any()


def from_axis(degrees):
    return np.array([math.sin(math.radians(degrees)), 0, -math.cos(math.radians(degrees))])


@pytest.mark.parametrize("lens", LENSES)
def test_within_its_limit_no_two_points_share_a_pixel(lens):
    """The Jacobian of the projection keeps its sign, taken from differences, out to the limit or to 80 degrees, or to
    where a tilted sensor has no place any more.
    """
    cam = pinhole(*LENSES[lens])
    radius = np.linspace(0.01, min(cam.model.distortion.limit, 5.0) * 0.999, 60)[:, None]
    azimuth = np.linspace(0, 2 * np.pi, 90)
    x, y = radius * np.cos(azimuth), radius * np.sin(azimuth)
    h = 1e-6
    here, right, up = (
        cam.project(np.stack((x + dx, y + dy, -np.ones_like(x)), axis=-1)) for dx, dy in ((0, 0), (h, 0), (0, h))
    )
    along, across = right - here, up - here
    area = along[..., 0] * across[..., 1] - along[..., 1] * across[..., 0]
    assert np.isnan(area).mean() < (0.3 if lens.startswith("tilted") else 1e-9)
    assert (area[~np.isnan(area)] > 0).all()


def test_a_frame_of_another_size_is_the_calibrated_picture_scaled():
    full = pinhole(*LENSES["tangential"])
    half = pinhole(*LENSES["tangential"], resolution_percentage=50, calibration_width=640, calibration_height=480)
    x, y = np.array([10.0, 300.5, 639.0]), np.array([470.0, 2.5, 240.0])
    np.testing.assert_array_equal(half.rays_at(x / 2, y / 2).directions, full.rays_at(x, y).directions)


@pytest.mark.parametrize("name", LENSES)
@pytest.mark.parametrize("width", [640, 2000])
def test_rays_of_a_picture_are_those_of_its_pixels(name, width):
    """Many go by polynomials, a list of pixels does not; 2000 columns reach out to where the barrel has no rays."""
    eye = pinhole(*LENSES[name], resolution_x=width)
    x, y = eye.raster.columns(), eye.raster.rows()[-160:]
    assert x.size > SMALLEST_SIZE[1]
    assert y.size > SMALLEST_SIZE[0]
    rows = eye.rays_at(x, y)
    pixels = eye.rays_at(*(array.reshape(-1) for array in np.broadcast_arrays(x, y)))
    assert np.array_equal(rows.valid.reshape(-1), pixels.valid)
    assert rows.valid.all() == ((name, width) != ("barrel", 2000))
    difference = np.abs(rows.directions.reshape(-1, 3) - pixels.directions)[pixels.valid]
    assert difference.max() < 16 * EPS


@pytest.mark.parametrize("farthest", [1.0, 10.0, 500.0], ids=["45 degrees", "84 degrees", "89.9 degrees"])
def test_a_picture_without_an_end_is_undistorted_by_whole_newton_steps(farthest, monkeypatch):
    """However far apart the entries of the table lie from which they start."""
    monkeypatch.setattr(RadialTangential, "_careful", lambda self, u, v: pytest.fail(f"{u.size} take halved steps"))
    lens = RadialTangential(k1=-0.3, k2=0.1, p1=1e-3)
    r, azimuth = np.linspace(0, farthest, 20_001)[1:], 0.1
    x, y = r * math.cos(azimuth), r * math.sin(azimuth)
    off = np.hypot(*np.subtract(lens.undistort(*lens.distort(x, y)), (x, y)))
    assert (off <= 16 * EPS * r * lens.cancelled(r * r)).all()


def test_skew_is_that_of_the_matrix():
    """OpenCV's projection leaves it out: it is applied to what an identity for a matrix gives."""
    points, lens = points_ahead(0.5), LENSES["tilted, with all terms"]
    plane, _ = cv2.projectPoints(points * OPENCV_FROM_CAMERA, np.zeros(3), np.zeros(3), np.eye(3), np.array(lens))
    matrix = K.copy()
    matrix[0, 1] = 7.5
    expected = bottom_up((np.append(plane[:, 0], np.ones((len(points), 1)), axis=1) @ matrix.T)[:, :2])
    cam = pinhole(*lens, skew=7.5)
    assert np.abs(cam.project(points) - expected).max() < PROJECTION
    np.testing.assert_allclose(cam.K, matrix, rtol=1e-15)


@pytest.mark.parametrize("key", ["OPENCV_PINHOLE", "UCM"])
def test_one_pixel_alone_beyond_the_fold_has_no_ray(key):
    cam = camera(key, SIZE | {"fx": 200.0, "fy": 200.0, "k1": -0.3, "p1": 1e-3})
    assert not cam.rays_at(0.5, 0.5).valid
    assert cam.rays_at(320.5, 240.5).valid


def test_a_lens_whose_corners_lie_near_a_pole_is_a_camera():
    """A calibration of OpenCV's regression tests, whose denominator has a root just beyond the corners: each pixel's
    ray leads back to it, and by OpenCV's own projection, too.
    """
    K = np.array([[1570.8956, 0, 744.87338], [0, 1570.3494, 575.55087], [0, 0, 1]])
    terms = (-2.82477176, -0.80078071, -0.01459536, 0.0018821, 1.98277956, -2.73067738, -1.21772582, 2.40522435,
             -0.00206704, 3.466e-5, 0.01410035, -3.0935e-5)  # fmt: skip
    names = "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"
    camera = crc.camera(
        "OPENCV_PINHOLE", (1500, 1150), fx=K[0, 0], fy=K[1, 1], cx=K[0, 2], cy=K[1, 2],
        **dict(zip(names, terms, strict=True)),
    )  # fmt: skip
    x, y = np.meshgrid(np.linspace(0.5, 1499.5, 31), np.linspace(0.5, 1149.5, 24))
    rays = camera.rays_at(x, y)
    assert rays.valid.all()
    assert np.abs(camera.project(rays.directions) - np.stack((x, y), axis=-1)).max() < 1e-6
    points = rays.directions.reshape(-1, 3) * (1, -1, -1)
    theirs = cv2.projectPoints(points, np.zeros(3), np.zeros(3), K, np.array(terms))[0][:, 0]
    np.testing.assert_allclose(theirs, np.stack((x - 0.5, 1149.5 - y), axis=-1).reshape(-1, 2), rtol=0, atol=1e-6)
