"""Exports from a timer, without a window: the files are those of one go, and a stop leaves nothing behind."""

import pytest

from camera_ray_caster.blender.ui import export_operators, in_steps


@pytest.fixture
def scene(blender, camera_scene, monkeypatch):
    """Two cameras, one of which moves and one of which has a size of its own; each frame and file is a step."""
    monkeypatch.setattr(export_operators, "WORK", 0.0)
    for frame in (1, 9):
        camera_scene.camera.location.x = frame
        camera_scene.camera.keyframe_insert("location", frame=frame)
    dome = blender.data.objects.new("Dome", blender.data.cameras.new("Dome"))
    dome["resolution"] = (24, 18)
    camera_scene.collection.objects.link(dome)
    camera_scene.frame_start, camera_scene.frame_end = 1, 5
    camera_scene.frame_set(7)
    return camera_scene


def export(blender, folder, **options):
    what = {"format": "mrcal", "cameras": "ALL", "frames": "RANGE"} | options
    return blender.ops.camera_ray_caster.export(filepath=str(folder), **what)


def state(scene):
    render = scene.render
    return scene.camera, scene.frame_current, render.resolution_x, render.resolution_y, render.resolution_percentage


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_the_files_are_those_of_one_go_and_the_scene_is_as_before(blender, scene, tmp_path):
    before, said = state(scene), []
    assert export(blender, tmp_path / "once") == {"FINISHED"}
    assert in_steps.running() is None
    assert export(blender, tmp_path / "steps", in_steps=True) == {"FINISHED"}
    assert not blender.ops.camera_ray_caster.export.poll()
    assert not blender.ops.camera_ray_caster.cast_all.poll()
    while in_steps.tick() is not None:
        said.append(in_steps.running().progress)
    assert said[0] == "Frame 1, 1 of 10"
    assert said[9] == "Frame 5, 10 of 10"
    assert said[10:] == [f"{name}_{i:04}.cameramodel" for i in range(1, 6) for name in (scene.camera.name, "Dome")]
    assert in_steps.latest() == f"Wrote 10 files into {tmp_path / 'steps'}"
    assert contents(tmp_path / "steps") == contents(tmp_path / "once")
    assert state(scene) == before
    assert blender.ops.camera_ray_caster.export.poll()


def test_a_file_that_is_saved_meanwhile_has_the_scene_as_before(blender, scene, tmp_path):
    before, path = state(scene), str(tmp_path / "meanwhile.blend")
    export(blender, tmp_path / "out", in_steps=True)
    for _ in range(7):  # frames of the camera with a size of its own
        in_steps.tick()
    during = state(scene)
    assert during[1:3] != before[1:3]
    blender.ops.wm.save_as_mainfile(filepath=path, copy=True)
    assert state(scene) == during
    in_steps.stop()
    assert state(scene) == before
    said = repr(before)
    blender.ops.wm.open_mainfile(filepath=path)
    assert repr(state(blender.context.scene)) == said


@pytest.mark.parametrize("steps", [0, 2, 7, 12])
def test_a_stop_leaves_nothing_behind_and_the_scene_as_it_was(blender, scene, tmp_path, steps):
    before = state(scene)
    export(blender, tmp_path / "out", in_steps=True)
    for _ in range(steps):
        in_steps.tick()
    blender.ops.camera_ray_caster.stop_all()
    assert in_steps.tick() is None
    assert in_steps.latest() == f"Stopped: nothing was written into {tmp_path / 'out'}"
    assert list(tmp_path.iterdir()) == []
    assert state(scene) == before


def test_a_refusal_and_a_camera_that_is_removed_midway_end_it_in_one_line(blender, scene, tmp_path):
    scene.objects["Dome"].data.type = "ORTHO"
    export(blender, tmp_path, in_steps=True)
    while in_steps.tick() is not None:
        pass
    assert in_steps.latest().startswith("Mrcal cannot represent the Orthographic of camera 'Dome': choose one of")
    before = state(scene)[1:]
    export(blender, tmp_path, in_steps=True, format="json")
    for _ in range(7):
        in_steps.tick()
    blender.data.objects.remove(scene.objects["Dome"])
    assert in_steps.tick() is None
    assert "removed" in in_steps.latest()
    assert state(scene)[1:] == before
    assert list(tmp_path.iterdir()) == []


def test_another_file_ends_it(blender, scene, tmp_path):
    export(blender, tmp_path, in_steps=True)
    in_steps.tick()
    blender.ops.wm.read_factory_settings(use_empty=True)
    assert in_steps.running() is None
    assert list(tmp_path.iterdir()) == []
