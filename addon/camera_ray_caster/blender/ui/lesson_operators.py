"""Operators that choose pixels by clicks in the camera's view or an Image Editor, and copy or clear their steps."""

from math import floor

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty, PointerProperty

from ..read.scene_cache import cached_scene
from ..view3d import pixel_lessons
from ..view3d.camera_frame import frame_in
from ..view3d.clicked import clicked
from ..view3d.shown import is_other
from .needs import Action, OfScene

HINT = "Click or drag in the camera's view or an Image Editor      Shift: One More      Esc, Enter: Done"

_waiting: list[str] = []
"""The name of the workspace in which Step Through waits for clicks."""


class StepThrough(OfScene, bpy.types.Operator):
    """Click pixels in the camera's view or in an Image Editor, and see each step from the pixel to its color"""

    bl_label = "Step Through"
    bl_options = {"REGISTER"}
    is_dragging = False
    """Whether the latest pixel follows the mouse."""

    @classmethod
    def why_gray(cls, context) -> str:
        return "Click a pixel, or press Esc" if _waiting else super().why_gray(context)

    def invoke(self, context, event):
        """Wait for clicks, in a view that shows the camera's picture: put the first 3D View into camera view if none
        is, and see through the camera if all show Blender's own view.
        """
        views = [area for area in context.screen.areas if area.type == "VIEW_3D"]
        through = [area for area in views if area.spaces.active.region_3d.view_perspective == "CAMERA"]
        if views and not through:
            views[0].spaces.active.region_3d.view_perspective = "CAMERA"
            through = views[:1]
        if through and all(is_other(area.spaces.active, context.scene) for area in through):
            with context.temp_override(area=through[0]):
                bpy.ops.camera_ray_caster.see_through()
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
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self.is_dragging = False
            hold(context, None)
        is_pressed = event.type == "LEFTMOUSE" and event.value == "PRESS"
        if not is_pressed and not (self.is_dragging and event.type == "MOUSEMOVE"):
            return {"PASS_THROUGH"}
        region, pixel = pixel_at(context, event.mouse_x, event.mouse_y)
        hold(context, region)
        if pixel is None:
            return {"RUNNING_MODAL"} if self.is_dragging else {"PASS_THROUGH"}
        if is_pressed:
            self.is_dragging = True
            known = clicked.pixels if event.shift else []
        else:
            known = clicked.pixels[:-1]
        clicked.choose([*(earlier for earlier in known if earlier != pixel), pixel])
        redraw(context)
        return {"RUNNING_MODAL"}

    def cancel(self, context):
        """Restore the status bar and the cursor."""
        end()


def end() -> None:
    """End the waiting for clicks: remove the hint from the workspace in which it was shown, and restore the cursor."""
    hold(bpy.context, None)
    while _waiting:
        workspace = bpy.data.workspaces.get(_waiting.pop())
        if workspace is not None:
            workspace.status_text_set(None)
        for window in bpy.context.window_manager.windows:
            window.cursor_modal_restore()


def pixel_at(context, x: int, y: int) -> tuple[bpy.types.Region | None, tuple[int, int] | None]:
    """Return the region at a position in the window, and column and row of the pixel there; twice None outside the
    camera's picture.
    """
    camera = cached_scene(context).camera
    for area in context.screen.areas:
        for region in area.regions:
            beside = not (0 <= x - region.x < region.width and 0 <= y - region.y < region.height)
            if beside or camera is None:
                continue
            if region.type != "WINDOW":
                return None, None  # the sidebar or another region covers the view
            with context.temp_override(area=area, region=region):
                frame = frame_in(bpy.context, camera.raster)
            if frame is None:
                continue
            left, bottom, right, top = frame
            column = floor((x - region.x - left) / (right - left) * camera.raster.width)
            row = floor((y - region.y - bottom) / (top - bottom) * camera.raster.height)
            if 0 <= column < camera.raster.width and 0 <= row < camera.raster.height:
                return region, (column, row)
    return None, None


def hold(context, region) -> None:
    """Draw the latest pixel with the mouse cursor in this region while it is dragged; None ends that."""
    areas = () if region is None else context.screen.areas
    is_view = any(region in area.regions[:] for area in areas if area.type == "VIEW_3D")
    held = [region.as_pointer()] if is_view else []
    if held != clicked.held:
        clicked.hold([])
        redraw(context)
        clicked.hold(held)


def redraw(context) -> None:
    """Redraw every 3D View and Image Editor and their sidebars, which show the pixels.

    A view in which a pixel is dragged is not redrawn: Blender draws the cursor with the view's sidebar, or with its
    header if the sidebar is closed.
    """
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type not in {"VIEW_3D", "IMAGE_EDITOR"}:
                continue
            is_open = any(region.type == "UI" and region.width > 1 for region in area.regions)
            for region in area.regions:
                if region.type in {"WINDOW", "UI" if is_open else "HEADER"} and region.as_pointer() not in clicked.held:
                    region.tag_redraw()


def _sides(context) -> tuple[int, int]:
    camera = cached_scene(context).camera
    return (1, 1) if camera is None else camera.raster.size


def _get(axis: int, is_view: bool):
    """Return the function that reads a coordinate of the latest pixel, in pixels or in [-1, 1]."""

    def get(self) -> float:
        at = clicked.pixels[-1][axis] if clicked.pixels else 0
        return 2 * (at + 0.5) / _sides(bpy.context)[axis] - 1 if is_view else at

    return get


def _set(axis: int, is_view: bool):
    """Return the function that moves the latest pixel, within the frame."""

    def put(self, value: float) -> None:
        side, pixel = _sides(bpy.context)[axis], list(clicked.pixels[-1]) if clicked.pixels else [0, 0]
        at = floor((value + 1) / 2 * side) if is_view else int(value)
        pixel[axis] = min(max(at, 0), side - 1)
        clicked.choose([*clicked.pixels[:-1], (pixel[0], pixel[1])])
        redraw(bpy.context)

    return put


class Place(bpy.types.PropertyGroup):
    """The type of ``window_manager.camera_ray_caster_place``: where the latest pixel is, and the step of a lecture.
    Setting the place moves the pixel.
    """

    column: IntProperty(name="Column", description="Column of the pixel, from the left", min=0,
                        get=_get(0, False), set=_set(0, False))  # fmt: skip
    row: IntProperty(name="Row", description="Row of the pixel, from the bottom", min=0,
                     get=_get(1, False), set=_set(1, False))  # fmt: skip
    x: FloatProperty(name="x", description="View coordinate of the pixel's center, -1 left to 1 right", min=-1, max=1,
                     precision=4, get=_get(0, True), set=_set(0, True))  # fmt: skip
    y: FloatProperty(name="y", description="View coordinate of the pixel's center, -1 below to 1 above", min=-1, max=1,
                     precision=4, get=_get(1, True), set=_set(1, True))  # fmt: skip
    lecture: BoolProperty(name="Lecture", description="Show the model's formula and each step of the latest pixel in "
                          "large letters. Page Down and Page Up show the next and the previous step",
                          update=lambda self, context: begin_lecture(context))  # fmt: skip
    step: IntProperty(name="Step", description="Step that a lecture shows, counted from 0", min=0,
                      update=lambda self, context: redraw(context))  # fmt: skip
    all_digits: BoolProperty(name="More Digits", description="Show numbers with all digits instead of four",
                             update=lambda self, context: redraw(context))  # fmt: skip

    @property
    def most_digits(self) -> int:
        """Maximum number of significant digits in the steps."""
        return 4 if self.lecture and not self.all_digits else 17


def begin_lecture(context) -> None:
    """Begin with the pixel in the middle if none is chosen, or end."""
    if context.window_manager.camera_ray_caster_place.lecture and not clicked.pixels:
        width, height = _sides(context)
        clicked.choose([(width // 2, height // 2)])
    redraw(context)


class OfLesson(Action):
    """Base of the operators on the clicked pixels."""

    bl_options = {"REGISTER"}

    @classmethod
    def why_gray(cls, context) -> str:
        return "" if clicked.pixels else "First click a pixel with Step Through"


class CopySteps(OfLesson, bpy.types.Operator):
    """Copy the steps of these pixels to the clipboard, as text"""

    bl_label = "Copy Steps"

    def execute(self, context):
        texts = ["\n".join(steps.lines()) for steps in pixel_lessons.lessons(context).values()]
        context.window_manager.clipboard = "\n\n".join(texts) + "\n"


class ClearSteps(OfLesson, bpy.types.Operator):
    """Forget the clicked pixels and their steps"""

    bl_label = "Clear Steps"

    def execute(self, context):
        pixel_lessons.forget()
        redraw(context)


CLASSES = (Place, StepThrough, CopySteps, ClearSteps)


def register(undo) -> None:
    bpy.types.WindowManager.camera_ray_caster_place = PointerProperty(type=Place)
    undo.callback(delattr, bpy.types.WindowManager, "camera_ray_caster_place")
    undo.callback(end)
