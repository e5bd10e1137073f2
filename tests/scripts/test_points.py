"""What cast.py --points writes, and what it refuses."""

import numpy as np
import pytest

from .running import left, refused, script, small


@pytest.fixture(scope="module")
def scene(registered, tmp_path_factory):
    """The small scene, whose ball has a category in words; its camera moves 1 to the right from frame 1 to 2."""
    bpy = registered
    path = small(bpy, tmp_path_factory.mktemp("points") / "small.blend")
    bpy.data.objects["Sphere"]["category"] = "ball"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_kittis_sequence_of_a_run(command, scene, tmp_path):
    words = "--points", "kitti", "--frames", "1:2", "--passes", "depth", "--noise", "0.01", "--seed", "3"
    done = command("cast", scene, *words, "--output", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    sequence = tmp_path / "sequences" / "00"
    assert left(sequence) == ["calib.txt", "labels", "poses.txt", "times.txt", "velodyne"]
    assert left(sequence / "labels") == ["000000.label", "000001.label"]
    points = np.fromfile(sequence / "velodyne" / "000000.bin", np.float32).reshape(-1, 4)
    labels = np.fromfile(sequence / "labels" / "000000.label", np.uint32)
    assert len(points) == len(labels) > 50
    assert set(labels.tolist()) == {1 << 16 | 1}  # the first word, and the first shape
    off = np.linalg.norm(points[:, :3] - (5, 0, 0), axis=1) - 1
    assert 0.003 < np.abs(off).mean() < 0.02
    poses = np.loadtxt(sequence / "poses.txt").reshape(-1, 3, 4)
    assert np.abs(poses[1][:, 3] - (1, 0, 0)).max() < 1e-6  # of a camera: x to the right
    before = (sequence / "velodyne" / "000001.bin").read_bytes()
    again = command("cast", scene, *words, "--output", tmp_path, "--skip-existing")
    assert again.returncode == 0
    assert (sequence / "velodyne" / "000001.bin").read_bytes() == before


@pytest.mark.full
def test_a_data_set_by_workers_has_the_points_of_one_process(scene, tmp_path):
    words = "--points", "ply", "--points-axes", "world", "--frames", "1:2", "--passes", "depth", "--dropout", "4"
    for folder, more in (("one", ()), ("two", ("--workers", "2"))):
        assert script("cast", scene, "--dataset", *words, *more, "--output", tmp_path / folder).returncode == 0
    files = [sorted(path.name for path in (tmp_path / folder).glob("*.ply")) for folder in ("one", "two")]
    assert files[0] == files[1]
    assert len(files[0]) > 1
    for name in files[0]:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--noise", "0.1"), "add --points"),
        (("--points", "ply", "--noise", "-1"), "noise"),
        (("--points", "ply", "--quantum", "devices"), "give a number, or DEVICE"),
        (("--points", "ply", "--quantum", "device"), "is not known: give a length"),
        (("--points", "e57"), "choose from"),
    ],
)
def test_what_has_no_meaning_is_refused_in_one_line(command, scene, tmp_path, words, message):
    assert message in refused(command("cast", scene, *words, "--output", tmp_path / "out"))
    assert not (tmp_path / "out").exists() or left(tmp_path / "out") == []
