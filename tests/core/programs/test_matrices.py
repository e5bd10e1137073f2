"""Programs that store a camera matrix and OpenCV's coefficients: the same lens and pose in each program's file."""

import re
from pathlib import Path

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.programs.parts.document import Document
from camera_ray_caster.core.programs.reading.camera_poses import placed_in
from camera_ray_caster.core.programs.reading.folders import pair_of
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

SAMPLES = Path(__file__).parent / "samples"
SIZE = (1280, 720)
TERMS = "fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"
LENS = [910.5, 911, 640.5, 355.5, -0.25, 0.125, 0, 0, 0.0625]
FISHEYE = [400.5, 401, 640.5, 355.5, -0.25, 0.125, 0, 0, 0.5]
FROM_WORLD = np.array([[0, 1, 0, -5], [-1, 0, 0, 4], [0, 0, 1, -6]])
"""The inverse of a quarter turn about z and (4, 5, 6)."""
TO_BODY = np.array([[0, -1, 0, 4], [1, 0, 0, 5], [0, 0, 1, 6]])


def poses_of(name):
    """The first three rows of the pose of each camera of a sample."""
    return {entry.camera: entry.pose[:3] for entry in placed_in(Document(str(SAMPLES / name), SIZE), 1.0)}


@pytest.mark.parametrize(
    ("name", "camera", "numbers"),
    [
        ("anipose.toml", "A", LENS), ("anipose.toml", "B", FISHEYE), ("panoptic.json", "00_00", LENS),
        ("depthai.json", "CAM_A", LENS), ("depthai.json", "CAM_B", FISHEYE), ("nuscenes.json", "a1", LENS),
        ("easymocap.yml", "01", LENS), ("ost.txt", "", LENS), ("callab.txt", "camera.0", LENS),
    ],
)  # fmt: skip
def test_lenses(name, camera, numbers):
    (lens,) = [entry for entry in lenses_of(str(SAMPLES / name), "", SIZE) if entry.name == camera]
    if name == "nuscenes.json":
        numbers = [*numbers[:4], 0, 0, 0, 0, 0]
    else:
        assert lens.size == SIZE
    assert lens.model == ("OPENCV_FISHEYE" if numbers is FISHEYE else "OPENCV_PINHOLE")
    assert lens.values(TERMS) == numbers


@pytest.mark.parametrize(
    ("name", "camera", "pose"),
    [
        ("anipose.toml", "A", FROM_WORLD), ("panoptic.json", "00_00", FROM_WORLD), ("easymocap.yml", "01", FROM_WORLD),
        ("depthai.json", "CAM_A", np.eye(4)[:3]), ("depthai.json", "CAM_C", TO_BODY),
        ("depthai.json", "CAM_B", [[0, -1, 0, 4], [1, 0, 0, 6], [0, 0, 1, 6]]),  # 1 m along x of CAM_C
        ("nuscenes.json", "a1", [[0, 0, 1, 4], [-1, 0, 0, 5], [0, -1, 0, 6]]),
    ],
)  # fmt: skip
def test_poses(name, camera, pose):
    np.testing.assert_allclose(poses_of(name)[camera], pose, rtol=0, atol=1e-12)


def test_the_files_of_easymocap_belong_together(tmp_path):
    text = (SAMPLES / "easymocap.yml").read_text()
    lenses, poses = (str(tmp_path / name) for name in ("intri.yml", "extri.yml"))
    for path in (lenses, poses):
        Path(path).write_text(text)
    assert pair_of(str(tmp_path)) == pair_of(poses) == (lenses, poses)


@pytest.mark.parametrize(
    ("name", "change", "says"),
    [
        ("callab.txt", ("camera.0.version=0", "camera.0.p1=0.1"), "tangential distortion, which is not read"),
        ("depthai.json", ('"cameraType": 0', '"cameraType": 3'), "cameraType of CAM_A is '3': it must be one of 0, 1"),
        ("depthai.json", ('"toCameraSocket": 2', '"toCameraSocket": 1'), "CAM_B lead to socket 1, which leads nowhere"),
        ("anipose.toml", ("[cam_1]", "[cam_0]"), "is not TOML: Cannot declare"),
        ("easymocap.yml", ("Rot_01", "Rot_1"), "it has no R_01$"),
        ("ost.txt", ("0.0 0.0 0.0625", "0.0 0.0"), "of a pinhole or of a fisheye"),
    ],
)
def test_what_is_not_read_is_refused_in_one_line(name, change, says, tmp_path):
    (tmp_path / name).write_text((SAMPLES / name).read_text().replace(*change))
    refusals = []
    for read in (lambda: placed_in(Document(str(tmp_path / name), SIZE), 1.0), lambda: lenses_of(str(tmp_path / name))):
        try:
            refusals += [entry.refusal for entry in read() if getattr(entry, "refusal", None)]
        except InputError as refusal:
            refusals.append(refusal)
    assert any(re.search(says, str(refusal)) for refusal in refusals)


def test_the_omni_cameras_of_svo():
    """vikit: a pixel is (x + e y, d x + c y) from the center, and its ray (x, y, -polynomial(r)), z ahead."""
    camera = crc.load_calibration(str(SAMPLES / "maplab.omni.yaml"), pose=np.eye(4))
    x, y = 100.0, 60.0
    r = np.hypot(x, y)
    z = 110 - 0.002 * r**2 + 8e-6 * r**3 - 2e-8 * r**4
    column, row = 376.5 + x - 0.03125 * y, 240.5 + 0.0625 * x + 1.125 * y
    np.testing.assert_allclose(camera.project((x, -y, -z)), (column + 0.5, 479.5 - row), rtol=0, atol=1e-9)
