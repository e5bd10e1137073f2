"""Shares of a data set that become the set that one run makes; folders; pictures that fail."""

import errno
import json

import numpy as np
import pytest

from camera_ray_caster.core.sets import shares

from .running import ROOT, left, refused

WORDS = "--cameras", "ALL", "--frames", "1:3", "--passes", "combined,ray_direction", "--annotations"


def content(path):
    """What a file of a set is, but for the times that it took and that a PNG has."""
    if path.suffix == ".npz":
        with np.load(path) as arrays:
            return {name: arrays[name].tobytes() for name in arrays.files}
    if path.suffix == ".png":
        data = path.read_bytes()
        return data[data.index(b"IDAT") :]
    written = json.loads(path.read_text()) if path.suffix == ".json" else path.read_text()
    if isinstance(written, dict) and "made" in written:
        written = {name: value for name, value in written.items() if name not in ("seconds", "rays_per_second")}
        del written["made"]["files"]  # sizes of reports and pictures, which have times in words
    return written


@pytest.fixture
def whole(command, scene, tmp_path):
    """The folder of a set that one run has made."""
    assert command("dataset", scene, *WORDS, "--output", tmp_path / "whole").returncode == 0
    return tmp_path / "whole"


def test_shares_become_what_one_run_makes(command, scene, whole, tmp_path):
    out = tmp_path / "out"
    command("dataset", scene, *WORDS, "--shard", "2/2", "--output", out)  # the one without the first frame comes first
    line = refused(command("dataset", out, "--complete"))
    assert "4 of 6 pictures are missing: Side_0001, Top_0001, Side_0003, Top_0003; run their shares again" in line
    with shares.running(out, (1, 2)):
        assert "share 1/2 still runs" in refused(command("dataset", out, "--complete"))
        again = refused(command("dataset", scene, *WORDS, "--shard", "1/2", "--output", out))
        assert again.startswith("dataset.py: share 1/2 of")
        assert again.endswith("runs already: let it end")
    other = command("dataset", scene, *WORDS[:3], "1:4", *WORDS[4:], "--shard", "1/2", "--output", out)
    assert "shares of a run of other cameras or frames" in refused(other)
    assert "shares of 2, and this is one of 3" in refused(
        command("dataset", scene, *WORDS, "--shard", "1/3", "--output", out)
    )
    command("dataset", scene, *WORDS, "--shard", "1/2", "--output", out)
    for _ in range(2):
        done = command("dataset", out, "--complete")
        assert (done.returncode, done.stdout) == (0, f"The 6 pictures in {out} are a data set\n")
    assert left(out) == left(whole)
    for path in whole.iterdir():
        assert content(out / path.name) == content(path), path.name


def test_a_folder_that_is_no_set_cannot_be_completed(command, scene, tmp_path):
    assert "has no dataset.json of this version" in refused(command("dataset", tmp_path, "--complete"))
    assert "dataset.py FOLDER --complete" in refused(command("dataset", scene, "--complete"))


def failing(blender, scene):
    """Let the camera Side be flat in frame 2."""
    side = blender.data.objects["Side"]
    for frame, scale in (1, 1), (2, 0), (3, 1):
        side.scale.y = scale
        side.keyframe_insert("scale", frame=frame)
    blender.ops.wm.save_as_mainfile(filepath=str(scene))


def test_a_picture_that_fails_is_one_line_and_the_others_are_made(command, blender, scene, tmp_path, monkeypatch):
    from camera_ray_caster.blender.terminal.picture_jobs import Pictures

    failing(blender, scene)
    tried = []
    make = Pictures.make
    monkeypatch.setattr(Pictures, "make", lambda self, job, *what: (tried.append(job.name), make(self, job, *what))[1])
    out = tmp_path / "out"
    line = refused(command("dataset", scene, *WORDS, "--retries", "2", "--output", out))
    assert line.startswith("dataset.py: Side_0002: ")
    assert "scale of zero" in line
    assert (tried.count("Side_0002"), len(tried)) == (3, 8)
    assert sorted(path.stem for path in out.glob("*_000?.png")) == ["Side_0001", "Side_0003", "Top_0001", "Top_0002",
                                                                    "Top_0003"]  # fmt: skip
    assert not (out / "annotations.json").exists()


def test_a_run_ends_if_all_pictures_fail(command, scene, tmp_path, monkeypatch):
    from camera_ray_caster.blender.terminal.picture_jobs import Pictures
    from camera_ray_caster.core.records import InputError

    def fail(self, job, *what):
        raise InputError("no")

    monkeypatch.setattr(Pictures, "make", fail)
    done = command("dataset", scene, "--frames", "1:30", "--output", tmp_path / "out")
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 11
    assert "the first 10 pictures failed" in done.stderr.splitlines()[-1]


def test_folders_hold_a_few_files_each_and_are_one_set(command, scene, whole, tmp_path):
    out = tmp_path / "out"
    assert command("dataset", scene, *WORDS, "--folders", "10", "--output", out).returncode == 0
    places = sorted(path.name for path in out.iterdir() if path.is_dir())
    assert places == ["Side_0000", "Side_0002", "Top_0000", "Top_0002"]
    assert all(len(list((out / name).iterdir())) <= 10 for name in places)
    for path in whole.glob("*_000?*"):
        (moved,) = out.glob(f"*/{path.name}")
        assert content(moved).keys() == content(path).keys() if path.suffix == ".json" else True
        if path.suffix != ".json":
            assert content(moved) == content(path)
    merged, expected = (json.loads((folder / "annotations.json").read_text()) for folder in (out, whole))
    assert [image.pop("file_name").rpartition("/")[2] for image in merged["images"]] == [
        image.pop("file_name") for image in expected["images"]
    ]
    assert merged == expected
    assert (out / merged["images"][0].get("file_name", "Side_0000/Side_0001.png")).is_file()
    again = command("dataset", scene, *WORDS, "--folders", "10", "--output", out)
    assert again.stdout.startswith("Wrote 0 of 6 pictures")


def test_a_full_disk_leaves_the_set_as_it_was(command, whole, monkeypatch):
    from camera_ray_caster.core.annotations import coco

    def full(*words, **options):
        raise OSError(errno.ENOSPC, "No space left on device")

    expected = {path.name: path.read_bytes() for path in whole.iterdir()}
    (whole / "annotations.json").unlink()
    before = left(whole)
    monkeypatch.setattr(coco, "TemporaryFile", full)
    assert "No space left on device" in refused(command("dataset", whole, "--complete"))
    assert left(whole) == before
    monkeypatch.undo()
    assert command("dataset", whole, "--complete").returncode == 0
    assert {path.name: path.read_bytes() for path in whole.iterdir()} == expected


@pytest.mark.full
def test_shares_of_a_scanner_are_one_sequence_of_kitti(command, tmp_path):
    words = (ROOT / "blend_scenes" / "street_scanner.blend", "--resolution", "64x16", "--passes", "distance",
             "--points", "kitti", "--frames", "1:2")  # fmt: skip
    for k in (2, 1):
        assert command("dataset", *words, "--shard", f"{k}/2", "--output", tmp_path).returncode == 0
    assert command("dataset", tmp_path, "--complete").returncode == 0
    sequence = tmp_path / "sequences" / "00"
    assert [float(line) for line in (sequence / "times.txt").read_text().split()] == [0.0, 0.1]
    assert len((sequence / "poses.txt").read_text().splitlines()) == 2
    for k in (0, 1):
        points = (sequence / "velodyne" / f"{k:06}.bin").read_bytes()
        assert points == (tmp_path / f"Camera_000{k + 1}.bin").read_bytes() != b""
