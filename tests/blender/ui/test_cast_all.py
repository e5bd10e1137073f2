"""Cast All without a window, where its renders block: the files are the terminal's, and the scene is as before."""

import numpy as np
import pytest

from camera_ray_caster.blender.terminal import files
from camera_ray_caster.blender.ui import chosen_frames, in_steps
from camera_ray_caster.core.casting.passes import PASSES
from camera_ray_caster.core.records import InputError

KEPT = "engine", "use_sequencer", "use_lock_interface", "use_persistent_data", "resolution_x", "resolution_percentage"


@pytest.fixture
def scene(blender, camera_scene):
    """A small scene of two cameras, one of which has pictures of its own size."""
    dome = blender.data.objects.new("Dome", blender.data.cameras.new("Dome"))
    dome.data.camera_ray_caster.model = "OMNIMAX"
    dome["resolution"] = (24, 18)
    camera_scene.collection.objects.link(dome)
    camera_scene.camera.name = "Plain"
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 32, 20
    camera_scene.render.engine = "BLENDER_WORKBENCH"
    camera_scene.frame_start, camera_scene.frame_end = 3, 4
    return camera_scene


def run(blender, folder, **options):
    """Cast all, to the end; return how it ended."""
    assert blender.ops.camera_ray_caster.cast_all(directory=str(folder), **options) == {"FINISHED"}
    while in_steps.tick() is not None:
        pass
    return in_steps.latest()


def state(blender, scene):
    """What is as it was after a run."""
    marked = [marker.camera for marker in scene.timeline_markers]
    form = scene.render.image_settings.file_format
    return [*(getattr(scene.render, name) for name in KEPT), scene.camera, scene.frame_current, marked, form,
            blender.context.view_layer.use_pass_normal]  # fmt: skip


def test_a_file_that_is_saved_meanwhile_has_the_scene_as_before(blender, scene, tmp_path):
    scene.timeline_markers.new("cut", frame=4).camera = scene.objects["Dome"]
    before, path = repr(state(blender, scene)), str(tmp_path / "meanwhile.blend")
    blender.ops.camera_ray_caster.cast_all(directory=str(tmp_path / "all"))
    for _ in range(3):
        in_steps.tick()
    during = state(blender, scene)
    assert (repr(during) != before, scene.camera.name) == (True, "Dome")
    blender.ops.wm.save_as_mainfile(filepath=path, copy=True)
    assert state(blender, scene) == during
    while in_steps.tick() is not None:
        pass
    assert in_steps.latest() == f"Wrote 4 pictures into {tmp_path / 'all'}"
    blender.ops.wm.open_mainfile(filepath=path)
    assert repr(state(blender, blender.context.scene)) == before


def test_all_cameras_and_frames_are_the_terminal_s_and_the_scene_is_as_before(blender, scene, tmp_path):
    scene.timeline_markers.new("cut", frame=4).camera = scene.objects["Dome"]
    before = state(blender, scene)
    assert run(blender, tmp_path / "all", format="NPZ") == f"Wrote 4 pictures into {tmp_path / 'all'}"
    assert state(blender, scene) == before
    for name in ("Plain", "Dome"):
        for frame in (3, 4):
            found = np.load(tmp_path / "all" / f"{name}_{frame:04}.npz")
            assert found["depth"].shape[:2] == ((20, 32) if name == "Plain" else (18, 24))
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.frame_set(3)
    blender.context.view_layer.use_pass_normal = blender.context.view_layer.use_pass_z = True
    assert {"depth", "normal"} <= PASSES.keys()
    files.render(scene, tmp_path / "one", "Plain", layers=files.NPZ)
    one, found = np.load(tmp_path / "one" / "Plain.npz"), np.load(tmp_path / "all" / "Plain_0003.npz")
    for key in ("depth", "normal"):
        np.testing.assert_array_equal(one[key], found[key])


def test_a_bad_camera_ends_it_in_one_line_and_leaves_whole_pictures(blender, scene, tmp_path):
    scene.objects["Dome"]["resolution"] = (0, 5)
    before = state(blender, scene)
    said = run(blender, tmp_path, frames="CURRENT")
    assert said.startswith("Resolution of 'Dome' must be two whole numbers")
    assert state(blender, scene) == before
    assert {path.suffix for path in tmp_path.iterdir()} <= {".png", ".exr", ".json"}


def test_stopped_between_two_pictures_it_leaves_whole_ones(blender, scene, tmp_path, monkeypatch):
    before = state(blender, scene)
    assert blender.ops.camera_ray_caster.cast_all(directory=str(tmp_path)) == {"FINISHED"}
    assert not blender.ops.camera_ray_caster.cast_all.poll()
    while not in_steps.running().made:
        in_steps.tick()
    blender.ops.camera_ray_caster.stop_all()
    assert in_steps.tick() is None
    assert in_steps.latest().startswith("Stopped: 1 of 4 pictures")
    assert state(blender, scene) == before
    assert len(list(tmp_path.iterdir())) == 3
    assert blender.ops.camera_ray_caster.cast_all.poll()


def test_a_folder_of_its_own_and_the_number_of_pictures_before(blender, scene, tmp_path):
    """Never into the folder of the .blend, which the file dialog shows where the own folder is missing."""
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "ride.blend"))
    assert run(blender, f"{tmp_path}/", frames="CURRENT") == f"Wrote 2 pictures into {tmp_path / 'ride_pictures'}"
    assert [path.name for path in tmp_path.iterdir() if path.suffix != ".blend1"] in (
        ["ride.blend", "ride_pictures"], ["ride_pictures", "ride.blend"],
    )  # fmt: skip
    assert chosen_frames.in_words(scene, "CURRENT") == "2 cameras × 1 frame = 2 pictures"
    scene.frame_end = 252
    assert chosen_frames.in_words(scene, "RANGE", 1.44) == "2 cameras × 250 frames = 500 pictures, about 12 minutes"
    with pytest.raises(InputError, match="no camera has poses"):
        chosen_frames.in_words(scene, "POSES")


def test_a_percentage_that_would_not_be_used_is_refused(blender, scene, tmp_path):
    scene.render.resolution_percentage = 50
    with pytest.raises(RuntimeError, match="Resolution % does not change pictures of cameras that have their own size"):
        run(blender, tmp_path / "all")
    assert not (tmp_path / "all").exists()
