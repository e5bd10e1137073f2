"""Rational polynomials of satellites: pixels worked out from those of the sample, at places on the ellipsoid."""

from math import cos, radians, sin, sqrt
from pathlib import Path

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

SAMPLES = Path(__file__).parent / "samples"
SAMPLE = SAMPLES / "rpc.txt"
LATITUDE, LONGITUDE, HEIGHT = -33.5, 151.0, 100.0
BENT = 1e-3
"""Pixels between a straight ray and the polynomials; measured is up to 3.9e-4."""


def from_geodetic(longitude, latitude, height):
    """The place in the frame of the Earth's center (WGS 84)."""
    squared = 0.00669437999014132
    x, y = radians(longitude), radians(latitude)
    across = 6378137.0 / sqrt(1 - squared * sin(y) ** 2)
    return np.array(((across + height) * cos(y) * cos(x), (across + height) * cos(y) * sin(x),
                     (across * (1 - squared) + height) * sin(y)))  # fmt: skip


FILES = {"rpc.txt": (1200, 1000), "rpc.rpb": (1200, 1000), "rpc.maxar.xml": (1190, 1010), "rpc.dimap.xml": (1190, 1010)}
"""Files of the same polynomials, and the sizes of their pictures."""


@pytest.mark.parametrize("file", FILES)
@pytest.mark.parametrize("scaled", [(0.5, 0.4, 0.5), (-0.9, 0.8, -0.9), (0.9, -0.9, 0.0), (0, 0, 1)])
def test_a_place_is_seen_where_the_polynomials_say(file, scaled):
    L, P, H = scaled
    line = (0.001 - P + 0.02 * H + 0.0005 * L * P) / (1 + 0.0004 * L)
    sample = (-0.002 + L - 0.015 * H + 0.0003 * L**3) / (1 - 0.0002 * P)
    x, y = radians(LONGITUDE), radians(LATITUDE)
    axes = np.array(((-sin(x), cos(x), 0), (-sin(y) * cos(x), -sin(y) * sin(x), cos(y)),
                     (cos(y) * cos(x), cos(y) * sin(x), sin(y))))  # fmt: skip
    middle = from_geodetic(LONGITUDE, LATITUDE, HEIGHT)
    local = axes @ (from_geodetic(LONGITUDE + 0.012 * L, LATITUDE + 0.01 * P, HEIGHT + 200 * H) - middle)
    pixel = crc.load_calibration(str(SAMPLES / file)).project(local)
    expected = (600 + 600 * sample, 500 + 500 * line)
    np.testing.assert_allclose((pixel[0] - 0.5, FILES[file][1] - 0.5 - pixel[1]), expected, rtol=0, atol=BENT)


@pytest.mark.parametrize("file", FILES)
def test_a_picture_has_the_size_of_its_file(file):
    camera = crc.load_calibration(str(SAMPLES / file))
    assert (camera.width, camera.height) == FILES[file]


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("LAT_SCALE: 00.01", "LAT_SCALE: 00.00"), "its scales must be above 0"),
        (("LINE_NUM_COEFF_3: -1.0", "LINE_NUM_COEFF_3: -0.0"), "no pixel has a ray"),
        (("LINE_NUM_COEFF_10: +0.0", "LINE_NUM_COEFF_10: +1.0"), "its rays are bent by .* pixels: up to 0.05 are read"),
        (("HEIGHT_OFF:", "HEIGHT:"), "it has no HEIGHT_OFF"),
    ],
)
def test_what_is_no_camera_is_refused(change, says, tmp_path):
    (tmp_path / "a.txt").write_text(SAMPLE.read_text().replace(*change))
    with pytest.raises(InputError, match=says):
        lenses_of(str(tmp_path / "a.txt"))
