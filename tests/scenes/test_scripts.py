"""The scripts as a user runs them: what they write, what they print, how they refuse, and what they never leave."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from ..exr import read_exr

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "blend_scenes"
INDEX = "IndexOB.X", "Object Index.X"
"""Blender's name of the object index before 5.0, and from then on."""


def script(name, *arguments, folder=None):
    """Run a script to its end."""
    words = [sys.executable, str(ROOT / "scripts" / f"{name}.py"), *map(str, arguments)]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=120)


def small(bpy, path, **settings):
    """Save a small scene: a sphere 5 below the camera "Top", which moves from x = 0 at frame 1 to x = 1 at frame 2."""
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1)
    bpy.context.object.pass_index = 7
    for name in ("Side", "Top"):
        bpy.ops.object.camera_add(location=(0, 0, 5))
        bpy.context.object.name = name
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    for frame in (1, 2):
        scene.camera.location.x = frame - 1
        scene.camera.keyframe_insert("location", frame=frame)
    bpy.data.objects["Side"].location.y = 0.5
    scene.render.resolution_x, scene.render.resolution_y = 32, 24
    for name, value in settings.items():
        setattr(scene.render, name, value)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture
def scene(blender, tmp_path):
    """A small .blend."""
    return small(blender, tmp_path / "small.blend")


def left(folder):
    """What is in a folder, hidden or not."""
    return sorted(path.name for path in folder.iterdir())


def refused(done):
    """The one line that a refusal is."""
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    (line,) = done.stderr.splitlines()
    return line


def test_cast_writes_a_picture_all_passes_and_a_report(scene, tmp_path):
    done = script("cast", scene, "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert left(tmp_path / "out") == ["report.json", "small.exr", "small.png"]
    assert (tmp_path / "out" / "small.png").read_bytes()[16:24] == bytes([0, 0, 0, 32, 0, 0, 0, 24])
    channels = {
        name.removeprefix("ViewLayer."): image for name, image in read_exr(tmp_path / "out" / "small.exr").items()
    }
    (index,) = (channels[name] for name in INDEX if name in channels)
    assert {name.split(".")[0] for name in channels} >= {"Combined", "Depth", "Normal", "Position"}
    assert index[12, 16] == 7
    assert index[0, 0] == 0
    assert channels["Depth.Z"].dtype == np.float32
    assert channels["Depth.Z"][11:13, 15:17] == pytest.approx(4, abs=2e-2)
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["passed"] is True
    assert report["pixels"] == 32 * 24
    assert {finding["witness"] for finding in report["findings"]} >= {"view_frame", "world_to_camera_view"}
    assert report["camera"]["name"] == "Top"


def test_standard_output_is_the_table_and_nothing_of_blenders(scene, tmp_path):
    done = script("cast", scene, "--output", tmp_path / "out")
    lines = done.stdout.splitlines()
    assert lines[0] == "Camera 'Top', Perspective, frame 1"
    assert lines[-1].startswith("Wrote ")
    assert not re.search("Fra:|Saved|Read blend|Time:|Blender", done.stdout)
    assert max(map(len, lines[:-1])) <= 100


def test_json_is_what_the_file_holds(scene, tmp_path):
    done = script("cast", scene, "--output", tmp_path / "out", "--json")
    assert json.loads(done.stdout) == json.loads((tmp_path / "out" / "report.json").read_text())


def test_cast_takes_camera_frame_passes_and_shading(scene, tmp_path):
    words = ["--camera", "Side", "--passes", "ray_origin,valid", "--shading", "grid", "--output", tmp_path / "side"]
    assert script("cast", scene, *words).returncode == 0
    channels = read_exr(tmp_path / "side" / "small.exr")
    assert (channels["ViewLayer.Ray Origin.Y"] == 0.5).all()
    assert {name.split(".")[1] for name in channels if name.startswith("ViewLayer.")} == {
        "Combined",
        "Ray Origin",
        "Valid",
    }
    done = script("cast", scene, "--frame", "1.5", "--passes", "ray_origin", "--output", tmp_path / "half")
    assert done.returncode == 0
    # Blender eases in and out of two keys evenly: half way at half the time
    x = read_exr(tmp_path / "half" / "small.exr")["ViewLayer.Ray Origin.X"]
    assert x == pytest.approx(np.full_like(x, 0.5), abs=1e-6)


def test_frames_are_numbered(scene, tmp_path):
    done = script("cast", scene, "--frames", "1:2", "--passes", "ray_origin", "--output", tmp_path / "out")
    assert done.returncode == 0
    names = ["report_{}.json", "small_{}.exr", "small_{}.png"]
    assert left(tmp_path / "out") == sorted(name.format(number) for name in names for number in ("0001", "0002"))
    for frame in (1, 2):
        x = read_exr(tmp_path / "out" / f"small_000{frame}.exr")["ViewLayer.Ray Origin.X"]
        assert (x == frame - 1).all()
        assert json.loads((tmp_path / "out" / f"report_000{frame}.json").read_text())["frame"] == frame


def test_frames_may_begin_before_0(scene, tmp_path):
    done = script("cast", scene, "--frames", "-1:0", "--passes", "depth", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    frames = {json.loads((tmp_path / "out" / name).read_text())["frame"] for name in left(tmp_path / "out")
              if name.startswith("report")}  # fmt: skip
    assert frames == {-1, 0}


def test_a_marker_does_not_take_the_chosen_cameras_place(blender, tmp_path):
    path = small(blender, tmp_path / "marked.blend")
    scene = blender.context.scene
    scene.timeline_markers.new("cut", frame=2).camera = blender.data.objects["Top"]
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    words = ["--camera", "Side", "--frame", 2, "--passes", "ray_origin", "--output", tmp_path / "out"]
    assert script("cast", path, *words).returncode == 0
    assert (read_exr(tmp_path / "out" / "marked.exr")["ViewLayer.Ray Origin.Y"] == 0.5).all()


def test_pixel_aspect_and_border_reach_the_files(blender, tmp_path):
    border = {"border_min_x": 0.25, "border_max_x": 0.75, "border_min_y": 0.0, "border_max_y": 0.5}
    path = small(
        blender, tmp_path / "aspect.blend", pixel_aspect_y=1.5, use_border=True, use_crop_to_border=True, **border
    )
    done = script("cast", path, "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert read_exr(tmp_path / "out" / "aspect.exr")["ViewLayer.Depth.Z"].shape == (12, 16)


def test_verify_prints_its_verdict(scene):
    done = script("verify", scene, "--frame", "1.25")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[0] == "Camera 'Top', Perspective, frame 1.25"
    assert done.stdout.splitlines()[-1] == "All witnesses agree"
    report = json.loads(script("verify", scene, "--json").stdout)
    assert all(finding["passed"] for finding in report["findings"])


FAULT = """
import sys
from dataclasses import replace
sys.argv = ["{command}.py", *{arguments}]
sys.path[:0] = [{scripts!r}, {addon!r}]
import bpy
from camera_ray_caster.core.cameras.perspective import Perspective
right = Perspective.rays
Perspective.rays = lambda self, x, y: right(self, x + 0.5, y)
from door import through
sys.exit(through("{command}"))
"""


@pytest.mark.parametrize("command", ["cast", "verify"])
def test_a_ray_half_a_pixel_off_is_status_1(scene, tmp_path, command):
    arguments = [str(scene), *(["--output", str(tmp_path / "out")] if command == "cast" else [])]
    places = {"scripts": str(ROOT / "scripts"), "addon": str(ROOT / "addon")}
    code = FAULT.format(command=command, arguments=arguments, **places)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert done.returncode == 1, done.stderr
    assert "FAILED" in done.stdout
    if command == "cast":
        assert json.loads((tmp_path / "out" / "report.json").read_text())["passed"] is False


@pytest.mark.parametrize("command", ["cast", "verify"])
def test_help_has_an_example(command):
    done = script(command, "--help")
    assert (done.returncode, done.stderr) == (0, "")
    assert f"{command}.py blend_scenes/spheres_and_planes.blend" in done.stdout
    assert "exit status" in done.stdout


WRONG_WORDS = {
    "no file": ([], "give the path of a .blend"),
    "missing": (["missing.blend"], "there is no file 'missing.blend'"),
    "a folder": (["."], "there is no file '.'"),
    "no .blend": (["text.blend"], "'text.blend' is no .blend that this Blender can open"),
    "a name that is too long for a file": (["a" * 300], "there is no file 'aaa"),
    "no such camera": (["small.blend", "--camera", "Front"], "no camera 'Front'; its cameras are: 'Side', 'Top'"),
    "no such option": (["small.blend", "--depth"], "unrecognized arguments: --depth"),
    "no number": (["small.blend", "--frame", "half"], "'half'"),
    "not finite": (["small.blend", "--frame", "nan"], "nan"),
    "beyond Blender's frames": (["small.blend", "--frame", "1e300"], "last frame"),
}
WRONG_FOR_CAST = {
    "no such pass": (["small.blend", "--passes", "depth,z"], "no pass is called 'z': choose from combined, depth"),
    "no such shading": (["small.blend", "--shading", "toon"], "MATERIAL"),
    "no such precision": (["small.blend", "--precision", "double"], "AUTOMATIC"),
    "frames backwards": (["small.blend", "--frames", "2:1"], "2:1 holds no frame"),
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
        words, said = WRONG_FOR_CAST[case][0], "unrecognized arguments"
    else:
        words, said = (WRONG_WORDS | WRONG_FOR_CAST)[case]
    monkeypatch.chdir(scene.parent)
    Path("text.blend").write_text("no .blend")
    before = left(scene.parent)
    with pytest.raises(InputError) as error:
        commands.COMMANDS[command](words, command)
    assert said in str(error.value)
    assert "\n" not in str(error.value)
    assert left(scene.parent) == before


@pytest.mark.parametrize("command", ["cast", "verify"])
@pytest.mark.parametrize("case", ["missing", "no .blend", "no such camera", "no such option"])
def test_a_refusal_is_one_line_and_status_2(scene, command, case):
    (scene.parent / "text.blend").write_text("no .blend")
    words, said = WRONG_WORDS[case]
    line = refused(script(command, *words, folder=scene.parent))
    assert line.startswith(f"{command}.py: ")
    assert said in line


@pytest.mark.parametrize("command", ["cast", "verify"])
def test_a_python_without_bpy_is_told_what_it_needs(command):
    words = [sys.executable, "-S", ROOT / "scripts" / f"{command}.py"]  # -S: no packages
    done = subprocess.run(words, capture_output=True, text=True, timeout=60, env={})
    assert "needs Blender or pip's bpy: `make cast`" in refused(done)


def test_a_scene_that_cannot_be_cast_is_refused_in_one_line(blender, tmp_path):
    path = small(blender, tmp_path / "bad.blend")
    scene, camera = blender.context.scene, blender.data.objects["Top"]
    cases = {
        "has a scale of zero": lambda: setattr(camera, "scale", (1, 0, 1)),
        "has no active camera": lambda: setattr(scene, "camera", None),
        "is of type mesh, not a camera": lambda: setattr(scene, "camera", blender.data.objects["Sphere"]),
        "no view layer of scene 'Scene' is used": lambda: [
            setattr(scene, "camera", camera),
            setattr(camera, "scale", (1, 1, 1)),
            setattr(scene.view_layers[0], "use", False),
        ],
    }
    for said, spoil in cases.items():
        spoil()
        blender.ops.wm.save_as_mainfile(filepath=str(path))
        assert said in refused(script("cast", path, "--output", tmp_path / "out"))
        assert not (tmp_path / "out").exists()


def test_a_failed_run_leaves_good_files_as_they_were(scene, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "small.exr").write_text("good")
    (out / "report.json").write_text("good")
    (out / "small.png").mkdir()
    assert "'small.png' is a folder" in refused(script("cast", scene, "--output", out))
    assert left(out) == ["report.json", "small.exr", "small.png"]
    assert [(out / name).read_text() for name in ("report.json", "small.exr")] == ["good", "good"]
