"""How See Through is left, and what may go wrong meanwhile, one scenario a function: see scenarios.py."""

import bpy
from parts import BUTTON, addon, load

SEE = f"{BUTTON}see_through("
CAST = "CAMERA", "RENDERED", "CAMERA_RAY_CASTER"


def state(user):
    """Perspective and shading of the first view, and the scene's engine."""
    space = user.area().spaces.active
    return space.region_3d.view_perspective, space.shading.type, bpy.context.scene.render.engine


def left_however(user, scenes):
    """A cast's view gives shading and engine back by Numpad 0, another shading, another workspace, and without the
    camera; from Numpad 0 and the workspace it comes back.
    """
    yield from load(user, scenes, "toys")
    scene, view, engine = bpy.context.scene, user.region("WINDOW"), "BLENDER_WORKBENCH"
    scene.render.engine, scene.camera.data.camera_ray_caster.model = engine, "GENERAL_LINEAR"
    yield from user.wait(0.5)

    def shows(*expected):
        return user.until(lambda: state(user) == expected, f"{expected}")

    yield from user.press(SEE)
    yield from shows(*CAST)
    middle = view.x + view.width // 3, view.y + view.height // 2
    for expected in (("PERSP", "SOLID", engine), CAST):
        yield from user.point(*middle)
        yield from user.key("KP_0")
        yield from shows(*expected)
    workspace = user.window.workspace
    user.window.workspace = bpy.data.workspaces["UV Editing"]
    yield from user.until(lambda: scene.render.engine == engine, "the engine is back in another workspace")
    user.window.workspace = workspace
    yield from shows(*CAST)
    user.area().spaces.active.shading.type = "WIREFRAME"
    yield from shows("CAMERA", "WIREFRAME", engine)
    yield from user.wait(0.5)
    assert state(user) == ("CAMERA", "WIREFRAME", engine)
    user.area().spaces.active.shading.type = "SOLID"
    yield from user.press(SEE)
    yield from shows(*CAST)
    bpy.data.objects.remove(scene.camera)
    yield from user.until(lambda: state(user)[1:] == ("SOLID", engine), "it is back without the camera")
    assert not addon("view3d.live")._handles


def own_view(user, scenes):
    """Blender's own view from a fisheye says so on the picture; a click there, or on Step Through, sees through it."""
    yield from load(user, scenes, "toys")
    view, space = user.region("WINDOW"), user.area().spaces.active
    bpy.context.scene.camera.data.camera_ray_caster.model = "DOME_MASTER"
    bpy.context.scene.camera_ray_caster_overlay.show = True
    shows_live = addon("ui.see_through").shows_live
    yield from user.point(view.x + view.width // 3, view.y + view.height // 2)
    yield from user.key("KP_0")
    yield from user.wait(1)
    user.screenshot("own_view")
    top = view.height - addon("ui.see_through_here").TOP
    yield from user.click(view.x + (view.width - user.region().width) / 2, view.y + top - 8)
    yield from user.until(lambda: shows_live(space, bpy.context.scene), "it is live")
    yield from user.wait(1)
    user.screenshot("own_view_clicked")
    yield from user.press(SEE)
    space.region_3d.view_perspective = "CAMERA"
    yield from user.wait(0.5)
    assert not shows_live(space, bpy.context.scene)
    yield from user.press(f"{BUTTON}step_through(")
    yield from user.until(lambda: shows_live(space, bpy.context.scene), "Step Through sees through first")
    yield from user.key("Escape")
    bpy.context.scene.camera_ray_caster_overlay.show = False
    yield from user.press(SEE)


def live_mishaps(user, scenes):
    """While a view is live: a second window, a face that fails, other engines and shadings, undo, Esc, a lamp as the
    scene's camera, a camera that is deleted; each ends in a picture or a line.
    """
    yield from load(user, scenes, "toys")
    scene, space, view = bpy.context.scene, user.area().spaces.active, user.region("WINDOW")
    live, picture, engine = addon("view3d.live"), addon("view3d.live_picture"), bpy.context.scene.render.engine
    scene.camera.data.camera_ray_caster.model = "DOME_MASTER"
    bpy.ops.ed.undo_push(message="model")
    yield from user.wait(0.5)
    yield from user.press(SEE)
    yield from user.wait(1)
    middle = view.x + view.width // 3, view.y + view.height // 2

    def draws(what):
        """Wait until the camera's move is drawn."""
        view_of = next(iter(live._live[space.as_pointer()].values()))
        count, bpy.context.scene.camera.location.y = view_of.count, bpy.context.scene.camera.location.y + 0.05
        yield from user.until(lambda: view_of.count > count and not view_of.camera[2], what)

    with bpy.context.temp_override(window=user.window):
        bpy.ops.wm.window_new()
    second = bpy.context.window_manager.windows[-1]
    yield from user.wait(1)
    area = next(item for item in second.screen.areas if item.type == "VIEW_3D" or item.width > 100)
    area.type = "VIEW_3D"
    yield from user.wait(1)
    region = next(item for item in area.regions if item.type == "WINDOW")
    with bpy.context.temp_override(window=second, area=area, region=region):
        if not addon("ui.see_through").is_seen_through(bpy.context):
            bpy.ops.camera_ray_caster.see_through()
    yield from user.wait(1)
    user.screenshot("live_two_windows")
    with bpy.context.temp_override(window=second):
        bpy.ops.wm.window_close()
    yield from user.wait(0.5)
    yield from draws("a move after the second window")

    draw_face = picture._draw_face

    def fail(*_):
        raise RuntimeError("no memory for a face")

    picture._draw_face = fail
    scene.camera.location.y += 0.05
    shown = next(iter(live._live[space.as_pointer()].values()))
    yield from user.until(lambda: "no memory for a face" in shown.camera[2], "the line says why")
    yield from user.wait(0.5)
    user.screenshot("live_face_failed")
    picture._draw_face = draw_face
    yield from draws("faces that no longer fail")

    workbench, cycles = ("RENDERED", "BLENDER_WORKBENCH"), ("RENDERED", "CYCLES")
    for shading, other in (("WIREFRAME", engine), workbench, cycles, ("SOLID", engine)):
        bpy.context.scene.render.engine, space.shading.type = other, shading
        yield from user.wait(1)
    yield from draws("Solid again")
    bpy.ops.ed.undo_push(message="moved")
    yield from user.point(*middle)
    yield from user.key("g")
    yield from user.point(middle[0] + 40, middle[1])
    yield from user.key("Escape")
    for keys in ("ctrl+z", "ctrl+shift+z"):
        yield from user.key(keys)
        yield from user.wait(0.5)
    yield from draws("a move after undo and redo")
    scene, count = bpy.context.scene, next(iter(live._live[space.as_pointer()].values())).count
    active = scene.camera
    scene.camera = next(item for item in scene.objects if item.type == "LIGHT")
    yield from user.wait(1)
    user.screenshot("live_lamp")
    assert next(iter(live._live[space.as_pointer()].values())).count == count
    scene.camera = active
    yield from draws("the camera again")
    bpy.data.objects.remove(scene.camera)
    yield from user.wait(1)
    user.screenshot("live_without_camera")
    assert bpy.context.scene.render.engine == engine
    yield from load(user, scenes, "toys")
    assert not live._live
    assert not live._handles


LEFT_SCENARIOS = (left_however, own_view, live_mishaps)
