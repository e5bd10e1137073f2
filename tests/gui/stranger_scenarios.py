"""What someone does who has never seen the add-on, with the sidebar alone: see scenarios.py."""

import bpy
import numpy as np
from all_scenarios import open_list
from lesson_scenarios import place_of
from parts import BUTTON, addon, load
from window_scenarios import middle

ROW = 26
"""Pixels from a row of the sidebar to the next."""
BELOW, SCROLLED = 270, 40
"""Pixels from the button Cast down to the camera's numbers, and width of the scroll bar and the tabs beside them."""


def default_scene(user):
    """Blender's default scene, a cube, with the sidebar on our tab."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    yield from user.wait(0.5)
    view = user.area().spaces.active
    view.shading.type, view.region_3d.view_perspective = "SOLID", "PERSP"
    yield from user.wait(0.5)
    yield from user.open_tab("Ray Caster")
    yield from user.scroll(60, down=False)


def open_menu(user, command, rows, share):
    """Click on the menu that stands so many rows below (above: negative) the button of a command."""
    yield from user.find(command)
    region = user.region()
    yield from user.click(region.x + region.width * share, user.known[command] - rows * ROW)
    yield from user.wait(0.7)


def choose(user, command, rows, share, text):
    """Find an entry of a menu by typing: the space bar begins the search."""
    yield from open_menu(user, command, rows, share)
    user.screenshot(f"menu_{text}")
    yield from user.key("space")
    user.send("type", text)
    yield from user.wait(0.7)
    yield from user.key("Return")
    yield from user.wait(0.7)


def choose_model(user, group, key, label):
    """Open the menu above the button See Through Camera, type the name of a model, and take it."""
    yield from open_menu(user, f"{BUTTON}see_through(", -1, 0.4)
    user.screenshot(f"models_{key}")
    user.send("type", label)
    yield from user.wait(0.7)
    yield from user.key("Return")
    yield from user.until(lambda: group.model == key, f"the model is {key}")
    yield from user.wait(0.7)


def cast_a_cube(user, scenes):
    """The Cast button is seen without scrolling, and what it made is shown from the menu below it."""
    yield from default_scene(user)
    user.screenshot("stranger_sidebar")
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(addon("output.reports").latest, "the cast has ended")
    yield from user.wait(0.5)
    user.screenshot("stranger_cast")
    yield from user.press(f"{BUTTON}verify(")
    yield from user.until(lambda: addon("output.reports").verified().findings, "the camera is verified")
    yield from user.wait(0.5)
    user.screenshot("stranger_verified")
    yield from choose(user, f"{BUTTON}cast(", 1.4, 0.4, "combined")
    yield from user.until(lambda: any(area.type == "IMAGE_EDITOR" for area in user.window.screen.areas), "it is shown")
    user.screenshot("stranger_shown")
    editor = user.area("IMAGE_EDITOR")
    assert editor.spaces.active.image == bpy.data.images["Ray Caster combined"]
    yield from user.point(editor.x + editor.width // 2, editor.y + editor.height // 2)
    yield from user.key("Escape")
    yield from user.until(lambda: any(area.type == "VIEW_3D" for area in user.window.screen.areas), "the view is back")


def see_through(user, scenes):
    """A model is chosen, and a button shows what the camera sees; a slit is added, undone, selected and dragged."""
    yield from default_scene(user)
    view, group = user.region("WINDOW"), bpy.context.scene.camera.data.camera_ray_caster
    button = f"{BUTTON}see_through("
    yield from choose_model(user, group, "OMNIMAX", "Omnimax")
    before = bpy.context.scene.render.engine
    yield from user.press(button)
    yield from user.wait(2)
    seen = user.cut(user.picture("stranger_omnimax"), view)
    assert bpy.context.scene.render.engine == before  # Blender's own drawing, through the model
    yield from choose_model(user, group, "CROSS_SLIT", "Cross-Slit")
    user.screenshot("stranger_slits_missing")
    yield from user.press(f"{BUTTON}add_line(")
    yield from user.until(lambda: group.slit_1, "the slit is added")
    yield from user.point(*middle(view))
    yield from user.key("ctrl+z")
    yield from user.wait(2)
    user.screenshot("stranger_slit_undone")
    group, shows = bpy.context.scene.camera.data.camera_ray_caster, addon("ui.see_through").shows_cast
    assert group.slit_1 is None
    assert shows(user.area().spaces.active, bpy.context.scene)
    yield from user.press(f"{BUTTON}add_line(")
    yield from user.press(f"{BUTTON}add_line(")
    yield from user.wait(2)
    first = user.cut(user.picture("stranger_slits"), view)
    assert np.abs(first - seen).max() > 0.1
    slit = bpy.context.object
    assert slit == group.slit_2
    start = slit.matrix_world.translation.copy()
    yield from user.point(view.x + view.width // 3, view.y + view.height // 3)
    yield from user.key("g")
    yield from user.point(view.x + view.width // 3 + 90, view.y + view.height // 3 + 40)
    yield from user.click(view.x + view.width // 3 + 90, view.y + view.height // 3 + 40)
    yield from user.wait(2)
    after = user.cut(user.picture("stranger_slit_dragged"), view)
    assert (slit.matrix_world.translation - start).length > 0.01
    assert np.count_nonzero(np.abs(after - first).max(axis=2) > 0.1) > 1000
    yield from user.press(button)
    space = user.area().spaces.active
    assert (space.region_3d.view_perspective, space.shading.type) == ("PERSP", "SOLID")
    assert bpy.context.scene.render.engine == before


def ray_of_a_pixel(user, scenes):
    """A pixel is clicked and its ray read off; the point that it hits gets an empty, and its pixel is found again."""
    yield from default_scene(user)
    lesson, scene = addon("view3d.pixel_lessons"), bpy.context.scene
    yield from user.press(f"{BUTTON}step_through(")
    yield from user.wait(1)
    yield from user.click(*place_of(user, 960, 500))
    yield from user.key("Escape")
    yield from user.wait(0.5)
    user.screenshot("stranger_ray")
    (pixel,) = lesson.clicked.pixels
    hit = lesson.lessons(bpy.context)[pixel].point
    yield from user.press(f"{BUTTON}copy_steps(")
    assert f"({pixel[0]}, {pixel[1]}) of" in bpy.context.window_manager.clipboard
    yield from user.press(f"{BUTTON}empty_at_hit(")
    yield from user.wait(0.5)
    empty = bpy.data.objects[f"Pixel {pixel[0]}, {pixel[1]}"]
    assert np.allclose(empty.matrix_world.translation, hit, atol=1e-6)
    lesson.forget()
    scene.cursor.location = empty.matrix_world.translation
    yield from user.press(f"{BUTTON}pixel_of_point(")
    yield from user.wait(0.5)
    user.screenshot("stranger_point")
    assert lesson.clicked.pixels == [pixel]


def export_colmap(user, scenes):
    """The Export menu stands below the camera, and Return in the file dialog writes beside the .blend."""
    yield from default_scene(user)
    bpy.ops.wm.save_as_mainfile(filepath=str(user.folder / "stranger.blend"))
    yield from choose(user, f"{BUTTON}see_through(", 1, 0.25, "colmap")
    yield from user.wait(1)
    user.screenshot("stranger_export")
    yield from user.key("Return")
    folder = user.folder / "stranger_colmap"
    yield from user.until(lambda: (folder / "cameras.txt").is_file(), "the camera is exported")
    assert (folder / "cameras.txt").read_text().splitlines()[-1].split()[1:4] == ["PINHOLE", "1920", "1080"]
    user.screenshot("stranger_exported")


def notes_stay(user, scenes):
    """A note that comes, and one that goes, moves nothing in the sidebar; a popover has all of them in whole sentences.
    """
    yield from load(user, scenes, "toys")
    scene, button, region = bpy.context.scene, f"{BUTTON}cast(", user.region()
    camera = scene.camera.data
    scene.render.engine = "CAMERA_RAY_CASTER"
    user.area().spaces.active.overlay.show_overlays = False  # the camera's lines show between the panels
    yield from user.wait(0.7)
    yield from user.find(button)
    top = user.known[button] - region.y

    def below(name):
        yield from user.point(*middle(user.region("WINDOW")))
        yield from user.wait(0.7)
        return user.cut(user.picture(name), region)[top - BELOW : top, :-SCROLLED]

    plain = yield from below("notes_none")
    camera.type, camera.panorama_type = "PANO", "FISHEYE_EQUIDISTANT"
    stretched = yield from below("notes_frame")
    scene.render.engine = "BLENDER_WORKBENCH"
    two = yield from below("notes_two")
    assert np.array_equal(plain, stretched)
    assert np.array_equal(plain, two)
    set_frame_button = f"{BUTTON}set_frame("
    yield from user.find(set_frame_button)
    yield from user.click(region.x + region.width // 3, user.known[set_frame_button] + ROW)
    yield from user.wait(1)
    user.screenshot("notes_popover")
    yield from user.key("Escape")
    yield from user.press(set_frame_button)
    yield from user.until(lambda: scene.render.resolution_x == scene.render.resolution_y, "the frame is square")
    assert np.array_equal(plain, (yield from below("notes_one_left")))


def results_stay(user, scenes):
    """A cast, a verification and a cast of all cameras move no button, whatever they say: each is where it was."""
    yield from load(user, scenes, "left_out")
    scene, run = bpy.context.scene, addon("ui.in_process")
    second = bpy.data.objects.new("Second", scene.camera.data)
    scene.collection.objects.link(second)
    scene.render.resolution_percentage = 10
    yield from user.wait(0.7)
    yield from open_list(user)
    buttons = [f"{BUTTON}{name}(" for name in ("cast", "cast_all", "export", "verify")]

    def places():
        for button in buttons:
            yield from user.find(button)
        return [user.known[button] for button in buttons]

    yield from user.scroll(60, down=False)
    before = yield from places()
    yield from user.press(buttons[0])
    yield from user.until(addon("output.reports").latest, "the cast has ended")
    assert addon("output.reports").latest().left_out
    yield from user.press(buttons[3])
    yield from user.until(lambda: addon("output.reports").verified().findings, "the camera is verified")
    bpy.ops.camera_ray_caster.cast_all(directory=str(user.folder / "stay"), frames="CURRENT")
    yield from user.until(lambda: run.running() is None and run.latest(), "the pictures are made")
    yield from user.wait(0.7)
    after = yield from places()
    user.screenshot("results_stay")
    assert after == before


STRANGER_SCENARIOS = (cast_a_cube, see_through, ray_of_a_pixel, export_colmap, notes_stay, results_stay)
