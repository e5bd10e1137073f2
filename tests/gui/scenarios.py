"""What a user does in the window, one scenario a function: steps, and what must then hold."""

from types import SimpleNamespace

import _cycles
import bpy
import numpy as np
from all_scenarios import ALL_SCENARIOS
from animated_scenarios import ANIMATED_SCENARIOS
from camera_scenarios import CAMERA_SCENARIOS
from cast_scenarios import CAST_SCENARIOS
from left_scenarios import LEFT_SCENARIOS
from lesson_scenarios import LESSON_SCENARIOS
from live_scenarios import LIVE_SCENARIOS
from parts import BUTTON, MODULE, addon, load, timed
from points_scenarios import POINTS_SCENARIOS
from redraw_scenarios import REDRAW_SCENARIOS
from saved_scenarios import SAVED_SCENARIOS
from stranger_scenarios import ROW, STRANGER_SCENARIOS, open_menu
from time_scenarios import TIME_SCENARIOS
from user import PATIENCE, pixels_of
from views_scenarios import VIEWS_SCENARIOS
from walk_scenarios import WALK_SCENARIOS
from window_scenarios import WINDOW_SCENARIOS

LEFT_OUT = 3.4
"""Rows from the button Cast down to the row of what is left out."""
DRAWN = 0.004
"""Seconds of the processor for a panel's quickest drawing: a quarter of a frame of 60 a second. It takes 1 to 2 ms."""


def panel(user, scenes):
    """Verify and cast from the sidebar: the report and the images are there, shown, and stay after an undo."""
    yield from load(user, scenes, "spheres_and_planes")
    area = user.area("DOPESHEET_EDITOR")
    area.ui_type = "IMAGE_EDITOR"
    timings = {}
    for name in (
        "ui.camera_panels",
        "ui.facts_panels",
        "ui.verify_panels",
        "ui.cast_panels",
        "ui.overlay_panels",
    ):
        for kind in vars(addon(name)).values():
            if isinstance(kind, type) and issubclass(kind, bpy.types.Panel) and "draw" in vars(kind):
                timed(kind, timings.setdefault(kind.__name__, []))
    yield from user.wait(0.5)
    user.screenshot("panel_before")
    yield from user.press(f"{BUTTON}verify(")
    yield from user.until(addon("output.reports").verified, "the camera is verified")
    assert addon("output.reports").verified().passed
    assert addon("output.reports").latest() is None
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(addon("output.reports").latest, "the cast has ended")
    yield from user.wait(0.5)
    user.screenshot("panel_after")
    report, scene = addon("output.reports").latest(), bpy.context.scene
    assert report.passed
    assert report.pixels == scene.render.resolution_x * scene.render.resolution_y
    assert area.spaces.active.image == bpy.data.images["Ray Caster combined"]
    depth = pixels_of(bpy.data.images["Ray Caster depth"])[..., 0]
    assert depth.min() > scene.camera.data.clip_start
    assert depth.max() == addon("properties.pass_properties").FAR
    print({name: f"{1e3 * np.median(seconds or [0]):.2f} ms" for name, seconds in timings.items()})
    assert all(timings[name] for name in ("SidebarCamera", "SidebarVerify", "SidebarCast", "SidebarFacts"))
    slow = {name: min(seconds) for name, seconds in timings.items() if min(seconds, default=0) > DRAWN}
    assert not slow, slow
    depth = pixels_of(bpy.data.images["Ray Caster depth"])
    bpy.ops.ed.undo_push(message="something")
    yield from user.point(area.x + area.width // 3, area.y + area.height // 2)
    yield from user.key("ctrl+z")
    yield from user.wait(0.5)
    assert np.array_equal(pixels_of(bpy.data.images["Ray Caster depth"]), depth)
    assert area.spaces.active.image == bpy.data.images["Ray Caster combined"]
    area.ui_type = "TIMELINE"


def no_camera(user, scenes):
    """Without a camera the buttons are gray and the panel says why."""
    yield from load(user, scenes, "empty")
    bpy.context.scene.camera = None
    yield from user.wait(0.5)
    user.screenshot("no_camera")
    yield from user.press(f"{BUTTON}cast(")
    assert addon("output.reports").latest() is None
    assert not bpy.data.images
    bpy.context.scene.camera = next(item for item in bpy.data.objects if item.type == "CAMERA")
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(addon("output.reports").latest, "the cast has ended")
    assert addon("output.reports").latest().shapes == 0


def left_out(user, scenes):
    """What is left out is counted in the sidebar, and named by reason in a popover, with a button that selects it."""
    yield from load(user, scenes, "left_out")
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(addon("output.reports").latest, "the cast has ended")
    names = addon("output.reports").by_reason(addon("output.reports").latest())
    yield from user.wait(0.5)
    user.screenshot("left_out")
    yield from open_menu(user, f"{BUTTON}cast(", LEFT_OUT, 0.4)
    user.screenshot("left_out_popover")
    region, top = user.region(), round(user.known[f"{BUTTON}cast("] - LEFT_OUT * ROW)
    popover = SimpleNamespace(x=region.x, width=region.width, y=top + 20, height=250)  # it opens above
    yield from user.press(f"{BUTTON}select(", popover)
    chosen = {item.name for item in bpy.context.view_layer.objects if item.select_get()}
    assert chosen in [set(group) for group in names.values()], (names, chosen)


def overlay(user, scenes):
    """The overlay is seen, follows the camera, and goes; for a fisheye too."""
    yield from load(user, scenes, "spheres_and_planes")
    scene, view = bpy.context.scene, user.region("WINDOW")
    user.area().spaces.active.region_3d.view_distance = 26
    yield from user.wait(0.5)

    def changed(before, after):
        return np.count_nonzero(np.abs(user.cut(before, view) - user.cut(after, view)).max(axis=2) > 0.1)

    def changes(name, before):
        return user.until(lambda: changed(before, user.picture(name)) > 3000, f"{name} is seen")

    off = user.picture("overlay_off")
    scene.camera_ray_caster_overlay.show = True
    user.area().tag_redraw()  # as a click on the switch does
    yield from changes("overlay", off)
    yield from user.wait(0.7)
    on = user.picture("overlay")
    scene.camera.location.x += 3
    yield from changes("overlay_moved", on)
    scene.camera.data.type = "PANO"
    scene.camera.data.panorama_type = "FISHEYE_EQUIDISTANT"
    yield from user.wait(0.7)
    user.screenshot("overlay_fisheye")
    scene.camera.data.type = "PERSP"
    scene.camera.location.x -= 3
    scene.camera_ray_caster_overlay.show = False
    user.area().tag_redraw()
    yield from user.until(lambda: changed(off, user.picture("overlay_gone")) < 100, "it is gone")
    scene.camera_ray_caster_overlay.show = True
    yield from user.press(f"{BUTTON}verify(")
    yield from user.until(addon("output.reports").verified, "the camera is verified")
    yield from user.wait(0.7)
    user.screenshot("sidebar_and_overlay", [user.area()])
    scene.camera_ray_caster_overlay.show = False


def ray_under_mouse(user, scenes):
    """In camera view the mouse is told of its pixel's ray."""
    yield from load(user, scenes, "spheres_and_planes")
    scene, view = bpy.context.scene, user.region("WINDOW")
    user.area().spaces.active.region_3d.view_perspective = "CAMERA"
    scene.camera_ray_caster_overlay.show = True
    written_lines = []
    gizmo = addon("view3d.mouse_gizmo")
    write = gizmo._write
    gizmo._write = lambda context, mouse, lines: (written_lines.append(dict(lines)), write(context, mouse, lines))
    yield from user.point(view.x + view.width // 2, view.y + view.height // 2)
    yield from user.until(lambda: written_lines, "the mouse is told")
    yield from user.wait(0.5)
    user.screenshot("ray_under_mouse")
    column, row = map(int, written_lines[-1]["Pixel"].removesuffix(" from the bottom left").split(", "))
    assert abs(column - scene.render.resolution_x / 2) < 10
    assert abs(row - scene.render.resolution_y / 2) < 10
    assert written_lines[-1]["Hit"] in bpy.data.objects
    gizmo._write = write


def viewport(user, scenes):
    """Rendered shading shows in camera view what a render shows, where Blender draws the camera's frame."""
    yield from load(user, scenes, "spheres_and_planes")
    scene, space, view = bpy.context.scene, user.area().spaces.active, user.region("WINDOW")
    scene.render.engine = "CAMERA_RAY_CASTER"
    space.overlay.show_overlays = False
    space.region_3d.view_perspective = "CAMERA"
    scene.render.filepath = str(user.folder / "f12.png")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    rendered = pixels_of(image)
    space.shading.type = "RENDERED"
    for kind, zoom, offset in (("camera", 0, (0, 0)), ("camera zoomed", 20, (0.06, -0.04))):
        space.region_3d.view_camera_zoom, space.region_3d.view_camera_offset = zoom, offset
        yield from user.wait(2)
        shown = user.cut(user.picture(kind.replace(" ", "_")), view)
        area, region = user.area(), view
        with bpy.context.temp_override(window=user.window, area=area, region=region):
            left, bottom, right, top = addon("read.view").camera_frame(bpy.context)
        differences = []
        for u in np.linspace(0.02, 0.98, 25):
            for v in np.linspace(0.02, 0.98, 15):
                x, y = left + u * (right - left), bottom + v * (top - bottom)
                row, column = int(v * rendered.shape[0]), int(u * rendered.shape[1])
                around = rendered[row - 8 : row + 9, column - 8 : column + 9, :3]
                plain = np.ptp(around, axis=(0, 1)).max() < 0.02  # no edge within two pixels of the window
                if plain and 60 < x < region.width - 400 and 0 < y < region.height - 100:  # beside tools and sidebar
                    differences.append(np.abs(shown[int(y), int(x), :3] - around.mean(axis=(0, 1))).max())
        assert len(differences) > 60, len(differences)
        assert np.max(differences) < 0.03, (kind, np.sort(differences)[-5:])
    for perspective in ("PERSP", "ORTHO"):
        space.region_3d.view_perspective = perspective
        yield from user.wait(1.5)
        user.screenshot(f"view_{perspective.lower()}")
    space.overlay.show_overlays = True
    space.shading.type = "SOLID"


def cycles(user, scenes):
    """A camera of a model that Blender does not have is made one of Cycles, or Blender's nearest, and seen there."""
    yield from load(user, scenes, "toys")
    scene, view = bpy.context.scene, user.area()
    camera = scene.camera
    bpy.context.view_layer.objects.active = camera
    camera.data.camera_ray_caster.model = "OMNIMAX"
    scene.render.engine = "CYCLES"
    scene.cycles.samples = scene.cycles.preview_samples = 8
    view.ui_type = "PROPERTIES"
    view.spaces.active.context = "DATA"
    yield from user.wait(1)
    user.screenshot("cycles_button")
    properties = next(region for region in view.regions if region.type == "WINDOW")
    yield from user.press(f"{BUTTON}use_in_cycles(", properties)
    yield from user.wait(2)
    user.screenshot("cycles_way_back")
    if _cycles.with_osl:
        assert camera.data.type == "CUSTOM"
    else:  # as Debian builds it: the button says so, the camera is as it was, and a dome is Blender's own fisheye
        assert (camera.data.type, len(bpy.data.texts)) == ("PERSP", 0)
        yield from user.key("Escape")  # closes the message
        camera.data.camera_ray_caster.model = "DOME_MASTER"
        yield from user.wait(1)
        yield from user.find(f"{BUTTON}fit_lens(", properties, share=2 / 3)
        user.send("click", 1)
        yield from user.wait(2)
        assert (scene.camera.data.type, scene.camera.parent) == ("PANO", camera)
        user.screenshot("cycles_fitted")
    view.ui_type = "VIEW_3D"
    yield from user.wait(0.5)
    space = view.spaces.active
    space.region_3d.view_perspective, space.overlay.show_overlays = "CAMERA", False
    space.shading.type = "RENDERED"
    shown = np.zeros(3)
    for _ in range(PATIENCE):
        yield from user.wait(1)
        shown = user.cut(user.picture("cycles_omnimax"), user.region("WINDOW"))[..., :3]
        if shown.std() > 0.05:  # a picture, and not one color
            break
    assert shown.std() > 0.05
    space.shading.type = "SOLID"
    space.overlay.show_overlays = True


def disable(user, scenes):
    """Disabled with everything on, it leaves no drawing, no timer and no panel."""
    yield from load(user, scenes, "spheres_and_planes")
    scene, space = bpy.context.scene, user.area().spaces.active
    scene.camera_ray_caster_overlay.show = True
    scene.render.engine = "CAMERA_RAY_CASTER"
    space.shading.type = "RENDERED"
    yield from user.wait(1)
    for _ in range(10):
        timer = addon("engine.viewport").redraw_if_finished
        bpy.ops.preferences.addon_disable(module=MODULE)
        space.shading.type = "SOLID"  # before the view is drawn by another engine, which takes its time
        assert not bpy.app.timers.is_registered(timer)
        assert not hasattr(bpy.types, "CAMERA_RAY_CASTER_PT_camera")
        yield
        bpy.ops.preferences.addon_enable(module=MODULE)
        yield
    yield from user.wait(1)
    bpy.ops.preferences.addon_disable(module=MODULE)
    yield from user.wait(1)
    user.screenshot("disabled")
    assert not hasattr(bpy.types.Scene, "camera_ray_caster_overlay")


SCENARIOS = {
    scenario.__name__: scenario
    for scenario in (
        panel, no_camera, left_out, *CAST_SCENARIOS, overlay, ray_under_mouse, viewport,
        cycles, *CAMERA_SCENARIOS, *LESSON_SCENARIOS, *STRANGER_SCENARIOS, *REDRAW_SCENARIOS, *WINDOW_SCENARIOS,
        *ALL_SCENARIOS, *WALK_SCENARIOS, *POINTS_SCENARIOS, *VIEWS_SCENARIOS, *ANIMATED_SCENARIOS, *SAVED_SCENARIOS,
        *LIVE_SCENARIOS, *LEFT_SCENARIOS, *TIME_SCENARIOS, disable,
    )
}  # fmt: skip
