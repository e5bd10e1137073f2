"""What export.py writes, prints and refuses."""

import subprocess
import sys

import pytest

from .running import ROOT, left, refused, script

WITHOUT_BLENDER = """
import sys
import camera_ray_caster as crc
camera = crc.camera_from_json(sys.argv[1], frame=2, camera="Top")
sys.stdout.buffer.write(camera.rays().directions.tobytes())
assert "bpy" not in sys.modules
"""


def test_export_writes_cameras_that_are_read_without_blender(blender, scene, tmp_path):
    from camera_ray_caster.blender.read.scene_reader import read_camera

    out = tmp_path / "out"
    done = script("export", scene, "--format", "json", "--cameras", "ALL", "--frames", "1:2", "--output", out)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"Wrote {out / 'camera.json'}\n"
    there = read_camera(blender.context.scene, blender.data.objects["Top"], frame=2)
    words = [sys.executable, "-c", WITHOUT_BLENDER, str(out / "camera.json")]
    read = subprocess.run(words, capture_output=True, timeout=300, cwd=ROOT / "addon")
    assert read.stdout == there.rays().directions.tobytes(), read.stderr


def test_the_active_camera_at_the_files_frame_is_the_default(command, scene, tmp_path):
    done = command("export", scene, "--format", "COLMAP", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert left(tmp_path / "out") == ["cameras.txt", "images.txt", "points3D.txt"]
    assert "Top_0001.png" in (tmp_path / "out" / "images.txt").read_text()
    assert done.stdout.startswith("Wrote ")


@pytest.mark.full
def test_a_lens_that_the_format_does_not_have_is_fitted_and_its_error_stated(command, tmp_path):
    out = tmp_path / "out"
    words = ["export", ROOT / "blend_scenes" / "division.blend", "--format", "opencv"]
    assert "cannot represent the Division" in refused(command(*words, "--output", out))
    done = command(*words, "--fit", "40", "--output", out)
    assert (done.returncode, done.stderr) == (0, "")
    (remark,) = [line for line in done.stdout.splitlines() if "fitted to its Division, within 40 degrees" in line]
    (file,) = out.iterdir()
    assert file.read_text().startswith(f"%YAML:1.0\n---\n# {remark}\n")


WRONG = {
    "an angle that is none": (["--format", "opencv", "--fit", "200"], "200 is not an angle above 0, up to 180 degrees"),
    "no format": ([], "--format"),
    "no such format": (["--format", "fbx"], "'fbx'"),
    "no such camera": (["--format", "json", "--cameras", "Top", "Front"], "no camera 'Front'"),
    "no such camera beside all": (["--format", "json", "--cameras", "ALL", "Front"], "no camera 'Front'"),
    "camera and cameras": (["--format", "json", "--camera", "Top", "--cameras", "Side"], "exclude each other"),
    "a calibration of several": (
        ["--format", "json", "--cameras", "Side", "--calibration", "small.blend"],
        "applies to one camera",
    ),
    "a target for no map": (["--format", "json", "--to", "Side"], "only maps have a target"),
    "a file for a folder": (["--format", "json", "--output", "small.blend"], "cannot write into 'small.blend'"),
}


@pytest.mark.parametrize("case", WRONG)
def test_bad_input_is_refused_and_leaves_nothing(command, scene, monkeypatch, case):
    words, message = WRONG[case]
    monkeypatch.chdir(scene.parent)
    before = left(scene.parent)
    assert message in refused(command("export", "small.blend", *words))
    assert left(scene.parent) == before


def test_a_set_of_mixed_lenses_is_exported_camera_by_camera(command, tmp_path):
    from ..core.sets.test_sets import view

    made = tmp_path / "set"
    made.mkdir()
    for frame in range(1, 6):
        view(made, frame)
        view(made, frame, "OPENCV_FISHEYE", fx=40.0, fy=40.0)
    words = ["export", made, "--output", tmp_path / "out", "--format"]
    for key in ("nerfstudio-scene", "nerfstudio", "bop-scenes", "bop"):
        assert "--cameras" in refused(command(*words, key))
    assert not (tmp_path / "out").exists()
    done = command(*words, "nerfstudio-scene", "--cameras", "OPENCV_FISHEYE", "--frames", "2:4")
    assert (done.returncode, done.stderr) == (0, "")
    names = sorted(path.name for path in (tmp_path / "out" / "images").iterdir())
    assert names == [f"OPENCV_FISHEYE_000{frame}.png" for frame in (2, 3, 4)]
    assert "the set has no camera 'cam2', only" in refused(command(*words, "json", "--cameras", "cam2"))
    assert "does not apply to --format depth16" in refused(command(*words, "depth16", "--validation", "0.2"))
    assert "'1.5' is not a part between 0 and 1" in refused(command(*words, "yolo", "--validation", "1.5"))
    for key in ("depth16", "normals"):
        summary = command("export", made, "--format", key, "--output", tmp_path / key).stdout
        assert summary == f"Wrote {10 + (key == 'depth16')} files into {tmp_path / key}\n"
