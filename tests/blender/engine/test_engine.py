"""The engine in Blender's pipeline: borders, frames, progress, refusals, warnings and the report."""

from types import SimpleNamespace

import numpy as np
import pytest

from ..pictures import HEIGHT, WIDTH, picture
from ..read.scene_parts import curves

BORDERS = [(0.1, 0.7, 0.2, 0.9), (0.0, 0.5, 0.5, 1.0), (0.31, 0.77, 0.13, 0.59)]


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize("crop", [True, False])
def test_a_border_shows_the_full_pictures_pixels(scene, render, border, crop, monkeypatch):
    from camera_ray_caster.blender.engine import engine

    whole = picture(render(), "ray_direction")
    monkeypatch.setattr(engine, "BAND_PIXELS", 2 * WIDTH)  # handed over in several bands, the last one smaller
    settings = scene.render
    settings.use_border, settings.use_crop_to_border = True, crop
    settings.border_min_x, settings.border_max_x, settings.border_min_y, settings.border_max_y = border
    shown = picture(render(), "ray_direction")
    # Blender's own rounding: the border times the size, in float32, cut
    x0, x1 = (int(np.float32(side) * np.float32(WIDTH)) for side in border[:2])
    y0, y1 = (int(np.float32(side) * np.float32(HEIGHT)) for side in border[2:])
    if not crop:
        outside = shown.copy()
        outside[y0:y1, x0:x1] = 0
        assert not outside.any()
        shown = shown[y0:y1, x0:x1]
    np.testing.assert_array_equal(shown, whole[y0:y1, x0:x1])


def test_an_animation_moves_the_camera(blender, scene, render):
    scene.frame_start, scene.frame_end = 1, 3
    for frame in (1, 2, 3):
        scene.camera.location.x = 10 * frame
        scene.camera.keyframe_insert("location", frame=frame)
    frames = render(animation=True)
    assert sorted(frames) == [1, 2, 3]
    for frame, channels in frames.items():
        assert (picture(channels, "ray_origin")[..., 0] == 10 * frame).all()


def test_a_subframe_lies_between(scene, render):
    from camera_ray_caster.blender.output import reports

    for frame in (1, 2):
        scene.camera.location.x = 10 * frame
        scene.camera.keyframe_insert("location", frame=frame)
    for curve in curves(scene.camera):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_set(1, subframe=0.25)
    np.testing.assert_allclose(picture(render(), "ray_origin")[..., 0], 12.5, rtol=1e-6)
    assert reports.latest().frame == 1.25


@pytest.mark.parametrize(("stopped", "ends"), [(True, False), (False, True), (False, False)])
def test_each_tile_shows_progress_and_asks_whether_to_stop(stopped, ends, monkeypatch):
    from camera_ray_caster.blender.engine import engine
    from camera_ray_caster.blender.process import signals

    shown = []
    stand_in = SimpleNamespace(doing=("", ""), update_progress=shown.append, update_stats=lambda *words: None)
    monkeypatch.setattr(signals, "_stopping", ends)
    with signals.heard(lambda: stopped):
        assert engine.CameraRayCaster.advance(stand_in, 0.25) is not (stopped or ends)
    assert shown == [0.25]


def test_the_whole_way_is_shown(scene, slow, monkeypatch):
    import bpy

    from camera_ray_caster.blender.engine.engine import CameraRayCaster

    scene.render.resolution_x = scene.render.resolution_y = 1000
    shown = []
    monkeypatch.setattr(CameraRayCaster, "advance", lambda self, fraction: not shown.append(fraction))
    bpy.ops.render.render()
    assert len(shown) > 3
    assert shown == sorted(shown)
    assert shown[-1] == 1


def test_a_stop_ends_the_render_after_a_tile_and_leaves_no_report(scene, slow, monkeypatch):
    import bpy

    from camera_ray_caster.blender.engine.engine import CameraRayCaster, RenderCall
    from camera_ray_caster.blender.output import reports

    scene.render.resolution_x = scene.render.resolution_y = 1000
    asked = []
    monkeypatch.setattr(CameraRayCaster, "advance", lambda self, fraction: bool(asked.append(fraction)))
    with RenderCall().handed() as call:
        bpy.ops.render.render()
    assert len(asked) == 1
    assert asked[0] < 0.5
    assert call.stopped
    assert reports.latest() is None


def test_bad_input_is_one_line_and_no_traceback(scene, capfd):
    import bpy

    scene.camera.scale.x = 0
    with pytest.raises(RuntimeError) as error:
        bpy.ops.render.render()
    assert str(error.value).splitlines() == [
        "Error: camera 'Camera' has a scale of zero: apply or clear its scale (Alt S)"
    ]
    assert "Traceback" not in "".join(capfd.readouterr())


def test_what_is_left_out_is_warned_of_in_one_line(blender, scene, capfd):
    for _ in range(12):
        blender.ops.mesh.primitive_monkey_add()
        blender.context.object.camera_ray_caster.primitive = "IGNORE"
    capfd.readouterr()
    blender.ops.render.render()
    output = "".join(capfd.readouterr())
    assert output.count("left out") == 1
    assert "12 objects left out: Suzanne, Suzanne.001" in output


@pytest.mark.parametrize("model", ["BLENDER", "FISHEYE_STEREOGRAPHIC"])
def test_lines_that_blender_draws_in_perspective_over_another_model_are_warned_of(blender, scene, capfd, model):
    scene.camera.data.camera_ray_caster.model = model
    scene.render.use_freestyle = True
    blender.ops.object.grease_pencil_add(type="MONKEY")
    blender.ops.render.render()
    warning = "Blender draws Freestyle and Grease Pencil over the picture in perspective, not through Fisheye"
    assert (warning in capfd.readouterr().out) == (model != "BLENDER")
    from camera_ray_caster.blender.output import reports

    assert [line for line in reports.latest().warnings if "Grease Pencil" in line] == [
        f"{warning} Stereographic: disable it"
    ] * (model != "BLENDER")


def test_the_report_is_kept_until_another_file_is_opened(blender, scene):
    from camera_ray_caster.blender.output import reports

    assert not blender.ops.camera_ray_caster.write_report.poll()
    scene.view_layers.new("Other")
    blender.ops.render.render()
    report = reports.latest()
    assert report.layers == ("ViewLayer", "Other")
    assert (report.pixels, report.passed) == (2 * WIDTH * HEIGHT, True)
    assert {finding.witness for finding in report.findings} >= {"view_frame", "calc_matrix_camera"}
    assert {"read", "rays", "cast", "passes", "write"} <= set(report.seconds)
    blender.ops.camera_ray_caster.write_report()
    assert "view_frame" in blender.data.texts["Camera Ray Caster Report"].as_string()
    blender.ops.wm.read_factory_settings(use_empty=True)
    assert reports.latest() is None


@pytest.mark.parametrize("persistent", [False, True])
def test_the_report_is_of_all_layers_of_one_frame(blender, scene, persistent):
    """With Persistent Data, too, where Blender keeps the engine from one frame to the next."""
    from camera_ray_caster.blender.output import reports

    scene.render.use_persistent_data = persistent
    scene.view_layers.new("Second")
    for frame in (1, 2):
        scene.frame_set(frame)
        blender.ops.render.render()
        report = reports.latest()
        assert report.frame == frame
        assert report.pixels == 2 * WIDTH * HEIGHT
