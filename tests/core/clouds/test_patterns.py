"""Scanners in files of simulators: rays worked out by hand."""

from math import cos, pi, radians, sin, tan
from pathlib import Path

import numpy as np
import pytest

import camera_ray_caster as crc

SAMPLES = Path(__file__).parents[1] / "programs" / "samples"
HALF = cos(radians(30)), sin(radians(30))
ROOM = crc.mesh([(x, y, z) for x in (-4, 4) for y in (-4, 4) for z in (-4, 4)],
                [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])  # fmt: skip


def ray(azimuth, elevation):
    """A direction, x ahead, y to the left, z up."""
    left, up = radians(azimuth), radians(elevation)
    return cos(up) * cos(left), cos(up) * sin(left), sin(up)


@pytest.mark.parametrize(
    ("file", "angles", "seconds", "rings"),
    [
        ("livox.csv", [(0.5, -0.25), (90, 30), (-45, -45)], [0, 1e-5, 2e-5], [0, 0, 0]),
        ("isaac_lidar.solid.json", [(0, 0), (30, -30), (-30, 10), (90, 0)], [0, 5e-6, 0.05, 0.050005], [1, 2, 1, 2]),
    ],
)
def test_a_pattern_is_a_cloud(file, angles, seconds, rings):
    expected = np.array([ray(*angle) for angle in angles])
    cloud = crc.scan(rays=str(SAMPLES / file), shapes=ROOM, fps=25)
    np.testing.assert_allclose(cloud.sensor / cloud.range[:, None], expected, rtol=0, atol=1e-15)
    np.testing.assert_allclose(cloud.world, expected * (4 / np.abs(expected).max(axis=1))[:, None], rtol=0, atol=1e-14)
    np.testing.assert_allclose(cloud.time, seconds, rtol=0, atol=1e-15)
    assert cloud.ring.tolist() == rings
    pose = crc.look_at((1, 0, 0.5), (1, 3, 0.5))  # ahead is y
    turned = crc.scan(rays=SAMPLES / file, shapes=ROOM, pose=pose)
    np.testing.assert_allclose(turned.sensor / turned.range[:, None], expected, rtol=0, atol=1e-14)
    world = np.stack((-expected[:, 1], expected[:, 0], expected[:, 2]), axis=-1)
    np.testing.assert_allclose(turned.world, (1, 0, 0.5) + turned.range[:, None] * world, rtol=0, atol=1e-14)


def test_a_rotary_profile_is_a_scanner():
    scanner = crc.load_calibration(str(SAMPLES / "isaac_lidar.rotary.json"))
    assert (scanner.width, scanner.height) == (360, 3)
    assert scanner.model.limits == (0.5, 80.0)
    model = scanner.model
    origin, direction = (np.array([np.broadcast_to(values, (3, 360)) for values in vector])
                         for vector in model.rays(np.arange(360) + 0.5, np.arange(3)[:, None] + 0.5))  # fmt: skip
    turned = 360 * 10 * 4e-6  # until the last emitter of a column fires
    for row, (azimuth, elevation, height) in enumerate(((0, -10, 0.01), (1.5, 0, 0), (-1.5, 12.5, -0.01))):
        x, y, z = ray(90 + azimuth + turned * row / 2, elevation)
        np.testing.assert_allclose(direction[:, row, 90], (-y, z, -x), rtol=0, atol=1e-14)
        np.testing.assert_allclose(origin[:, row, 90], (0, height, 0), rtol=0, atol=1e-17)


def test_presets_of_range_scanners():
    scanner = crc.load_calibration(str(SAMPLES / "blainder.yaml"), "Spinner")
    assert (scanner.width, scanner.height) == (181, 21)
    directions = scanner.rays().directions
    for row, column, angles in ((0, 0, (45, -20)), (20, 180, (-45, 20)), (10, 90, (0, 0)), (10, 91, (-0.5, 0))):
        x, y, z = ray(*angles)
        np.testing.assert_allclose(directions[row, column], (-y, z, -x), rtol=0, atol=1e-14)
    flat = crc.load_calibration(str(SAMPLES / "blainder.yaml"), "Depth camera")
    corner = flat.rays().directions[0, 0]
    half = tan(35 * pi / 180)
    np.testing.assert_allclose(corner[:2] / -corner[2], (-half, -half * 60 / 70), rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    ("file", "change", "says"),
    [
        ("livox.csv", ("90,60", "90,x"), "its lines must have 3 numbers"),
        ("livox.csv", ("90,60", "90,inf"), "numbers that are not finite"),
        ("livox.csv", ("\n", "\n# "), "it has no rays"),
        ("isaac_lidar.rotary.json", (), "its scanType is rotary: load it as a calibration"),
        ("hesai.csv", (), "it has no rays of a scanner: give a file of Livox or Isaac Sim lidars"),
    ],
)
def test_what_is_no_pattern_is_refused(file, change, says, tmp_path):
    text = (SAMPLES / file).read_text()
    (tmp_path / file).write_text(text.replace(*change) if change else text)
    with pytest.raises(crc.InputError, match=says):
        crc.scan(rays=tmp_path / file, shapes=ROOM)


def test_a_pattern_is_no_lens():
    with pytest.raises(crc.InputError, match=r"it is a file of Livox, which has a list of rays: give it to scan"):
        crc.load_calibration(str(SAMPLES / "livox.csv"), size=(640, 480))
