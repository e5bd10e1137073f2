"""The overlay in the 3D View: the camera's image plane in space, its orthobasis, some of its rays, and their hits."""

from __future__ import annotations

import bpy
import gpu
from bpy.props import BoolProperty, IntProperty, PointerProperty
from gpu_extras.batch import batch_for_shader

from ...core.report.diagram import Diagram, diagram
from .scene_cache import CachedScene, cached_scene


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
    rays: IntProperty(
        name="Rays Across",
        description="Number of drawn rays across the width of the picture",
        default=12,
        min=1,
        soft_max=32,
        max=128,
    )


WIDE, THIN = 2.0, 1.0
AXES = ((1.0, 0.2, 0.32, 1.0), (0.545, 0.863, 0.0, 1.0), (0.157, 0.565, 1.0, 1.0))
"""Colors of u, v and w: those of Blender's X, Y and Z axes."""
STYLES = {
    "grid": ((0.9, 0.9, 0.9, 0.3), THIN),
    "border": ((0.95, 0.95, 0.95, 0.8), WIDE),
    "missed_rays": ((0.6, 0.6, 0.6, 0.22), THIN),
    "hit_rays": ((1.0, 0.72, 0.2, 0.5), THIN),
    "normals": ((0.3, 0.9, 0.95, 0.95), WIDE),
    "hits": ((1.0, 0.85, 0.3, 1.0), 6.0),
}
"""Color and width in pixels of lines or points, in drawing order."""

_drawn: list[tuple] = []
"""The latest batches, as (inputs, batches)."""


def draw() -> None:
    """Draw the overlay of the window's scene; called by Blender for each 3D View."""
    context = bpy.context
    settings = context.scene.camera_ray_caster_overlay
    if not settings.show or not context.space_data.overlay.show_overlays:
        return
    scene = cached_scene(context)
    if scene.camera is None:
        return
    in_camera = context.region_data.view_perspective == "CAMERA"
    batches = _batches(scene, context.scene.camera.data.display_size, settings.rays)
    scale = context.preferences.system.ui_scale
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("LESS_EQUAL")
    for name in _wanted(settings, in_camera):
        color, width = STYLES[name]
        draw_batch(batches[name], "POINT" if name == "hits" else "POLYLINE", color, width * scale)
    if settings.show_frustum and not in_camera:
        gpu.state.depth_test_set("NONE")
        for batch, color in zip(batches["basis"], AXES, strict=True):
            draw_batch(batch, "POLYLINE", color, 1.5 * WIDE * scale)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


def _wanted(settings, in_camera: bool) -> list[str]:
    """Return the parts to draw. In camera view, rays would be points and the frustum the frame: leave both out."""
    shown = {
        "grid": settings.show_frustum and not in_camera,
        "border": settings.show_frustum and not in_camera,
        "missed_rays": settings.show_rays and not in_camera,
        "hit_rays": settings.show_rays and not in_camera,
        "normals": settings.show_normals,
        "hits": settings.show_hits,
    }
    return [name for name in STYLES if shown[name]]


def _batches(scene: CachedScene, size: float, rays: int) -> dict:
    """Return the batches of the diagram; make them again after a change."""
    made_of = scene, size, rays
    if not _drawn or _drawn[0][0] != made_of:
        _drawn[:] = [(made_of, _made(diagram(scene.camera, scene.shapes, size, rays)))]
    return _drawn[0][1]


def _made(parts: Diagram) -> dict:
    """Return the batches by the names of STYLES, None for empty parts, and a list of the axes' batches as "basis"."""

    def batch(kind: str, form: str, points):
        return batch_for_shader(shader(kind), form, {"pos": points.reshape(-1, 3)}) if len(points) else None

    batches = {name: batch("POLYLINE", "LINES", getattr(parts, name)) for name in STYLES if name != "hits"}
    batches["hits"] = batch("POINT", "POINTS", parts.hits)
    batches["basis"] = [batch("POLYLINE", "LINES", axis) for axis in parts.basis]
    return batches


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
    """Register this module; see ``registration``."""
    undo.callback(_drawn.clear)
    bpy.types.Scene.camera_ray_caster_overlay = PointerProperty(type=OverlayProperties)
    undo.callback(delattr, bpy.types.Scene, "camera_ray_caster_overlay")
    handle = bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", "POST_VIEW")
    undo.callback(bpy.types.SpaceView3D.draw_handler_remove, handle, "WINDOW")
