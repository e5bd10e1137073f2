"""KITTI's calibrations and poses, by the formulas of its development kits, written down here once more."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.records import InputError

POINTS = np.random.default_rng(6).uniform((-2, -1, 5), (2, 1, 9), (30, 3))
"""In the frame of camera 00: x right, y down, z ahead."""
K = np.array(((959.0, 0, 696.0), (0, 956.9, 224.2), (0, 0, 1)))
D = -0.2, 0.1, 1.4e-3, 5.7e-4, -0.01
R = np.array(((0.96, 0.28, 0), (-0.28, 0.96, 0), (0, 0, 1)))
T = np.array((0.0596, 2.9e-4, 2.6e-3))
TURN = np.array(((0.936, -0.352, 0), (0.352, 0.936, 0), (0, 0, 1)))
P = np.array(((721.5, 0, 609.6, 44.9), (0, 721.5, 172.9, 0.22), (0, 0, 1, 2.7e-3)))


def line(name, numbers):
    return f"{name}: {' '.join(f'{number:.15e}' for number in np.ravel(numbers))}\n"


RAW = "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.95e-02\n" + "".join(line(*entry) for entry in (
    ("S_02", (1392, 512)), ("K_02", K), ("D_02", D), ("R_02", R), ("T_02", T), ("S_rect_02", (1242, 375)),
    ("R_rect_00", TURN), ("P_rect_02", P),
))  # fmt: skip
BENCHMARK = line("P0", P - (0, 0, 0, 1) * P) + line("P2", P) + line("R0_rect", TURN) + line("Tr_velo_to_cam", P)


def rig(tmp_path, text, size=(1242, 375)):
    path = tmp_path / "calib.txt"
    path.write_text(text)
    return {camera.name: camera for camera in mounted(str(path), "", size, 24.0)}


def pixels_of(camera):
    """The pixels of the points, y down, from the center of the first pixel."""
    size = camera.size or (1242, 375)
    loaded = crc.load_calibration(camera.file, camera.lens.name, size=size, pose=camera.poses[0])
    return loaded.project(POINTS) * (1, -1) + (-0.5, size[1] - 0.5)


def test_a_camera_is_seen_as_calibrated_and_as_rectified(tmp_path):
    cameras = rig(tmp_path, RAW)
    assert {name: camera.size for name, camera in cameras.items()} == {"K_02": (1392, 512), "P_rect_02": (1242, 375)}
    rectified = np.column_stack((POINTS @ TURN.T, np.ones(len(POINTS)))) @ P.T
    np.testing.assert_allclose(pixels_of(cameras["P_rect_02"]), rectified[:, :2] / rectified[:, 2:], atol=1e-9)
    local = POINTS @ R.T + T
    x, y = local[:, 0] / local[:, 2], local[:, 1] / local[:, 2]
    s = x * x + y * y
    gain = 1 + D[0] * s + D[1] * s**2 + D[4] * s**3
    bent = np.stack((x * gain + 2 * D[2] * x * y + D[3] * (s + 2 * x * x),
                     y * gain + D[2] * (s + 2 * y * y) + 2 * D[3] * x * y, np.ones_like(x)), axis=-1)  # fmt: skip
    np.testing.assert_allclose(pixels_of(cameras["K_02"]), (bent @ K.T)[:, :2], atol=1e-9)


def test_cameras_of_a_benchmark_stand_in_the_frame_of_the_first_one(tmp_path):
    cameras = rig(tmp_path, BENCHMARK.replace("\n", "\r\n"))
    assert [*cameras] == ["P0", "P2"]
    np.testing.assert_allclose(cameras["P0"].poses[0], np.diag((1.0, -1, -1, 1)), atol=1e-15)
    expected = np.column_stack((POINTS, np.ones(len(POINTS)))) @ P.T
    np.testing.assert_allclose(pixels_of(cameras["P2"]), expected[:, :2] / expected[:, 2:], atol=1e-9)


def test_what_is_exported_as_poses_is_read_as_a_trajectory(tmp_path):
    cameras = [crc.camera("PERSP", (64, 48), crc.look_at((frame, -4, 2), (0, 0, 1)), name="car", frame=frame)
               for frame in (1, 2, 3)]  # fmt: skip
    (path,) = crc.export(cameras, tmp_path, "kitti").paths
    (car,) = mounted(str(path), "", (64, 48), 10.0)
    assert (car.lenses, car.frames) == ([], [1, 2, 3])
    for camera, pose in zip(cameras, car.poses, strict=True):
        np.testing.assert_allclose(pose[:3, 3], camera.pose.eye, atol=1e-15)
        np.testing.assert_allclose(pose[:3, :3] * (1, -1, -1), camera.pose.basis, atol=1e-15)
    path.write_text("1 0 0 0 0 1 0 0 0 0 1 0\n")  # an image of COLMAP has an id, a quaternion and a place
    assert mounted(str(path), "", (64, 48), 10.0)[0].frames == [1]


def test_numbers_before_poses_are_frames_or_times_of_all(tmp_path):
    path, row = tmp_path / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n"
    path.write_text(f"0 {row}0.5 {row}1 {row}")  # 10 frames in a second
    assert mounted(str(path), "", (64, 48), 10.0)[0].frames == [1, 6, 11]
    path.write_text(f"3 {row}5 {row}")
    assert mounted(str(path), "", (64, 48), 10.0)[0].frames == [3, 5]
    path.write_text(f"3 {row}{row}")
    with pytest.raises(crc.InputError, match="pose 2 has 12 numbers, and the first one 13"):
        mounted(str(path), "", (64, 48), 10.0)


def test_names_of_lenses_are_those_of_their_lines(tmp_path):
    path = tmp_path / "calib.txt"
    path.write_text(RAW)
    with pytest.raises(InputError, match=r"has 2 cameras: .*in Python camera=\) to one of K_02, P_rect_02$"):
        crc.load_calibration(path)
    np.testing.assert_array_equal(crc.load_calibration(path, "P_rect_02").K, P[:, :3])
    path.write_text(BENCHMARK)
    with pytest.raises(InputError, match="does not tell the size of its pictures: give size="):
        crc.load_calibration(path, "P2")


@pytest.mark.parametrize(("before", "after", "words"), [
    ("D_02: -2", "D_02: 1 -2", "D_02 is .* 5 finite numbers"),
    ("D_02", "D_03", "it has no D_02"),
    ("K_02: 9", "K_02: -9", "the camera matrix .* with fx and fy above 0"),
    ("K_02: 9", "K_02: nan 9", "K_02 is .* 9 finite numbers"),
    ("S_02: 1", "S_02: 1.5 1", "S_02 is .* 2 finite numbers"),
])  # fmt: skip
def test_a_damaged_line_is_refused_by_its_name(tmp_path, before, after, words):
    path = tmp_path / "calib.txt"
    path.write_text(RAW.replace(before, after))
    (lens, _) = lenses_of(str(path))
    with pytest.raises(InputError, match=words) as caught:
        crc.load_calibration(path, lens.name)
    assert "\n" not in str(caught.value)
    with pytest.raises(InputError):
        rig(tmp_path, RAW.replace(before, after))


@pytest.mark.parametrize(("text", "words"), [
    (RAW.replace("R_02: 9", "R_02: 8"), "R_02 and T_02 is no rotation"),
    (RAW.replace("T_02", "T_03"), "it has no T_02"),
    (line("", P)[2:] + "1 0 0 0 0 1 0 0 0 0 1\n", "pose 1 is no rotation"),
    (line("", np.eye(4)[:3])[2:] + "1 0 0 0 0 1 0 0 0 0 1\n", "pose 2 has 11 numbers"),
])  # fmt: skip
def test_a_bad_place_is_refused(tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        rig(tmp_path, text)


def test_long_numbers_are_read_at_once(tmp_path):
    """A pattern of numbers took time that grew with a power of their digits."""
    with pytest.raises(InputError):
        rig(tmp_path, " ".join(["9" * 400] * 13) + "\n")


def test_a_coefficient_named_p1_is_none_of_kittis_cameras(tmp_path):
    path = tmp_path / "camera.yml"
    path.write_text("fx: 300.\nfy: 301.\ncx: 320.\ncy: 240.\nP1: 0.001 # tangential\nP2: 0.002\nw: 640\nh: 480\n")
    (lens,) = lenses_of(str(path))
    assert (lens.settings["fx"], lens.settings["p1"]) == (300, 0.001)
