"""What a user does with the settings of a camera, one scenario a function: see scenarios.py."""

from itertools import cycle

import bpy
import numpy as np
from parts import BUTTON, addon, load


def properties_of(user, scene):
    """Turn the 3D View into the Properties editor with the camera's tab, and return area and region."""
    view = user.area()
    bpy.context.view_layer.objects.active = scene.camera
    view.ui_type = "PROPERTIES"
    view.spaces.active.context = "DATA"
    yield from user.wait(0.7)
    return view, next(region for region in view.regions if region.type == "WINDOW")


def camera_settings(user, scenes):
    """With our engine the camera's tab has the model on top, and slits are added where the camera sees something."""
    yield from load(user, scenes, "toys")
    scene = bpy.context.scene
    scene.render.engine = "CAMERA_RAY_CASTER"
    camera = scene.camera.data
    area, region = yield from properties_of(user, scene)
    for kind in ("PERSP", "ORTHO", "PANO"):
        camera.type = kind
        yield from user.wait(0.5)
        user.screenshot(f"camera_{kind.lower()}")
    camera.type, camera.camera_ray_caster.model = "PERSP", "CROSS_SLIT"
    yield from user.wait(0.5)
    user.screenshot("camera_without_slits")
    yield from user.press(f"{BUTTON}add_line(", region)
    yield from user.press(f"{BUTTON}add_line(", region)
    user.screenshot("camera_with_slits")
    group = camera.camera_ray_caster
    assert None not in (group.slit_1, group.slit_2)
    assert group.slit_1 != group.slit_2
    assert addon("read").read_camera(scene).rays().valid.all()
    area.ui_type = "VIEW_3D"


MODELS = 'bpy.ops.wm.call_menu(name="CAMERA_RAY_CASTER_MT_models")'
"""What Ctrl+C copies of the menu of models."""


def model_gallery(user, scenes):
    """A picture of the gallery is a button: a click sets its model, after a direct move or the mouse wheel, in turn."""
    yield from load(user, scenes, "toys")
    camera, keys = bpy.context.scene.camera.data, [it.key for it in addon("ui.gallery_panels").pictured()]
    group = camera.camera_ray_caster
    yield from user.find(MODELS, share=0.3)
    button = user.region().x + user.region().width - 75, user.known[MODELS]
    for key, steps in zip(keys[::7], cycle((0, 3)), strict=False):
        if key in addon("ui.gallery_panels").TIMES:
            group.time_mode = "NONE"
        group.model = "PENCIL" if key != "PENCIL" else "OMNIMAX"
        yield from user.click(*button)
        yield from user.wait(0.7)
        cell = marked(user.picture("gallery"), button)
        numbers = keys.index(key), keys.index(group.model)
        (across, up), (left, bottom) = ([n % 8 for n in numbers], [n // 8 for n in numbers]), cell[:2]
        x = left + (across[0] - across[1] + 0.5) * cell[2]
        for _ in range(steps):
            user.send("click", 5)
            yield
        yield from user.click(x, bottom + (up[1] - up[0] + 0.6) * cell[3])
        yield from user.wait(0.3)
        chosen = group.time_mode if key in addon("ui.gallery_panels").TIMES else camera.camera_ray_caster_gallery
        assert chosen == key, (key, chosen, steps)
    yield from user.click(user.region().x + 60, button[1])
    yield from user.wait(0.5)
    user.screenshot("menu_of_models")
    yield from user.key("Escape")


def marked(picture, button):
    """Return left, bottom, width and height of the picture that is chosen in the gallery below a button: it is blue."""
    below = picture[: round(button[1]) - 20, 100:, :3]
    is_blue = np.abs(below - (0.28, 0.45, 0.70)).max(axis=2) < 0.03
    rows, columns = (np.flatnonzero(is_blue.sum(axis=axis) > 25) for axis in (1, 0))
    return 100 + columns.min(), rows.min(), np.ptp(columns) + 2, np.ptp(rows) + 2


def search(user, scenes):
    """A search (F3) finds Cast and Verify."""
    yield from load(user, scenes, "spheres_and_planes")
    view = user.region("WINDOW")
    for word, result in (("verify", addon("output.reports").verified), ("cast", addon("output.reports").latest)):
        assert result() is None or word == "cast"
        yield from user.point(view.x + view.width // 3, view.y + view.height // 3)
        yield from user.key("F3")
        user.send("type", word)
        yield from user.wait(1)
        user.screenshot(f"search_{word}")
        yield from user.key("Return")
        yield from user.until(result, f"{word} has been found and has run")


def told(user, scenes):
    """Rendered shading and the overlay say what a render shows otherwise; a line says how many objects are left out."""
    yield from load(user, scenes, "left_out")
    scene, space = bpy.context.scene, user.area().spaces.active
    text, written = addon("view3d.text"), []
    write = text.write
    text.write = lambda context, lines, corner: (
        written.append([line for _, line in lines]),
        write(context, lines, corner),
    )
    camera, overlay = scene.camera.data, scene.camera_ray_caster_overlay
    camera.camera_ray_caster.time_mode, camera.dof.use_dof = "ROWS", True
    scene.render.engine = "CAMERA_RAY_CASTER"
    notified = [("CAMERA", "RENDERED", True), ("CAMERA", "RENDERED", False), ("PERSP", "SOLID", True)]
    for view, shading, has_overlays in (*notified, ("PERSP", "RENDERED", False), ("CAMERA", "SOLID", False)):
        space.region_3d.view_perspective, space.shading.type = view, shading
        space.overlay.show_overlays = overlay.show = has_overlays
        yield from user.wait(2)
        written.clear()
        user.area().tag_redraw()
        yield from user.wait(1)
        user.screenshot(f"told_{view}_{shading}_{has_overlays}".lower())
        if (view, shading, has_overlays) in notified:
            *time, blur = written[-1]
            if shading == "SOLID":
                assert time[0].startswith(f"Every pixel is shown at frame {scene.frame_current}; in a render"), time
            else:  # unless the scene has been evaluated at all frames
                assert all(line.startswith("Each pixel has its own time: it is shown from") for line in time), time
            assert blur.startswith("Only rays through the center of the lens are shown, as in a render"), blur
        else:
            assert not written, (view, shading, written)
    text.write = write
    space.overlay.show_overlays, overlay.show = True, False
    space.region_3d.view_perspective, space.shading.type = "CAMERA", "RENDERED"
    yield from user.wait(2)
    with_line = user.cut(user.picture("told"), user.region("WINDOW"))
    camera.camera_ray_caster.time_mode, camera.dof.use_dof = "NONE", False
    for item in scene.objects:
        item.hide_render = True
    yield from user.wait(2)
    without = user.cut(user.picture("told_nothing"), user.region("WINDOW"))
    space.shading.type = "SOLID"
    line = np.s_[-120:-96, 60:500]  # below the names of the view and the object
    letters = [np.count_nonzero(picture[line][..., :3].min(axis=2) > 0.9) for picture in (with_line, without)]
    assert letters[0] > 100 > letters[1] + 50, letters
    seen = addon("read.scene_cache").cached_scene(bpy.context)
    assert not seen.differences
    assert not seen.shapes.left_out


CAMERA_SCENARIOS = (camera_settings, model_gallery, search, told)
