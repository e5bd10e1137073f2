"""What a user sees of a live view through the camera's model, one scenario a function: see scenarios.py."""

import time
from colorsys import hsv_to_rgb
from glob import glob
from resource import RUSAGE_SELF, getrusage

import bpy
import numpy as np
from lesson_scenarios import place_of
from parts import BUTTON, addon, load
from stranger_scenarios import default_scene

REDRAWS = 6
# Most times the processor time of Blender's own redraw, both with antialiasing, as a user has it: 2.4 to 2.7 measured
# alone, 2.6 and 2.9 beside two other windows, 1.5 to 1.8 without antialiasing. 2.5 is aimed at.
SHARE = 3.0
TRIES = 4
"""At most, until a measurement is not of a busy machine."""
EDGE = 2
"""Pixels from an edge at which colors are compared; a pixel of the picture is 1.02 of the window's."""
EEVEES = 4e6
"""KB that EEVEE may take, for Blender's own view and one canvas: 2.2 GB were measured, and 6.1 GB with a buffer for
each of five faces.
"""
GRID = np.linspace(0.05, 0.95, 24)


def live_picture(user, scenes):
    """In Solid with flat colors each pixel of a live view, through six models, has the color of the object that our own
    ray hits, as near as a pixel to an edge; a click selects it.
    """
    yield from load(user, scenes, "living_room")
    scene, space, view = bpy.context.scene, user.area().spaces.active, user.region("WINDOW")
    items, engine = [item for item in scene.objects if item.type == "MESH"], scene.render.engine
    for number, item in enumerate(items):
        item.color = (*hsv_to_rgb(number * 0.618 % 1, 1 - number % 3 / 4, 1 - number % 4 / 6), 1)
    space.overlay.show_overlays, space.shading.light, space.shading.color_type = False, "FLAT", "OBJECT"
    space.show_gizmo_navigate = False  # Blender draws it over the picture
    scene.display.viewport_aa = "OFF"
    bpy.context.preferences.system.viewport_aa = "OFF"
    space.shading.show_cavity = space.shading.show_object_outline = space.shading.show_shadows = False
    group, cast = scene.camera.data.camera_ray_caster, addon("view3d.mouse_gizmo").probe.__globals__["passes_at"]
    yield from user.press(f"{BUTTON}see_through(")
    for model in ("DOME_MASTER", "OMNIMAX", "CYLINDRICAL", "FISHEYE_STEREOGRAPHIC", "FISHEYE_ORTHOGRAPHIC", "UCM"):
        group.model = model
        yield from user.wait(1.2)
        shown = user.picture(f"live_{model.lower()}")
        seen = addon("read.scene_cache").cached_scene(bpy.context)
        width, height = seen.camera.raster.size
        compared, off = 0, []
        columns, rows = ((GRID * size).astype(int) for size in (width, height))
        around = [(places[:, None] + np.arange(-EDGE, EDGE + 1)).ravel() for places in (columns, rows)]
        indices = cast(seen.camera, seen.shapes, *around, ("shape_index",))["shape_index"]
        indices = indices.reshape(len(rows), 2 * EDGE + 1, len(columns), 2 * EDGE + 1).swapaxes(1, 2)
        left, bottom = place_of(user, 0, 0)
        across, up = np.subtract(place_of(user, 1, 1), (left, bottom))
        for j, i in np.ndindex(len(rows), len(columns)):
            at, index = (left + columns[i] * across, bottom + rows[j] * up), indices[j, i].ravel()
            if not (view.x + 60 < at[0] < view.x + view.width - 320 and at[1] < view.y + view.height - 60):
                continue  # covered by the tools, the sidebar or the header
            if len(set(index)) > 1 or index[0] < 0:
                continue
            name = seen.shapes.names[seen.shapes.name_index[index[0]]]
            color, color_seen = np.array(bpy.data.objects[name].color[:3]), shown[int(at[1]), int(at[0]), :3]
            color_seen = np.where(color_seen < 0.04045, color_seen / 12.92, ((color_seen + 0.055) / 1.055) ** 2.4)
            compared += 1
            off += [(name, at, color_seen, color)] if np.abs(color_seen - color).max() > 0.03 else []
        print(f"{model}: {compared} pixels, {len(off)} off")
        assert compared > 100
        assert not off, (model, len(off), compared, off[:3])
        if model == "OMNIMAX":
            for x, y in ((0.3, 0.3), (0.5, 0.35), (0.65, 0.3)):
                pixel = int(x * width), int(y * height)
                yield from user.click(*place_of(user, *pixel))
                name = addon("view3d.mouse_gizmo").probe(seen.camera, seen.shapes, *pixel).name
                assert [item.name for item in bpy.context.selected_objects] == [name]
    assert scene.render.engine == engine
    yield from user.press(f"{BUTTON}see_through(")
    space.overlay.show_overlays, space.shading.light, space.shading.color_type = True, "STUDIO", "MATERIAL"
    space.show_gizmo_navigate = True


def live_ends(user, scenes):
    """A live view is restored: by a second press, when a model that cannot be warped is chosen, in a saved file and in
    another one; nothing stays.
    """
    yield from load(user, scenes, "toys")
    scene, space, live = bpy.context.scene, user.area().spaces.active, addon("view3d.live")
    group, engine, button = scene.camera.data.camera_ray_caster, scene.render.engine, f"{BUTTON}see_through("
    group.model = "DOME_MASTER"
    yield from user.wait(0.5)
    before = space.region_3d.view_perspective, space.shading.type, space.shading.use_world_space_lighting, engine

    def now():
        shading = space.shading
        return space.region_3d.view_perspective, shading.type, shading.use_world_space_lighting, scene.render.engine

    for _ in range(2):
        yield from user.press(button)
        yield from user.until(lambda: now() == ("CAMERA", "SOLID", True, engine), "it is live")
        yield from user.press(button)
        yield from user.until(lambda: now() == before, "it is as it was")
        assert not live._handles
        assert not any(function in getattr(bpy.app.handlers, name) for name, function in live.HANDLERS)
    yield from user.press(button)
    yield from user.wait(0.5)
    user.screenshot("live_toys")
    group.model = "TWISTED_ORTHOGRAPHIC"
    yield from user.until(lambda: now() == ("CAMERA", "RENDERED", False, "CAMERA_RAY_CASTER"), "it is cast")
    yield from user.wait(1)
    user.screenshot("live_cast_instead")
    group.model = "DOME_MASTER"
    yield from user.until(lambda: now() == ("CAMERA", "SOLID", True, engine), "it is live again")
    path = str(user.folder / "live.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    yield from user.until(lambda: now() == ("CAMERA", "SOLID", True, engine), "it is live after saving")
    space.shading.light = "MATCAP"
    yield from user.wait(0.7)
    assert live.MATCAP in list(said(user))
    user.screenshot("live_matcap")
    space.shading.light = "STUDIO"
    bpy.ops.wm.open_mainfile(filepath=path, load_ui=True)
    assert not live._live
    assert not live._handles
    scene, space = bpy.context.scene, user.area().spaces.active
    assert not space.shading.use_world_space_lighting
    assert scene.render.engine == engine
    yield from user.wait(0.5)


def live_shadings(user, scenes):
    """Material Preview, and Rendered with Workbench, are drawn through the model, too. EEVEE's shaders are compiled
    first, which takes minutes with software OpenGL; Rendered with EEVEE would compile more.
    """
    yield from load(user, scenes, "spheres_and_planes")
    scene, space, view = bpy.context.scene, user.area().spaces.active, user.region("WINDOW")
    scene.camera.data.camera_ray_caster.model, space.overlay.show_overlays = "DOME_MASTER", False
    scene.camera.data.camera_ray_caster.tilt, scene.eevee.taa_samples = 1.2, 1
    yield from user.wait(0.5)
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.wait(0.5)
    (region,) = addon("view3d.live")._live[space.as_pointer()].values()
    before = getrusage(RUSAGE_SELF).ru_maxrss
    eevee = "BLENDER_EEVEE" if bpy.app.version >= (5, 0) else "BLENDER_EEVEE_NEXT"
    for shading, engine in (("RENDERED", "BLENDER_WORKBENCH"), ("MATERIAL", eevee)):
        began, count = time.process_time(), region.count
        scene.render.engine, space.shading.type = engine, shading
        yield from user.until(lambda count=count: region.count > count, "it is drawn", 600)
        first = time.process_time() - began
        yield from user.wait(0.5)
        count, began = region.count, time.process_time()
        for _ in range(3):
            scene.camera.location.y += 0.02
            user.area().tag_redraw()
            yield from user.until(lambda count=count: region.count > count, "it is drawn again")
            count = region.count
        again = (time.process_time() - began) / 3
        print(f"{shading}, {scene.render.engine}: {first:.1f} s of processor time at first, then {1e3 * again:.0f} ms")
        yield from user.wait(0.5)
        shown = user.cut(user.picture(f"live_{shading}_{scene.render.engine}".lower()), view)
        assert not region.camera[2]
        assert shown[view.height // 2 - 100 : view.height // 2 + 100, 450:650, :3].std() > 0.02
    grown = getrusage(RUSAGE_SELF).ru_maxrss - before
    print(f"EEVEE takes {grown / 1e6:.1f} GB")
    assert grown < EEVEES, grown
    yield from user.press(f"{BUTTON}see_through(")
    space.overlay.show_overlays = True


def live_look(user, scenes):
    """A fisheye of 180 degrees in a living room, with an object that a click has selected, in the dark and the light
    theme.
    """
    yield from load(user, scenes, "living_room")
    scene, space, view = bpy.context.scene, user.area().spaces.active, user.region("WINDOW")
    scene.camera.data.type, scene.camera.data.panorama_type = "PANO", "FISHEYE_EQUISOLID"
    scene.camera.data.fisheye_lens, scene.camera.data.fisheye_fov = 9.6, np.pi
    scene.render.resolution_x, scene.render.resolution_y = 700, 620
    scene.camera.location, scene.camera.rotation_euler = (0.9, -1.3, 1.5), (1.35, 0, 0.35)
    space.shading.color_type, space.overlay.show_overlays = "TEXTURE", True
    yield from user.wait(0.5)
    yield from user.press(f"{BUTTON}see_through(")
    space.region_3d.view_camera_zoom, space.region_3d.view_camera_offset = 20, (0.12, 0)
    yield from user.wait(1)
    (region,) = addon("view3d.live")._live[space.as_pointer()].values()
    count = region.count
    yield from user.click(view.x + view.width * 0.53, view.y + view.height * 0.31)
    yield from user.until(lambda: region.count > count, "the outline of what is selected is drawn")
    assert [item.name for item in bpy.context.selected_objects] == [bpy.context.object.name]
    yield from user.wait(1)
    user.screenshot("live_look", [user.area()])
    (theme,) = (path for folder in bpy.utils.preset_paths("interface_theme") for path in glob(f"{folder}/*Light.xml"))
    bpy.ops.script.execute_preset(filepath=theme, menu_idname="USERPREF_MT_interface_theme_presets")
    yield from user.wait(1)
    user.screenshot("live_look_light", [user.area()])
    bpy.ops.preferences.reset_default_theme()
    yield from user.press(f"{BUTTON}see_through(")


def said(user):
    """What the notice of the view says."""
    with bpy.context.temp_override(window=user.window, area=user.area(), region=user.region("WINDOW")):
        yield from addon("view3d.notice")._sentences(bpy.context)


def live_redraws(user, scenes):
    """A redraw while the camera moves takes little more than Blender's own; a still view draws no face again. Beside
    it the first pictures of a cast of models that cannot be warped: a warp of faces would be no quicker than they are.
    """
    for name in ("living_room", "street"):
        yield from load(user, scenes, name)
        scene, area, drawn = bpy.context.scene, user.area(), []
        space, view, live = area.spaces.active, bpy.types.SpaceView3D, addon("view3d.live")
        handle = view.draw_handler_add(lambda drawn=drawn: drawn.append(1), (), "WINDOW", "POST_PIXEL")
        space.region_3d.view_perspective = "CAMERA"

        def moved(scene=scene, area=area, drawn=drawn):
            yield from user.wait(1)
            drawn.clear()
            times = [time.process_time()]
            for count in range(1, REDRAWS + 1):
                scene.camera.location.y += 0.02
                area.tag_redraw()
                yield from user.until(lambda count=count: len(drawn) >= count, "it is drawn")
                times.append(time.process_time())
            return 1e3 * np.diff(times).min()  # other programs share the caches: they add to most redraws

        for turn in range(TRIES):
            if turn:
                yield from user.press(f"{BUTTON}see_through(")
            scene.camera.data.camera_ray_caster.model = "BLENDER"
            plain = yield from moved()
            scene.camera.data.camera_ray_caster.model = "DOME_MASTER"
            yield from user.wait(0.5)
            yield from user.press(f"{BUTTON}see_through(")
            warped = yield from moved()
            if warped < SHARE * plain:
                break
        width, height = user.region("WINDOW").width, user.region("WINDOW").height
        print(f"{name}, {width} x {height}, Solid: {plain:.0f} ms of processor time a redraw, live {warped:.0f}")
        assert warped < SHARE * plain
        yield from user.wait(1)
        (region,) = live._live[space.as_pointer()].values()
        count = region.count
        for _ in range(3):
            area.tag_redraw()
            yield from user.wait(0.2)
        assert region.count == count
        for model in ("CROSS_SLIT", "GENERAL_LINEAR", "PUSHBROOM"):
            scene.camera.data.camera_ray_caster.model = model
            yield from user.until(lambda scene=scene: scene.render.engine == "CAMERA_RAY_CASTER", "it is cast")
            picture = yield from moved()
            print(f"{name}, {model}: {picture:.0f} ms")
            assert picture < warped, model
        view.draw_handler_remove(handle, "WINDOW")
        yield from user.press(f"{BUTTON}see_through(")


def live_edges(user, scenes):
    """In the corners of a fisheye's frame, where no ray is, nothing of Blender's own view is left, a red wall: neither
    at once after a change nor once the view has settled.
    """
    yield from default_scene(user)
    scene, area, view = bpy.context.scene, user.area(), user.region("WINDOW")
    space, wall, live = area.spaces.active, bpy.data.objects["Cube"], addon("view3d.live")
    wall.location, wall.scale, wall.color = scene.camera.location, (30, 30, 30), (1, 0, 0, 1)
    scene.camera.data.camera_ray_caster.model = "DOME_MASTER"
    scene.render.resolution_x = scene.render.resolution_y = 512
    space.shading.light, space.shading.color_type = "FLAT", "OBJECT"
    space.show_gizmo_navigate = space.overlay.show_axis_x = space.overlay.show_cursor = False  # they are red, too
    bpy.ops.object.select_all(action="DESELECT")
    yield from user.wait(0.5)
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.wait(0.5)
    (region,), settled = live._live[space.as_pointer()].values(), live.SETTLED
    for zoom in (0.0, 3.7, -7.3):
        space.region_3d.view_camera_zoom = zoom
        yield from user.wait(1)
        with bpy.context.temp_override(window=user.window, area=area, region=view):
            frame = addon("read.view").camera_frame(bpy.context)
        for moment in ("settled", "changed"):
            if moment == "changed":
                count, live.SETTLED = region.count, 5.0
                scene.camera.location.x += 0.1
                yield from user.until(lambda count=count: region.count > count, "it is drawn")
                live.SETTLED = settled
            shown = user.cut(user.picture(f"live_edges_{moment}"), view)
            rows, columns = np.nonzero(shown[..., 0] > 2 * shown[..., 1] + 0.1)
            x = 2 * (columns + 0.5 - frame[0]) / (frame[2] - frame[0]) - 1
            y = 2 * (rows + 0.5 - frame[1]) / (frame[3] - frame[1]) - 1
            left = np.hypot(x, y) > 1.02
            assert (~left).sum() > 1000, "the wall is seen"
            assert not left.any(), (zoom, moment, left.sum())
    space.shading.light, space.shading.color_type = "STUDIO", "MATERIAL"
    space.show_gizmo_navigate = space.overlay.show_axis_x = space.overlay.show_cursor = True
    yield from user.press(f"{BUTTON}see_through(")


LIVE_SCENARIOS = (live_picture, live_ends, live_redraws, live_shadings, live_look, live_edges)
