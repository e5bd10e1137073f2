"""What to_cycles.py saves: a file that renders our rays in a Blender that has never heard of this add-on."""

import subprocess
import sys

import numpy as np
import pytest

from .running import ROOT, left, refused, script, small

WITHOUT_ADD_ON = """
import sys
import numpy as np
import bpy
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
assert not hasattr(bpy.context.scene, "camera_ray_caster")
sys.path.insert(0, sys.argv[2])
from tests.blender.cycles.cycles import cycles_directions
np.save(sys.argv[3], cycles_directions(bpy.context.scene))
"""


def test_the_copy_renders_our_rays_without_the_add_on(blender, tmp_path):
    from camera_ray_caster.blender.read.scene_reader import read_camera

    path = small(blender, tmp_path / "small.blend")
    blender.data.objects["Side"].data.camera_ray_caster.model = "OMNIMAX"
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    before, copy = path.read_bytes(), tmp_path / "copy.blend"
    done = script("to_cycles", path, "--camera", "Side", "--output", copy)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"Wrote {copy}\n"
    assert path.read_bytes() == before
    rays, expected = tmp_path / "rays.npy", read_camera(blender.context.scene, blender.data.objects["Side"]).rays()
    words = [sys.executable, "-c", WITHOUT_ADD_ON, str(copy), str(ROOT), str(rays)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=300)
    assert rays.exists(), done.stderr
    seen = np.load(rays)
    assert np.array_equal(~np.isnan(seen[..., 0]), expected.valid)
    assert np.nanmax(np.linalg.norm(seen - expected.directions, axis=-1)) <= 2e-6  # float32; see test_to_cycles


def test_what_was_changed_in_the_scene_is_printed(command, blender, tmp_path):
    path = small(blender, tmp_path / "small.blend")
    blender.context.scene.camera.data.camera_ray_caster.time_mode = "ROLLING_SHUTTER"
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    done = command("to_cycles", path, "--output", tmp_path / "copy.blend")
    assert (done.returncode, done.stderr) == (0, "")
    assert "Motion Blur was enabled" in done.stdout
    blender.ops.wm.open_mainfile(filepath=str(tmp_path / "copy.blend"))
    scene = blender.context.scene
    assert (scene.render.engine, scene.camera.data.type) == ("CYCLES", "CUSTOM")
    assert scene.render.use_motion_blur
    assert scene.cycles.rolling_shutter_type == "TOP"


WRONG = {
    "no output": ([], "--output"),
    "no .blend": (["--output", "copy.png"], "give a name that ends in .blend"),
    "the file itself": (["--output", "small.blend"], "give the copy another name"),
    "no folder": (["--output", "nowhere/copy.blend"], "cannot write 'nowhere/copy.blend': "),
    "no camera": (["--output", "copy.blend", "--camera", "Front"], "no camera 'Front'"),
}


@pytest.mark.parametrize("case", WRONG)
def test_bad_input_is_refused_and_leaves_nothing(command, scene, monkeypatch, case):
    words, message = WRONG[case]
    monkeypatch.chdir(scene.parent)
    before = left(scene.parent)
    assert message in refused(command("to_cycles", "small.blend", *words))
    assert left(scene.parent) == before
