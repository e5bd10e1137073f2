"""Cast All without a window: a process makes the terminal's files, and the open scene is left alone."""

from time import sleep

import numpy as np
import pytest

from camera_ray_caster.blender.terminal import frame_files
from camera_ray_caster.blender.ui import chosen_frames, in_process
from camera_ray_caster.core.records import InputError


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
    return ended()


def ended():
    """Wait for the process; return how it ended."""
    while in_process.tick() is not None:
        sleep(0.05)
    return in_process.latest()


def test_all_cameras_and_frames_are_the_terminal_s_and_the_window_s_work_goes_on(blender, scene, tmp_path):
    """Unsaved changes are in the pictures, and what is done to the scene meanwhile is not."""
    blender.context.view_layer.use_pass_normal = blender.context.view_layer.use_pass_z = True
    assert blender.ops.camera_ray_caster.cast_all(directory=str(tmp_path / "all"), format="NPZ") == {"FINISHED"}
    assert not blender.ops.camera_ray_caster.cast_all.poll()
    assert not blender.ops.camera_ray_caster.export.poll()
    assert (scene.render.engine, scene.camera.name, blender.data.filepath) == ("BLENDER_WORKBENCH", "Plain", "")
    work = in_process.running()
    assert (work.fraction, work.progress) == (0.0, "Starting")
    scene.objects["Plain"].location.x += 100
    work.process.wait()
    assert any("1 of 4" in line for line in in_process._lines(work.errors)), work.errors.read_text()
    assert work.fraction == 1
    assert in_process.tick() is None
    assert in_process.latest().startswith(f"Wrote 4 pictures into {tmp_path / 'all'}")
    assert blender.ops.camera_ray_caster.cast_all.poll()
    assert not work.printed.exists()
    scene.objects["Plain"].location.x -= 100
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.frame_set(3)
    frame_files.render(scene, tmp_path / "one", "Plain", layers=frame_files.NPZ)
    alone, among = np.load(tmp_path / "one" / "Plain.npz"), np.load(tmp_path / "all" / "Plain_0003.npz")
    for key in ("depth", "normal"):
        np.testing.assert_array_equal(alone[key], among[key])
    assert np.load(tmp_path / "all" / "Dome_0004.npz")["depth"].shape[:2] == (18, 24)


def test_a_bad_camera_ends_it_in_one_line_and_leaves_whole_pictures(blender, scene, tmp_path):
    scene.objects["Dome"]["resolution"] = (0, 5)
    end = run(blender, tmp_path, frames="CURRENT")
    assert end.startswith("Resolution of 'Dome' must be two whole numbers")
    assert "\n" not in end
    assert {path.suffix for path in tmp_path.iterdir()} <= {".png", ".exr", ".json"}


def test_stopped_between_two_pictures_it_leaves_whole_ones(blender, scene, tmp_path):
    scene.frame_end = 500
    assert blender.ops.camera_ray_caster.cast_all(directory=str(tmp_path)) == {"FINISHED"}
    work = in_process.running()
    while not work.fraction:
        assert in_process.tick() is not None, in_process.latest()
        sleep(0.05)
    blender.ops.wm.read_factory_settings(use_empty=True)  # another file does not end it
    assert in_process.running() is work
    work.stop()
    assert ended().startswith("Stopped: ")
    assert in_process.latest().endswith(f" of 996 pictures are in {tmp_path}")
    reports = list(tmp_path.glob("*.json"))
    assert 0 < len(reports) < 996
    assert len(list(tmp_path.iterdir())) == 3 * len(reports)


def test_a_folder_of_its_own_and_the_number_of_pictures_before(blender, scene, tmp_path):
    """Never into the folder of the .blend, which the file dialog shows where the own folder is missing."""
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "ride.blend"))
    end = run(blender, f"{tmp_path}/", frames="CURRENT")
    assert end.startswith(f"Wrote 2 pictures into {tmp_path / 'ride_pictures'}")
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


def test_of_a_single_picture_the_report_is_not_the_result(blender, scene, tmp_path):
    blender.data.objects.remove(scene.objects["Dome"])
    end = run(blender, tmp_path / "one", frames="CURRENT")
    assert end.startswith("Wrote ")
    assert end.count("\n") < 4  # the report has some 70 lines
    blender.ops.wm.read_factory_settings(use_empty=True)
    assert in_process.latest() == "", "another file has no result"


def test_what_cannot_begin_or_end_leaves_the_buttons_as_they_were(blender, scene, tmp_path, monkeypatch):
    """No temporary folder; and a folder of pictures that is gone as the run is stopped."""

    def fail(error):
        def raising(*arguments, **options):
            raise error

        return raising

    with monkeypatch.context() as patch:
        patch.setattr(in_process, "TemporaryDirectory", fail(FileNotFoundError("no temporary folder")))
        with pytest.raises(RuntimeError, match="The command cannot be started: no temporary folder"):
            blender.ops.camera_ray_caster.cast_all(directory=str(tmp_path / "a"))
    assert blender.ops.camera_ray_caster.cast_all.poll()
    monkeypatch.setattr(in_process, "clear_up", fail(InputError("cannot write into 'b'")))
    assert blender.ops.camera_ray_caster.cast_all(directory=str(tmp_path)) == {"FINISHED"}
    in_process.running().stop()
    assert ended() == "Cannot write into 'b'"
    assert blender.ops.camera_ray_caster.cast_all.poll()
