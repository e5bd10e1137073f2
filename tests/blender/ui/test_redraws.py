"""What a redraw of the panels reads."""

import os
from functools import partial

from camera_ray_caster.blender.read import evaluated
from camera_ray_caster.blender.ui.camera_panels import SidebarCamera
from camera_ray_caster.blender.ui.facts_panels import CameraData, SidebarFacts
from camera_ray_caster.core.camera.stereo import eye_record

from .test_panels import drawn


def test_redraws_build_a_camera_once_until_it_or_its_file_changes(blender, scene, monkeypatch, tmp_path):
    built, data, path = [], scene.camera.data, tmp_path / "cameras.txt"
    build = evaluated.camera_from
    monkeypatch.setattr(evaluated, "camera_from", lambda raw: built.append(raw) or build(raw))

    def redraw():
        built.clear()
        blender.context.view_layer.update()
        text = [drawn(blender, panel) for panel in (SidebarCamera, SidebarFacts, CameraData)][1]
        return len(built), text

    assert redraw()[0] == 1
    data.lens = 35.0
    assert redraw()[0] == 1
    assert redraw()[0] == 0
    data.camera_ray_caster.model, data.camera_ray_caster.calibration_file = "OPENCV_PINHOLE", str(path)
    for focal in (17, 18):  # the same file with other numbers, copied with the time and size of the former
        copy = tmp_path / "copy.txt"
        copy.write_text(f"1 PINHOLE 24 16 {focal} {focal} 12 8\n")
        os.utime(copy, ns=(1, 1))
        copy.replace(path)
        count, text = redraw()
        assert count == 1
        assert f" {focal} 0 " in text
    assert redraw()[0] == 0
    path.unlink()
    assert redraw()[1] == ""


def test_the_cameras_that_a_window_shows_at_once_are_kept(blender, scene, monkeypatch):
    """The active one, its two eyes, and that of a Properties editor that is pinned to another."""
    built, build = [], evaluated.camera_from
    monkeypatch.setattr(evaluated, "camera_from", lambda raw: built.append(raw) or build(raw))
    pinned = blender.data.objects.new("Pinned", blender.data.cameras.new("Pinned"))
    scene.collection.objects.link(pinned)
    scene.render.use_multiview, scene.camera.data.stereo.pivot = True, "CENTER"
    blender.context.view_layer.update()
    evaluated.forget_cameras()
    depsgraph = blender.context.evaluated_depsgraph_get()
    eyes = [partial(eye_record, view=view) for view in ("left", "right")]
    for count in (4, 0):
        built.clear()
        for camera, eye in ((scene.camera, None), *((scene.camera, eye) for eye in eyes), (pinned, None)):
            assert evaluated.camera_or_reason(camera, depsgraph, eye)[2] == ""
        assert len(built) == count


def test_cameras_with_an_image_of_times_are_not_kept(blender, scene, monkeypatch):
    group = scene.camera.data.camera_ray_caster
    group.time_mode, group.time_image = "IMAGE", blender.data.images.new("Times", 8, 8, float_buffer=True, is_data=True)
    monkeypatch.setattr(evaluated, "_kept_camera", None)

    def first_time():
        blender.context.view_layer.update()
        depsgraph = blender.context.evaluated_depsgraph_get()
        return evaluated.camera_or_reason(scene.camera, depsgraph)[1].pixel_time.first

    group.time_image.pixels = [0.0] * 256
    assert first_time() == 1
    group.time_image.pixels = [1.0] * 256
    assert first_time() == 25
