"""What cast.py writes of many cameras and frames, what of it a second run takes, and how it tells how far it is."""

import json
import re

import numpy as np
import pytest

import camera_ray_caster as crc

from ..exr import read_exr
from .running import left, refused, small

WORDS = "--cameras", "ALL", "--frames", "1:3:2", "--passes", "ray_origin"


def states(folder):
    """Of each file what changes where it is written."""
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in folder.iterdir()}


def origin(path):
    """The one place that all rays of a picture come from."""
    with np.load(path) as file:
        origins = file["ray_origin"].reshape(-1, 3)
    assert (origins == origins[0]).all()
    return origins[0].tolist()


def test_each_camera_and_frame_has_its_files(command, scene, tmp_path):
    done = command("cast", scene, *WORDS, "--format", "npz", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    summary, note = done.stdout.splitlines()
    assert summary == f"Wrote 4 pictures into {tmp_path / 'out'}"
    assert note.startswith("'Sphere': the exact shape is up to 0.96% of its radius away from the mesh")
    stems = [f"{camera}_{frame}" for camera in ("Side", "Top") for frame in ("0001", "0003")]
    assert left(tmp_path / "out") == [f"{stem}.{kind}" for stem in stems for kind in ("json", "npz", "png")]
    assert origin(tmp_path / "out" / "Side_0003.npz") == [0, 0.5, 5]
    assert origin(tmp_path / "out" / "Top_0003.npz") == [1, 0, 5]
    report = json.loads((tmp_path / "out" / "Top_0003.json").read_text())
    assert (report["camera"]["name"], report["frame"]) == ("Top", 3)
    assert report["made"]["files"].keys() == {"Top_0003.npz", "Top_0003.png"}


def test_arrays_are_the_passes_that_the_exr_has(command, scene, tmp_path):
    words = ("--passes", "combined,depth,normal,shape_index,valid", "--output", tmp_path / "out")
    for kind in "npz", "exr":
        assert command("cast", scene, *words, "--format", kind).returncode == 0
    arrays = dict(np.load(tmp_path / "out" / "small.npz"))
    layers = read_exr(tmp_path / "out" / "small.exr")
    assert arrays.keys() == {"combined", "depth", "normal", "shape_index", "valid"}
    assert {key: array.dtype for key, array in arrays.items()} == {
        "combined": np.float32, "depth": np.float32, "normal": np.float32, "shape_index": np.int32, "valid": np.bool_,
    }  # fmt: skip
    far = np.isinf(arrays["depth"])
    assert 0 < np.count_nonzero(far) < far.size
    assert (np.where(far, np.float32(1e10), arrays["depth"]) == layers["ViewLayer.Depth.Z"]).all()
    for axis, letter in enumerate("XYZ"):
        assert (arrays["normal"][..., axis] == layers[f"ViewLayer.Normal.{letter}"]).all()
    assert (arrays["shape_index"] == layers["ViewLayer.Shape Index.X"]).all()


def test_arrays_of_layers_and_eyes(command, blender, tmp_path):
    path = small(blender, tmp_path / "stereo.blend", use_multiview=True)
    blender.context.scene.view_layers.new("Second")
    blender.data.objects["Top"].data.stereo.pivot = "CENTER"
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    done = command("cast", path, "--passes", "ray_origin", "--format", "npz", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    with pytest.raises(crc.InputError, match="the views left, right: choose one"):
        crc.camera_from_json(tmp_path / "out" / "report.json")
    for eye, side in ("L", -1), ("R", 1):
        view = {"L": "left", "R": "right"}[eye]
        assert np.sign(crc.camera_from_json(tmp_path / "out" / "report.json", camera=view).pose.eye[0]) == side
        with np.load(tmp_path / "out" / f"stereo_{eye}.npz") as file:
            assert set(file) == {"ViewLayer.ray_origin", "Second.ray_origin"}
            assert (np.sign(file["Second.ray_origin"][..., 0]) == side).all()


@pytest.mark.parametrize(("name", "entry"), [("../../away", "_._.._away"), ("C:\\nul", "C__nul"), ("aux", "_aux")])
def test_entries_of_arrays_are_plain_names(command, blender, scene, tmp_path, name, entry):
    """An NPZ is a ZIP, which other programs unpack into files."""
    blender.context.scene.view_layers.new(name)
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    words = "--passes", "depth", "--format", "npz", "--output", tmp_path / "out"
    assert command("cast", scene, *words).returncode == 0
    assert set(np.load(tmp_path / "out" / "small.npz")) == {"ViewLayer.depth", f"{entry}.depth"}
    blender.context.scene.view_layers.new(entry)
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert "would have the same name" in refused(command("cast", scene, *words[:-1], tmp_path / "second"))
    assert not (tmp_path / "second").exists()


def test_bounds_hold_for_what_16_bits_store_and_what_they_cannot_hold_is_refused(command, blender, tmp_path):
    path = small(blender, tmp_path / "small.blend")
    passes = ("distance", "depth", "position", "normal", "distance_bound", "position_bound", "normal_bound")
    words = ("--passes", ",".join(passes), "--format", "npz", "--output")
    assert command("cast", path, *words, tmp_path / "all").returncode == 0
    assert command("cast", path, *words, tmp_path / "half", "--half").returncode == 0
    with np.load(tmp_path / "all" / "small.npz") as exact, np.load(tmp_path / "half" / "small.npz") as half:
        met = np.isfinite(exact["depth"])
        assert met.any()
        for name, bound in (("distance",) * 2, ("depth", "distance"), ("position",) * 2, ("normal",) * 2):
            off = exact[name][met].astype(float) - half[name][met]
            off = np.abs(off) if off.ndim == 1 else np.linalg.norm(off, axis=-1)
            assert off.max() > 1e-6
            assert (off <= half[f"{bound}_bound"][met]).all(), name
    accuracy = json.loads((tmp_path / "half" / "report.json").read_text())["accuracy"]
    assert accuracy["rounding_when_stored"] == 2.0**-11
    blender.context.scene.camera.data.clip_end = 1e6
    for item in blender.context.scene.objects:
        item.location *= 1e5
        item.scale *= 1e5
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    done = command("cast", path, *words, tmp_path / "far", "--half")
    assert done.returncode == 2
    assert "above 65504, the largest of 16 bits: write it without --half" in done.stderr
    assert not (tmp_path / "far").exists()


@pytest.mark.parametrize("kind", ["npz", "exr"])
def test_16_bits_only_where_they_are_asked_for(command, scene, tmp_path, kind):
    words = ("--passes", "combined,depth,shape_index", "--format", kind, "--half", "--output", tmp_path / "out")
    assert command("cast", scene, *words).returncode == 0
    if kind == "npz":
        with np.load(tmp_path / "out" / "small.npz") as file:
            assert (file["depth"].dtype, file["shape_index"].dtype) == (np.float16, np.int32)
    else:  # Blender keeps what is no color
        layers = read_exr(tmp_path / "out" / "small.exr")
        assert [layers[f"ViewLayer.{name}"].dtype for name in ("Combined.R", "Depth.Z")] == [np.float16, np.float32]


def test_the_resolution_is_the_whole_picture_s(command, blender, tmp_path):
    path = small(blender, tmp_path / "small.blend", resolution_percentage=50)
    assert command("cast", path, "--resolution", "20x10", "--output", tmp_path / "out").returncode == 0
    assert json.loads((tmp_path / "out" / "report.json").read_text())["pixels"] == 200


def test_shards_are_together_all_frames_once(command, scene, tmp_path):
    frames = {}
    for number in range(1, 4):
        out = tmp_path / f"{number}"
        words = ("--frames", "2:9", "--passes", "depth", "--shard", f"{number}/3", "--output", out)
        assert command("cast", scene, *words).returncode == 0
        frames[number] = [int(path.stem[-4:]) for path in sorted(out.glob("*.png"))]
    assert frames == {1: [2, 5, 8], 2: [3, 6, 9], 3: [4, 7]}


def test_finished_files_are_taken(command, scene, tmp_path):
    out = tmp_path / "out"
    assert command("cast", scene, *WORDS, "--output", out).returncode == 0
    before = states(out)
    (out / "Side_0001.exr").write_bytes(b"cut off")
    (out / "Top_0003.png").unlink()
    (out / "Top_0001.json").write_text('{"made": [')
    done = command("cast", scene, *WORDS, "--skip-existing", "--output", out)
    assert (done.returncode, done.stderr) == (0, "")
    summary = done.stdout.splitlines()[0]
    assert summary == f"Wrote 3 of 4 pictures into {out}; the other pictures were already finished"
    after = states(out)
    assert after.keys() == before.keys()
    kept = {name for name in after if after[name] == before[name]}
    assert kept == {f"Side_0003.{kind}" for kind in ("exr", "json", "png")}


OTHERS = {
    "passes": ("--passes", "depth"),
    "shading": ("--shading", "grid"),
    "resolution": ("--resolution", "16x12"),
    "format": ("--format", "npz"),
    "bits": ("--half",),
}


@pytest.mark.parametrize("case", ["nothing", *OTHERS, "file", "a file that it uses", "camera", "frame"])
def test_what_was_made_of_something_else_is_made_again(command, blender, scene, tmp_path, case):
    words, other = ("--camera", "Side", "--frame", "1"), OTHERS.get(case, ())
    image = blender.data.images.new("image", 4, 4)
    image.filepath_raw, image.file_format = str(tmp_path / "image.png"), "PNG"
    image.save()
    image.use_fake_user = True
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    command("cast", scene, *words, "--output", tmp_path / "out")
    if case == "file":
        blender.data.objects["Sphere"].location.x = 0.25
        blender.ops.wm.save_as_mainfile(filepath=str(scene))
    elif case == "a file that it uses":
        with (tmp_path / "image.png").open("ab") as file:
            file.write(b"more")
    elif case == "camera":
        words = ("--camera", "Top", "--frame", "1")
    elif case == "frame":
        words = ("--camera", "Side", "--frame", "2")
    for is_finished in (case == "nothing", True):
        done = command("cast", scene, *words, *other, "--skip-existing", "--output", tmp_path / "out")
        assert done.returncode == 0
        assert ("Wrote 0 of 1 pictures" in done.stdout) == is_finished


def test_an_option_that_is_not_named_is_a_setting_of_the_pictures(registered, scene, monkeypatch):
    """``--skip-existing`` keeps no picture that was made with another value of an option which nobody thought of."""
    from camera_ray_caster.blender.terminal import cast
    from camera_ray_caster.blender.terminal.picture_jobs import Pictures
    from camera_ray_caster.blender.terminal.words import unstamped

    def add_others(parser):
        parser.add_argument("--new", default="a word")
        unstamped(parser.add_argument("--where", default="here"))

    monkeypatch.setattr(cast, "add_json", add_others)
    settings = Pictures(cast.options_of([str(scene)], "cast.py")).stamp()["settings"]
    assert settings["new"] == "a word"
    assert "where" not in settings
    assert settings.keys() == {
        "new", "scene", "calibration_camera", "model", "resolution", "enable_autoexec", "rig_parent", "passes",
        "shading", "engine", "samples", "device", "format", "half", "rows", "annotations", "keypoints", "points",
        "points_axes", "noise", "dropout", "quantum", "seed", "file_output", "calibration", "rig",
    }  # fmt: skip


def test_a_witness_that_disagreed_still_does(command, scene, tmp_path):
    command("cast", scene, "--output", tmp_path / "out")
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    (tmp_path / "out" / "report.json").write_text(json.dumps(report | {"passed": False}))
    assert command("cast", scene, "--skip-existing", "--output", tmp_path / "out").returncode == 1


def test_what_a_kill_has_left_is_cleared_up_where_all_is_finished(command, scene, tmp_path):
    command("cast", scene, "--output", tmp_path / "out")
    (tmp_path / "out" / f".writing_{'0' * 16}").mkdir()
    assert command("cast", scene, "--skip-existing", "--output", tmp_path / "out").returncode == 0
    assert left(tmp_path / "out") == ["report.json", "small.exr", "small.png"]


def test_cameras_whose_files_would_have_the_same_name_are_refused(command, blender, scene, tmp_path):
    for name in "A/B", "a:b":
        blender.ops.object.camera_add()
        blender.context.object.name = name
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert "would have the same name" in refused(command("cast", scene, *WORDS, "--output", tmp_path / "out"))
    assert not (tmp_path / "out").exists()


def test_a_picture_that_takes_long_says_so(command, scene, tmp_path, monkeypatch):
    """A wide picture with pixel times took minutes without a word."""
    from camera_ray_caster.blender.terminal import progress

    monkeypatch.setattr(progress, "LONG", 0.0)
    done = command("cast", scene, "--output", tmp_path / "out")
    assert done.returncode == 0
    assert done.stderr
    assert all(re.fullmatch(r"cast\.py: 0 of 1, 0:00:\d\d so far", line) for line in done.stderr.splitlines())


@pytest.mark.parametrize("is_terminal", [True, False])
def test_progress_has_rate_failures_and_the_time_that_is_left(blender, capsys, monkeypatch, is_terminal, tmp_path):
    from camera_ray_caster.blender.terminal import progress

    clock = iter([0.0, 1.0, 30.0, 35.0, 60.0, 75.0])
    monkeypatch.setattr(progress, "monotonic", lambda: next(clock))
    monkeypatch.setattr("sys.stderr.isatty", lambda: is_terminal)
    shown = progress.Progress(5, "it", tmp_path / "log")
    for made, failed in (False, False), (True, False), (True, False), (False, True), (True, False):
        shown.add(made, failed)
    output = capsys.readouterr().err
    lines = [
        "it: 2 pictures a minute, 0 failed, 2 of 5, 0:01:30 left",
        "it: 2 pictures a minute, 1 failed, 4 of 5, 0:00:20 left",
        "it: 2.4 pictures a minute, 1 failed, 5 of 5, 0:00:00 left",
    ]
    if is_terminal:
        assert [line.split("| ")[1].removesuffix("\033[K") for line in output.strip().split("\r")] == [
            "1/5 [0:00:01<?, ? pictures/min, 0 failed]",
            "2/5 [0:00:30<0:01:30, 2 pictures/min, 0 failed]",
            "3/5 [0:00:35<0:00:35, 3.43 pictures/min, 0 failed]",
            "4/5 [0:01:00<0:00:20, 2 pictures/min, 1 failed]",
            "5/5 [0:01:15<0:00:00, 2.4 pictures/min, 1 failed]",
        ]
        assert output.split("\r")[3].startswith(f" 60%|{'#' * 18:30}|")
    else:
        assert output.splitlines() == lines
    assert (tmp_path / "log").read_text().splitlines() == lines
