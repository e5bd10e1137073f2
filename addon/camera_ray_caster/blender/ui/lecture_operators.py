"""Operators of a lecture: the next and the previous step, and views of the latest pixel's ray from outside."""

import bpy
import numpy as np
from bpy.props import EnumProperty, IntProperty
from mathutils import Matrix

from ...core.lesson.diagram import pixel_outline
from ...core.records import InputError
from ..read.scene_cache import cached_scene
from ..view3d import pixel_lessons, text
from ..view3d.clicked import clicked
from .lesson_operators import OfLesson
from .needs import Action

SIDES = {
    "OUTSIDE": ("Outside", "from behind the camera, in perspective", (0.7, 0.5, 0.8), "PERSP"),
    "SIDE": ("Side", "from the camera's right; it looks to the right", (1.0, 0.0, 0.0), "ORTHO"),
    "ABOVE": ("Above", "from above the camera; it looks up", (0.0, 1.0, 0.0), "ORTHO"),
    "BACK": ("Back", "through the camera again", (0.0, 0.0, 1.0), "CAMERA"),
}
"""Label, description, direction to the viewer in the camera's upright axes, and the 3D View's perspective."""

FREE = 0.55
"""Part of a view's height for the ray, from its bottom: a lecture's text is above."""
SENSOR = 72.0
"""Width of a view in mm, at its focal length, times the distance: Blender's 36 mm, twice."""
LEVEL = 0.1
"""Sine of the angle to the vertical below which a camera looks up or down."""
MISSED = 10.0
"""Length of a ray that hits nothing, in units of the camera's display size."""


class LectureStep(Action, bpy.types.Operator):
    """Show the next or the previous step of the lecture"""

    bl_label = "Lecture Step"
    bl_options = {"REGISTER"}
    by: IntProperty(name="By", description="Number of steps, negative for previous ones", default=1)

    @classmethod
    def why_gray(cls, context) -> str:
        is_on = context.window_manager.camera_ray_caster_place.lecture and pixel_lessons.lessons(context)
        return "" if is_on else "First click a pixel with Step Through, and switch on Lecture"

    def execute(self, context):
        state, (*_, latest) = context.window_manager.camera_ray_caster_place, pixel_lessons.lessons(context).values()
        last = len(latest.screens) - 1
        state.step = min(max(min(state.step, last) + self.by, 0), last)


class RayView(OfLesson, bpy.types.Operator):
    """Look at the ray of the latest pixel in the 3D View"""

    bl_label = "Look at Ray"
    side: EnumProperty(name="Side", items=[(key, side[0], side[1].capitalize()) for key, side in SIDES.items()])

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip: from where."""
        return f"Look at the ray of the latest pixel {SIDES[properties.side][1]}. Marks stay"

    def execute(self, context):
        views = [area for area in context.screen.areas if area.type == "VIEW_3D"]
        latest = pixel_lessons.lessons(context).get(clicked.pixels[-1])
        if not views or latest is None:
            raise InputError("there is no 3D View: open one" if latest else "the pixel is outside the frame")
        area = context.area if context.area in views else views[0]
        region = next(region for region in area.regions if region.type == "WINDOW")
        with context.temp_override(area=area, region=region):
            look_at(bpy.context, latest, self.side)


def look_at(context, explained, side: str) -> None:
    """Turn the context's 3D View to a side of a pixel's ray, and frame the ray below the lecture's text."""
    camera, view, region = cached_scene(context).camera, context.region_data, context.region
    *_, towards, view.view_perspective = SIDES[side]
    context.space_data.overlay.show_overlays = True
    if side == "BACK":
        return
    size, seen = context.scene.camera.data.display_size, explained.seen
    end = seen.distance if np.isfinite(seen.distance) else MISSED * size
    outline = np.reshape(pixel_outline(camera, size, *seen.pixel), (-1, 3))
    points = np.vstack((camera.pose.eye, seen.origin, seen.origin + end * seen.direction, outline))
    points = points[np.isfinite(points).all(axis=1)]
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    radius = max(np.linalg.norm(points - middle, axis=1).max(), size)
    basis = upright(camera.pose.basis)
    toward = basis @ np.array(towards) / np.linalg.norm(towards)
    up = -basis[:, 2] if side == "ABOVE" else basis[:, 1]
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    up = np.cross(toward, right)
    left, right_end = text.uncovered(context)
    free = max(min(right_end - left, FREE * region.height), 1.0)  # toolbar and sidebar may cover a narrow region
    unit = 2 * radius / free  # of a pixel
    view.view_rotation = Matrix(np.column_stack((right, up, toward)).tolist()).to_quaternion()
    view.view_distance = unit * max(region.width, region.height) * context.space_data.lens / SENSOR
    aside = region.width / 2 - (left + right_end) / 2, region.height * (1 - FREE) / 2
    view.view_location = middle + unit * (aside[0] * right + aside[1] * up)


def upright(basis: np.ndarray) -> np.ndarray:
    """Return a camera's axes (3, 3), turned so that Y is the world's Z; as they are if it looks up or down."""
    basis = basis / np.linalg.norm(basis, axis=0)
    backward = basis[:, 2] * (1, 1, 0)
    length = np.linalg.norm(backward)
    if length < LEVEL:
        return basis
    up, backward = np.array((0.0, 0.0, 1.0)), backward / length
    return np.column_stack((np.cross(up, backward), up, backward))


CLASSES = (LectureStep, RayView)


def register(undo) -> None:
    keys = bpy.context.window_manager.keyconfigs.addon
    for name, space in (("3D View", "VIEW_3D"), ("Image", "IMAGE_EDITOR")) if keys else ():  # None in background
        keymap = keys.keymaps.new(name, space_type=space)
        for key, by in (("PAGE_DOWN", 1), ("PAGE_UP", -1)):
            item = keymap.keymap_items.new(LectureStep.bl_idname, key, "PRESS", repeat=True)
            item.properties.by = by
            undo.callback(keymap.keymap_items.remove, item)
