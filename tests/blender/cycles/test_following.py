"""What becomes of custom cameras afterwards: copies, frames, libraries, whatever stands in their inputs."""

import addon_utils
import bpy
import pytest

from camera_ray_caster.blender.cycles import from_cycles, shader_updates, to_cycles
from camera_ray_caster.core.records import InputError

from ..read.scene_parts import new_object
from .test_to_cycles import check, scene, set_up, settings_of

__all__ = ["scene"]


def update():
    bpy.context.view_layer.update()


def animate_lens(camera, frames=(1, 9)):
    for frame, lens in zip(frames, (30.0, 60.0), strict=True):
        camera.data.lens = lens
        camera.data.keyframe_insert("lens", frame=frame)


def test_a_copy_gets_a_text_of_its_own_when_its_formula_changes(scene, monkeypatch):
    camera = set_up(scene, {"lens": 30.0})
    to_cycles(scene)
    other = new_object("Other", camera.data.copy())
    settings_of(other).model = "OMNIMAX"
    update()
    assert other.data.custom_shader != camera.data.custom_shader
    monkeypatch.setattr(shader_updates, "rewrite", None)  # it would be called again and again
    for active in (camera, other):
        scene.camera = active
        check(scene)


def test_an_active_camera_outside_of_the_scene_is_followed(scene):
    scene.camera = camera = bpy.data.objects.new("Outside", bpy.data.cameras.new("Outside"))
    to_cycles(scene)
    camera.data.lens = 80.0
    update()
    check(scene)


@pytest.mark.parametrize("value", [3, 48, "three", [1.0, 2.0], None])
def test_inputs_of_another_type_are_set_right(scene, value):
    camera = set_up(scene, {"lens": 30.0})
    to_cycles(scene)
    inputs = camera.data.cycles_custom
    if value is None:
        del inputs["frame_width"]
    else:
        inputs["frame_width"] = value
    camera.data.update_tag()
    update()
    check(scene)


def test_what_is_not_keyed_does_not_become_a_keyframe(scene):
    camera = set_up(scene, {})
    animate_lens(camera)
    scene.frame_end = 9
    scene.frame_set(3)
    camera.data.lens = 90.0
    to_cycles(scene)
    check(scene)


def test_the_current_subframe_is_no_whole_frame(scene):
    camera = set_up(scene, {})
    animate_lens(camera)
    scene.frame_end = 9
    scene.frame_set(3, subframe=0.5)
    (warning,) = to_cycles(scene)
    assert "frames 1 to 9:" in warning
    check(scene)
    scene.frame_set(3)
    check(scene)


def test_a_range_of_more_frames_than_can_be_evaluated_is_refused(scene):
    camera = set_up(scene, {})
    animate_lens(camera)
    scene.frame_end = 1_048_574
    with pytest.raises(InputError, match="1048574 frames"):
        to_cycles(scene)
    assert camera.data.type == "PERSP"


def test_without_cycles_nothing_fails(scene, capfd):
    camera = set_up(scene, {"model": "OMNIMAX"})
    to_cycles(scene)
    addon_utils.disable("cycles")
    try:
        settings_of(camera).model = "FISHEYE_STEREOGRAPHIC"
        update()
        with pytest.raises(InputError, match="Cycles is disabled"):
            from_cycles(camera)
    finally:
        addon_utils.enable("cycles")
    assert "Traceback" not in capfd.readouterr().err
    update()
    camera.data.update_tag()
    update()
    check(scene)


def test_a_custom_camera_of_a_library_is_not_taken_back(scene, tmp_path):
    to_cycles(scene)
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {scene.camera})
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.objects = there.objects
    with pytest.raises(InputError, match="library"):
        from_cycles(here.objects[0])
    assert here.objects[0].data.type == "CUSTOM"


def test_keyframes_do_not_hold_what_is_followed(scene, monkeypatch):
    """Between keyframes, and where the animation is edited afterwards."""
    camera = set_up(scene, {})
    animate_lens(camera)
    scene.frame_end = 9
    to_cycles(scene)
    scene.frame_set(3, subframe=0.5)
    check(scene)
    scene.frame_set(5)
    camera.data.lens = 100.0
    camera.data.keyframe_insert("lens", frame=5)
    scene.frame_set(4)
    check(scene)
    update()
    monkeypatch.setattr(bpy.types.Camera, "update_tag", None, raising=False)  # it would go on for ever
    update()
    update()
