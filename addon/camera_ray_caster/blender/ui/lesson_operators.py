"""Step Through: pixels are clicked in the camera's view or in an Image Editor, and their steps can be copied."""

from math import floor

import bpy

from ..view3d import lesson
from ..view3d.camera_frame import frame_in
from ..view3d.scene_cache import cached_scene
from .needs import OfScene

HINT = "Click a pixel in the camera's view or an Image Editor      Shift: One More      Esc, Enter: Done"


class StepThrough(OfScene, bpy.types.Operator):
    """Click pixels in the camera's view or in an Image Editor, and see each step from the pixel to its color"""

    bl_idname = "camera_ray_caster.step_through"
    bl_label = "Step Through"
    bl_options = {"REGISTER"}

    def invoke(self, context, event):
        """Wait for clicks; a 3D View that no camera is seen through looks through it from now on."""
        views = [area for area in context.screen.areas if area.type == "VIEW_3D"]
        through = [area for area in views if area.spaces.active.region_3d.view_perspective == "CAMERA"]
        if views and not through:
            views[0].spaces.active.region_3d.view_perspective = "CAMERA"
        context.window_manager.modal_handler_add(self)
        context.workspace.status_text_set(HINT)
        context.window.cursor_modal_set("CROSSHAIR")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Take clicks on pixels; let every other event pass to Blender."""
        if event.type in {"ESC", "RET", "RIGHTMOUSE"} and event.value == "PRESS":
            self.cancel(context)
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
        """Give status bar and cursor back."""
        context.workspace.status_text_set(None)
        context.window.cursor_modal_restore()


def pixel_at(context, x: int, y: int) -> tuple[int, int] | None:
    """Return column and row of the pixel at a place in the window; None beside the camera's picture."""
    camera = cached_scene(context).camera
    for area in context.screen.areas:
        for region in area.regions:
            beside = not (0 <= x - region.x < region.width and 0 <= y - region.y < region.height)
            if beside or camera is None:
                continue
            if region.type != "WINDOW":
                return None  # the sidebar and other regions lie over the view
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
    """Redraw what shows these pixels: every 3D View and Image Editor, with its sidebar."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"VIEW_3D", "IMAGE_EDITOR"}:
                area.tag_redraw()


class OfLesson:
    """An operator on the pixels that are stepped through."""

    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        """Grayed out without any."""
        cls.poll_message_set("Click a pixel with Step Through first")
        return bool(lesson.pixels)


class CopySteps(OfLesson, bpy.types.Operator):
    """Copy the steps of these pixels to the clipboard, as text"""

    bl_idname = "camera_ray_caster.copy_steps"
    bl_label = "Copy Steps"

    def execute(self, context):
        """Copy them."""
        texts = ["\n".join(one.lines()) for one in lesson.lessons(context).values()]
        context.window_manager.clipboard = "\n\n".join(texts) + "\n"
        return {"FINISHED"}


class ClearSteps(OfLesson, bpy.types.Operator):
    """Forget the pixels that are stepped through"""

    bl_idname = "camera_ray_caster.clear_steps"
    bl_label = "Clear Steps"

    def execute(self, context):
        """Forget them."""
        lesson.forget()
        redraw(context)
        return {"FINISHED"}


CLASSES = (StepThrough, CopySteps, ClearSteps)
