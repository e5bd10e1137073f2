"""The overlay in the 3D View: the camera's image plane in space, its orthobasis, some of its rays, and their hits.

In camera view hit points and normals are drawn over the picture, through the camera's model: Blender would draw them in
perspective, beside the picture of any other model.
"""

import blf
import bpy
import gpu
import numpy as np
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty
from bpy_extras.view3d_utils import location_3d_to_region_2d
from gpu_extras.batch import batch_for_shader

from ...core.clouds.colors import LABEL, RANGE, RING
from ...core.lesson.diagram import Diagram, diagram
from ...core.lesson.in_picture import lines_in_picture, points_in_picture
from ..read.scene_cache import CachedScene, cached_scene
from .camera_frame import in_pixels
from .shown import picture_frame


class OverlayProperties(bpy.types.PropertyGroup):
    """The type of ``scene.camera_ray_caster_overlay``."""

    show: BoolProperty(name="Overlay", description="Draw the rays of the active camera in the 3D View")
    show_frustum: BoolProperty(
        name="Frustum", description="Draw the image plane in space, and the camera's axes u, v and w", default=True
    )
    show_rays: BoolProperty(name="Rays", description="Draw some of the rays, up to their hit points", default=True)
    show_hits: BoolProperty(name="Hit Points", description="Draw the hit points of these rays", default=True)
    show_normals: BoolProperty(name="Normals", description="Draw the surface normals at the hit points", default=True)
    show_ray: BoolProperty(
        name="Ray under Mouse",
        description="In camera view, draw the ray under the mouse and its hit point",
        default=True,
    )
    show_points: BoolProperty(name="Points", description="Draw all points that the rays hit, as a scanner's")
    points_by: EnumProperty(
        name="Color of Points",
        items=[
            (RING, "Ring", "From blue, the lowest beam, to red, the highest"),
            (RANGE, "Range", "From blue, the nearest point, to red, the farthest"),
            (LABEL, "Label", "A color for each category"),
        ],
    )
    show_sweep: BoolProperty(
        name="Sweep by Timeline", description="Draw only the points that a scanner has swept by this frame"
    )
    rays: IntProperty(
        name="Rays Across",
        description="Number of drawn rays across the width of the picture",
        default=12,
        min=1,
        soft_max=32,
        max=128,
    )


WIDE, THIN, TEXT = 2.0, 1.0, 13.0
"""Line widths and font size in pixels at interface scale 1."""
AXES = ((1.0, 0.2, 0.32, 1.0), (0.545, 0.863, 0.0, 1.0), (0.157, 0.565, 1.0, 1.0))
"""Colors of u, v and w: those of Blender's X, Y and Z axes."""
STYLES = {
    "grid": ((0.9, 0.9, 0.9, 0.3), THIN, "show_frustum"),
    "border": ((0.95, 0.95, 0.95, 0.8), WIDE, "show_frustum"),
    "missed_rays": ((0.6, 0.6, 0.6, 0.22), THIN, "show_rays"),
    "hit_rays": ((1.0, 0.72, 0.2, 0.5), THIN, "show_rays"),
    "normals": ((0.3, 0.9, 0.95, 0.95), WIDE, "show_normals"),
    "hits": ((1.0, 0.85, 0.3, 1.0), 6.0, "show_hits"),
}
"""Color and width in pixels of lines or points, and the setting that shows them, in drawing order."""

_drawn: list[tuple] = []
"""The latest diagram, as (inputs, diagram, batches in space and in the picture)."""


def draw() -> None:
    """Draw the overlay in space; called by Blender for each 3D View. A view through the camera has its own."""
    context = bpy.context
    settings, scene = context.scene.camera_ray_caster_overlay, _shown(context)
    if scene is None or picture_frame(context) is not None:
        return
    batches = _batches(scene, context.scene.camera.data.display_size, settings.rays)
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    _draw(context, batches, STYLES)
    if settings.show_frustum:
        gpu.state.depth_test_set("NONE")
        scale = context.preferences.system.ui_scale
        for batch, color in zip(batches["basis"], AXES, strict=True):
            draw_batch(batch, "POLYLINE", color, 1.5 * WIDE * scale)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


def draw_in_picture() -> None:
    """Draw the overlay in the picture of a view through the camera, and the names of the axes in any other view; called
    by Blender for each 3D View.
    """
    context = bpy.context
    settings, scene = context.scene.camera_ray_caster_overlay, _shown(context)
    frame = None if scene is None else picture_frame(context)
    if frame is None:
        if scene is not None and settings.show_frustum:
            _name_axes(context, scene.camera)
        return
    batches = _batches(scene, context.scene.camera.data.display_size, settings.rays, in_picture=True)
    gpu.state.blend_set("ALPHA")
    with in_pixels(frame, scene.camera.raster):
        _draw(context, batches, batches)
    gpu.state.blend_set("NONE")


def _name_axes(context, camera) -> None:
    """Write e, u, v and w beside the eye and the ends of the axes."""
    size, eye = context.scene.camera.data.display_size, camera.pose.eye
    u, v, z = camera.pose.basis.T
    blf.size(0, TEXT * context.preferences.system.ui_scale)
    blf.enable(0, blf.SHADOW)
    blf.shadow(0, 5, 0.0, 0.0, 0.0, 1.0)
    for name, way, color in zip("euvw", (0 * u, u, v, -z), ((1.0, 1.0, 1.0, 1.0), *AXES), strict=True):
        position = location_3d_to_region_2d(context.region, context.region_data, eye + size * way)
        if position is not None:
            blf.color(0, *color)
            blf.position(0, position.x + TEXT / 3, position.y + TEXT / 3, 0)
            blf.draw(0, name)
    blf.disable(0, blf.SHADOW)


def _shown(context) -> CachedScene | None:
    """Return the scene whose overlay a 3D View shows; None if it shows none."""
    if not context.scene.camera_ray_caster_overlay.show or not context.space_data.overlay.show_overlays:
        return None
    scene = cached_scene(context)
    return None if scene.camera is None else scene


def _draw(context, batches: dict, names) -> None:
    """Draw the batches of these names that the settings show."""
    settings, scale = context.scene.camera_ray_caster_overlay, context.preferences.system.ui_scale
    for name in names:
        color, width, setting = STYLES[name]
        if getattr(settings, setting):
            draw_batch(batches[name], "POINT" if name == "hits" else "POLYLINE", color, width * scale)


def _batches(scene: CachedScene, size: float, rays: int, in_picture: bool = False) -> dict:
    """Return the batches of the diagram, in space or in the picture; make them again after a change."""
    made_of = scene, size, rays
    if not _drawn or _drawn[0][0] != made_of:
        _drawn[:] = [(made_of, diagram(scene.camera, scene.shapes, size, rays), {})]
    _, parts, known = _drawn[0]
    if in_picture not in known:
        known[in_picture] = _in_picture(scene.camera, parts) if in_picture else _made(parts)
    return known[in_picture]


def _made(parts: Diagram) -> dict:
    """Return the batches by the names of STYLES, None for empty parts, and a list of the axes' batches as "basis"."""
    batches = {name: batch_of("POLYLINE", getattr(parts, name)) for name in STYLES if name != "hits"}
    batches["hits"] = batch_of("POINT", parts.hits)
    batches["basis"] = [batch_of("POLYLINE", axis) for axis in parts.basis]
    return batches


def _in_picture(camera, parts: Diagram) -> dict:
    """Return the batches in the picture: there, rays would be points and the frustum the frame."""
    return {
        "normals": batch_of("POLYLINE", lines_in_picture(camera, parts.normals)),
        "hits": batch_of("POINT", points_in_picture(camera, parts.hit_rays[:, 1])),
    }


def batch_of(kind: str, points):
    """Return the batch of points, or of the ends of line segments (POLYLINE), in two or three dimensions; or None."""
    points = np.asarray(points, np.float32)
    if not points.size:
        return None
    points = points.reshape(-1, points.shape[-1])
    if points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    return batch_for_shader(shader(kind), "POINTS" if kind == "POINT" else "LINES", {"pos": points})


def shader(kind: str):
    """Return Blender's shader of uniform color for POLYLINE or POINT."""
    return gpu.shader.from_builtin(f"{kind}_UNIFORM_COLOR")


def draw_batch(batch, kind: str, color, width: float) -> None:
    """Draw lines or points in a color and a width in pixels; draw nothing if the batch is None."""
    if batch is None:
        return
    bound = shader(kind)
    bound.bind()
    bound.uniform_float("color", color)
    if kind == "POINT":
        gpu.state.point_size_set(width)
    else:
        bound.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
        bound.uniform_float("lineWidth", width)
    batch.draw(bound)


CLASSES = (OverlayProperties,)


def register(undo) -> None:
    undo.callback(_drawn.clear)
    bpy.types.Scene.camera_ray_caster_overlay = PointerProperty(type=OverlayProperties)
    undo.callback(delattr, bpy.types.Scene, "camera_ray_caster_overlay")
    undo.add_drawing(bpy.types.SpaceView3D, draw, "POST_VIEW")
    undo.add_drawing(bpy.types.SpaceView3D, draw_in_picture, "POST_PIXEL")
