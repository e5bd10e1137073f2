"""What a user sees in several views and windows, and in files that Blender saves by itself: see scenarios.py."""

import bpy
from parts import BUTTON, addon, cast_through, load


def overlays(space):
    """What of Blender's own is shown in a 3D View."""
    return {name: getattr(space.overlay, name) for name in addon("ui.hide_overlays").MISLEADING}


def autosaved(user, scenes):
    """A file that Blender saved by itself while See Through hid outlines and grid shows them when it is opened."""
    yield from load(user, scenes, "toys")
    paths = bpy.context.preferences.filepaths
    bpy.context.scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    before = overlays(user.area().spaces.active)
    cast_through(user)
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.until(lambda: not any(overlays(user.area().spaces.active).values()), "they are hidden")
    bpy.context.scene.camera.location.x += 0.01
    bpy.ops.ed.undo_push(message="moved")
    paths.temporary_directory, paths.use_auto_save_temporary_files = str(user.folder), True
    paths.auto_save_time = 1
    yield from user.until(lambda: list(user.folder.glob("*autosave.blend")), "Blender has saved by itself")
    paths.use_auto_save_temporary_files = False
    assert not any(overlays(user.area().spaces.active).values()), "it told nobody"
    (path,) = user.folder.glob("*autosave.blend")
    bpy.ops.wm.open_mainfile(filepath=str(path))
    assert overlays(user.area().spaces.active) == before
    yield from user.until(lambda: not any(overlays(user.area().spaces.active).values()), "they are hidden again")
    bpy.ops.wm.open_mainfile(filepath=str(scenes / "toys.blend"), load_ui=False)
    assert overlays(user.area().spaces.active) == before
    assert addon("ui.hide_overlays").MARK not in user.window.screen


def quad_and_local_views(user, scenes):
    """See Through works in a quad view's camera corner and in local view, and ends as it began."""
    yield from load(user, scenes, "living_room_omnimax")
    area, button = user.area(), f"{BUTTON}see_through("
    space, before = area.spaces.active, overlays(area.spaces.active)
    group, live = bpy.context.scene.camera.data.camera_ray_caster, addon("view3d.live")._live
    in_view = {"window": user.window, "area": area, "region": user.region("WINDOW")}
    for enter in (bpy.ops.screen.region_quadview, bpy.ops.view3d.localview):
        with bpy.context.temp_override(**in_view):
            enter()
        yield from user.wait(0.5)
        group.model = "OMNIMAX"
        yield from user.press(button)
        yield from user.until(lambda: any(picture.count for picture in live[space.as_pointer()].values()), "it is live")
        user.screenshot(f"live_{enter.idname_py().rpartition('.')[2]}")
        group.model = "GENERAL_LINEAR"
        yield from user.until(lambda: not any(overlays(space).values()), "they are hidden")
        yield from user.wait(1)
        user.screenshot(f"view_{enter.idname_py().rpartition('.')[2]}")
        yield from user.press(button)
        yield from user.until(lambda: overlays(space) == before, "they come back")
        with bpy.context.temp_override(**in_view):
            enter()
        yield from user.wait(0.5)


def undone(user, scenes):
    """Each change that a button makes goes with Ctrl+Z, and comes back with Ctrl+Shift+Z; keys and drivers stay."""
    yield from load(user, scenes, "toys")
    view = user.region("WINDOW")

    def own():
        return bpy.context.scene.camera.data.camera_ray_caster

    own().model, bpy.context.scene.frame_end = "CROSS_SLIT", 9
    own().keyframe_insert("time_end", frame=1)
    bpy.ops.ed.undo_push(message="model")
    yield from user.wait(0.7)
    for name, changed in (
        ("use_this_engine", lambda: bpy.context.scene.render.engine == "CAMERA_RAY_CASTER"),
        ("add_line", lambda: own().slit_1 is not None),
    ):
        if name == "use_this_engine":
            bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
            own().model = "OMNIMAX"
            bpy.ops.ed.undo_push(message="engine")
        else:
            own().model = "CROSS_SLIT"
            bpy.ops.ed.undo_push(message="slits")
        yield from user.wait(0.7)
        yield from user.press(f"{BUTTON}{name}(")
        yield from user.until(changed, f"{name} has changed something")
        for keys, holds in (("ctrl+z", False), ("ctrl+shift+z", True)):
            yield from user.point(view.x + view.width // 3, view.y + view.height // 3)
            yield from user.key(keys)
            yield from user.until(lambda changed=changed, holds=holds: changed() is holds, f"{name}, {keys}")
        yield from user.wait(0.5)
    assert bpy.context.scene.camera.data.animation_data.action is not None


def linked_cameras(user, scenes):
    """A second scene, in a second window, whose camera is of a library: buttons act on the scene of their window, and
    settings of an override are its own.
    """
    yield from load(user, scenes, "toys")
    first, reports = bpy.context.scene, addon("output.reports")
    with bpy.data.libraries.load(str(scenes / "living_room_omnimax.blend"), link=True) as (there, here):
        here.objects = there.objects
    second = bpy.data.scenes.new("Second")
    for item in here.objects:
        second.collection.objects.link(item)
    second.camera = next(item for item in here.objects if item.type == "CAMERA")
    second.render.resolution_percentage = 20
    with bpy.context.temp_override(window=user.window):
        bpy.ops.wm.window_new_main()  # another of the first window would show the same scene
    other = bpy.context.window_manager.windows[-1]
    other.scene = second
    yield from user.wait(1)
    user.screenshot("two_windows")
    with bpy.context.temp_override(window=other):
        bpy.ops.wm.window_close()
    yield from user.wait(0.5)
    yield from user.press(f"{BUTTON}verify(")
    yield from user.until(lambda: reports.verified(first), "the first is verified")
    assert reports.verified(second) is None

    user.window.scene = second
    yield from user.wait(0.7)
    user.screenshot("linked_camera")
    yield from user.press(f"{BUTTON}verify(")
    yield from user.until(lambda: reports.verified(second), "the second is verified")
    assert reports.verified(second).camera["model"] == "Omnimax"
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(lambda: reports.latest(second), "it is cast")
    assert reports.latest(first) is None
    linked = second.camera
    linked.override_create(remap_local_usages=True).data.override_create(remap_local_usages=True)
    assert (linked.library is None, second.camera.library) == (False, None)
    second.camera.data.camera_ray_caster.model = "CAMERA_OBSCURA"
    yield from user.wait(0.7)
    user.screenshot("overridden_camera")
    yield from user.press(f"{BUTTON}verify(")
    yield from user.until(lambda: reports.verified(second).camera["model"] == "Camera Obscura", "it is verified")
    assert linked.data.camera_ray_caster.model == "OMNIMAX"


VIEWS_SCENARIOS = (autosaved, quad_and_local_views, undone, linked_cameras)
