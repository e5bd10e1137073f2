"""In camera view, text about the ray of the pixel under the mouse. It is a gizmo, to receive mouse moves."""

import math

import bpy

from ...core.lesson.diagram import Probe, probe
from ..read.lengths import length
from ..read.scene_cache import cached_scene
from . import text
from .shown import picture_frame

TEXT_DISTANCE = 14
"""Distance between mouse and text, in pixels at interface scale 1."""


class RayUnderMouse(bpy.types.Gizmo):
    """A gizmo that only draws the text; it cannot be selected or dragged."""

    bl_idname = "CAMERA_RAY_CASTER_GT_ray"
    mouse: tuple[int, int] | None = None

    def test_select(self, context, location):
        self.mouse = tuple(location)
        context.region.tag_redraw()
        return -1

    def draw(self, context):
        frame = picture_frame(context)
        scene = cached_scene(context)
        if self.mouse is None or frame is None or scene.camera is None:
            return
        left, bottom, right, top = frame
        x, y = (self.mouse[0] - left) / (right - left), (self.mouse[1] - bottom) / (top - bottom)
        if not (0 <= x < 1 and 0 <= y < 1):
            return
        raster = scene.camera.raster
        seen = probe(scene.camera, scene.shapes, int(x * raster.width), int(y * raster.height))
        _write(context, self.mouse, _lines(context, seen))


class RayUnderMouseGroup(bpy.types.GizmoGroup):
    """The gizmo group, shown in every 3D View in camera view while the overlay is on."""

    bl_idname = "CAMERA_RAY_CASTER_GGT_ray"
    bl_label = "Ray under Mouse"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"PERSISTENT", "SCALE"}

    @classmethod
    def poll(cls, context):
        settings = context.scene.camera_ray_caster_overlay
        wanted = settings.show and settings.show_ray and context.space_data.overlay.show_overlays
        return wanted and context.region_data.view_perspective == "CAMERA"

    def setup(self, context):
        self.gizmos.new(RayUnderMouse.bl_idname)


def _lines(context, seen: Probe) -> list[tuple[str, str]]:
    lines = [
        ("Pixel", f"{seen.pixel[0]}, {seen.pixel[1]} from the bottom left"),
        ("View", f"{seen.view[0]:z.4f}, {seen.view[1]:z.4f}"),
    ]
    if math.isnan(seen.direction[0]):
        return [*lines, ("Ray", "none: the camera sees nothing here")]
    lines.append(("Direction", ", ".join(f"{component:z.4f}" for component in seen.direction)))
    if math.isinf(seen.distance):
        return [*lines, ("Hit", "nothing")]
    return [*lines, ("Hit", seen.name), ("Distance", length(context, seen.distance))]


def _write(context, mouse, lines) -> None:
    """Write lines next to the mouse, on the side where they fit, and not past the left edge."""
    margin, (left, right) = TEXT_DISTANCE * context.preferences.system.ui_scale, text.uncovered(context)

    def corner(width, height):
        x = mouse[0] + 2 * margin
        if x + width + margin > right:
            x = max(mouse[0] - 2 * margin - width, left + margin)
        return x, max(mouse[1] - margin, height + margin)

    text.write(context, lines, corner)


CLASSES = (RayUnderMouse, RayUnderMouseGroup)
