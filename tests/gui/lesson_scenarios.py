"""What a user does to see how a pixel gets its color, one scenario a function: see scenarios.py."""

import bpy
import numpy as np
from mathutils import Euler
from parts import BUTTON, addon, load


def place_of(user, column, row):
    """Where a pixel of the camera is in the window."""
    view, raster = user.region("WINDOW"), addon("read.scene_cache").cached_scene(bpy.context).camera.raster
    with bpy.context.temp_override(window=user.window, area=user.area(), region=view):
        left, bottom, right, top = addon("read.view").camera_frame(bpy.context)
    x, y = (column + 0.5) / raster.width, (row + 0.5) / raster.height
    return view.x + left + x * (right - left), view.y + bottom + y * (top - bottom)


def step_through(user, scenes):
    """Two pixels are clicked: their steps stand in the sidebar, their rays in every 3D View, and can be copied."""
    yield from load(user, scenes, "toys")
    space, lesson = user.area().spaces.active, addon("view3d.pixel_lessons")
    yield from user.press(f"{BUTTON}step_through(")
    yield from user.wait(0.5)
    assert space.region_3d.view_perspective == "CAMERA"
    camera = addon("read.scene_cache").cached_scene(bpy.context).camera
    yield from user.click(*place_of(user, 400, 200))
    (first,) = lesson.clicked.pixels
    assert np.abs(np.subtract(first, (400, 200))).max() <= 3
    user.send("keydown", "shift")
    yield from user.click(*place_of(user, 150, 120))
    user.send("keyup", "shift")
    assert len(lesson.clicked.pixels) == 2
    yield from user.key("Escape")
    user.screenshot("step_through")
    steps = lesson.lessons(bpy.context)[first]
    hit = camera.project(steps.point)
    assert np.abs(hit - np.add(first, 0.5)).max() < 1e-9
    yield from user.press(f"{BUTTON}copy_steps(")
    copied = bpy.context.window_manager.clipboard
    assert copied.count("View coordinates [-1, 1]²") == 2
    assert f"({first[0]}, {first[1]}) of {camera.raster.width}" in copied
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_distance = 26
    yield from user.wait(0.7)
    on = user.cut(user.picture("step_through_rays"), user.region("WINDOW"))
    bpy.ops.camera_ray_caster.clear_steps()
    yield from user.wait(0.7)
    off = user.cut(user.picture("step_through_cleared"), user.region("WINDOW"))
    assert not lesson.clicked.pixels
    assert np.count_nonzero(np.abs(on - off).max(axis=2) > 0.1) > 500


def lens_in_view(user, scenes):
    """A pixel of a real lens is clicked: its glass, its rays and its section are drawn, until it is cleared."""
    yield from load(user, scenes, "real_lens")
    space, lesson = user.area().spaces.active, addon("view3d.pixel_lessons")
    yield from user.press(f"{BUTTON}step_through(")
    yield from user.wait(0.5)
    yield from user.click(*place_of(user, 200, 110))
    assert len(lesson.clicked.pixels) == 1
    yield from user.key("Escape")
    yield from user.point(user.region().x + 60, user.region().y + 60)
    yield from user.scroll(40)
    yield from user.wait(0.5)
    user.screenshot("lens_section")
    camera = addon("read.scene_cache").cached_scene(bpy.context).camera
    assert addon("view3d.lens_icon").icon(camera, lesson.clicked.pixels[0])
    space.region_3d.view_perspective = "ORTHO"
    space.region_3d.view_location = camera.pose.eye
    space.region_3d.view_rotation = Euler((np.pi / 2, 0, np.pi / 2)).to_quaternion()
    space.region_3d.view_distance = 2.0
    yield from user.wait(0.7)
    on = user.cut(user.picture("lens_in_view"), user.region("WINDOW"))
    bpy.ops.camera_ray_caster.clear_steps()
    yield from user.wait(0.7)
    off = user.cut(user.picture("lens_cleared"), user.region("WINDOW"))
    assert np.count_nonzero(np.abs(on - off).max(axis=2) > 0.1) > 2000


def beside(user):
    """An Image Editor beside the 3D View, which keeps two fifths of its place."""
    before = list(user.window.screen.areas)
    old = user.area()
    with bpy.context.temp_override(window=user.window, area=old, region=user.region("WINDOW")):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.4)
    (new,) = [area for area in user.window.screen.areas if area not in before]
    editor = max(old, new, key=lambda area: area.width)
    editor.ui_type = "IMAGE_EDITOR"
    return editor


def step_through_image(user, scenes):
    """Pixels are clicked in the picture that a cast has made: each has a frame around it, and its steps beside it."""
    yield from load(user, scenes, "toys")
    lesson, editor, space = addon("view3d.pixel_lessons"), beside(user), user.area().spaces.active
    yield from user.wait(1)
    view, sidebar = parts_of(editor)
    in_view = {"window": user.window, "area": editor, "region": view}
    addon("properties.pass_properties").tick(bpy.context.scene, bpy.context.view_layer, ["combined"])
    bpy.ops.camera_ray_caster.cast()
    image = editor.spaces.active.image
    assert image == bpy.data.images["Ray Caster combined"]
    space.show_region_ui = space.show_region_toolbar = False
    yield from user.open_tab("Ray Caster", editor)
    yield from user.press(f"{BUTTON}step_through(", sidebar)
    yield from lesson_frames(user, editor)
    lesson.clicked.choose([])
    with bpy.context.temp_override(**in_view):
        bpy.ops.image.view_zoom_ratio(ratio=16)
    yield from user.wait(0.5)

    middle = image.size[0] // 2 - 8, image.size[1] // 2
    pixels = [middle, (middle[0] + 5, middle[1] - 6)]
    yield from user.click(*place_in(view, image, *np.add(pixels[0], 0.5)))
    assert lesson.clicked.pixels == pixels[:1]
    user.send("keydown", "shift")
    yield from user.click(*place_in(view, image, *np.add(pixels[1], (0.9, 0.1))))
    user.send("keyup", "shift")
    assert lesson.clicked.pixels == pixels
    yield from user.key("Escape")
    yield from user.wait(0.5)
    marked = user.picture("step_through_image")
    assert [sides_marked(marked, view, image, *pixel) for pixel in pixels] == [4, 4]
    bpy.ops.camera_ray_caster.clear_steps()
    yield from user.wait(0.7)
    cleared = user.picture("step_through_image_cleared")
    assert [sides_marked(cleared, view, image, *pixel) for pixel in pixels] == [0, 0]
    space.show_region_ui = space.show_region_toolbar = True
    with bpy.context.temp_override(window=user.window, area=editor):
        bpy.ops.screen.area_close()
    yield from user.wait(0.5)


def lesson_frames(user, editor):
    """The README's animated picture: pixels are clicked in the whole picture, and the view turns around their rays."""
    area, lesson = user.area(), addon("view3d.pixel_lessons")
    view, sidebar = parts_of(editor)
    region, image = area.spaces.active.region_3d, editor.spaces.active.image
    in_view = {"window": user.window, "area": editor, "region": view}
    with bpy.context.temp_override(**in_view):
        bpy.ops.image.view_zoom_ratio(ratio=0.5)
        bpy.ops.image.view_pan(offset=(sidebar.width, 0))  # in pixels of the image: half as many of the window
    region.view_perspective, region.view_distance, region.view_location = "PERSP", 17.5, (0.6, -4.6, 1.5)
    turns = np.radians([40] * 3 + [*range(40, 104, 8)])
    clicks = {1: (392, 260), 2: (246, 120), 3: (704, 128)}
    for i, turn in enumerate(turns):
        region.view_rotation = Euler((np.radians(66), 0, turn)).to_quaternion()
        if i in clicks:
            user.send(*(["keydown", "shift"] if i > 1 else ["keyup", "shift"]))
            yield from user.click(*place_in(view, image, *clicks[i]))
            user.send("keyup", "shift")
            assert len(lesson.clicked.pixels) == i, lesson.clicked.pixels
        yield from user.wait(0.3)
        user.screenshot(f"lesson_{i:02}", (editor, area))
    with bpy.context.temp_override(**in_view):
        bpy.ops.image.view_pan(offset=(-sidebar.width, 0))


def parts_of(area):
    """An area's main region and its sidebar."""
    return [next(region for region in area.regions if region.type == kind) for kind in ("WINDOW", "UI")]


def place_in(view, image, column, row):
    """Where a point of an image is in the window, by Blender."""
    x, y = view.view2d.view_to_region(column / image.size[0], row / image.size[1], clip=False)
    return view.x + x, view.y + y


def sides_marked(picture, view, image, column, row):
    """On how many sides of a pixel there is a mark's color."""
    sides = [place_in(view, image, column + x, row + y) for x, y in ((0, 0.5), (1, 0.5), (0.5, 0), (0.5, 1))]
    around = [picture[y - 2 : y + 3, x - 2 : x + 3, :3] for x, y in sides]
    return sum(np.abs(pixels - addon("view3d.pixel_lessons").RAY[:3]).max(axis=2).min() < 0.1 for pixels in around)


def examples(user, scenes):
    """The gallery's menu has a picture for each model, and a camera of it comes with its slits."""
    yield from load(user, scenes, "toys")
    view = user.region("WINDOW")
    yield from user.point(view.x + 60, view.y + view.height - 150)
    with bpy.context.temp_override(window=user.window, area=user.area(), region=view):
        bpy.ops.wm.call_menu(name="CAMERA_RAY_CASTER_MT_cameras")
    yield from user.wait(2)
    user.screenshot("examples")
    yield from user.key("Escape")
    bpy.ops.camera_ray_caster.append_camera(name="cross_slit")
    user.area().spaces.active.region_3d.view_perspective = "CAMERA"
    yield from user.wait(1)
    user.screenshot("appended")
    assert bpy.context.scene.camera.data.camera_ray_caster.slit_2 is not None


SIDES = {"OUTSIDE": (0.13, "PERSP"), "SIDE": (0.34, "ORTHO"), "ABOVE": (0.55, "ORTHO"), "BACK": (0.76, "CAMERA")}
"""Where the buttons are in the sidebar's width, and the view's perspective after a click."""
ROW = 26
"""Height of a row of buttons and the space between two, in pixels."""


def look_from(user, side):
    """Press the button that looks at the ray from a side."""
    command, view = f"{BUTTON}ray_view(side='{side}'", user.area().spaces.active.region_3d
    share, perspective = SIDES[side]
    yield from user.find(command, share=share)
    user.send("click", 1)
    yield from user.until(lambda: view.view_perspective == perspective, f"the ray is seen: {side}")
    yield from user.wait(0.7)


def lecture(user, scenes):
    """A lecture shows the formula large on the picture, its steps by Page Down and Page Up, its ray from all sides."""
    yield from load(user, scenes, "toys")
    lesson, chosen = addon("view3d.pixel_lessons"), bpy.context.window_manager.camera_ray_caster_place
    view, panel = user.area().spaces.active.region_3d, user.region()
    view.view_perspective = "CAMERA"
    lesson.clicked.choose([(150, 120)])
    yield from user.wait(0.7)
    off = user.cut(user.picture("lecture_off"), user.region("WINDOW"))
    yield from user.find(f"{BUTTON}step_through(")  # above the switch, and the sides below that
    row = user.known[f"{BUTTON}step_through("] - 2 * ROW
    user.known |= {f"{BUTTON}ray_view(side='{side}'": row for side in SIDES}
    yield from look_from(user, "ABOVE")
    yield from user.click(panel.x + panel.width // 3, row + ROW)
    assert chosen.lecture
    user.known |= {f"{BUTTON}ray_view(side='{side}'": row - ROW for side in SIDES}  # More Digits is above them
    for side in ("BACK", "OUTSIDE", "SIDE", "ABOVE", "BACK"):
        yield from look_from(user, side)
        user.screenshot(f"lecture_{side.lower()}")
        assert lesson.clicked.pixels == [(150, 120)]
    on = user.cut(user.picture("lecture_formula"), user.region("WINDOW"))
    assert np.count_nonzero(np.abs(on - off).max(axis=2) > 0.1) > 5000
    yield from user.point(*place_of(user, 300, 200))
    for key, step in (("Next", 1), ("Next", 2), ("Next", 3), ("Next", 4), ("Prior", 3)):
        yield from user.key(key)
        yield from user.until(lambda step=step: chosen.step == step, f"{key} shows step {step}")
    user.screenshot("lecture_numbers")
    chosen.all_digits = True
    yield from user.wait(0.5)
    user.screenshot("lecture_all_digits")
    chosen.lecture, chosen.all_digits, chosen.step = False, False, 0
    lesson.forget()


LESSON_SCENARIOS = (step_through, step_through_image, lecture, lens_in_view, examples)
