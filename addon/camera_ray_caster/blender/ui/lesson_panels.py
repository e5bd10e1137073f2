"""Sidebar panels that show the steps of a pixel, in the 3D View and in an Image Editor with the camera's picture."""

from collections.abc import Iterator

import bpy

from ...core.lesson.lesson import GLASS
from ..read.scene_cache import cached_scene
from ..view3d import lens_icon
from ..view3d.camera_frame import is_picture
from ..view3d.pixel_lessons import lessons
from .drawing import Sidebar, draw_message
from .lecture_operators import SIDES, LectureStep, RayView
from .lesson_operators import ClearSteps, CopySteps, StepThrough
from .open_lesson import OpenLesson
from .point_operators import EmptyAtHit, PixelOfPoint

OPEN = ("Model", GLASS, "Ray", "Ray in the world", "Seen", "Color")
"""Titles of the steps that are open at first."""

HEIGHT = 12.0
"""Height of the section of a lens, in rows of the panel."""

LISTED = 3
"""Maximum number of objects that the panel names."""


class Steps:
    """Base of the panels that explain a pixel step by step."""

    bl_label = "Step Through"

    def draw(self, context):
        layout = self.layout
        layout.operator(StepThrough.bl_idname, icon="EYEDROPPER", text="Click a Pixel")
        state, known = context.window_manager.camera_ray_caster_place, lessons(context)
        draw_lecture(layout, state, bool(known))
        if known and not state.lecture:
            row = layout.row(align=True)
            row.operator(CopySteps.bl_idname, icon="COPYDOWN")
            row.operator(ClearSteps.bl_idname, icon="X")
        layout.operator(OpenLesson.bl_idname, icon="URL")
        if state.lecture:
            draw_place(layout, state)
            return
        layout.operator(PixelOfPoint.bl_idname, icon="PIVOT_CURSOR", text="Pixel of 3D Cursor")
        if not known:
            return
        layout.operator(EmptyAtHit.bl_idname, icon="EMPTY_SINGLE_ARROW")
        draw_place(layout, state)
        *others, latest = known.values()
        if others:
            pixels = ", ".join(f"({x}, {y})" for x, y in (earlier.seen.pixel for earlier in others))
            draw_message(layout, context, f"Also drawn: {pixels}")
        for text in _differences(context):
            draw_message(layout, context, text)
        for title, lines in latest.steps:
            header, body = layout.panel(f"camera_ray_caster {title}", default_closed=title not in OPEN)
            header.label(text=f"{title} {latest.seen.pixel[0]}, {latest.seen.pixel[1]}" if title == "Pixel" else title)
            if body:
                if title == GLASS:
                    body.template_icon(lens_icon.icon(cached_scene(context).camera, latest.seen.pixel), scale=HEIGHT)
                for line in lines:
                    draw_message(body, context, line, "BLANK1" if line.startswith(" ") else "DOT")


def draw_lecture(layout, state, has_pixel: bool) -> None:
    """Draw the switch of the lecture and its step's arrows, and buttons that look at the ray from other sides."""
    row = layout.row(align=True)
    row.prop(state, "lecture", toggle=True, icon="TEXT")
    if state.lecture:
        for icon, by in (("TRIA_LEFT", -1), ("TRIA_RIGHT", 1)):
            row.operator(LectureStep.bl_idname, icon=icon, text="").by = by
        layout.prop(state, "all_digits")
    if has_pixel:
        row = layout.row(align=True)
        for side, (label, *_) in SIDES.items():
            row.operator(RayView.bl_idname, text=label).side = side


def draw_place(layout, state) -> None:
    """Draw the latest pixel's place as sliders, in pixels and in view coordinates."""
    for names in (("column", "row"), ("x", "y")):
        row = layout.row(align=True)
        for name in names:
            row.prop(state, name, slider=name in "xy")


def _differences(context) -> Iterator[str]:
    """Yield sentences about how a render differs from what the steps show."""
    scene = cached_scene(context)
    yield from scene.differences
    if scene.otherwise:
        unlisted = len(scene.otherwise) - LISTED
        names = ", ".join(scene.otherwise[:LISTED]) + (f" and {unlisted} more" if unlisted > 0 else "")
        yield f"Objects are shown as in the viewport; a render shows these otherwise: {names}"


class SidebarLesson(Sidebar, Steps, bpy.types.Panel):
    """The steps in the 3D View's sidebar."""

    bl_idname = "CAMERA_RAY_CASTER_PT_lesson"


class ImageLesson(Sidebar, Steps, bpy.types.Panel):
    """The steps in the sidebar of an Image Editor."""

    bl_idname = "CAMERA_RAY_CASTER_PT_image_lesson"
    bl_space_type = "IMAGE_EDITOR"

    @classmethod
    def poll(cls, context):
        return is_picture(context.space_data.image)


CLASSES = (SidebarLesson, ImageLesson)
