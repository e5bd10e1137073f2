"""The notes of the sidebar: all are in the popover, and the panel has as many rows with any of them as without."""

from unittest.mock import MagicMock

import pytest

from camera_ray_caster.blender.read import evaluated
from camera_ray_caster.blender.ui.camera_notes import notes
from camera_ray_caster.blender.ui.camera_panels import CameraNotes, SidebarCamera

from .test_panels import drawn

DRAWN = {"label", "menu", "operator", "popover", "prop", "row"}


def stretched(scene, data):
    data.type, data.panorama_type = "PANO", "EQUIRECTANGULAR"
    return "Set Frame to 24 × 12"


def missing(scene, data):
    data.camera_ray_caster.model = "CROSS_SLIT"
    return "Add Slit camera_ray_caster.add_line slit_1"


def unknown(scene, data):
    data.camera_ray_caster.model, scene.render.engine = "OMNIMAX", "BLENDER_WORKBENCH"
    return "camera_ray_caster.use_this_engine"


def sharp(scene, data):
    data.dof.use_dof, data.dof.focus_distance, data.dof.aperture_fstop = True, 5.0, 1.0
    return "No blur with 1 sample: every ray passes through the center of the aperture samples"


def wide_open(scene, data):
    data.camera_ray_caster.model, scene.camera_ray_caster.samples = "REAL_LENS", 4
    data.dof.use_dof, data.dof.aperture_fstop = True, 1.2
    return "The lens opens to f/2.03: it is cast with that stop in place of f/1.2"


def all_at_once(scene, data):
    data.dof.use_dof = True
    stretched(scene, data)
    scene.render.engine = "BLENDER_WORKBENCH"
    return "3 notes: The picture is stretched"


def still(scene, data):
    data.camera_ray_caster.time_mode, scene.frame_end = "ROWS", 9
    return "All frames have the same times camera_ray_caster.follow_timeline"


def no_camera(scene, data):
    scene.camera = None
    return "no active camera"


def rows(blender):
    """How many rows the panel has, each of one line."""
    layout = MagicMock()
    drawn(blender, SidebarCamera, layout)
    called = [name for name, *_ in layout.method_calls if name != "context_pointer_set" and "." not in name]
    assert set(called) <= DRAWN, "nothing is wrapped"
    return len(called)


@pytest.mark.parametrize("deviate", [stretched, missing, unknown, sharp, wide_open, still, all_at_once])
def test_a_note_moves_nothing_below_it(blender, scene, deviate):
    scene.render.engine = "CAMERA_RAY_CASTER"
    assert "No notes" in drawn(blender, SidebarCamera)
    before = rows(blender)
    note = deviate(scene, scene.camera.data)
    blender.context.view_layer.update()
    assert " ".join(note.split()[:4]) in drawn(blender, SidebarCamera), "as many words as fit"
    assert note.removeprefix("3 notes: ") in drawn(blender, CameraNotes)
    assert rows(blender) == before


def test_every_note_is_in_the_popover_with_its_buttons(blender, scene):
    all_at_once(scene, scene.camera.data)
    blender.context.view_layer.update()
    text = drawn(blender, CameraNotes)
    assert len(notes(blender.context)) == 3
    for word in ("set_frame", "use_this_engine", "use_in_cycles", "No blur", "samples"):
        assert word in text


def test_of_two_missing_slits_each_is_added_by_the_same_button(blender, scene):
    missing(scene, scene.camera.data)
    for name in ("slit_1", "slit_2"):
        assert f"camera_ray_caster.add_line {name}" in drawn(blender, SidebarCamera)
        blender.ops.camera_ray_caster.add_line(setting=name)
    assert "add_line" not in drawn(blender, SidebarCamera)


def test_operators_on_rays_are_gray_without_slits(blender, scene, monkeypatch):
    monkeypatch.setattr(evaluated, "camera_record", None)  # a poll reads no camera: a real lens takes 80 ms
    ours = blender.ops.camera_ray_caster
    operators = ours.use_in_cycles, ours.fit_lens, ours.add_projector, ours.render_through_model
    assert [operator.poll() for operator in operators] == [True] * 4
    missing(scene, scene.camera.data)
    blender.context.view_layer.update()
    assert not any(operator.poll() for operator in operators)
    with pytest.raises(RuntimeError, match="Missing: "):
        ours.use_in_cycles()
    for name in ("slit_1", "slit_2"):
        ours.add_line(setting=name)
    blender.context.view_layer.update()
    assert [operator.poll() for operator in operators] == [True] * 3 + [False], "many origins are no warp of faces"


def test_the_times_of_a_slit_scan_go_with_the_timeline(blender, scene):
    scene.render.engine, scene.frame_end = "CAMERA_RAY_CASTER", 9
    follow, group = blender.ops.camera_ray_caster.follow_timeline, scene.camera.data.camera_ray_caster
    assert not follow.poll()
    still(scene, scene.camera.data)
    scene.frame_set(4)
    group.time_start, group.time_end = 3.1, 25
    assert follow() == {"FINISHED"}
    start = group.time_start
    blender.context.view_layer.update()
    assert (group.time_start, group.time_end) == (start, 25), "the current frame is as it was"
    scene.frame_set(6)
    assert group.time_start == pytest.approx(5.1, abs=1e-6)
    assert group.time_end == 27
    assert not notes(blender.context)


def test_the_frame_of_a_calibrated_camera_is_one_note(blender, scene, tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text("1 PINHOLE 1241 376 700 700 620 188\n")
    blender.ops.camera_ray_caster.load_calibration(filepath=str(path))
    scene.render.engine, scene.render.resolution_x = "CAMERA_RAY_CASTER", 1920
    blender.context.view_layer.update()
    (note,) = notes(blender.context)
    assert "1241" in note.text
    assert "Set Frame to 1241 × 376" in drawn(blender, SidebarCamera)
