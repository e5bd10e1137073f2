"""Unit Scale: what is written in meters is read in meters, by every writer and reader."""

import struct
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.clouds.formats import POINT_FORMATS as CLOUDS
from camera_ray_caster.core.clouds.formats import files_of
from camera_ray_caster.core.clouds.sequences import sequence
from camera_ray_caster.core.exports import EXPORT_FORMATS, export_files
from camera_ray_caster.core.exports.file_writer import write
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.programs import PROGRAMS
from camera_ray_caster.core.programs.parts.document import Document
from camera_ray_caster.core.programs.parts.placed import Placed
from camera_ray_caster.core.programs.reading import camera_poses
from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.units import UNIT_SCALE

from .cameras.model_examples import camera
from .exports.shots import pose

SCALES = 0.01, 1.0, 1000.0
NO_POSES = {"opencv", "ros", "mrcal", "stmap", "npz"}
"""Formats whose poses, if there are any, this add-on does not read."""


def shots(meters):
    """A pinhole at two frames; float32 holds its places."""
    settings = {"resolution_x": 64, "resolution_y": 48, "lens": 30.0, "sensor_width": 36.0}
    return [Shot("a", frame, camera("PERSP", settings | {"matrix_world": pose(frame)}), meters) for frame in (1, 2)]


def words(content):
    """The content of a file without comments."""
    return [line for line in content.splitlines() if not line.startswith("#")] if isinstance(content, str) else content


@pytest.mark.one_for_each("chosen")
@pytest.mark.parametrize("chosen", EXPORT_FORMATS, ids=lambda export: export.key)
def test_cameras_come_back_at_any_unit_scale(tmp_path, chosen):
    for meters in SCALES:
        exported = shots(meters)
        files, remarks = export_files(chosen.key, exported)
        files = dict(files)
        assert any("Blender units" in line for line in remarks) == (
            chosen.unit is None and chosen.rigid and meters != 1
        )
        if chosen.unit is None and chosen.key != "json":  # json states the length of the unit
            plain = dict(export_files(chosen.key, shots(1.0))[0])
            assert {name: repr(words(content)) for name, content in files.items()} == {
                name: repr(words(content)) for name, content in plain.items()
            }
        if chosen.key in NO_POSES:
            continue
        folder = tmp_path / str(meters)
        paths = write(files.items(), folder)
        path = (
            folder if chosen.key == "colmap" else next(candidate for candidate in paths if "_val" not in candidate.name)
        )
        path = folder / "transforms_train.json" if chosen.key == "nerf" else path
        (mount,) = mounted(str(path), "", (64, 48), 24.0, meters)
        first = np.eye(4)
        if chosen.key == "kalibr":  # the first camera's frame
            first = np.linalg.inv(exported[0].camera.opencv_from_world) @ np.diag((1, -1, -1, 1))
            first[:3, :3] = np.eye(3)
        for placed, shot in zip(mount.poses, exported, strict=False):
            assert np.allclose(placed[:3, 3] + first[:3, 3], shot.camera.pose.eye, rtol=0, atol=1e-6)


def heights(key, files):
    """The heights of points in the sensor's axes, and in the file's unit."""
    if key == "las":
        (content,) = files.values()
        start, count = struct.unpack_from("<I", content, 96)[0], struct.unpack_from("<Q", content, 247)[0]
        length, scale, offset = (struct.unpack_from(*field)[0] for field in (
            ("<H", content, 105), ("<d", content, 147), ("<d", content, 171)))  # fmt: skip
        return (
            np.array([struct.unpack_from("<i", content, start + k * length + 8)[0] for k in range(count)]) * scale
            + offset
        )
    if key == "npz":
        return np.load(BytesIO(next(iter(files.values()))))["points"][:, 2]
    kind = {"kitti": 4, "nuscenes": 5}.get(key, 0)
    return np.frombuffer(next(iter(files.values())), "<f4").reshape(-1, kind)[:, 2] if kind else None


@pytest.mark.one_for_each("key")
@pytest.mark.parametrize("key", CLOUDS)
def test_points_are_in_the_unit_of_their_format(key):
    floor = crc.planes((0.0, 0.0, -1.2), infinite=True)
    level = crc.look_at((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
    cam = crc.camera("SCANNER", (36, 16), level, scanner_device="VLP_16")
    for meters in SCALES:
        record = replace(cam.record, settings={**cam.record.settings, UNIT_SCALE: meters})
        cloud = crc.scan(replace(cam, record=record), floor)
        files = dict(files_of(cloud, key))
        height = heights(key, files)
        if key in ("kitti", "nuscenes", "las"):
            assert np.allclose(height, -1.2 * meters, rtol=1e-6, atol=1e-4 if key == "las" else 0)  # steps of 0.1 mm
        elif height is not None:
            assert np.allclose(height, -1.2)
            assert np.load(BytesIO(files["_points.npz"]))["meters"] == meters
        else:
            assert f"lengths are in Blender units of {meters:g} m\n".encode() in next(iter(files.values()))[:200]


def test_poses_of_a_sequence_are_in_meters():
    cameras = [
        crc.camera("SCANNER", (36, 16), crc.look_at((x, 0, 0), (9, 0, 0)), scanner_device="VLP_16") for x in (0, 1)
    ]
    for meters in SCALES:
        for cam in cameras:
            cam.record.settings[UNIT_SCALE] = meters
        poses = dict(sequence(cameras, (0.0, 1.0)))["poses.txt"].split()
        assert np.array(poses[12:], float).reshape(3, 4)[:, 3] == pytest.approx((0, 0, meters))


UNITS = {
    "COLMAP": "", "nerfstudio": "", "Kalibr": "m", "EuRoC": "m", "OKVIS": "m", "Basalt": "m", "BOP": "mm",
    "Project Aria": "m", "maplab": "m", "HOT3D": "m", "Metashape": "", "Meshroom": "", "Polycam": "m",
    "NVIDIA NCore": "m", "CAHVOR": "m", "DepthAI": "cm", "Anipose": "", "EasyMocap": "m", "CMU Panoptic": "cm",
    "nuScenes": "m", "ORB-SLAM": "m", "WoodScape": "m", "VINS": "m",
    "NVIDIA (f-theta, Isaac Sim)": "m",
    "ARKitScenes": "m", "OpenCV": "", "mrcal": "", "OpenSfM": "m", "RealityCapture": "", "openMVG": "",
    "Bundler": "", "NVM": "", "Gaussian splatting": "", "ns-render camera paths": "", "LLFF": "",
    "Surround360": "", "fSpy": "", "Hugin": "", "PTGui": "", "Open3D": "m",
    "KITTI": "m", "this add-on": "", "TUM": "m", "EuRoC trajectories": "m",
}  # fmt: skip
"""Units of lengths by the formats' documentation; "" for those that have none, of reconstructions."""


@pytest.mark.parametrize("meters", SCALES)
def test_every_reader_of_poses_has_the_unit_of_its_format(tmp_path, monkeypatch, meters):
    (tmp_path / "file").write_text("any")
    pose, sizes = np.eye(4), {"": 1.0, "m": 1.0 / meters, "cm": 1e-2 / meters, "mm": 1e-3 / meters}
    pose[:3, 3] = 1, 2, 3
    for program in (known for known in PROGRAMS if known.poses is not None):
        assert program.name in UNITS, f"UNITS of test_units.py has no entry for the lengths of {program.name}"
        of_any = replace(program, poses=lambda document: [Placed("", "", None, pose)])
        monkeypatch.setattr(camera_poses, "program_of", lambda document, of_any=of_any: of_any)
        (placed,) = camera_poses.placed_in(Document(str(tmp_path / "file")), meters)
        assert np.allclose(placed.pose[:3, 3], np.array((1, 2, 3)) * sizes[UNITS[program.name]], rtol=1e-12)
        assert (placed.pose[:3, :3] == np.eye(3)).all()
