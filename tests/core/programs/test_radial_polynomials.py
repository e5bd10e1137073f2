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
    lens = crc.load_calibration(str(SAMPLES / file), camera=camera, size=SIZE, pose=np.eye(4))
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


TURNED = 'p f2 w3600 h1800 v360\ni w800 h600 f0 v50 r10 p20 y30 TrX0 n"a.jpg"\n'
SEEN = {(400, 300): (2099.788217, 699.886911), (500, 300): (2168.915979, 712.766067),
        (400, 200): (2112.676377, 634.450229), (10, 20): (1840.105205, 511.614468)}  # fmt: skip
"""Pixels of its picture, and of the panorama by pano_trafo of Hugin 2022.0; the first one's center is (0, 0)."""


def test_a_turned_picture_is_where_pano_trafo_has_it(tmp_path):
    (tmp_path / "a.pto").write_text(TURNED)
    rays = crc.load_rig(tmp_path / "a.pto")["Camera"].rays()
    for (column, row), expected in SEEN.items():
        x, y, z = rays.directions[599 - row, column]
        pixel = 1800 + 10 * np.degrees(np.arctan2(x, y)) - 0.5, 900 - 10 * np.degrees(np.arcsin(z)) - 0.5
        np.testing.assert_allclose(pixel, expected, rtol=0, atol=1e-6)
    same = crc.load_rig(SAMPLES / "ptgui.json")["b"]  # has the same angles
    np.testing.assert_allclose(same.pose.basis, crc.load_rig(tmp_path / "a.pto")["Camera"].pose.basis, rtol=0, atol=0)


@pytest.mark.parametrize(
    ("file", "moved"), [("hugin.pto", ("TrX0", "TrX0.5")), ("ptgui.json", ('"vpd": 0', '"vpd": 2'))]
)
def test_pictures_from_another_place_are_refused(file, moved, tmp_path):
    (tmp_path / file).write_text((SAMPLES / file).read_text().replace(*moved))
    with pytest.raises(crc.InputError, match="it must be 0: pictures are taken from one place"):
        crc.load_rig(tmp_path / file)


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
