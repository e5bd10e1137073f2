"""Scanners: their devices by hand, their files, the times of their beams, and where they look."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras.parts.devices import DEVICES
from camera_ray_caster.core.conventions import EPS

ROWS = {"VLP_16": 16, "PUCK_HI_RES": 16, "HDL_32E": 32, "VLP_32C": 32, "OS1_64": 64, "OS1_128": 128}
COLUMNS = {"VLP_16": 1808, "PUCK_HI_RES": 1808, "HDL_32E": 2170, "VLP_32C": 1808, "OS1_64": 1024, "OS1_128": 1024,
           "TERRESTRIAL": 3600, "SOLID_STATE": 600}  # fmt: skip


def scanner(device, size=None, **settings):
    size = size or (COLUMNS.get(device, 360), ROWS.get(device, 32))
    return crc.camera("SCANNER", size, scanner_device=device, **settings)


@pytest.mark.parametrize("device", DEVICES)
def test_a_device_has_its_columns_and_a_ray_in_each_pixel_that_leads_back(device):
    cam = scanner(device)
    assert cam.model.columns == COLUMNS[device]
    rays = cam.rays()
    assert rays.valid.all()
    x, y = np.broadcast_arrays(cam.raster.columns(), cam.raster.rows())
    for distance in (0.5, 100.0):
        off = cam.project(rays.origins + distance * rays.directions) - np.stack((x, y), axis=-1)
        assert np.abs(off).max() < 1e-9


def test_the_shots_of_a_vlp_16_are_those_of_its_manual():
    """x right, y ahead, z up: section 9.3.1.1, with the vertical offset of laser 14, elevation -1, and shot times."""
    cam = scanner("VLP_16", (3616, 16), time_mode="SWEEP", fps=1_000_000, scanner_rate=5.0)
    assert cam.model.columns == 3616
    rays, column, row, laser = cam.rays(), 1000, 7, 14
    shot = 55.296 * column + 2.304 * laser
    assert rays.time[row, column] == pytest.approx(shot, rel=1e-12)
    azimuth, elevation = 2 * np.pi * 5.0 * shot * 1e-6, np.radians(-1)
    ahead = np.array((np.cos(elevation) * np.sin(azimuth), np.cos(elevation) * np.cos(azimuth), np.sin(elevation)))
    np.testing.assert_allclose(rays.directions[row, column], ahead[[0, 2, 1]] * (1, 1, -1), rtol=0, atol=16 * EPS)
    np.testing.assert_array_equal(rays.origins[row, column], (0, 0.7e-3, 0))


def test_beams_are_numbered_as_their_makers_do():
    assert scanner("VLP_16").model.beams.ring.tolist() == list(range(16))
    assert scanner("OS1_64").model.beams.ring.tolist() == list(range(64))[::-1]  # 0 is the top


def test_another_frame_shows_the_same_sweep():
    full, small = scanner("VLP_32C"), scanner("VLP_32C", (904, 16))
    x, y = np.random.default_rng(1).uniform(1, 15, (2, 50))
    rays, other = full.rays_at(2 * x, 2 * y), small.rays_at(x, y)
    np.testing.assert_allclose(rays.directions, other.directions, rtol=0, atol=1e-14)


VELODYNE = """lasers:
- {dist_correction: 0.0, laser_id: 1, rot_correction: 0.1, vert_correction: 0.2, vert_offset_correction: 0.11,
  horiz_offset_correction: 0.026}
- {dist_correction: 0.0, laser_id: 0, rot_correction: -0.07, vert_correction: -0.3, vert_offset_correction: 0.14}
num_lasers: 2
distance_resolution: 0.002
"""
ALTITUDES, AZIMUTHS = [16.6, 1.25, -1.5, -14.75], [3.164, 1.055, -1.055, -3.164]
HALF_TURN = [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36.18, 0, 0, 0, 1]
FLAT = {"beam_altitude_angles": ALTITUDES, "beam_azimuth_angles": AZIMUTHS, "lidar_mode": "512x20",
        "lidar_origin_to_beam_origin_mm": 15.806, "lidar_to_sensor_transform": HALF_TURN}  # fmt: skip
NESTED = {
    "beam_intrinsics": {
        "beam_altitude_angles": ALTITUDES, "beam_azimuth_angles": AZIMUTHS,
        "beam_to_lidar_transform": [1, 0, 0, 15.806, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    },
    "lidar_intrinsics": {"lidar_to_sensor_transform": HALF_TURN}, "config_params": {"lidar_mode": "512x20"},
    "lidar_data_format": {"columns_per_frame": 512, "pixels_per_column": 4},
    "sensor_info": {"prod_line": "OS-1-4"},
}  # fmt: skip
HESAI = "\ufeffEEFF,1,1\nLaser id,Elevation,Azimuth\n1,15.0,-1.042\n2,-7.25,3.257\n"


def test_velodynes_calibration(tmp_path):
    """rot_correction is subtracted from the azimuth; the origin is left of the beam and above."""
    (tmp_path / "unit.yaml").write_text(VELODYNE)
    cam = crc.camera("SCANNER", (360, 2), calibration_file=str(tmp_path / "unit.yaml"), scanner_rate=20.0)
    assert cam.settings["scanner_rate"] == 20.0  # which the file does not tell
    for row, (rot, vert, up, left) in enumerate([(-0.07, -0.3, 0.14, 0.0), (0.1, 0.2, 0.11, 0.026)]):
        azimuth = np.radians(100) - rot
        ray = cam.rays_at(100.5, row + 0.5)
        expected = np.cos(vert) * np.sin(azimuth), np.sin(vert), -np.cos(vert) * np.cos(azimuth)
        np.testing.assert_allclose(ray.directions, expected, rtol=0, atol=16 * EPS)
        np.testing.assert_allclose(ray.origins, (-left * np.cos(azimuth), up, -left * np.sin(azimuth)), atol=16 * EPS)


@pytest.mark.parametrize("metadata", [FLAT, NESTED], ids=["flat", "nested"])
def test_ousters_metadata_in_both_generations(tmp_path, metadata):
    """The sensor's frame: x ahead, y left, z up; rows from the top down."""
    (tmp_path / "os1.json").write_text(json.dumps(metadata))
    cam = crc.load_calibration(tmp_path / "os1.json")
    assert cam.raster.size == (512, 4)
    assert cam.settings["scanner_rate"] == 20
    encoder, altitude, azimuth = -2 * np.pi * 70 / 512, np.radians(1.25), np.radians(1.055)
    lidar = np.array((np.cos(encoder - azimuth), np.sin(encoder - azimuth)))
    direction = np.array((*(np.cos(altitude) * lidar), np.sin(altitude))) * (-1, -1, 1)
    origin = np.array((0.015806 * np.cos(encoder), 0.015806 * np.sin(encoder), 0.03618)) * (-1, -1, 1)
    ray = cam.rays_at(70.5, 2.5)
    for vector, expected in ((ray.directions, direction), (ray.origins, origin)):
        np.testing.assert_allclose(vector, (-expected[1], expected[2], -expected[0]), rtol=0, atol=16 * EPS)


def test_hesais_angles(tmp_path):
    (tmp_path / "XT 2.csv").write_text(HESAI, encoding="utf-8")
    cam = crc.load_calibration(tmp_path / "XT 2.csv")
    assert cam.raster.size == (2000, 2)
    azimuth, elevation = np.radians(3.257), np.radians(-7.25)
    expected = np.cos(elevation) * np.sin(azimuth), np.sin(elevation), -np.cos(elevation) * np.cos(azimuth)
    np.testing.assert_allclose(cam.rays_at(0.5, 0.5).directions, expected, rtol=0, atol=16 * EPS)


@pytest.mark.parametrize(
    ("name", "text", "word"),
    [
        ("a.yaml", VELODYNE.replace("laser_id: 1", "laser_id: 2"), "laser_id"),
        ("a.yaml", VELODYNE.replace("num_lasers: 2", "num_lasers: 3"), "num_lasers"),
        ("a.yaml", VELODYNE.replace("rot_correction: 0.1,", ""), "rot_correction"),
        ("a.json", json.dumps(FLAT | {"beam_azimuth_angles": [1.0]}), "beam_azimuth_angles"),
        ("a.json", json.dumps(FLAT | {"lidar_mode": "fast"}), "lidar_mode"),
        ("a.json", json.dumps(FLAT | {"lidar_to_sensor_transform": [1, *HALF_TURN[1:]]}), "half a turn"),
        ("a.csv", HESAI.replace("2,-7.25", "3,-7.25"), "channels"),
        ("a.csv", HESAI.replace("-7.25", "low"), "not a channel"),
        ("a.csv", "Channel,Elevation,Azimuth\n", "no channels"),
    ],
)
def test_files_without_meaning_are_refused_in_one_line(tmp_path, name, text, word):
    (tmp_path / name).write_text(text)
    with pytest.raises(crc.InputError, match=word) as caught:
        crc.load_calibration(tmp_path / name, size=(100, 2))
    assert "\n" not in str(caught.value)


def test_what_single_beams_have_not_is_refused():
    cam = scanner("VLP_16")
    shapes = crc.spheres([(0, 0, -5)], 1.0)
    for ask in (
        lambda: crc.cast(cam, shapes, passes=("solid_angle",)),
        lambda: crc.cast(cam, shapes, passes=("flow_forward", "depth")),
        cam.rays_jacobian,
        lambda: cam.project([(0.0, 0.0, -5.0)], jacobian=True),
    ):
        with pytest.raises(crc.InputError, match="single beams"):
            ask()
    with pytest.raises(crc.InputError, match="is no scanner"):
        crc.camera("PERSP", (8, 8), time_mode="SWEEP")


def test_the_range_is_limited_by_the_device_and_the_clip_range():
    shapes = crc.spheres([(0, 0, 0)], [150.0])
    assert not np.isfinite(crc.cast(scanner("VLP_16"), shapes, passes=("distance",))["distance"]).any()
    assert np.isfinite(crc.cast(scanner("VLP_32C"), shapes, passes=("distance",))["distance"]).all()
    with pytest.raises(crc.InputError, match="range"):
        scanner("VLP_16", clip_start=200.0, clip_end=300.0)


def test_angles_of_beams_are_radians_in_python():
    """The same three beams by the range of elevations, by a table of radians, and by Blender's text in degrees."""
    even = crc.camera("SCANNER", (8, 3), scanner_low=-0.2, scanner_high=0.2).rays().directions
    table = crc.camera("SCANNER", (8, 3), scanner_elevations=[-0.2, 0.0, 0.2], scanner_azimuths=np.zeros(3))
    np.testing.assert_allclose(table.rays().directions, even, atol=1e-15)
    with pytest.warns(FutureWarning, match="scanner_elevations is taken as degrees: give radians"):
        old = crc.camera("SCANNER", (8, 3), scanner_elevations=np.degrees([-0.2, 0.0, 0.2]), scanner_azimuths=[1, 0, 0])
    text = crc.camera("SCANNER", (8, 3), scanner_elevations=" ".join(map(repr, np.degrees([-0.2, 0.0, 0.2]).tolist())),
                      scanner_azimuths="1 0 0")  # fmt: skip
    np.testing.assert_array_equal(old.rays().directions, text.rays().directions)
