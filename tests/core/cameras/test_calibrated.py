"""Calibrated lens families against the programs that calibrate with them: COLMAP and OpenCV; else their own formulas.

Each lens projects 10,000 points, and the rays of 10,000 places in the picture are projected back to these.
"""

from math import tan

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.conventions import EPS

from ..colmap import colmap, project
from .model_examples import camera

COUNT = 10_000
WIDTH, HEIGHT = 640, 480
K = {"fx": 250.0, "fy": 245.5, "cx": 331.7, "cy": 236.2}
FRAME = {"resolution_x": WIDTH, "resolution_y": HEIGHT, **K}
SAME = 1e-9
FARTHEST = 2e3
"""Pixels."""

COLMAP = {
    "EUCM": (
        "EUCM",
        ("unified_alpha", "unified_beta"),
        [(0.0, 1.0), (0.3, 0.8), (0.6, 1.1), (0.8, 2.5), (0.95, 0.4)],
    ),
    "FISHEYE624": (
        "RAD_TAN_THIN_PRISM_FISHEYE",
        ("k1", "k2", "k3", "k4", "k5", "k6", "p2", "p1", "s1", "s2", "s3", "s4"),
        [
            (0.0,) * 12,
            (0.4, -0.5, 0.25, 1.2, -1.7, 0.6, 4e-4, -2e-4, -6e-4, -2e-4, 9e-4, 1e-5),
            (-0.03, 0.004, -0.002, 3e-4, 0, 0, 3e-3, -5e-3, 2e-3, -1e-3, -4e-3, 5e-4),
        ],
    ),
    "FOV": ("FOV", ("fov_omega",), [(0.7,), (1.5,), (2.5,)]),
    "DIVISION": ("DIVISION", ("division_lambda",), [(0.0,), (-0.3,), (-1.2,), (0.1,), (0.4,)]),
    "THIN_PRISM_FISHEYE": (
        "THIN_PRISM_FISHEYE",
        ("k1", "k2", "p1", "p2", "k3", "k4", "s1", "s3"),
        [(0.0,) * 8, (-0.04, 0.01, 1e-3, -2e-3, -1e-3, 1e-4, 3e-3, -2e-3), (0.1, 0, 3e-3, 0, 0, 1e-4, 0, 5e-3)],
    ),
}
"""COLMAP's name and the settings in the order of its parameters, and values of these."""
SERIES = {"FOV": 0.03}
"""Radians from the axis within which COLMAP takes a series that is right to 1e-5 pixels."""

OMNIDIR = [
    {"unified_xi": 0.0},
    {"unified_xi": 0.8, "k1": -0.05, "k2": 0.01, "p1": 2e-3, "p2": -1e-3},
    {"unified_xi": 1.0, "skew": 1.7},
    {"unified_xi": 1.9, "fx": 700.0, "fy": 690.0, "k1": -0.2, "k2": 0.3, "p1": -1e-3, "skew": -2.5},
]
SPHERES = [(0.0, 0.0), (-0.2, 0.55), (0.4, 0.3), (0.9, 0.7), (-0.9, 0.2), (0.0, 1.05), (0.2, -0.3), (1.5, 0.4)]
"""xi and alpha of the double sphere."""


def directions():
    """Points all around, in the camera's frame, more of them ahead."""
    random = np.random.default_rng(5)
    theta, azimuth = np.pi * random.uniform(0, 1, COUNT) ** 1.5, random.uniform(-np.pi, np.pi, COUNT)
    unit = (np.sin(theta) * np.cos(azimuth), np.sin(theta) * np.sin(azimuth), -np.cos(theta))
    return np.stack(unit, axis=-1) * random.uniform(0.5, 50, (COUNT, 1))


def agree(cam, project, fewest, nearest=0.0):
    """Hold a camera's ``project`` and its rays against another program's ``project``: of our points, our pixels.

    nearest: radians from the axis from which on the other program is exact.
    """
    for points, pixels in ((directions(), None), seen(cam)):
        ours, expected = cam.project(points) if pixels is None else pixels, project(points)
        from_axis = np.arctan2(np.hypot(points[:, 0], points[:, 1]), -points[:, 2])
        both = ~np.isnan(ours[:, 0]) & ~np.isnan(expected[:, 0]) & (from_axis >= nearest)
        both[both] = np.abs(expected[both]).max(axis=1) <= FARTHEST
        assert both.sum() >= fewest
        assert np.abs(ours - expected)[both].max() <= SAME


def seen(cam):
    """Points on the rays of places all over the picture, and these places."""
    places = np.random.default_rng(6).uniform(0, (WIDTH, HEIGHT), (COUNT, 2))
    rays = cam.rays_at(*places.T)
    return rays.directions[rays.valid] * 3, places[rays.valid]


def bottom_up(pixels, center):
    """Pixels counted from the top left, whose first one's center is this, in ours."""
    return np.stack((pixels[..., 0] + 0.5 - center, HEIGHT - (pixels[..., 1] + 0.5 - center)), axis=-1)


ROWS = [(key, values) for key, (_, _, lenses) in COLMAP.items() for values in lenses]


@pytest.mark.parametrize(("key", "values"), ROWS)
def test_colmap_projects_points_to_our_pixels_and_our_rays_to_theirs(key, values):
    model, names, _ = COLMAP[key]
    cam = camera(key, FRAME | dict(zip(names, values, strict=True)))
    matrix = [K["fx"], K["fy"], K["cx"] + 0.5, K["cy"] + 0.5]

    def seen(points):
        return bottom_up(colmap(project, model, WIDTH, HEIGHT, [*matrix, *values], points * (1, -1, -1)), 0.5)

    agree(cam, seen, 2_000, SERIES.get(key, 0.0))


@pytest.mark.parametrize("lens", OMNIDIR)
def test_opencv_projects_points_to_the_pixels_of_the_unified_camera(lens):
    cam, numbers = camera("UCM", FRAME | lens), K | {"skew": 0.0} | lens
    matrix = np.array([[numbers["fx"], numbers["skew"], numbers["cx"]], [0, numbers["fy"], numbers["cy"]], [0, 0, 1]])
    coefficients = np.array([[numbers.get(name, 0.0) for name in ("k1", "k2", "p1", "p2")]])

    def project(points):
        ahead, still = (points * (1, -1, -1))[None], np.zeros(3)
        pixels, _ = cv2.omnidir.projectPoints(ahead, still, still, matrix, numbers["unified_xi"], coefficients)
        return bottom_up(pixels[0], 0)

    agree(cam, project, 3_000)


def double_sphere(x, y, z, xi, alpha):
    """Equations (40) to (45) of the paper."""
    first = np.sqrt(x * x + y * y + z * z)
    second = np.sqrt(x * x + y * y + (xi * first + z) ** 2)
    below = alpha * second + (1 - alpha) * (xi * first + z)
    return x / below, y / below


def field_of_view(x, y, z, omega):
    """Equation (13) of the paper."""
    undistorted = np.hypot(x, y) / np.where(z > 0, z, np.nan)
    distorted = np.arctan(2 * undistorted * tan(omega / 2)) / omega
    return x / z * distorted / undistorted, y / z * distorted / undistorted


PAPERS = [
    *[("DOUBLE_SPHERE", double_sphere, {"unified_xi": xi, "unified_alpha": alpha}) for xi, alpha in SPHERES],
    *[("FOV", field_of_view, {"fov_omega": omega}) for omega in (1e-3, 0.7, 2.5)],
]
"""Formulas of papers: of x right, y down, z ahead, and the settings; the distorted coordinates."""


@pytest.mark.parametrize(("key", "formula", "settings"), PAPERS)
def test_the_formula_of_the_paper_gives_the_same(key, formula, settings):
    cam = camera(key, FRAME | settings)

    def project(points):
        u, v = formula(*(points * (1, -1, -1)).T, *settings.values())
        return bottom_up(np.stack((K["fx"] * u + K["cx"], K["fy"] * v + K["cy"]), axis=-1), 0)

    agree(cam, project, 2_000)


@pytest.mark.parametrize("forward", [True, False])
def test_f_theta_is_the_polynomial_that_is_declared(forward):
    """The other one, which a file has too, does not count: its inverse is made from the one that does."""
    coefficients = (0, 280.3, 4.1, -11.0, 0.7, -0.05) if forward else (0, 3.5e-3, 1e-7, -2e-10, 1e-13)
    c, d, e = 1.02, 0.01, -0.02
    text = " ".join(map(repr, coefficients))
    names = ("ftheta_angle_to_radius", "ftheta_radius_to_angle")[:: 1 if forward else -1]
    polynomials = {"ftheta_reference": names[0][7:].upper(), names[0]: text, names[1]: "no numbers"}
    cam = camera("FTHETA", FRAME | polynomials | {"ftheta_c": c, "ftheta_d": d, "ftheta_e": e, "ftheta_max_angle": 2.0})
    points, places = seen(cam)
    assert len(points) > COUNT / 2
    assert np.abs(cam.project(points) - places).max() <= SAME
    x, y, z = (points * (1, -1, -1)).T
    theta, across = np.arctan2(np.hypot(x, y), z), np.hypot(x, y)
    u, v = places[:, 0] - 0.5 - K["cx"], HEIGHT - places[:, 1] - 0.5 - K["cy"]
    square_x, square_y = (u - d * v) / (c - d * e), (c * v - e * u) / (c - d * e)
    r = np.hypot(square_x, square_y)
    start, other = (theta, r) if forward else (r, theta)
    # a pixel is 1 / 280 rad
    assert np.abs(np.polyval(coefficients[::-1], start) - other).max() <= (SAME if forward else SAME / 280)
    assert np.abs(np.stack((square_x * y - square_y * x, square_x * x + square_y * y - r * across))).max() <= SAME


def test_ocam_is_the_toolbox_s_cam2world():
    """Whose x counts rows, whose y columns, and whose z is towards the back."""
    polynomial, (c, d, e) = (-180.4, 0, 1.7e-3, -2e-7, 6e-9), (0.999, 0.003, -0.004)
    ocam_settings = {"ocam_polynomial": ", ".join(map(repr, polynomial)), "ocam_c": c, "ocam_d": d, "ocam_e": e}
    cam = camera("OCAM", FRAME | ocam_settings)
    points, places = seen(cam)
    assert len(points) > COUNT / 2
    assert np.abs(cam.project(points) - places).max() <= SAME
    pixel = np.stack((HEIGHT - places[:, 1] - 0.5 - K["cy"], places[:, 0] - 0.5 - K["cx"]))
    x, y = np.linalg.inv([[c, d], [e, 1]]) @ pixel
    z = np.polyval(polynomial[::-1], np.hypot(x, y))
    expected = np.stack((y, -x, z), axis=1)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    np.testing.assert_allclose(points / 3, expected, rtol=0, atol=16 * EPS)


def test_a_skewed_matrix_is_given_back():
    cam = camera("UCM", FRAME | {"skew": 1.7})
    np.testing.assert_allclose(cam.K, [[250.0, 1.7, 331.7], [0, 245.5, 236.2], [0, 0, 1]], rtol=1e-15)


def test_an_angle_beyond_180_degrees_is_180_degrees_in_f_theta():
    wide, half = (camera("FTHETA", FRAME | {"ftheta_max_angle": angle}).model for angle in (4.0, np.pi))
    assert wide.max_angle == half.max_angle == np.pi


def test_field_of_view_0_is_the_pinhole():
    points = np.random.default_rng(1).normal(size=(100, 3)) * (1, 1, 0) - (0, 0, 1)
    none, tiny, pinhole = (
        camera(key, FRAME | settings).project(points)
        for key, settings in (("FOV", {"fov_omega": 0.0}), ("FOV", {"fov_omega": 1e-30}), ("OPENCV_PINHOLE", {}))
    )
    np.testing.assert_allclose(none, pinhole, rtol=1e-13)
    np.testing.assert_array_equal(none, tiny)


@pytest.mark.parametrize(
    ("key", "settings"),
    [
        ("EUCM", {"unified_alpha": 1.05}),
        ("EUCM", {"unified_alpha": 1.05, "unified_beta": 0.7}),
        ("DOUBLE_SPHERE", {"unified_xi": 1.3, "unified_alpha": 0.6}),
        ("DOUBLE_SPHERE", {"unified_xi": 0.4, "unified_alpha": -0.3}),
    ],
)
def test_beyond_the_usual_range_unified_lenses_have_the_rays_of_their_formula(key, settings):
    """r by the definition, at angles up to the one at which r stops growing, beyond which nothing is seen."""
    cam = camera(key, FRAME | settings)
    xi, alpha, beta = (
        settings.get(f"unified_{name}", default) for name, default in (("xi", 0.0), ("alpha", 0), ("beta", 1.0))
    )
    theta = np.linspace(1e-3, np.pi, 4000)
    s, z = np.sin(theta), np.cos(theta) + xi
    below = alpha * np.sqrt(beta * s * s + z * z) + (1 - alpha) * z
    r = np.where(below > 0, s / np.where(below > 0, below, 1), np.nan)
    last = int(np.flatnonzero(~(np.diff(r) > 0))[0])
    assert last > 1000
    points = np.stack((0 * theta, s, -np.cos(theta)), axis=-1)
    pixels = cam.project(points)
    middle = cam.project((0.0, 0.0, -1.0))
    np.testing.assert_allclose((pixels - middle)[: last - 2, 1], K["fy"] * r[: last - 2], rtol=1e-9)
    assert np.isnan(pixels[last + 3 :]).all()
    rays = cam.rays_at(*pixels[: last - 2].T)
    assert np.abs(np.cross(rays.directions, points[: last - 2])).max() <= 1e-9
