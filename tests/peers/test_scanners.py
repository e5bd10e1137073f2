"""Rays and times of scanners beside the makers' own and others' decoders, on metadata of real units."""

import json
import struct

import numpy as np
import pytest

import camera_ray_caster as crc

from ..core.cameras.test_scanner import FLAT, NESTED
from ..core.clouds.test_clouds import CLOUD

pytestmark = pytest.mark.full


def unit(kind):
    """Metadata as the files of a unit have them: 16 beams, no two alike."""
    rng = np.random.default_rng(3)
    angles = {
        "beam_altitude_angles": np.round(np.linspace(16.7, -16.6, 16) + rng.uniform(-0.1, 0.1, 16), 3).tolist(),
        "beam_azimuth_angles": np.round(np.tile([3.1, 1.0, -1.1, -3.2], 4) + rng.uniform(-0.1, 0.1, 16), 3).tolist(),
    }
    size = {"columns_per_frame": 512, "pixels_per_column": 16, "columns_per_packet": 16, "column_window": [0, 511],
            "pixel_shift_by_row": [0] * 16, "udp_profile_lidar": "LEGACY", "udp_profile_imu": "LEGACY"}  # fmt: skip
    about = {"prod_line": "OS-1-16", "prod_sn": "1", "prod_pn": "1", "build_rev": "v2.3.0", "image_rev": "v2.3.0",
             "status": "RUNNING", "build_date": "", "base_pn": "", "base_sn": "", "proto_rev": "",
             "initialization_id": 1}  # fmt: skip
    imu = {"imu_to_sensor_transform": [1, 0, 0, 6.253, 0, 1, 0, -11.775, 0, 0, 1, 7.645, 0, 0, 0, 1]}
    if kind == "flat":
        return FLAT | angles | about | imu | {"data_format": size, "json_calibration_version": 4, "hostname": ""}
    return NESTED | {
        "beam_intrinsics": NESTED["beam_intrinsics"] | angles | {"lidar_origin_to_beam_origin_mm": 15.806},
        "lidar_data_format": size, "sensor_info": about, "imu_intrinsics": imu, "calibration_status": {},
        "config_params": {"lidar_mode": "512x20", "udp_profile_lidar": "LEGACY", "udp_profile_imu": "LEGACY"},
    }  # fmt: skip


@pytest.mark.parametrize("kind", ["flat", "nested"])
def test_rays_and_origins_are_those_of_ousters_library(read, tmp_path, kind):
    path = tmp_path / "unit.json"
    path.write_text(json.dumps(unit(kind)))
    decoded, cam = read("ouster", path), crc.load_calibration(path)
    rays = cam.rays()
    direction = (decoded["far"] - decoded["near"]) / 10
    origin = decoded["near"] - (10 - decoded["behind"]) * direction
    for vectors, expected in ((rays.directions, direction), (rays.origins, origin)):
        x, y, z = np.moveaxis(expected[::-1], -1, 0)  # row 0 is at the top there; ahead, left, up
        assert np.abs(vectors - np.stack((-y, z, -x), axis=-1)).max() < 1e-9


def packets(columns, distance, azimuth_step):
    """The packets of a VLP-16: 12 blocks of two firings each, at azimuths in hundredths of a degree."""
    data = b""
    for first in range(0, columns, 24):
        for firing in range(first, first + 24, 2):
            data += struct.pack("<HH", 0xEEFF, round(firing * azimuth_step * 100) % 36000)
            data += struct.pack("<HB", round(distance / 0.002), 100) * 32
        data += struct.pack("<IBB", round(first * 55.296), 0x37, 0x22)
    return data


def test_shots_are_those_of_the_decoder_of_velodynes_packets(read, tmp_path):
    """At 10.05 revolutions a second firings are 0.2 degrees apart, which packets can tell."""
    rate, columns, distance = 0.2 / 360 / 55.296e-6, 1800, 60.0
    (tmp_path / "packets.bin").write_bytes(packets(columns, distance, 0.2))
    decoded = read("velodyne", tmp_path / "packets.bin")
    cam = crc.camera("SCANNER", (columns, 16), scanner_device="VLP_16", scanner_rate=rate,
                     time_mode="SWEEP", fps=1_000_000, frame=0.0)  # fmt: skip
    assert cam.model.columns == columns
    rays = cam.rays()
    points = rays.origins + distance * rays.directions
    row, column = decoded["ring"].astype(int), decoded["column"].astype(int)
    assert len(row) == 16 * columns
    fired = points[row, column]
    x, y, z = -fired[:, 2], -fired[:, 0], fired[:, 1]
    apart = np.degrees(np.angle(np.exp(1j * (np.arctan2(y, x) - np.arctan2(decoded["y"], decoded["x"])))))
    assert np.abs(apart).max() < 0.0051  # it rounds azimuths to hundredths of a degree
    assert np.abs(np.hypot(x, y) - np.hypot(decoded["x"], decoded["y"])).max() < 2e-5  # float32
    assert np.abs(z - decoded["z"]).max() < 5e-5  # the manual's offsets have a tenth of a millimeter
    times = decoded["time"] - decoded["time"].min()
    assert np.abs(times - 1e-6 * rays.time[row, column]).max() < 1e-6  # packets tell microseconds


COLUMNS = "range", "true_range", "time", "ring", "column", "instance", "category", "incidence", "reflectance"


@pytest.mark.parametrize(
    ("key", "kind", "axes", "digits"),
    [
        ("ply", "ply", "sensor", "f4"), ("ply", "ply", "world", "f8"), ("pcd", "pcd", "sensor", "f4"),
        ("ply", "open3d", "sensor", "f4"), ("ply", "open3d", "world", "f8"),
    ],
)  # fmt: skip
def test_other_programs_read_the_fields_of_points(read, tmp_path, key, kind, axes, digits):
    (path,) = crc.save_points(CLOUD, tmp_path / "points", key, axes=axes).paths
    fields = read(kind, path)
    seen = np.isfinite(fields["x"])
    order: object = slice(None)
    if key == "pcd":  # by rows from the top
        assert len(seen) == CLOUD.size[0] * CLOUD.size[1]
        order = np.argsort(fields["column"][seen] * 100 + fields["ring"][seen], kind="stable")
    points = CLOUD.sensor if axes == "sensor" else CLOUD.world
    for k, name in enumerate("xyz"):
        np.testing.assert_array_equal(fields[name][seen][order], points[:, k].astype(digits))
    for name in COLUMNS:
        stored = fields[name].dtype
        np.testing.assert_array_equal(fields[name][seen][order], getattr(CLOUD, name).astype(stored), err_msg=name)
    if kind == "open3d":
        normals = CLOUD.sensor_normal if axes == "sensor" else CLOUD.normal
        np.testing.assert_array_equal(fields["normals"], normals.astype("f4"))


def test_laspy_reads_the_points_and_their_extra_dimensions(read, tmp_path):
    (path,) = crc.save_points(CLOUD, tmp_path / "points", "las", axes="world").paths
    fields = read("las", path)
    for k, name in enumerate("xyz"):
        assert np.abs(fields[name] - CLOUD.world[:, k]).max() < 0.5001e-4
    np.testing.assert_array_equal(fields["classification"], CLOUD.category)
    np.testing.assert_array_equal(fields["gps_time"], CLOUD.time)
    np.testing.assert_array_equal(fields["true range"], CLOUD.true_range.astype("f4"))
    for name in ("ring", "column", "instance"):
        np.testing.assert_array_equal(fields[name], getattr(CLOUD, name))
