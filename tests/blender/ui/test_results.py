"""What casts leave: images that are saved and shown, and the steps of pixels."""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from camera_ray_caster.blender.output import image_datablocks as images
from camera_ray_caster.blender.properties import pass_properties
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.blender.registration import Undo
from camera_ray_caster.blender.view3d import pixel_lessons
from camera_ray_caster.core.cast import cast

from .conftest import HEIGHT, WIDTH
from .test_sidebar import pixels_of


def test_images_are_saved_with_the_file_exactly_and_cast_anew_after_it_is_loaded(blender, scene, tmp_path):
    scene.camera_ray_caster.samples = 5
    pass_properties.tick(scene, blender.context.view_layer, ["combined", "depth", "normal"])
    blender.ops.camera_ray_caster.cast()
    names = list(images.results())
    before = {name: pixels_of(blender.data.images[name]) for name in names}
    path = str(tmp_path / "saved.blend")
    for _ in range(2):
        blender.ops.wm.save_as_mainfile(filepath=path)
        blender.ops.wm.open_mainfile(filepath=path)
        assert images.results() == dict(zip(names, ["combined", "depth", "normal"], strict=True))
        for name in names:
            assert np.array_equal(pixels_of(blender.data.images[name]), before[name]), name
    scene = blender.context.scene
    scene.render.resolution_x = 2 * WIDTH
    blender.ops.camera_ray_caster.cast()
    assert blender.data.images[names[1]].size[:] == (2 * WIDTH, HEIGHT)
    assert len(blender.data.images) == 3
    expected = cast(read_camera(scene), read_shapes(scene), passes=["normal"])["normal"]
    assert np.array_equal(pixels_of(blender.data.images[names[2]])[..., :3], expected)


def test_images_stay_as_they_are_when_something_else_is_undone_and_redone(blender, scene):
    pass_properties.tick(scene, blender.context.view_layer, ["combined", "depth"])
    push = blender.ops.ed.undo_push
    push(message="before")
    blender.ops.camera_ray_caster.cast()
    push(message="cast")
    before = {name: pixels_of(blender.data.images[name]) for name in images.results()}
    blender.context.scene.camera.location.x += 1
    push(message="moved")
    blender.ops.ed.undo()
    assert len(before) == 2
    for step in (None, blender.ops.ed.undo, blender.ops.ed.redo, blender.ops.ed.redo):
        if step:
            step()
        assert set(images.results()) == set(before)
        for name in before:
            assert np.array_equal(pixels_of(blender.data.images[name]), before[name]), name
            assert blender.data.images[name].is_float


def test_passes_of_all_widths_are_stored_beside_each_other(blender, scene):
    keys = ["combined", "normal", "flow_forward", "depth", "ray_direction"]
    pass_properties.tick(scene, blender.context.view_layer, keys)
    for _ in range(2):  # into new images, and into these again
        assert blender.ops.camera_ray_caster.cast() == {"FINISHED"}
        before = {key: pixels_of(blender.data.images[images.image_name(key)]) for key in keys}
        for key in keys:
            pass_properties.tick(scene, blender.context.view_layer, [key])
            blender.ops.camera_ray_caster.cast()
            assert np.array_equal(pixels_of(blender.data.images[images.image_name(key)]), before[key], equal_nan=True)
        pass_properties.tick(scene, blender.context.view_layer, keys)
    assert not before["flow_forward"][..., 2].any()
    assert (before["normal"][..., 3] == 1).all()


def test_an_image_of_the_same_name_that_is_somebody_elses_is_left_alone(blender, scene):
    other = blender.data.images.new("Ray Caster combined", 3, 2)
    blender.ops.camera_ray_caster.cast()
    assert tuple(other.size) == (3, 2)
    assert tuple(blender.data.images["Ray Caster combined.001"].size) == (WIDTH, HEIGHT)


def test_a_result_is_shown_in_colors(blender, scene):
    pass_properties.tick(scene, blender.context.view_layer, ["combined", "depth", "distance", "distance_bound"])
    blender.ops.camera_ray_caster.cast()
    assert list(images.results().values()) == ["combined", "depth", "distance", "distance_bound"]
    image, legend = images.show_in_colors(images.image_name("depth"))
    shown = pixels_of(image)
    depth = pixels_of(blender.data.images[images.image_name("depth")])[..., 0]
    near = np.unravel_index(depth.argmin(), depth.shape)
    assert legend == f"white to dark: {depth.min():.4g} to {depth[depth < 1e9].max():.4g}"
    assert shown[near][0] == 1
    assert not shown[depth > 1e9][:, :3].any()
    scene.camera.location.z += 1
    blender.ops.camera_ray_caster.cast()
    there = blender.data.images[images.VIEW]
    assert not np.array_equal(pixels_of(there), shown), "the next cast shows it anew"
    shown = pixels_of(there)
    assert np.array_equal(pixels_of(images.show_in_colors(images.image_name("depth"))[0]), shown)
    assert images.show_in_colors(images.image_name("combined"))[0].name == images.image_name("combined")
    with pytest.raises(RuntimeError, match="No cast has made an image 'Cat'"):
        blender.ops.camera_ray_caster.show_result(name="Cat")


def test_the_steps_of_pixels_are_copied_and_forgotten(blender, scene):
    from camera_ray_caster.blender.ui.lesson_panels import SidebarLesson
    from camera_ray_caster.blender.view3d import pixel_lessons

    assert not blender.ops.camera_ray_caster.copy_steps.poll()
    pixel_lessons.clicked.choose([(12, 8), (0, 0), (24, 0)])  # the last one is outside of the frame
    lessons = pixel_lessons.lessons(blender.context)
    assert list(lessons) == [(12, 8), (0, 0)]
    assert lessons[12, 8].seen.name == "Sphere"
    assert blender.ops.camera_ray_caster.copy_steps() == {"FINISHED"}
    blender.data.objects["Sphere"].location.z = -3
    blender.context.view_layer.update()
    assert pixel_lessons.lessons(blender.context)[12, 8].seen.distance > lessons[12, 8].seen.distance + 2.9
    assert SidebarLesson.is_registered
    assert blender.ops.camera_ray_caster.clear_steps() == {"FINISHED"}
    assert pixel_lessons.lessons(blender.context) == {}


def test_the_color_of_a_clicked_pixel_follows_the_settings_of_the_picture(blender, scene):
    pixel_lessons.clicked.choose([(12, 8)])
    settings = scene.camera_ray_caster
    for settings.shading, settings.samples in (("MATERIAL", 1), ("GRID", 1), ("GRID", 4)):
        blender.ops.camera_ray_caster.cast()
        picture = pixels_of(blender.data.images[images.image_name("combined")])
        lesson_color = pixel_lessons.lessons(blender.context)[12, 8].color
        assert lesson_color == pytest.approx(picture.reshape(HEIGHT, WIDTH, 4)[8, 12], rel=1e-6)  # float32
    settings.samples = pixel_lessons.MOST_SAMPLES + 1
    assert pixel_lessons.lessons(blender.context)[12, 8].color is None
    pixel_lessons.forget()


def test_a_pixel_that_shows_nothing_has_a_mark_on_its_ray(blender, scene):
    camera, shapes = read_camera(scene), read_shapes(scene)
    hit, missed = (pixel_lessons.lesson(camera, shapes, *pixel) for pixel in ((WIDTH // 2, HEIGHT // 2), (0, 0)))
    assert hit.point is not None
    assert missed.point is None
    for lesson in hit, missed:
        parts = pixel_lessons._parts(camera, lesson, 1.0)
        (mark,) = (points for kind, points, _, width in parts if kind == "POINT" and width == pixel_lessons.POINT)
        assert camera.project(np.array(mark))[0] == pytest.approx(np.array(lesson.seen.pixel) + 0.5, abs=1e-3)


def test_step_through_waits_once_and_its_hint_goes_where_it_was_shown(blender, scene):
    from camera_ray_caster.blender.ui import lesson_operators

    step = blender.ops.camera_ray_caster.step_through
    assert step.poll()
    lesson_operators._waiting.append(blender.data.workspaces[0].name)
    assert not step.poll()
    lesson_operators.end()
    assert step.poll()


def test_a_camera_of_another_file_is_not_changed(blender, scene, tmp_path):
    path = str(tmp_path / "library.blend")
    blender.data.libraries.write(path, {scene.camera})
    with blender.data.libraries.load(path, link=True) as (there, here):
        here.objects = list(there.objects)
    (linked,) = here.objects
    scene.collection.objects.link(linked)
    assert blender.ops.camera_ray_caster.load_calibration.poll()
    blender.context.view_layer.objects.active = linked
    scene.camera = linked
    for name in ("load_calibration", "add_line"):
        assert not getattr(blender.ops.camera_ray_caster, name).poll()


def test_the_images_of_the_latest_cast_come_first(blender, scene):
    from camera_ray_caster.blender.ui.show_result import ResultsMenu

    from .test_panels import drawn

    def listed():
        return [word for word in drawn(blender, ResultsMenu).split() if word not in {"camera_ray_caster.show_result"}]

    pass_properties.tick(scene, blender.context.view_layer, ["combined", "depth"])
    blender.ops.camera_ray_caster.cast()
    assert listed() == ["Combined", "Depth"]
    pass_properties.tick(scene, blender.context.view_layer, ["depth"])
    blender.ops.camera_ray_caster.cast()
    assert listed() == ["Depth", "Earlier", "Casts", "Combined"]


@pytest.mark.parametrize("why", ["disabled", "no camera", "Esc"])
def test_step_through_gives_every_window_its_cursor_back(blender, scene, monkeypatch, why):
    from camera_ray_caster.blender.ui import lesson_operators

    restored = []
    windows = [SimpleNamespace(cursor_modal_restore=partial(restored.append, i)) for i in range(2)]
    keys = SimpleNamespace(addon=None)
    context = SimpleNamespace(window_manager=SimpleNamespace(windows=windows, keyconfigs=keys), scene=scene)
    monkeypatch.setattr(lesson_operators, "bpy", SimpleNamespace(
        data=blender.data, context=context, types=SimpleNamespace(WindowManager=type("WindowManager", (), {})),
    ))  # fmt: skip
    lesson_operators._waiting.append(blender.data.workspaces[0].name)
    move, escape = (SimpleNamespace(type=kind, value="PRESS") for kind in ("MOUSEMOVE", "ESC"))
    step = partial(lesson_operators.StepThrough.modal, SimpleNamespace(is_dragging=False), context)
    assert step(move) == {"PASS_THROUGH"}
    assert restored == []
    if why == "disabled":
        with Undo() as undo:
            lesson_operators.register(undo)
    if why == "no camera":
        blender.data.objects.remove(scene.camera)
    else:
        assert why == "Esc" or restored == [0, 1]
    assert step(escape if why == "Esc" else move) == {"FINISHED"}
    assert restored == [0, 1]
    assert not lesson_operators._waiting


def test_the_sliders_move_the_latest_pixel_and_its_ray(blender, scene):
    chosen = blender.context.window_manager.camera_ray_caster_place
    pixel_lessons.clicked.choose([(1, 1), (12, 8)])
    assert (chosen.column, chosen.row) == (12, 8)
    assert (chosen.x, chosen.y) == pytest.approx((2 * 12.5 / WIDTH - 1, 2 * 8.5 / HEIGHT - 1))
    before = pixel_lessons.lessons(blender.context)[12, 8].seen
    chosen.x = -0.99
    assert pixel_lessons.clicked.pixels == [(1, 1), (0, 8)]
    chosen.column = 900
    chosen.y = 1.0
    assert pixel_lessons.clicked.pixels == [(1, 1), (WIDTH - 1, HEIGHT - 1)]
    after = pixel_lessons.lessons(blender.context)[WIDTH - 1, HEIGHT - 1].seen
    assert after.view == pytest.approx((chosen.x, chosen.y))
    assert after.direction[0] > before.direction[0]
    pixel_lessons.forget()
    assert (chosen.column, chosen.row) == (0, 0)


@pytest.mark.parametrize(
    ("rays", "seconds", "text"),
    [
        (999_999, 0.9512, "0.951 s: 999,999 rays"),
        (2_073_600, 99.96, "100 s: 2.07 M rays"),
        (1_061_683_200, 1234.5, "1,234 s: 1,062 M rays"),
    ],
)
def test_the_result_of_a_cast_has_no_powers_of_ten(rays, seconds, text):
    from camera_ray_caster.blender.ui.cast_panels import summary

    assert summary(SimpleNamespace(rays=rays, seconds={"cast": seconds}, shapes=2)) == f"{text}, 2 shapes"
