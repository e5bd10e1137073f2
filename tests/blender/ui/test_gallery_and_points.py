"""The gallery's cameras in another scene, and the way between points and pixels."""

import numpy as np
import pytest
from mathutils import Vector

from camera_ray_caster.blender import gallery
from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.blender.ui.gallery_panels import GALLERY, TIMES, by_group, pictured
from camera_ray_caster.blender.view3d import pixel_lessons
from camera_ray_caster.core.cameras import MODELS


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_the_camera_of_each_model_comes_with_all_that_it_needs(blender, model):
    before = set(blender.data.objects)
    assert blender.ops.camera_ray_caster.append_camera(name=gallery.scene_name(model.key)) == {"FINISHED"}
    scene = blender.context.scene
    assert scene.camera not in before
    assert len(set(blender.data.objects) - before) <= 3  # camera, slits
    scene.render.resolution_percentage = 10
    blender.context.view_layer.update()
    camera = read_camera(scene)
    assert camera.model.key == model.key
    assert camera.rays().valid.any()


SHOWN = {name for entries in gallery.groups().values() for name in entries.values()}


def test_the_menus_offer_all_that_has_a_picture():
    pictures = gallery.folder() / "pictures"
    with_picture = {path.stem for path in gallery.scenes() if (pictures / f"{path.stem}.png").is_file()}
    assert with_picture == SHOWN


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_the_gallery_has_a_button_for_each_model(blender, scene, model):
    """Blender's own set their types. The menu has each once, too."""
    assert [it.key for _, entries in by_group() for it in entries].count(model.key) == 1
    settings = scene.camera.data.camera_ray_caster
    settings.model = "CAMERA_OBSCURA"
    assert blender.ops.camera_ray_caster.choose_type(key=model.key) == {"FINISHED"}
    settings.model = "CAMERA_OBSCURA"
    setattr(scene.camera.data, GALLERY, model.key)
    assert getattr(scene.camera.data, GALLERY) == model.key
    assert settings.model == ("BLENDER" if model.number is None else model.key)
    blender.context.view_layer.update()
    if not any(setting.kind in ("OBJECT", "VECTORS") for setting in model.SETTINGS):  # without slits there is no camera
        assert read_camera(scene).model.key == model.key


def test_the_gallery_has_the_times_of_the_pixels(blender, scene):
    settings = scene.camera.data.camera_ray_caster
    settings.model = "OMNIMAX"
    for key in TIMES:
        setattr(scene.camera.data, GALLERY, key)
        assert (settings.model, settings.time_mode) == ("OMNIMAX", key)
    assert len(pictured()) == len(MODELS) + len(TIMES)


@pytest.mark.parametrize("name", [*gallery.TIMES, "unrolled_monkey", "living_room"])
def test_the_camera_of_a_time_or_a_place_comes_with_all_that_it_needs(blender, name):
    assert blender.ops.camera_ray_caster.append_camera(name=name) == {"FINISHED"}
    blender.context.scene.render.resolution_percentage = 10
    blender.context.view_layer.update()
    camera = read_camera(blender.context.scene)
    assert camera.rays().valid.any()
    assert (camera.pixel_time is not None) == (name in gallery.TIMES)


def test_what_the_gallery_does_not_have_is_refused(blender):
    for operator in (blender.ops.camera_ray_caster.append_camera, blender.ops.camera_ray_caster.open_example):
        with pytest.raises(RuntimeError, match="The gallery has no scene 'cat'"):
            operator(name="cat")


def test_a_camera_of_the_gallery_has_its_model_s_name_and_stands_at_the_view_or_the_cursor(blender):
    scene, ops = blender.context.scene, blender.ops.camera_ray_caster
    scene.cursor.location = (3, -2, 1)
    ops.append_camera(name="cross_slit")
    camera = scene.camera
    blender.context.view_layer.update()
    assert camera.name == "Cross-Slit"
    assert np.allclose(camera.matrix_world.translation, (3, -2, 1))
    settings = camera.data.camera_ray_caster
    slits = [camera.matrix_world.inverted() @ slit.matrix_world for slit in (settings.slit_1, settings.slit_2)]
    area = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D")
    view = area.spaces.active.region_3d
    view.view_perspective, view.view_location, view.view_distance = "PERSP", (1, 2, 3), 7
    with blender.context.temp_override(area=area):
        ops.append_camera(name="cross_slit")
    blender.context.view_layer.update()
    second, settings = scene.camera, scene.camera.data.camera_ray_caster
    assert np.allclose(second.matrix_world, view.view_matrix.inverted(), atol=1e-5)
    for slit, before in zip((settings.slit_1, settings.slit_2), slits, strict=True):
        assert np.allclose(second.matrix_world.inverted() @ slit.matrix_world, before, atol=1e-5)


def test_slit_scan_and_time_displacement_are_called_so_and_a_button_makes_a_gradient(blender, scene):
    from camera_ray_caster.core.camera import pixel_time

    labels = {item.key: item.label for item in pixel_time.MODE.items}
    assert [labels[key] for key in ("ROWS", "COLUMNS", "IMAGE")] == [
        "Slit Scan, Rows", "Slit Scan, Columns", "Time Displacement",
    ]  # fmt: skip
    ops, group = blender.ops.camera_ray_caster, scene.camera.data.camera_ray_caster
    ops.choose_type(key="IMAGE")
    group.time_start, group.time_end = 1, 5
    assert ops.add_gradient() == {"FINISHED"}
    blender.context.view_layer.update()
    times = read_camera(scene).rays().time
    assert times[:, 0] == pytest.approx(1, abs=0.2)
    assert times[:, -1] == pytest.approx(5, abs=0.2)
    assert (np.diff(times[3]) > 0).all()


def test_an_example_is_opened_as_a_new_file(blender):
    blender.ops.camera_ray_caster.open_example(name="omnimax")
    assert blender.data.filepath == "", "the extension's own file would be saved over"
    assert blender.context.scene.camera.data.camera_ray_caster.model == "OMNIMAX"
    space = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D").spaces.active
    assert (space.region_3d.view_perspective, space.shading.type) == ("CAMERA", "RENDERED"), "its picture is seen"
    assert blender.context.scene.render.engine == "CAMERA_RAY_CASTER"
    space.shading.type = "SOLID"
    blender.ops.wm.read_homefile(use_factory_startup=True)
    space = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D").spaces.active
    assert space.shading.type == "SOLID", "only an example is"


def test_the_3d_cursor_has_a_pixel_and_its_ray_hits_what_hides_it(blender, scene, capfd):
    scene.cursor.location = (0.5, 0.25, 0.0)  # within the ball
    pixel = read_camera(scene).project(np.array(scene.cursor.location))
    assert blender.ops.camera_ray_caster.pixel_of_point() == {"FINISHED"}
    assert f"x = {pixel[0]:.3f}, y = {pixel[1]:.3f}, from the bottom left; hidden by 'Sphere'" in capfd.readouterr().out
    assert pixel_lessons.clicked.pixels == [tuple(pixel.astype(int))]
    assert blender.ops.camera_ray_caster.empty_at_hit() == {"FINISHED"}
    empty = next(item for item in blender.data.objects if item.type == "EMPTY")
    blender.context.view_layer.update()
    assert blender.context.view_layer.objects.active == empty
    on_the_ball = np.array(empty.matrix_world.translation)
    assert np.linalg.norm(on_the_ball) == pytest.approx(1, abs=1e-6)
    assert np.array(empty.matrix_world)[:3, 2] == pytest.approx(on_the_ball, abs=1e-6)
    scene.cursor.location = (0, 0, 10)  # behind the camera
    assert blender.ops.camera_ray_caster.pixel_of_point() == {"CANCELLED"}
    assert pixel_lessons.clicked.pixels == [], "the pixel of the point before would pass for this one's"


def test_a_selected_vertex_has_a_pixel(blender, scene):
    ball = blender.data.objects["Sphere"]
    blender.context.view_layer.objects.active = ball
    blender.ops.object.mode_set(mode="EDIT")
    blender.ops.mesh.select_all(action="DESELECT")
    blender.ops.object.mode_set(mode="OBJECT")
    chosen = max(ball.data.vertices, key=lambda vertex: vertex.co @ Vector((1.0, 0.3, 0.5))).index
    ball.data.vertices[chosen].select = True
    blender.ops.object.mode_set(mode="EDIT")
    blender.ops.camera_ray_caster.pixel_of_point()
    blender.ops.object.mode_set(mode="OBJECT")
    vertex = ball.data.vertices[chosen]  # those of before are gone
    pixel = read_camera(scene).project(np.array(ball.matrix_world @ vertex.co))
    assert abs(pixel % 1 - 0.5).max() < 0.45
    assert pixel_lessons.clicked.pixels == [tuple(pixel.astype(int))]
