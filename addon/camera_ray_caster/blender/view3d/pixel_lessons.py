"""The pixels chosen by Step Through, their step-by-step explanations, and their rays drawn in every 3D View.

In a picture of the camera, in an Image Editor or a view through the camera, each of these pixels has a frame and its
coordinates. The view also has hit points and normals, through the camera's model. While the latest pixel is dragged in
a view, it is drawn with the mouse cursor, because Blender can redraw the cursor without the scene below it.
"""

from typing import Any

import blf
import bpy
import gpu
import numpy as np
from bpy.app.handlers import persistent

from ...core.lesson.diagram import pixel_outline
from ...core.lesson.formula import at_most
from ...core.lesson.in_picture import lines_in_picture, points_in_picture
from ...core.lesson.lesson import Lesson, lesson
from ..properties.declared import SHADING
from ..read.scene_cache import CachedScene, cached_scene
from .camera_frame import frame_in, in_pixels
from .clicked import clicked
from .lecture import write_step
from .lens_view import draw_lens, forget_lens, parts_of_paths
from .overlay import batch_of, draw_batch
from .shown import picture_frame

LENGTH_OF_MISSES = 100.0
"""Drawn length of a ray that hits nothing, in units of the camera's display size."""
RAY, OTHERS, SEEN, NORMAL = (1.0, 0.45, 0.1, 1.0), (0.7, 0.7, 0.7, 0.9), (1.0, 0.9, 0.2, 1.0), (0.3, 0.9, 0.95, 1.0)
GROUND = (0.0, 0.0, 0.0, 1.0)
WIDTH, POINT, MARK, TEXT = 2.5, 8.0, 5.0, 12.0
"""Sizes in pixels at interface scale 1: line width, point size, minimum half side of a mark, font size."""

MOST_SAMPLES = 256
"""Largest number of samples that are cast for a pixel while a sidebar is drawn: they take 0.2 s in a small scene."""

_read: list[tuple[CachedScene, dict[str, Any], dict[tuple[int, int], Lesson]]] = []


def lessons(context) -> dict[tuple[int, int], Lesson]:
    """Return the explanations of the pixels inside the frame, updated after a change of the scene or its settings."""
    scene, settings = cached_scene(context), context.scene.camera_ray_caster
    look: dict[str, Any] = {"shading": settings.shading or SHADING.default, "samples": settings.samples}
    most_digits = context.window_manager.camera_ray_caster_place.most_digits
    known_by = look | {"most_digits": most_digits}
    if not _read or _read[0][0] is not scene or _read[0][1] != known_by:
        _read[:] = [(scene, known_by, {})]
    known = _read[0][2]
    if scene.camera is None:
        return {}
    raster = scene.camera.raster
    shown = [(x, y) for x, y in clicked.pixels if x < raster.width and y < raster.height]
    with at_most(most_digits):
        for pixel in shown:
            if pixel not in known:
                known[pixel] = lesson(scene.camera, scene.shapes, *pixel, max_samples=MOST_SAMPLES, **look)
    return {pixel: known[pixel] for pixel in shown}


def draw() -> None:
    """Draw the rays, the outlines of the pixels and the points on the rays in space; called for each 3D View."""
    context = bpy.context
    if not (clicked.pixels and context.space_data.overlay.show_overlays) or picture_frame(context) is not None:
        return
    explained, scale = lessons(context), context.preferences.system.ui_scale
    size = context.scene.camera.data.display_size if explained else 0.0
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("NONE")
    for steps in explained.values():
        camera = cached_scene(context).camera
        for kind, points, color, width in (*parts_of_paths(camera, steps), *_parts(camera, steps, size)):
            if np.isfinite(points).all():
                draw_batch(batch_of(kind, points), kind, color, width * scale)
    gpu.state.blend_set("NONE")


def draw_glass() -> None:
    """Draw a real lens while steps or the overlay are shown; called by Blender for each 3D View."""
    draw_lens(bpy.context, bool(clicked.pixels))


def _parts(camera, steps: Lesson, size: float):
    """Yield (kind of shader, points, color, width) of each part drawn for a pixel."""
    yield "POLYLINE", pixel_outline(camera, size, *steps.seen.pixel), RAY, WIDTH
    origin, direction = steps.seen.origin, steps.seen.direction
    end = steps.seen.distance if np.isfinite(steps.seen.distance) else LENGTH_OF_MISSES * size
    yield "POLYLINE", [origin, origin + end * direction], RAY, WIDTH
    others = [crossing.t for meeting in steps.met for crossing in meeting.places if 0 <= crossing.t != end]
    if others:
        yield "POLYLINE", [origin + end * direction, origin + max(others) * direction], OTHERS, WIDTH / 2
        yield "POINT", [origin + t * direction for t in others], OTHERS, POINT * 0.75
    if steps.point is None:
        yield "POINT", [origin + end * direction], RAY, POINT
    else:
        yield "POLYLINE", [steps.point, steps.point + size * steps.normal], NORMAL, WIDTH
        yield "POINT", [steps.point], SEEN, POINT


def draw_in_picture(context, frame, explained) -> None:
    """Draw the points and the normals of the pixels in a view through the camera, and nothing outside of its frame."""
    camera, scale = cached_scene(context).camera, context.preferences.system.ui_scale
    gpu.state.blend_set("ALPHA")
    with in_pixels(frame, camera.raster):
        for steps in explained.values():
            for kind, points, color, width in _parts(camera, steps, context.scene.camera.data.display_size):
                if color not in (SEEN, NORMAL) or not np.isfinite(points).all():
                    continue  # a ray is a point in its camera's picture
                shown = lines_in_picture(camera, points) if kind == "POLYLINE" else points_in_picture(camera, points)
                draw_batch(batch_of(kind, shown), kind, color, width * scale)
    gpu.state.blend_set("NONE")


def draw_marks() -> None:
    """Draw the marks of the pixels, except a dragged one; called by Blender for each Image Editor and each 3D View."""
    context = bpy.context
    _draw_marks(context, clicked.pixels[:-1] if context.region.as_pointer() in clicked.held else clicked.pixels)


def draw_held(*_) -> None:
    """Draw the marks of a dragged pixel; called by Blender with the mouse cursor, in pixels of the window."""
    context = bpy.context
    if context.region is not None and context.region.as_pointer() in clicked.held:
        with gpu.matrix.push_pop():
            gpu.matrix.translate((context.region.x, context.region.y))
            _draw_marks(context, clicked.pixels[-1:])


def _draw_marks(context, shown) -> None:
    """Draw a frame around each of some pixels in the picture of the context's region."""
    every = lessons(context) if shown and context.space_data.overlay.show_overlays else {}
    explained = {pixel: steps for pixel, steps in every.items() if pixel in shown}
    if not explained:
        return
    frame = frame_in(context, cached_scene(context).camera.raster)
    settings = context.window_manager.camera_ray_caster_place
    if settings.lecture and clicked.pixels[-1] in explained and (frame is not None or context.area.type == "VIEW_3D"):
        write_step(context, explained[clicked.pixels[-1]], settings.step)
    if frame is None:
        return
    raster, scale = cached_scene(context).camera.raster, context.preferences.system.ui_scale
    if context.area.type == "VIEW_3D":
        draw_in_picture(context, frame, explained)
    corner, far = np.array(frame[:2]), np.array(frame[2:])
    side = (far - corner) / (raster.width, raster.height)
    blf.size(0, TEXT * scale)
    for pixel in explained:
        middle, half = corner + (np.array(pixel) + 0.5) * side, np.maximum(side / 2, MARK * scale)
        x, y = np.transpose([middle - half, middle + half])
        square = batch_of("POLYLINE", np.stack((x[[0, 1, 1, 1, 1, 0, 0, 0]], y[[0, 0, 0, 1, 1, 1, 1, 0]]), axis=-1))
        for color, width in ((GROUND, 2 * WIDTH), (RAY, WIDTH)):
            draw_batch(square, "POLYLINE", color, width * scale)
        blf.enable(0, blf.SHADOW)
        blf.shadow(0, 5, *GROUND)
        blf.color(0, 1, 1, 1, 1)
        blf.position(0, x[1] + MARK * scale, middle[1] - TEXT * scale / 3, 0)
        blf.draw(0, f"{pixel[0]}, {pixel[1]}")
        blf.disable(0, blf.SHADOW)


@persistent
def forget(*_):
    """Forget the pixels: another file is loaded."""
    clicked.choose([])
    clicked.hold([])
    forget_lens()
    _read.clear()


def register(undo) -> None:
    undo.callback(forget)
    undo.add_handlers(forget, "load_pre")
    undo.add_drawing(bpy.types.SpaceView3D, draw_glass, "POST_VIEW")
    undo.add_drawing(bpy.types.SpaceView3D, draw, "POST_VIEW")
    undo.add_drawing(bpy.types.SpaceView3D, draw_marks, "POST_PIXEL")
    undo.add_drawing(bpy.types.SpaceImageEditor, draw_marks, "POST_PIXEL")
    cursor = bpy.types.WindowManager.draw_cursor_add(draw_held, (), "VIEW_3D", "WINDOW")
    undo.callback(bpy.types.WindowManager.draw_cursor_remove, cursor)
