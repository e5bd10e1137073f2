"""What a user finds in a file that was saved while something was running or shown: see scenarios.py."""

import bpy
from cast_scenarios import begin as begin_cast
from lesson_scenarios import place_of
from parts import BUTTON, addon, load
from views_scenarios import overlays
from window_scenarios import middle


def saved_views(user, scenes):
    """While See Through is on, a pixel is shown, or points are swept."""
    yield from saved(user, scenes, a_sweep, see_through, a_pixel)


def saved_runs(user, scenes):
    """While a cast runs."""
    yield from saved(user, scenes, a_cast)


def saved(user, scenes, *states):
    """A file that is saved in each of some states is opened again as if nothing had been: nothing is stuck, no handler
    is there twice, and the panel works.
    """
    yield from load(user, scenes, "toys")  # which ends what a scenario before has begun
    handlers = every_handler()
    for begin in states:
        held = yield from begin(user, scenes)
        path = user.folder / f"{begin.__name__}.blend"
        yield from save(user, path)
        user.screenshot(f"saved_{begin.__name__}")
        bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=True)
        yield from user.wait(1)
        user.screenshot(f"reopened_{begin.__name__}")
        held()
        assert every_handler() == handlers
        assert addon("ui.cast_operator").fraction() is None
        assert not addon("ui.lesson_operators")._waiting
        assert not addon("view3d.pixel_lessons").clicked.pixels
        user.area().spaces.active.shading.type = "SOLID"
        yield from user.press(f"{BUTTON}verify(")
        yield from user.until(addon("output.reports").verified, "the camera is verified")
        bpy.context.scene.camera_ray_caster_overlay.show = False


def save(user, path):
    """Save with Ctrl+S: the file has that name already. Pictures that are rendered lock the window, but not between two
    of them.
    """
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    before = path.stat().st_mtime_ns
    yield from user.point(*middle(user.region("WINDOW")))
    for _ in range(40):
        yield from user.key("ctrl+s")
        if path.stat().st_mtime_ns > before:
            return
    raise AssertionError("it is not saved")


def see_through(user, scenes):
    """Look through a camera that is cast: in the file what was hidden is back, and so are shading and engine."""
    yield from load(user, scenes, "living_room_omnimax")
    bpy.context.scene.render.engine, before = "BLENDER_WORKBENCH", overlays(user.area().spaces.active)
    bpy.context.scene.camera.data.camera_ray_caster.model = "GENERAL_LINEAR"  # of many origins: a cast shows it
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.until(lambda: not any(overlays(user.area().spaces.active).values()), "they are hidden")

    def held():
        assert overlays(user.area().spaces.active) == before
        assert addon("ui.hide_overlays").MARK not in user.window.screen
        assert bpy.context.scene.render.engine == "BLENDER_WORKBENCH"
        assert user.area().spaces.active.shading.type == "SOLID"

    return held


def a_pixel(user, scenes):
    """Click a pixel, and wait for more."""
    yield from load(user, scenes, "toys")
    yield from user.press(f"{BUTTON}step_through(")
    yield from user.click(*place_of(user, 400, 200))
    assert addon("view3d.pixel_lessons").clicked.pixels
    return lambda: None


def a_cast(user, scenes):
    """Cast for long: nothing of it is there."""
    yield from begin_cast(user, scenes, 16384, "distance_bound")

    def held():
        assert addon("output.reports").latest() is None
        assert not [image for image in bpy.data.images if image.name.startswith("Ray Caster")]

    return held


def a_sweep(user, scenes):
    """Draw the points that a scanner has swept: they are drawn again."""
    yield from load(user, scenes, "street_scanner")
    overlay, points = bpy.context.scene.camera_ray_caster_overlay, addon("view3d.hit_points")
    overlay.show = overlay.show_points = overlay.show_sweep = True
    user.area().tag_redraw()
    yield from user.until(lambda: points._drawn, "the points are measured")

    def held():
        settings = bpy.context.scene.camera_ray_caster_overlay
        assert settings.show_sweep
        assert points._drawn[0][0] is addon("read.scene_cache").cached_scene(bpy.context)

    return held


def every_handler():
    """How often each of our functions is called by Blender."""
    lists = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {
        name: [function.__qualname__ for function in handlers if "camera_ray_caster" in function.__module__]
        for name, handlers in lists.items() if isinstance(handlers, list)
    }  # fmt: skip


SAVED_SCENARIOS = (saved_views, saved_runs)
