"""Relative paths of cameras' files, where Blender remaps its own paths: the witness is a text's path."""

from pathlib import Path

import bpy
import pytest

LENS = "//lens.yml"


def path_of(camera):
    settings = camera.camera_ray_caster
    assert settings.lens_file == settings.calibration_file
    return settings.calibration_file


def resolved(path):
    return Path(bpy.path.abspath(path)).resolve()


@pytest.fixture
def camera(camera_scene, tmp_path):
    """The data of a camera that names a file beside the .blend, one/a.blend; so does a text."""
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "one" / "a.blend"))
    camera = camera_scene.camera.data
    camera.camera_ray_caster.calibration_file = camera.camera_ray_caster.lens_file = LENS
    bpy.data.texts.new("Lens").filepath = LENS
    bpy.ops.wm.save_mainfile()
    return camera


def test_save_as_and_append(camera, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two" / "copy.blend"), copy=True)
    assert path_of(camera) == LENS, "the open file is where it was"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two" / "b.blend"))
    assert path_of(camera) == bpy.data.texts["Lens"].filepath == "//../one/lens.yml"
    for name in ("b", "copy"):
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "two" / f"{name}.blend"))
        assert resolved(path_of(bpy.data.cameras[0])) == (tmp_path / "one" / "lens.yml").resolve()
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    for saved in (False, True):
        if saved:
            bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two" / "c.blend"))
        with bpy.data.libraries.load(str(tmp_path / "one" / "a.blend")) as (there, here):
            here.cameras = there.cameras
        assert resolved(path_of(here.cameras[0])) == (tmp_path / "one" / "lens.yml").resolve()
        assert path_of(here.cameras[0]).startswith("//") == saved


def test_a_linked_camera_keeps_its_path(camera, tmp_path):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two" / "c.blend"))
    with bpy.data.libraries.load(str(tmp_path / "one" / "a.blend"), link=True) as (there, here):
        here.cameras = there.cameras
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "c.blend"))
    assert path_of(here.cameras[0]) == LENS
