"""A notice at the bottom of a 3D View: why its camera cannot be cast, and differences between the view and a render.

A view shows all pixels at one frame, and the notice says so, until the scene has been evaluated at other frames.
The shapes are read once for all views, so the notice also says that rays are not limited to Local View.
"""

from collections.abc import Iterator

import bpy

from ..properties.declared import ENGINE
from ..read import other_times
from ..read.scene_cache import TIMES, cached_scene
from . import live, text
from .shown import is_live

EDGE_DISTANCE = 28
"""Distance between the text and the edge, in pixels at interface scale 1."""
LOCAL_VIEW = "Rays see the whole scene, not only the objects in Local View"


def draw() -> None:
    """Write the notice, if there is one; called by Blender for each 3D View."""
    context = bpy.context
    sentences = list(_sentences(context))
    if sentences:
        margin, (left, right) = EDGE_DISTANCE * context.preferences.system.ui_scale, text.uncovered(context)
        width = right - left - 2 * margin
        lines = [("", line) for sentence in sentences for line in text.wrapped(context, sentence, width)]
        text.write(context, lines, lambda width, height: ((left + right - width) / 2, height + margin))


def _sentences(context) -> Iterator[str]:
    """Yield the sentences for a view that shows the camera's picture or another one of this engine, or the overlay."""
    scene, space = context.scene, context.space_data
    is_rendered = space.shading.type == "RENDERED" and scene.render.engine == ENGINE
    is_overlaid = scene.camera_ray_caster_overlay.show and space.overlay.show_overlays
    looks_through = context.region_data.view_perspective == "CAMERA"
    if is_rendered and looks_through and (reason := cached_scene(context).reason):
        yield reason
    elif is_live(space) and looks_through:
        yield from live.sentences(context)
    if is_rendered and looks_through:
        yield from other_times.sentences(scene, context.view_layer)
        yield from (line for line in cached_scene(context).differences if not line.startswith(TIMES))
    elif is_overlaid:
        yield from cached_scene(context).differences
    if space.local_view is not None and (is_overlaid or is_rendered):
        yield LOCAL_VIEW


def register(undo) -> None:
    undo.add_drawing(bpy.types.SpaceView3D, draw, "POST_PIXEL")
