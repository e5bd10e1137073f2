"""Camchains, trajectories and NeRF's files: read back by our own readers, and by hand."""

import json
from math import atan

import numpy as np
import pytest

from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.exports.rigid import with_rotation
from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera
from .shots import CAMERAS, FRAMES, pose, shots


def written(key, views, folder):
    files, _ = export_files(key, views)
    for name, content in files:
        (folder / name).write_text(content)


def rig(frames=FRAMES, lens=("radtan", "fisheye", "unified")):
    """Cameras that do not move beside each other, while the rig moves."""
    views = []
    for frame in frames:
        for number, name in enumerate(lens):
            key, settings = CAMERAS[name]
            matrix = pose(frame) @ pose(number + 0.25)
            views.append(Shot(name, frame, camera(key, settings | {"matrix_world": matrix}), 0.5))
    return views


def test_a_camchain_is_the_rig(tmp_path):
    rig_shots = rig()
    written("kalibr", rig_shots, tmp_path)
    mounts = mounted(str(tmp_path / "camchain.yaml"), "", (640, 480), 24)
    assert [mount.lens.model for mount in mounts] == ["OPENCV_PINHOLE", "OPENCV_FISHEYE", "UCM"]
    first = np.linalg.inv(with_rotation(rig_shots[0].camera)[0].opencv_from_world)
    for mount, shot in zip(mounts, rig_shots, strict=False):
        beside = np.linalg.inv(first) @ np.linalg.inv(with_rotation(shot.camera)[0].opencv_from_world)
        beside[:3, 3] *= 0.5  # meters
        assert np.abs(mount.poses[0] @ np.diag((1, -1, -1, 1)) - beside).max() < 1e-6
        for name, value in shot.camera.settings.items():
            if name in mount.lens.settings and not name.startswith("cal"):
                assert mount.lens.settings[name] == pytest.approx(value, rel=1e-12)


def test_a_rig_whose_cameras_move_is_no_camchain():
    other = [Shot("fov", frame, camera("FOV", CAMERAS["fov"][1] | {"matrix_world": pose(frame + 1)}))
             for frame in FRAMES]  # fmt: skip
    with pytest.raises(InputError, match=r"camera 'fov' changes .it moves beside 'unified'.: export one frame"):
        list(export_files("kalibr", [*rig(), *other])[0])


@pytest.mark.parametrize("key", ["tum", "euroc", "kitti"])
def test_a_trajectory_has_the_poses(tmp_path, key):
    path_shots = shots("panorama")
    written(key, path_shots, tmp_path)
    near = [with_rotation(shot.camera)[0].pose for shot in path_shots]
    if key == "kitti":
        rows = np.loadtxt(tmp_path / "panorama_kitti.txt").reshape(-1, 3, 4)
        poses = [row @ np.diag((1, -1, -1, 1)) for row in rows]
    else:
        (path,) = mounted(str(next(tmp_path.iterdir())), "", (640, 480), 24)
        poses = path.poses
        assert path.frames == pytest.approx([1, 12, 10000], abs=1e-6)
    for matrix, nearest in zip(poses, near, strict=True):
        assert np.abs(matrix[:3, :3] - nearest.basis).max() < 1e-14 if key == "kitti" else True
        assert np.abs(matrix[:3, 3] - nearest.eye).max() < 1e-14


def test_nerfs_files_have_every_picture_once(tmp_path):
    views = [Shot("a", frame, camera("PERSP", {"resolution_x": 640, "resolution_y": 480, "matrix_world": pose(frame)}))
             for frame in range(1, 24)]  # fmt: skip
    written("nerf", views, tmp_path)
    parts = {name: json.loads((tmp_path / f"transforms_{name}.json").read_text()) for name in ("train", "val", "test")}
    assert {name: len(document["frames"]) for name, document in parts.items()} == {"train": 19, "val": 2, "test": 2}
    assert len({frame["file_path"] for document in parts.values() for frame in document["frames"]}) == 23
    (camera_,) = mounted(str(tmp_path / "transforms_val.json"), "", (640, 480), 24)
    assert camera_.frames == [8, 18]
    assert camera_.lens.settings["fx"] == pytest.approx(views[0].camera.K[0, 0], rel=1e-14)
    assert parts["train"]["camera_angle_x"] == pytest.approx(2 * atan(18 / 50), rel=1e-7)
    with pytest.raises(InputError, match=r"NeRF cannot represent .* which camera_angle_x alone does not say"):
        export_files("nerf", shots("shifted"))
    zooming = [Shot("a", frame, camera("PERSP", {"lens": 30.0 + frame % 3})) for frame in range(1, 6)]
    with pytest.raises(InputError, match=r"^NeRF has one camera_angle_x, but 'a_000[25]' and 'a_0003' differ: export"):
        list(export_files("nerf", zooming)[0])


def test_maps_of_a_camera_that_stands_still_are_written_once():
    still = [Shot("a", frame, camera("OPENCV_FISHEYE", {"resolution_x": 16, "resolution_y": 12, "fx": 5.0, "fy": 5.0}))
             for frame in (1, 2, 3)]  # fmt: skip
    assert [name for name, _ in export_files("stmap", still)[0]] == ["a_undistort.exr", "a_distort.exr"]
    assert [name for name, _ in export_files("stmap", still[:1])[0]] == ["a_0001_undistort.exr", "a_0001_distort.exr"]
