"""A click in a view that shows the camera's picture selects the object under the mouse, by the ray of that pixel."""

import bpy

from ...core.lesson.diagram import probe
from ..read.scene_cache import cached_scene
from ..read.unique import named
from .hide_overlays import misleads
from .lesson_operators import pixel_at
from .needs import Action, select_alone

TOOLS = "builtin.select", "builtin.select_box", "builtin.select_circle", "builtin.select_lasso"
"""Tools with which a click selects: Tweak, and the three kinds of Select."""

TWEAK = "3D View Tool: Tweak"

KEYS = (("3D View", "LEFTMOUSE", "CLICK"), ("3D View", "RIGHTMOUSE", "PRESS"), (TWEAK, "LEFTMOUSE", "PRESS"))
"""Where Blender selects, by its keymaps: button and event, without modifier keys."""


class SelectSeen(Action, bpy.types.Operator):
    """Select the object that the camera's picture shows under the mouse, whatever the camera's model"""

    bl_label = "Select in Camera's Picture"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    @classmethod
    def poll(cls, context):
        """Let Blender select where its own outlines are right, in other modes, and with other tools."""
        area = context.area
        if area is None or area.type != "VIEW_3D" or context.mode != "OBJECT":
            return False
        tool = context.workspace.tools.from_space_view3d_mode("OBJECT", create=False)
        return tool is not None and tool.idname in TOOLS and misleads(context.space_data, context.scene)

    def invoke(self, context, event):
        """Select; after a press, wait whether the mouse is dragged. Outside of the frame Blender selects."""
        _, pixel = pixel_at(context, event.mouse_x, event.mouse_y)
        if pixel is None or event.type != select_mouse(context):
            return {"PASS_THROUGH"}
        self.item, self.start = object_at(context, pixel), (event.mouse_x, event.mouse_y)
        if event.value != "PRESS":
            return self.execute(context)
        if self.item is None or not self.item.select_get():  # others stay selected, to be dragged together
            self.execute(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Move what is selected once the mouse is dragged, as Blender does; otherwise end with the button."""
        if event.value == "RELEASE":
            return self.execute(context)
        way = max(abs(event.mouse_x - self.start[0]), abs(event.mouse_y - self.start[1]))
        if way < context.preferences.inputs.drag_threshold_mouse * context.preferences.system.ui_scale:
            return {"RUNNING_MODAL"}
        if bpy.ops.transform.translate.poll():
            bpy.ops.transform.translate("INVOKE_DEFAULT", release_confirm=True)
        return {"FINISHED"}

    def execute(self, context):
        """Select this object and no others; none, if nothing is under the mouse."""
        select_alone(context, *([] if self.item is None else [self.item]))


def object_at(context, pixel: tuple[int, int]):
    """Return the object that the ray of a pixel hits, or None: also if it cannot be selected in this view."""
    scene = cached_scene(context)
    item = named(probe(scene.camera, scene.shapes, *pixel).name, context.view_layer.objects)
    return item if item is not None and not item.hide_select and item.visible_get(viewport=context.space_data) else None


def select_mouse(context) -> str:
    """Return the type of the events with which the user selects."""
    chosen = context.window_manager.keyconfigs.active.preferences
    return f"{getattr(chosen, 'select_mouse', 'LEFT')}MOUSE"


CLASSES = (SelectSeen,)


def register(undo) -> None:
    """Add the keys, if there is a window; see ``registration``."""
    keys = bpy.context.window_manager.keyconfigs.addon
    for name, button, event in KEYS if keys is not None else ():
        keymap = keys.keymaps.new(name, space_type="VIEW_3D", region_type="WINDOW")
        item = keymap.keymap_items.new(SelectSeen.bl_idname, button, event)
        undo.callback(keymap.keymap_items.remove, item)
