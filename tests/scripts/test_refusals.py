"""What the scripts refuse: bad input is one line on standard error, status 2, and leaves nothing."""

import subprocess
import sys
from pathlib import Path

import pytest

from .running import ROOT, left, refused, script, small

WRONG_WORDS = {
    "no file": ([], "give the path of a .blend"),
    "missing": (["missing.blend"], "there is no file 'missing.blend'"),
    "a folder": (["."], "there is no file '.'"),
    "no .blend": (["text.blend"], "'text.blend' is not a .blend file that this Blender can open"),
    "a name that is too long for a file": (["a" * 300], "there is no file 'aaa"),
    "no such camera": (["small.blend", "--camera", "Front"], "no camera 'Front'; its cameras are: 'Side', 'Top'"),
    "no such option": (["small.blend", "--depth"], "unrecognized arguments: --depth"),
    "no number": (["small.blend", "--frame", "half"], "'half'"),
    "a negative number": (["small.blend", "--frame", "-1e9"], "-1e9 is beyond Blender's last frame"),
    "not finite": (["small.blend", "--frame", "nan"], "'nan' is not a frame number"),
    "no size": (["small.blend", "--resolution", "640"], "'640'"),
    "a small size": (["small.blend", "--resolution", "640x0"], "outside Blender's range of 4 to 65536"),
    "beyond Blender's frames": (["small.blend", "--frame", "1e300"], "last frame"),
}
WRONG_FOR_CAST = {
    "no such pass": (["small.blend", "--passes", "depth,normals"], "unknown pass 'normals': did you mean normal?"),
    "no such shading": (["small.blend", "--shading", "toon"], "MATERIAL"),
    "frames backwards": (["small.blend", "--frames", "2:1"], "2:1 has no frames"),
    "frames without a step": (["small.blend", "--frames", "1:2:0"], "1:2:0 has the step 0"),
    "no such camera of several": (["small.blend", "--cameras", "Top", "Front"], "no camera 'Front'"),
    "camera and cameras": (["small.blend", "--cameras", "ALL", "--camera", "Top"], "exclude each other"),
    "a calibration of several": (
        ["small.blend", "--cameras", "ALL", "--calibration", "text.blend"],
        "applies to one camera",
    ),
    "no share": (["small.blend", "--frames", "1:4", "--shard", "5/4"], "shares of 4 are 1/4 to 4/4"),
    "share 0": (["small.blend", "--frames", "1:4", "--shard", "0/4"], "shares of 4"),
    "a share of none": (["small.blend", "--frames", "1:4", "--shard", "0/0"], "give K/N, such as 1/4"),
    "half a share": (["small.blend", "--frames", "1:4", "--shard", "3"], "'3'"),
    "a share of one frame": (["small.blend", "--shard", "1/4"], "of the frames of --frames"),
    "no such format": (["small.blend", "--format", "tiff"], "EXR"),
    "poses of none": (["small.blend", "--poses"], "no camera has poses from a file: give --frames"),
    "poses and frames": (["small.blend", "--poses", "--frames", "1:2"], "leave out --frame and --frames"),
    "one frame for frames": (["small.blend", "--frames", "2"], "'2'"),
    "frame and frames": (["small.blend", "--frame", "1", "--frames", "1:2"], "not allowed with"),
    "a file for a folder": (["small.blend", "--output", "text.blend"], "cannot write into 'text.blend'"),
    "below a file": (["small.blend", "--output", "text.blend/out"], "cannot write into 'text.blend/out'"),
    "a name that is too long": (["small.blend", "--output", "a" * 300], "cannot write into"),
    "no place for a folder": (["small.blend", "--output", "/proc/out"], "cannot write into '/proc/out'"),
}


@pytest.mark.parametrize("command", ["cast", "verify"])
@pytest.mark.parametrize("case", WRONG_WORDS | WRONG_FOR_CAST)
def test_wrong_words_are_refused(scene, monkeypatch, command, case):
    from camera_ray_caster.blender.terminal import commands
    from camera_ray_caster.core.records import InputError

    if command == "verify" and case in WRONG_FOR_CAST:
        words, message = WRONG_FOR_CAST[case][0], "unrecognized arguments"
    else:
        words, message = (WRONG_WORDS | WRONG_FOR_CAST)[case]
    monkeypatch.chdir(scene.parent)
    Path("text.blend").write_text("no .blend")
    before = left(scene.parent)
    with pytest.raises(InputError) as error:
        commands.COMMANDS[command](words, command)
    assert message in str(error.value)
    assert "\n" not in str(error.value)
    assert left(scene.parent) == before


@pytest.mark.cases(1)
@pytest.mark.parametrize("command", ["cast", "verify"])
@pytest.mark.parametrize("case", ["missing", "no .blend", "no such camera", "no such option"])
def test_a_refusal_is_one_line_and_status_2(scene, command, case):
    (scene.parent / "text.blend").write_text("no .blend")
    words, message = WRONG_WORDS[case]
    line = refused(script(command, *words, folder=scene.parent))
    assert line.startswith(f"{command}.py: ")
    assert message in line


@pytest.mark.cases(1)
@pytest.mark.parametrize("command", ["cast", "verify"])
def test_a_python_without_bpy_is_told_what_it_needs(command):
    words = [sys.executable, "-S", ROOT / "scripts" / f"{command}.py"]  # -S: no packages
    done = subprocess.run(words, capture_output=True, text=True, timeout=300, env={})
    assert "needs Blender or pip's bpy, which `make cast`" in refused(done)


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", ["make_scenes", "make_pictures"])
def test_what_is_made_has_to_be_known(name):
    assert f"{name}.py: no {name[5:-1]} is called no?such: choose from " in refused(script(name, "no\nsuch"))


UNCASTABLE = {
    "has a scale of zero": lambda scene: setattr(scene.camera, "scale", (1, 0, 1)),
    "has no active camera": lambda scene: setattr(scene, "camera", None),
    "is of type mesh, not a camera": lambda scene: setattr(scene, "camera", scene.objects["Sphere"]),
    "no view layer of scene 'Scene' is used": lambda scene: setattr(scene.view_layers[0], "use", False),
}


@pytest.mark.parametrize("case", UNCASTABLE)
def test_a_scene_that_cannot_be_cast_is_refused_in_one_line(command, blender, scene, tmp_path, case):
    UNCASTABLE[case](blender.context.scene)
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert case in refused(command("cast", scene, "--output", tmp_path / "out"))
    assert not (tmp_path / "out").exists()


def test_a_failed_run_leaves_good_files_as_they_were(command, scene, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "small.exr").write_text("good")
    (out / "report.json").write_text("good")
    (out / "small.png").mkdir()
    assert "'small.png' is a folder" in refused(command("cast", scene, "--output", out))
    assert left(out) == ["report.json", "small.exr", "small.png"]
    assert [(out / name).read_text() for name in ("report.json", "small.exr")] == ["good", "good"]


def test_views_with_one_suffix_are_refused(command, blender, tmp_path):
    """One would overwrite the other's files; Windows and macOS do not tell upper from lower case."""
    path = small(blender, tmp_path / "stereo.blend", use_multiview=True)
    views = blender.context.scene.render.views
    views["left"].file_suffix, views["right"].file_suffix = "_Eye", "_eye"
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    line = refused(command("cast", path, "--passes", "depth", "--output", tmp_path / "out"))
    assert "views 'left' and 'right' have the same file suffix, '_eye'" in line
    assert not (tmp_path / "out").exists()
