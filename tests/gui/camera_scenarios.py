"""What a user does with the settings of a camera, one scenario a function: see scenarios.py."""

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
        user.picture(f"camera_{kind.lower()}")
    camera.type, camera.camera_ray_caster.model = "PERSP", "CROSS_SLIT"
    yield from user.wait(0.5)
    user.picture("camera_without_slits")
    yield from user.press(f"{BUTTON}add_line(", region)
    yield from user.press(f"{BUTTON}add_line(", region)
    user.picture("camera_with_slits")
    own = camera.camera_ray_caster
    assert None not in (own.slit_1, own.slit_2)
    assert own.slit_1 != own.slit_2
    assert addon("read").read_camera(scene).rays().valid.all()
    area.ui_type = "VIEW_3D"


def model_gallery(user, scenes):
    """The gallery shows a picture for each model, and closes when one is chosen."""
    yield from load(user, scenes, "toys")
    own = bpy.context.scene.camera.data.camera_ray_caster
    own.model = "PENCIL"
    view = user.region("WINDOW")
    yield from user.point(view.x + view.width // 2, view.y + view.height // 2)
    with bpy.context.temp_override(window=user.window, area=user.area(), region=view):
        bpy.ops.wm.call_menu(name="CAMERA_RAY_CASTER_MT_gallery")
    yield from user.wait(3)
    opened = user.picture("gallery")
    yield from user.key("Return")  # the entry under the mouse, at first that of the first model
    yield from user.wait(1)
    assert np.abs(user.picture("gallery_closed") - opened).max(axis=2).mean() > 0.05
    assert own.model != "PENCIL"


def search(user, scenes):
    """A search (F3) finds Cast and Verify."""
    yield from load(user, scenes, "spheres_and_planes")
    view = user.region("WINDOW")
    for word, found in (("verify", addon("output.reports").verified), ("cast", addon("output.reports").latest)):
        assert found() is None or word == "cast"
        yield from user.point(view.x + view.width // 3, view.y + view.height // 3)
        yield from user.key("F3")
        user.send("type", word)
        yield from user.wait(1)
        user.picture(f"search_{word}")
        yield from user.key("Return")
        yield from user.until(found, f"{word} has been found and has run")


def told(user, scenes):
    """Rendered shading and the overlay say what a render shows otherwise; a line says how many objects are left out."""
    yield from load(user, scenes, "left_out")
    scene, space = bpy.context.scene, user.area().spaces.active
    text, written = addon("view3d.text"), []
    write = text.write
    text.write = lambda context, lines, place: (
        written.append([line for _, line in lines]),
        write(context, lines, place),
    )
    camera, overlay = scene.camera.data, scene.camera_ray_caster_overlay
    camera.camera_ray_caster.time_mode, camera.dof.use_dof = "ROWS", True
    scene.render.engine = "CAMERA_RAY_CASTER"
    told = [("CAMERA", "RENDERED", True), ("CAMERA", "RENDERED", False), ("PERSP", "SOLID", True)]
    for view, shading, has_overlays in (*told, ("PERSP", "RENDERED", False), ("CAMERA", "SOLID", False)):
        space.region_3d.view_perspective, space.shading.type = view, shading
        space.overlay.show_overlays = overlay.show = has_overlays
        yield from user.wait(2)
        written.clear()
        user.area().tag_redraw()
        yield from user.wait(1)
        user.picture(f"told_{view}_{shading}_{has_overlays}".lower())
        if (view, shading, has_overlays) in told:
            time, blur = written[-1]
            assert time.startswith(f"Every pixel is shown at frame {scene.frame_current}; in a render, each"), time
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
