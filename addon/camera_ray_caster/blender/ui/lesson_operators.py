"""Operators that choose pixels by clicks in the camera's view or an Image Editor, and copy or clear their steps."""

from math import floor

import bpy

from ..view3d import lesson
from ..view3d.camera_frame import frame_in
from ..view3d.scene_cache import cached_scene
from .needs import OfScene

HINT = "Click a pixel in the camera's view or an Image Editor      Shift: One More      Esc, Enter: Done"


_waiting: list[str] = []
"""The name of the workspace in which Step Through waits for clicks."""


class StepThrough(OfScene, bpy.types.Operator):
    """Click pixels in the camera's view or in an Image Editor, and see each step from the pixel to its color"""

    bl_idname = "camera_ray_caster.step_through"
    bl_label = "Step Through"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        """Gray out the operator without a camera and while it waits for clicks."""
        cls.poll_message_set("Click a pixel, or press Esc")
        return not _waiting and super().poll(context)

    def invoke(self, context, event):
        """Wait for clicks. If no 3D View is in camera view, put the first one into camera view."""
        views = [area for area in context.screen.areas if area.type == "VIEW_3D"]
        through = [area for area in views if area.spaces.active.region_3d.view_perspective == "CAMERA"]
        if views and not through:
            views[0].spaces.active.region_3d.view_perspective = "CAMERA"
        context.window_manager.modal_handler_add(self)
        _waiting.append(context.workspace.name)
        context.workspace.status_text_set(HINT)
        context.window.cursor_modal_set("CROSSHAIR")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Handle clicks on pixels, and end without a camera; pass all other events to Blender."""
        is_over = not _waiting or context.scene.camera is None
        if is_over or (event.type in {"ESC", "RET", "RIGHTMOUSE"} and event.value == "PRESS"):
            end()
            return {"FINISHED"}
        if event.type != "LEFTMOUSE" or event.value != "PRESS":
            return {"PASS_THROUGH"}
        pixel = pixel_at(context, event.mouse_x, event.mouse_y)
        if pixel is None:
            return {"PASS_THROUGH"}
        if not event.shift:
            lesson.pixels.clear()
        lesson.pixels[:] = [*(known for known in lesson.pixels if known != pixel), pixel]
        redraw(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        """Restore the status bar and the cursor."""
        end()


def end() -> None:
    """End the waiting for clicks: remove the hint from the workspace in which it was shown, and restore the cursor."""
    while _waiting:
        workspace = bpy.data.workspaces.get(_waiting.pop())
        if workspace is not None:
            workspace.status_text_set(None)
        for window in bpy.context.window_manager.windows:
            window.cursor_modal_restore()


def pixel_at(context, x: int, y: int) -> tuple[int, int] | None:
    """Return column and row of the pixel at a position in the window, or None outside the camera's picture."""
    camera = cached_scene(context).camera
    for area in context.screen.areas:
        for region in area.regions:
            beside = not (0 <= x - region.x < region.width and 0 <= y - region.y < region.height)
            if beside or camera is None:
                continue
            if region.type != "WINDOW":
                return None  # the sidebar or another region covers the view
            with context.temp_override(area=area, region=region):
                frame = frame_in(bpy.context, camera.raster)
            if frame is None:
                continue
            left, bottom, right, top = frame
            column = floor((x - region.x - left) / (right - left) * camera.raster.width)
            row = floor((y - region.y - bottom) / (top - bottom) * camera.raster.height)
            if 0 <= column < camera.raster.width and 0 <= row < camera.raster.height:
                return column, row
    return None


def redraw(context) -> None:
    """Redraw every 3D View and Image Editor, with their sidebars: they show the pixels."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"VIEW_3D", "IMAGE_EDITOR"}:
                area.tag_redraw()


class OfLesson:
    """Base of the operators on the clicked pixels."""

    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        """Gray out the operator if no pixel was clicked."""
        cls.poll_message_set("First click a pixel with Step Through")
        return bool(lesson.pixels)


class CopySteps(OfLesson, bpy.types.Operator):
    """Copy the steps of these pixels to the clipboard, as text"""

    bl_idname = "camera_ray_caster.copy_steps"
    bl_label = "Copy Steps"

    def execute(self, context):
        """Copy the steps."""
        texts = ["\n".join(one.lines()) for one in lesson.lessons(context).values()]
        context.window_manager.clipboard = "\n\n".join(texts) + "\n"
        return {"FINISHED"}


class ClearSteps(OfLesson, bpy.types.Operator):
    """Forget the clicked pixels and their steps"""

    bl_idname = "camera_ray_caster.clear_steps"
    bl_label = "Clear Steps"

    def execute(self, context):
        """Forget the pixels."""
        lesson.forget()
        redraw(context)
        return {"FINISHED"}


CLASSES = (StepThrough, CopySteps, ClearSteps)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    undo.callback(end)
