"""See Through Camera, slits that are added and deleted, and what a view says that cannot be cast."""

from types import SimpleNamespace

import bpy
import pytest
from mathutils import Quaternion

from camera_ray_caster.blender.ui import see_through
from camera_ray_caster.blender.ui.model_settings import missing
from camera_ray_caster.blender.ui.see_through import BEFORE, shows_picture
from camera_ray_caster.blender.view3d import notice


@pytest.mark.parametrize("engine", ["CYCLES", "CAMERA_RAY_CASTER"])
def test_see_through_shows_the_camera_s_own_picture_and_restores_everything(blender, scene, engine):
    operator = blender.ops.camera_ray_caster.see_through
    assert not operator.poll()
    area = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D")
    space, scene.render.engine = area.spaces.active, engine
    space.region_3d.view_perspective, space.shading.type = "ORTHO", "MATERIAL"
    turned = space.region_3d.view_rotation = Quaternion((0.6, 0.8, 0.0, 0.0))
    with blender.context.temp_override(area=area):
        for _ in range(2):
            operator()
            space.region_3d.view_rotation = scene.camera.matrix_world.to_quaternion()  # as Blender does when it draws
            assert scene.render.engine == "CAMERA_RAY_CASTER"
            assert (space.region_3d.view_perspective, space.shading.type) == ("CAMERA", "RENDERED")
            operator()
            assert (space.region_3d.view_perspective, space.shading.type) == ("ORTHO", "MATERIAL")
            assert space.region_3d.view_rotation.rotation_difference(turned).angle < 1e-5
            assert scene.render.engine == engine


@pytest.fixture
def view(blender, scene):
    """A 3D View in Solid that See Through shows by a cast, of a scene with another engine."""
    scene.render.engine = "BLENDER_WORKBENCH"
    area = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D")
    area.spaces.active.shading.type = "SOLID"
    with blender.context.temp_override(area=area):
        blender.ops.camera_ray_caster.see_through()
    assert shows_picture(area.spaces.active, scene)
    see_through.watch()
    assert shows_picture(area.spaces.active, scene)
    return area.spaces.active


def leave_for_perspective(scene, view):
    view.region_3d.view_perspective = "PERSP"


def choose_a_shading(scene, view):
    view.shading.type = "WIREFRAME"


def choose_an_engine(scene, view):
    scene.render.engine = "CYCLES"


def delete_the_camera(scene, view):
    bpy.data.objects.remove(scene.camera)


def show_another_editor(scene, view):
    next(a for a in bpy.context.screen.areas if a.spaces.active == view).type = "IMAGE_EDITOR"


def disable_it(scene, view):
    see_through.stop()


@pytest.mark.parametrize(("leave", "engine", "shading"), [
    (leave_for_perspective, "BLENDER_WORKBENCH", "SOLID"), (choose_a_shading, "BLENDER_WORKBENCH", "WIREFRAME"),
    (choose_an_engine, "CYCLES", "RENDERED"), (delete_the_camera, "BLENDER_WORKBENCH", "SOLID"),
    (show_another_editor, "BLENDER_WORKBENCH", "SOLID"), (disable_it, "BLENDER_WORKBENCH", "SOLID"),
])  # fmt: skip
def test_engine_and_shading_are_given_back_however_it_is_left(blender, scene, view, leave, engine, shading):
    area = next(area for area in blender.context.screen.areas if area.spaces.active == view)
    leave(scene, view)
    assert see_through.watch() is None
    assert (scene.render.engine, view.shading.type) == (engine, shading)
    assert BEFORE not in scene
    area.type = "VIEW_3D"  # for the tests that follow: a file that is opened need not bring its screens


@pytest.mark.parametrize("engine", ["BLENDER_WORKBENCH", "OF_ANOTHER_VERSION"])
def test_a_saved_file_has_the_engine_of_before(blender, scene, view, tmp_path, engine):
    path = str(tmp_path / "seen.blend")
    blender.ops.wm.save_as_mainfile(filepath=path)
    assert shows_picture(view, scene)
    assert scene[BEFORE] == "BLENDER_WORKBENCH"
    blender.ops.wm.open_mainfile(filepath=path)
    assert blender.context.scene.render.engine == "BLENDER_WORKBENCH"
    blender.context.scene.render.engine, blender.context.scene[BEFORE] = "CAMERA_RAY_CASTER", engine  # by Auto Save
    bpy.app.handlers.save_pre.remove(see_through.give_back)
    try:
        blender.ops.wm.save_as_mainfile(filepath=path)
    finally:
        bpy.app.handlers.save_pre.append(see_through.give_back)
    blender.ops.wm.open_mainfile(filepath=path)
    scene = blender.context.scene
    assert scene.render.engine == (engine if engine == "BLENDER_WORKBENCH" else "CAMERA_RAY_CASTER")
    assert BEFORE not in scene


def test_it_can_be_switched_off_where_the_camera_is_a_light(blender, scene, view):
    lamp = blender.data.objects.new("Lamp", blender.data.lights.new("Lamp", "POINT"))
    scene.collection.objects.link(lamp)
    scene.camera = lamp
    with blender.context.temp_override(area=next(a for a in blender.context.screen.areas if a.spaces.active == view)):
        assert blender.ops.camera_ray_caster.see_through() == {"FINISHED"}
        assert not blender.ops.camera_ray_caster.see_through.poll()
    assert scene.render.engine == "BLENDER_WORKBENCH"


def test_the_engine_is_undone_and_redone(blender, scene):
    area = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D")
    scene.render.engine = "BLENDER_WORKBENCH"
    blender.ops.ed.undo_push(message="before")
    with blender.context.temp_override(area=area):
        blender.ops.camera_ray_caster.see_through()
    blender.ops.ed.undo_push(message="after")
    for step, is_on in ((blender.ops.ed.undo, False), (blender.ops.ed.redo, True)):
        step()
        scene = blender.context.scene
        assert (scene.render.engine == "CAMERA_RAY_CASTER", BEFORE in scene) == (is_on, is_on)


def test_a_slit_that_is_deleted_is_offered_again(blender, scene):
    camera, ops = scene.camera, blender.ops
    camera.data.camera_ray_caster.model = "PUSHBROOM"
    assert [setting.name for setting in missing(blender.context, camera)] == ["slit_1"]
    ops.camera_ray_caster.add_line(setting="slit_1")
    assert missing(blender.context, camera) == []
    first = camera.data.camera_ray_caster.slit_1
    with blender.context.temp_override(selected_objects=[first]):
        ops.object.delete()
    blender.context.view_layer.update()
    assert [setting.name for setting in missing(blender.context, camera)] == ["slit_1"]
    ops.camera_ray_caster.add_line(setting="slit_1")
    assert missing(blender.context, camera) == []
    assert camera.data.camera_ray_caster.slit_1 != first


def test_a_view_that_cannot_be_cast_says_once_why_with_the_labels_of_the_panels(blender, scene, monkeypatch):
    scene.camera.data.camera_ray_caster.model, scene.render.engine = "PUSHBROOM", "CAMERA_RAY_CASTER"
    blender.context.view_layer.update()
    space = SimpleNamespace(shading=SimpleNamespace(type="RENDERED"), overlay=SimpleNamespace(show_overlays=True))
    fields = {name: getattr(blender.context, name) for name in ("scene", "view_layer", "evaluated_depsgraph_get")}
    space.local_view, seen = None, SimpleNamespace(view_perspective="CAMERA")
    monkeypatch.setattr(notice, "is_live", lambda space: True)
    monkeypatch.setattr(notice.live, "sentences", lambda context: iter(["A cast is shown: the slit is not set"]))
    (sentence,) = notice._sentences(SimpleNamespace(space_data=space, region_data=seen, **fields))
    assert "Slit" in sentence
    assert "slit_1" not in sentence


def test_a_slit_that_the_sidebar_adds_is_selected_to_be_moved(blender, scene):
    data = scene.camera.data
    data.camera_ray_caster.model = "CROSS_SLIT"
    area = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D")
    blender.ops.camera_ray_caster.add_line(setting="slit_1")  # as in the camera's properties, which it would leave
    assert blender.context.object == scene.camera
    with blender.context.temp_override(area=area):
        blender.ops.camera_ray_caster.add_line(setting="slit_2")
    settings = data.camera_ray_caster
    assert blender.context.selected_objects == [blender.context.object] == [settings.slit_2]
    blender.ops.camera_ray_caster.select_line(setting="slit_1")
    assert blender.context.selected_objects == [blender.context.object] == [settings.slit_1]
    settings.slit_1 = None
    with pytest.raises(RuntimeError, match="not in this view layer"):
        blender.ops.camera_ray_caster.select_line(setting="slit_1")
