"""Exports of several frames from the dialog: the process's files are those of one go, and a stop leaves nothing."""

from time import sleep

import pytest

from camera_ray_caster.blender.ui import in_process


@pytest.fixture
def scene(blender, camera_scene):
    """Two cameras, one of which moves and one of which has a size of its own."""
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
    assert blender.ops.camera_ray_caster.export(filepath=str(folder), **what) == {"FINISHED"}


def ended():
    while in_process.tick() is not None:
        sleep(0.05)
    return in_process.latest()


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_the_files_are_those_of_one_go(blender, scene, tmp_path):
    export(blender, tmp_path / "once")
    assert in_process.running() is None
    export(blender, tmp_path / "apart", in_process=True)
    assert not blender.ops.camera_ray_caster.export.poll()
    assert scene.frame_current == 7
    assert ended().partition("\n")[0] == f"Wrote 10 files into {tmp_path / 'apart'}"
    assert contents(tmp_path / "apart") == contents(tmp_path / "once")
    assert blender.ops.camera_ray_caster.export.poll()


def test_a_stop_leaves_nothing_behind(blender, scene, tmp_path):
    scene.frame_end = 100000
    export(blender, tmp_path / "out", in_process=True)
    work = in_process.running()
    while not work.fraction:
        assert in_process.tick() is not None, in_process.latest()
        sleep(0.05)
    blender.ops.camera_ray_caster.stop_all()
    assert ended() == "Stopped"
    assert list(tmp_path.iterdir()) == []


def test_a_refusal_ends_it_in_one_line(blender, scene, tmp_path):
    scene.objects["Dome"].data.type = "ORTHO"
    export(blender, tmp_path / "out", in_process=True)
    assert ended().startswith("Mrcal cannot represent the Orthographic of camera 'Dome': choose one of")
    assert list(tmp_path.iterdir()) == []


def test_names_that_a_terminal_would_not_take_are_exported_all_the_same(blender, scene, tmp_path):
    scene.objects["Dome"].name = "-Dome"
    export(blender, tmp_path / "out", in_process=True)
    assert in_process.running() is None
    assert len(list((tmp_path / "out").iterdir())) == 10
