"""What a redraw of the panels reads."""

import os

from camera_ray_caster.blender.read import evaluated
from camera_ray_caster.blender.ui.camera_panels import SidebarCamera
from camera_ray_caster.blender.ui.facts_panels import CameraData, SidebarFacts

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
    for focal in (17, 18):  # the same file with other numbers
        path.write_text(f"1 PINHOLE 24 16 {focal} {focal} 12 8\n")
        os.utime(path, ns=(focal, focal))
        count, text = redraw()
        assert count == 1
        assert f" {focal} 0 " in text
    assert redraw()[0] == 0
    path.unlink()
    assert redraw()[1] == ""
