"""Lenses of Hugin, PTGui and lensfun: pixels worked out by hand, with r in halves of the shorter side."""

from math import hypot, radians, tan
from pathlib import Path

import numpy as np
import pytest

import camera_ray_caster as crc

SAMPLES = Path(__file__).parent / "samples"
SIZE = (800, 600)
SHORT = 300
CURVE = 0.4 * (1.04 - 0.05 * 0.4 + 0.02 * 0.4**2 - 0.01 * 0.4**3)
"""The radius 0.4 with a = -0.01, b = 0.02, c = -0.05."""


def pixel(file, camera, point):
    """The pixel of a point, x right, y down, z ahead, from the picture's upper left corner."""
    lens = crc.load_calibration(str(SAMPLES / file), camera=camera, size=SIZE)
    x, y = lens.project((point[0], -point[1], -point[2]))
    return x, SIZE[1] - y


@pytest.mark.parametrize(
    ("file", "camera", "point", "expected"),
    [
        ("hugin.pto", "first picture.jpg", (0.3, 0, 1), (404 + SHORT * CURVE, 297)),  # f = 400: 120 pixels are 0.4
        ("hugin.pto", "second.jpg", (tan(0.4 * SHORT * radians(60) / 400), 0, 1), (404 + SHORT * CURVE, 297)),
        ("ptgui.json", "a.jpg", (0, 0.24, 1), (400, 300 + SHORT * CURVE)),  # f = 25 / 50 of 1000 pixels
        ("ptgui.json", "b.jpg", (tan(0.6), 0, 1), (400 + SHORT * (0.4 * 0.9 + 0.1 * 0.4**2), 300)),  # f = 200
    ],
)  # fmt: skip
def test_panorama_programs(file, camera, point, expected):
    np.testing.assert_allclose(pixel(file, camera, point), expected, rtol=0, atol=1e-9)


def test_lensfun():
    """Its pixels follow from the diagonals of the frame and of the sensor."""
    pixels, half = 1000 / (hypot(36, 24) / 1.5), hypot(36, 24) / 1.5 / hypot(3, 2)  # of 3:2, not 4:3 as the frame
    point = (0.4 * half / 10, 0, 1)
    x, y = pixel("lensfun.xml", "Wide 10-20 10 mm", point)
    np.testing.assert_allclose((x, y), (400 + pixels * half * CURVE, 300), rtol=0, atol=1e-9)
    focal = 19 / 0.95  # of the ideal picture
    x, _ = pixel("lensfun.xml", "Wide 10-20 20 mm", (0.5 * half / focal, 0, 1))
    np.testing.assert_allclose(x, 400 + pixels * half * 0.5 * (0.95 + 0.05 * 0.25), rtol=0, atol=1e-9)
    half = hypot(36, 24) / 2 * 3 / 5 / 2
    x, _ = pixel("lensfun.xml", "Fish 8 mm", (tan(0.5 * half / 8), 0, 1))
    expected = 400 + 1000 / (hypot(36, 24) / 2) * half * 0.5 * (1 + 0.1 / 4 - 0.02 / 16)
    np.testing.assert_allclose(x, expected, rtol=0, atol=1e-9)
