"""What cast.py writes and prints."""

import json
import re
import sys

import numpy as np
import pytest

from ..exr import read_exr
from .running import left, script, small

INDEX = "IndexOB.X", "Object Index.X"
"""Blender's name of the object index before 5.0, and from then on."""


@pytest.fixture(scope="module")
def ran(registered, tmp_path_factory):
    """How the script ended on a small scene, and the folder that it was told to write into."""
    folder = tmp_path_factory.mktemp("cast")
    scene = small(registered, folder / "small.blend")
    return script("cast", scene, "--output", folder / "out"), folder / "out"


def test_cast_writes_a_picture_all_passes_and_a_report(ran):
    done, out = ran
    assert (done.returncode, done.stderr) == (0, "")
    assert left(out) == ["report.json", "small.exr", "small.png"]
    assert (out / "small.png").read_bytes()[16:24] == bytes([0, 0, 0, 32, 0, 0, 0, 24])
    channels = {name.removeprefix("ViewLayer."): image for name, image in read_exr(out / "small.exr").items()}
    (index,) = (channels[name] for name in INDEX if name in channels)
    assert {name.split(".")[0] for name in channels} >= {"Combined", "Depth", "Normal", "Position"}
    assert index[12, 16] == 7
    assert index[0, 0] == 0
    assert channels["Depth.Z"].dtype == np.float32
    assert channels["Depth.Z"][11:13, 15:17] == pytest.approx(4, abs=2e-2)
    report = json.loads((out / "report.json").read_text())
    assert report["passed"] is True
    assert report["pixels"] == 32 * 24
    assert {finding["witness"] for finding in report["findings"]} >= {"view_frame", "world_to_camera_view"}
    assert report["camera"]["name"] == "Top"
    assert report["host"]["meters"] == 1
    assert report["indices"]["ViewLayer"] == {
        "object_index": {"7": ["Sphere"]},
        "material_index": {},
        "shape_index": [{"first": 0, "count": 1, "object": "Sphere", "kind": "SPHERE"}],
    }


def test_standard_output_is_the_table_and_nothing_of_blenders(ran):
    done, _ = ran
    lines = done.stdout.splitlines()
    assert lines[0] == "Camera 'Top', Perspective, frame 1"
    assert lines[-1].startswith("Wrote ")
    assert not re.search("Fra:|Saved|Read blend|Time:|Blender", done.stdout)
    assert max(map(len, lines[:-1])) <= 100


def test_json_is_what_the_file_holds(command, scene, tmp_path):
    done = command("cast", scene, "--output", tmp_path / "out", "--json")
    assert json.loads(done.stdout) == json.loads((tmp_path / "out" / "report.json").read_text())


def test_cast_takes_camera_frame_passes_and_shading(command, scene, tmp_path):
    words = ["--camera", "Side", "--passes", "ray_origin,valid", "--shading", "grid", "--output", tmp_path / "side"]
    assert command("cast", scene, *words).returncode == 0
    channels = read_exr(tmp_path / "side" / "small.exr")
    assert (channels["ViewLayer.Ray Origin.Y"] == 0.5).all()
    assert {name.split(".")[1] for name in channels if name.startswith("ViewLayer.")} == {
        "Combined",
        "Ray Origin",
        "Valid",
    }
    done = command("cast", scene, "--frame", "1.5", "--passes", "ray_origin", "--output", tmp_path / "half")
    assert done.returncode == 0
    # Blender eases in and out of two keys evenly: half way at half the time
    x = read_exr(tmp_path / "half" / "small.exr")["ViewLayer.Ray Origin.X"]
    assert x == pytest.approx(np.full_like(x, 0.5), abs=1e-6)


def test_freestyle_runs_only_where_the_combined_pass_is_cast(command, blender, tmp_path):
    path = small(blender, tmp_path / "lines.blend")
    render, layer = blender.context.scene.render, blender.context.view_layer
    render.use_freestyle = layer.use_freestyle = True
    blender.ops.wm.save_mainfile()
    for passes, is_drawn in (("depth", False), ("depth,combined", True)):
        done = command("cast", path, "--passes", passes, "--output", tmp_path / passes)
        assert ("Freestyle draws" in done.stderr) == is_drawn


def test_frames_are_numbered(command, scene, tmp_path):
    done = command("cast", scene, "--frames", "1:2", "--passes", "ray_origin", "--output", tmp_path / "out")
    assert done.returncode == 0
    names = ["report_{}.json", "small_{}.exr", "small_{}.png"]
    assert left(tmp_path / "out") == sorted(name.format(number) for name in names for number in ("0001", "0002"))
    for frame in (1, 2):
        x = read_exr(tmp_path / "out" / f"small_000{frame}.exr")["ViewLayer.Ray Origin.X"]
        assert (x == frame - 1).all()
        assert json.loads((tmp_path / "out" / f"report_000{frame}.json").read_text())["frame"] == frame


def test_frames_may_begin_before_0(command, scene, tmp_path):
    done = command("cast", scene, "--frames", "-1:0", "--passes", "depth", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    frames = {json.loads((tmp_path / "out" / name).read_text())["frame"] for name in left(tmp_path / "out")
              if name.startswith("report")}  # fmt: skip
    assert frames == {-1, 0}


def test_a_marker_does_not_take_the_chosen_cameras_place(command, blender, tmp_path):
    path = small(blender, tmp_path / "marked.blend")
    scene = blender.context.scene
    scene.timeline_markers.new("cut", frame=2).camera = blender.data.objects["Top"]
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    words = ["--camera", "Side", "--frame", 2, "--passes", "ray_origin", "--output", tmp_path / "out"]
    assert command("cast", path, *words).returncode == 0
    assert (read_exr(tmp_path / "out" / "marked.exr")["ViewLayer.Ray Origin.Y"] == 0.5).all()


def test_pixel_aspect_and_border_reach_the_files(command, blender, tmp_path):
    border = {"border_min_x": 0.25, "border_max_x": 0.75, "border_min_y": 0.0, "border_max_y": 0.5}
    path = small(
        blender, tmp_path / "aspect.blend", pixel_aspect_y=1.5, use_border=True, use_crop_to_border=True, **border
    )
    done = command("cast", path, "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert read_exr(tmp_path / "out" / "aspect.exr")["ViewLayer.Depth.Z"].shape == (12, 16)


def test_each_eye_has_its_files(command, blender, tmp_path):
    path = small(blender, tmp_path / "stereo.blend", use_multiview=True)
    camera = blender.data.objects["Top"]
    camera.data.stereo.interocular_distance, camera.data.stereo.pivot = 0.5, "CENTER"
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    done = command("cast", path, "--passes", "ray_origin", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    names = [f"stereo_{eye}.{kind}" for eye in "LR" for kind in ("exr", "png")]
    assert left(tmp_path / "out") == ["report.json", *names]
    for eye, eye_x in ("L", -0.25), ("R", 0.25):
        (x,) = (image for name, image in read_exr(tmp_path / "out" / f"stereo_{eye}.exr").items()
                if "Ray Origin" in name and name.endswith("X"))  # fmt: skip
        assert (x == eye_x).all()


def test_the_report_of_a_cast_has_the_bounds_of_the_hits(command, blender, tmp_path):
    scene = small(blender, tmp_path / "small.blend")
    done = command("cast", scene, "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    accuracy = report["accuracy"]
    assert accuracy["sampled_pixels"] == 32 * 24
    depth = read_exr(tmp_path / "out" / "small.exr")["ViewLayer.Depth.Z"]
    assert accuracy["hits"] == np.count_nonzero(depth < 1e9)
    distance = accuracy["distance"]
    assert distance["unit"] == "world units"
    assert 0 < distance["median_bound"] <= distance["worst_bound"] < 1e-11
    assert report["seconds"]["accuracy"] > 0
    assert "in float64" in done.stdout
    assert f"{distance['worst_bound']:.1e}  world units" in done.stdout


@pytest.mark.full
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere names of files are text")
def test_a_file_whose_name_is_no_text_is_cast(scene, tmp_path):
    path = scene.rename(scene.with_name("\udcff.blend"))
    for made in ("Wrote", "Wrote 0 of 1 pictures"):
        done = script("cast", path, "--skip-existing", "--annotations", "--output", tmp_path / "out")
        assert (done.returncode, done.stderr) == (0, "")
        assert done.stdout.splitlines()[-1].startswith(made)
    assert left(tmp_path / "out") == ["report.json", *(f"\udcff{end}" for end in (".exr", ".png", "_coco.json"))]
    assert json.loads((tmp_path / "out" / "report.json").read_text())["made"]["of"]["file"] == path.name
