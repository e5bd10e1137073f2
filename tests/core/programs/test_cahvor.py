"""JPL's camera models: pixels by the models' own formulas, from the vectors of the files; and as mrcal projects."""

from math import atan, hypot, sin, tan
from pathlib import Path

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

SAMPLES = Path(__file__).parent / "samples"
TABLE = 1e-4
"""Pixels by which the table of a CAHVORE is off; measured is up to 2.2e-5."""


def vectors(file):
    """The vectors of a file by name."""
    lines = [line.split("=") for line in (SAMPLES / file).read_text().splitlines() if " = " in line]
    return {name.strip(): np.array(text.split(), float) for name, text, *_ in lines if name.strip() in "CAHVORE"}


def pixel_of(file, point, linearity):
    """The pixel of a point in the frame of a file."""
    lens = vectors(file)
    axis, (r0, r1, r2), (e0, e1, e2) = lens["O"] / np.linalg.norm(lens["O"]), lens["R"], lens.get("E", np.zeros(3))
    to_point = point - lens["C"]
    along = to_point @ axis
    across = to_point - along * axis
    low, high = 1e-9, 1.5
    for _ in range(100):  # the angle at the moved pupil
        theta = (low + high) / 2
        pupil = (theta / sin(theta) - 1) * (e0 + e1 * theta**2 + e2 * theta**4)
        low, high = (theta, high) if tan(theta) * (along - pupil) < hypot(*across) else (low, theta)
    chi = tan(linearity * theta) / linearity
    assert theta == pytest.approx(atan(hypot(*across) / (along - pupil)))
    ray = axis + across / hypot(*across) * chi * (1 + r0 + r1 * chi**2 + r2 * chi**4)
    return np.array((lens["H"] @ ray, lens["V"] @ ray)) / (lens["A"] @ ray)


@pytest.mark.parametrize(
    ("file", "linearity", "atol"), [("cahvor.cahvor", 1.0, 1e-9), ("cahvor.e.cahvore", 0.5, TABLE)]
)
@pytest.mark.parametrize("point", [(4.0, 0.75, -2.0), (3.0, -0.5, -1.25), (9.0, 0.3, -0.5)])
def test_vectors(file, linearity, atol, point):
    camera = crc.load_calibration(str(SAMPLES / file))
    x, y = camera.project(point)
    np.testing.assert_allclose((x - 0.5, 767.5 - y), pixel_of(file, point, linearity), rtol=0, atol=atol)


@pytest.mark.parametrize(
    ("model", "terms", "expected", "atol"),
    [
        ("CAHVOR", [-0.637, -0.002, 0.016], (2143.17840406, 1442.93419919), 1e-8),
        ("CAHVORE_linearity=0.5", [0.1, -0.002, 0.016, 0.01, 0.002, 0], (2497.23991456, 2137.01389856), TABLE),
    ],
)
def test_mrcal(model, terms, expected, atol, tmp_path):
    """The pixels are those of mrcal 2.5."""
    lens = [4842.918, 4842.771, 1970.528, 1085.302, -0.001, 0.002, *terms]
    entries = {"lensmodel": f"LENSMODEL_{model}", "intrinsics": lens, "imagersize": [4000, 2200],
               "extrinsics": [0, 0, 0, 1, 2, 3]}  # fmt: skip
    (tmp_path / "a.cameramodel").write_text(repr(entries))
    x, y = crc.load_calibration(str(tmp_path / "a.cameramodel")).project((0, 0, 7))  # (1, 2, 10) of the camera
    np.testing.assert_allclose((x - 0.5, 2199.5 - y), expected, rtol=0, atol=atol)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("CAHVOR = persp", "CAHVORE2 = persp"), "CAHVORE1, CAHVORE2 or CAHVORE3,L has E, and no other model"),
        (("V = 384.0 0.0 1200.0", "V = 384.0 0.0 -1200.0"), "its camera is mirrored"),
        (("O = 0.9998", "O = -0.9998"), "its camera is mirrored or looks away"),
        (("R = 0.01", "R = -1.5"), "its camera is mirrored or looks away"),
    ],
)
def test_what_is_no_camera_is_refused(change, says, tmp_path):
    (tmp_path / "a.cahvor").write_text((SAMPLES / "cahvor.cahvor").read_text().replace(*change))
    with pytest.raises(InputError, match=says):
        lenses_of(str(tmp_path / "a.cahvor"))
