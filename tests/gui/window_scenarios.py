"""What once trapped a user in the window, one scenario a function: see scenarios.py."""

import time

import bpy
import numpy as np
from lesson_scenarios import place_of
from parts import BUTTON, addon, cast_through, load

MOVES = 12
"""Places of the mouse on its way when a mark is dragged."""


def shown_camera(user, scenes):
    """The sidebar's buttons change the camera that it shows while another one is selected, and say so of a light."""
    yield from load(user, scenes, "toys")
    scene = bpy.context.scene
    shown, other = scene.camera, bpy.data.objects.new("Other", bpy.data.cameras.new("Other"))
    scene.collection.objects.link(other)
    bpy.context.view_layer.objects.active = other
    other.select_set(True)
    shown.data.camera_ray_caster.model = other.data.camera_ray_caster.model = "CROSS_SLIT"
    yield from user.wait(0.5)
    yield from user.press(f"{BUTTON}add_line(")
    yield from user.until(lambda: shown.data.camera_ray_caster.slit_1, "the slit is added to the camera that is shown")
    assert other.data.camera_ray_caster.slit_1 is None
    scene.camera = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "SUN"))
    yield from user.wait(0.7)
    user.screenshot("camera_is_a_light")
    for command in ("see_through(", "load_calibration(", "cast("):
        yield from user.press(BUTTON + command)
    area = user.area()
    assert area.spaces.active.region_3d.view_perspective == "PERSP"
    area.ui_type = "PROPERTIES"
    yield from user.wait(0.7)
    user.screenshot("camera_is_a_light_properties")
    area.ui_type = "VIEW_3D"


def set_frame(user, scenes):
    """F12 warns of a stretched fisheye, and a button sets its frame; the load dialog shows both sizes, and sets that of
    a file.
    """
    yield from load(user, scenes, "toys")
    camera, render = bpy.context.scene.camera.data, bpy.context.scene.render
    camera.type, camera.panorama_type = "PANO", "FISHEYE_EQUIDISTANT"
    render.engine, render.resolution_percentage = "CAMERA_RAY_CASTER", 5
    render.resolution_x, render.resolution_y = 1920, 1080
    yield from user.wait(0.7)
    user.screenshot("set_frame")
    engine, sizes = addon("engine.engine"), []
    asked_size = engine.asked_size
    engine.asked_size = lambda raw: sizes.append(asked_size(raw)) or sizes[-1]
    yield from user.point(*middle(user.region("WINDOW")))
    yield from user.key("F12")
    yield from user.until(lambda: sizes, "the render warns")
    engine.asked_size = asked_size
    assert sizes[0].sentence.startswith("the picture is stretched: the frame has 96 × 54 pixels"), sizes
    yield from user.see_render()
    yield from user.wait(0.5)
    yield from user.press(f"{BUTTON}set_frame(")
    yield from user.until(lambda: render.resolution_x == 1080, "the frame is square")
    path = user.folder / "cameras.txt"
    path.write_text("1 PINHOLE 1241 376 700 700 620 188\n")
    yield from user.press(f"{BUTTON}load_calibration(")
    browser = yield from dialog(user)
    assert browser.spaces.active.params.filename == ""
    browser.spaces.active.params.directory = str(user.folder).encode()
    browser.spaces.active.params.filename = path.name
    yield from user.wait(1)
    user.screenshot("load_dialog")
    yield from user.point(*middle(browser))
    yield from user.key("Return")
    yield from user.until(lambda: camera.camera_ray_caster.model == "OPENCV_PINHOLE", "the calibration is loaded")
    assert (render.resolution_x, render.resolution_y) == (1241, 376)
    yield from user.wait(0.5)
    user.screenshot("loaded")


def other_engine(user, scenes):
    """F12 by an engine that does not know the model says so in the status bar, and the panel has what would work."""
    yield from load(user, scenes, "toys")
    scene, texts, other = bpy.context.scene, [], addon("ui.other_engine")
    scene.camera.data.camera_ray_caster.model, scene.render.engine = "OMNIMAX", "BLENDER_WORKBENCH"
    scene.render.resolution_percentage = 10
    show = other.show
    other.show = lambda text: (texts.append(text), show(text))
    yield from user.wait(0.5)
    yield from user.point(*middle(user.region("WINDOW")))
    yield from user.key("F12")
    yield from user.until(lambda: texts, "the status bar says it")
    assert texts[0].startswith("Workbench renders a perspective view, not Omnimax"), texts
    yield from user.see_render("other_engine_f12")
    yield from user.wait(0.5)
    user.screenshot("other_engine")
    yield from user.press(f"{BUTTON}use_this_engine(")
    yield from user.until(lambda: scene.render.engine == "CAMERA_RAY_CASTER", "the engine is set")
    yield from user.until(lambda: None in texts, "the status bar is Blender's again")
    other.show = show


def marks(user, scenes):
    """In a view through a dome's camera the marks of a clicked pixel and of the overlay lie in the picture."""
    yield from load(user, scenes, "living_room_omnimax")
    scene, lesson = bpy.context.scene, addon("view3d.pixel_lessons")
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.wait(1)
    raster = addon("read.scene_cache").cached_scene(bpy.context).camera.raster
    pixel = raster.width // 3, raster.height // 3
    yield from user.press(f"{BUTTON}step_through(")
    yield from user.click(*place_of(user, *pixel))
    yield from user.key("Escape")
    yield from user.until(lambda: lesson.clicked.pixels, "a pixel is clicked")
    yield from user.wait(2)
    shown = user.picture("marks_clicked")
    x, y = map(round, place_of(user, *lesson.clicked.pixels[0]))
    assert near(shown, x, y, lesson.SEEN) <= 3
    assert 3 <= near(shown, x, y, lesson.RAY) <= 8, "the frame around the pixel"
    bpy.ops.camera_ray_caster.clear_steps()
    overlay = scene.camera_ray_caster_overlay
    overlay.show, overlay.rays, overlay.show_normals, overlay.show_ray = True, 6, False, False
    yield from user.wait(2)
    shown = user.picture("marks_of_the_overlay")
    color, count = addon("view3d.overlay").STYLES["hits"][0], 0
    rows = round(6 * raster.height / raster.width)  # as square a grid as that of the columns
    for column in (np.arange(6) + 0.5) / 6 * raster.width:
        for row in (np.arange(rows) + 0.5) / rows * raster.height:
            x, y = map(round, place_of(user, column - 0.5, row - 0.5))
            count += near(shown, x, y, color) <= 3
    assert count > 12, count
    overlay.show = False


def click_seen(user, scenes):
    """A click in a dome's picture selects what is seen there; Blender's outlines are hidden as long as they lie."""
    yield from load(user, scenes, "living_room_omnimax")
    space, view, context = user.area().spaces.active, user.region("WINDOW"), bpy.context
    hidden = addon("ui.hide_overlays").MISLEADING
    space.overlay.show_bones = False

    def overlays():
        return {name: getattr(space.overlay, name) for name in hidden}

    before = overlays()
    tool(user, "builtin.select_box")
    cast_through(user)
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.until(lambda: not any(overlays().values()), "outlines and grid are hidden")
    seen, probe = addon("read.scene_cache").cached_scene(context), addon("view3d.mouse_gizmo").probe
    width, height = seen.camera.raster.size
    names = []
    for x, y in ((0.3, 0.3), (0.5, 0.35), (0.65, 0.3), (0.4, 0.6), (0.6, 0.7)):
        pixel = int(x * width), int(y * height)
        yield from user.click(*place_of(user, *pixel))
        yield from user.wait(0.3)
        name = probe(seen.camera, seen.shapes, *pixel).name
        assert [item.name for item in context.selected_objects] == [name]
        assert context.object.name == name
        names.append(name)
    assert len(set(names)) > 2, names
    user.screenshot("click_seen")
    for keys, expected in (("ctrl+z", names[-2]), ("ctrl+shift+z", name)):
        yield from user.key(keys)
        yield from user.until(lambda expected=expected: [item.name for item in context.selected_objects] == [expected],
                              f"{keys} of a click")  # fmt: skip
    select_seen, asked = addon("ui.select_seen"), []
    object_at = select_seen.object_at
    select_seen.object_at = lambda *arguments: (asked.append(arguments), object_at(*arguments))[1]
    sides = np.add(place_of(user, 0, height / 2), (-20, 0)), np.add(place_of(user, width / 3, 0), (0, -20))
    yield from user.click(*next(side for side in sides if side[0] > view.x + 100))
    user.send("keydown", "shift")
    yield from user.click(*place_of(user, *pixel))
    user.send("keyup", "shift")
    select_seen.object_at = object_at
    assert not asked, "outside of the frame and with a modifier key Blender selects"

    tool(user, "builtin.select")
    item = bpy.data.objects[name]
    was_at = item.matrix_world.translation.copy()
    start = place_of(user, *pixel)
    yield from user.point(*start)
    user.send("mousedown", 1)
    yield from user.wait(0.2)
    for step in range(1, 9):
        user.send("mousemove", round(start[0] + 6 * step), user.window.height - 1 - round(start[1]))
        yield
    user.send("mouseup", 1)
    yield from user.wait(0.5)
    assert [selected.name for selected in context.selected_objects] == [name]
    assert (item.matrix_world.translation - was_at).length > 0.01, "what is dragged moves"
    tool(user, "builtin.select_box")

    stored = str(user.folder / "hidden.blend")
    bpy.ops.wm.save_as_mainfile(filepath=stored, copy=True)
    assert overlays() == before, "the file has the overlays of before"
    yield from user.until(lambda: not any(overlays().values()), "they are hidden again")
    with bpy.context.temp_override(window=user.window, area=user.area(), region=view):
        bpy.ops.view3d.view_camera()
    yield from user.until(lambda: overlays() == before, "they come back in another view")
    with bpy.context.temp_override(window=user.window, area=user.area(), region=view):
        bpy.ops.view3d.view_camera()
    yield from user.until(lambda: not any(overlays().values()), "they are hidden again")
    bpy.context.scene.camera.data.camera_ray_caster.model = "BLENDER"
    yield from user.until(lambda: overlays() == before, "they come back with a perspective")
    bpy.context.scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    yield from user.until(lambda: not any(overlays().values()), "they are hidden again")
    bpy.ops.wm.open_mainfile(filepath=stored, load_ui=False)
    space = user.area().spaces.active
    assert overlays() == before, "another file is loaded"
    space.overlay.show_bones, space.shading.type = True, "SOLID"


def tool(user, name):
    """Set the 3D View's tool."""
    with bpy.context.temp_override(window=user.window, area=user.area(), region=user.region("WINDOW")):
        bpy.ops.wm.tool_set_by_id(name=name)


def drag_a_ray(user, scenes):
    """The mark follows the mouse while it is dragged, and the sliders while they are set: ray and numbers with it."""
    yield from load(user, scenes, "living_room")
    scene, lesson, drawn = bpy.context.scene, addon("view3d.pixel_lessons"), []
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    yield from user.press(f"{BUTTON}step_through(")
    yield from user.wait(1)
    marks = lesson.draw_in_picture
    lesson.draw_in_picture = lambda *args: (drawn.extend(lesson.clicked.pixels), marks(*args))
    start = place_of(user, 300, 270)
    yield from user.click(*start)
    yield from user.until(lambda: lesson.clicked.pixels, "a pixel is clicked")
    first = lesson.clicked.pixels[0]
    yield from user.point(*start)
    user.send("mousedown", 1)
    yield from user.wait(0.2)
    drawn.clear()
    began = time.process_time()
    for step in range(1, MOVES + 1):
        before = lesson.clicked.pixels[0]
        x, y = np.add(start, np.multiply((120, 30), step / MOVES))
        user.send("mousemove", round(x), user.window.height - 1 - round(y))
        yield from user.until(lambda before=before: drawn and drawn[-1] != before, "the mark follows")
    spent = 1e3 * (time.process_time() - began) / MOVES
    print(f"dragged: {MOVES} updates, {spent:.0f} ms of processor time each")
    assert lesson.clicked.pixels[0][0] > first[0] + 60
    yield from user.wait(0.5)
    assert lesson.clicked.held, "the view is not drawn while its mark moves"
    places = [place_of(user, *pixel) for pixel in (lesson.clicked.pixels[0], first)]
    shown = user.picture("dragging")
    assert [near(shown, *map(round, point), lesson.RAY) <= 8 for point in places] == [True, False]
    user.send("mouseup", 1)
    yield from user.wait(0.5)
    assert not lesson.clicked.held
    shown = user.picture("dragged")
    assert [near(shown, *map(round, point), lesson.RAY) <= 8 for point in places] == [True, False]
    assert len(lesson.clicked.pixels) == 1
    held = lesson.clicked.pixels[0]
    yield from user.point(*place_of(user, 600, 400))
    yield from user.wait(0.3)
    assert lesson.clicked.pixels == [held], "the mark stays where it was dropped"
    yield from user.key("Escape")
    chosen = bpy.context.window_manager.camera_ray_caster_place
    chosen.x = 0.5
    yield from user.until(lambda: drawn[-1][0] == round((0.5 + 1) / 2 * 960), "the view shows the slider's pixel")
    user.screenshot("slid")
    lesson.draw_in_picture = marks
    bpy.ops.camera_ray_caster.clear_steps()


def near(picture, x, y, color, most=12):
    """The distance in pixels from a place in a picture to the nearest pixel of a color; inf if there is none."""
    square = picture[y - most : y + most + 1, x - most : x + most + 1, :3]
    rows, columns = np.nonzero(np.abs(square - color[:3]).max(axis=2) < 0.12)
    return np.hypot(rows - most, columns - most).min(initial=np.inf)


def middle(region):
    """The middle of an area or a region, in the window."""
    return region.x + region.width // 2, region.y + region.height // 2


def dialog(user):
    """Wait for the file dialog, and return its area."""
    def areas():
        return [area for area in user.window.screen.areas if area.type == "FILE_BROWSER"]

    yield from user.until(lambda: areas() and areas()[0].spaces.active.params, "the file dialog is open")
    yield from user.wait(0.7)
    return areas()[0]


WINDOW_SCENARIOS = (shown_camera, set_frame, other_engine, marks, click_seen, drag_a_ray)
