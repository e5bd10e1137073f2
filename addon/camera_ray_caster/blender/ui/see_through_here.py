"""A line on a camera view that shows Blender's own view in place of the model's picture; a click sees through it."""

import bpy

from ..properties.declared import BLENDERS_OWN, GROUP
from ..properties.setting_labels import label_of
from ..read.view import camera_frame
from ..view3d import text
from ..view3d.shown import is_other
from .model_settings import blender_type
from .see_through import SeeThrough

TOP, ROOM = 64, 12
"""Distance of the text from the region's top, below Blender's header, and room around it that takes clicks, in pixels
at interface scale 1.
"""


class SeeThroughHere(bpy.types.Gizmo):
    """The line, which is a button."""

    bl_idname = "CAMERA_RAY_CASTER_GT_see_through"
    box: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)

    def draw(self, context):
        """Write the line at the top of the region."""
        camera, scale = context.scene.camera.data, context.preferences.system.ui_scale
        key, (left, right) = getattr(camera, GROUP).model, text.uncovered(context)
        model = label_of(key if key != BLENDERS_OWN else blender_type(camera))
        lines = text.wrapped(context, f"Blender's own view, not {model}: click here to see through the camera",
                             right - left - 4 * ROOM * scale)  # fmt: skip

        def at_top(width, height):
            x, y = (left + right - width) / 2, context.region.height - TOP * scale
            room = ROOM * scale
            self.box = x - room, y - height - room, x + width + room, y + room
            return x, y

        text.write(context, [("", line) for line in lines], at_top)

    def test_select(self, context, location):
        """Return 0 if the mouse is over the line."""
        left, bottom, right, top = self.box
        return 0 if left <= location[0] <= right and bottom <= location[1] <= top else -1


class SeeThroughHereGroup(bpy.types.GizmoGroup):
    """The gizmo group, shown in camera views of Blender's own."""

    bl_idname = "CAMERA_RAY_CASTER_GGT_see_through"
    bl_label = "See Through Camera"
    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    bl_options = {"PERSISTENT", "SCALE"}

    @classmethod
    def poll(cls, context):
        """Show the line where Blender shows another picture than the camera's."""
        return camera_frame(context) is not None and is_other(context.space_data, context.scene)

    def setup(self, context):
        """Add the gizmo."""
        self.gizmos.new(SeeThroughHere.bl_idname).target_set_operator(SeeThrough.bl_idname)


CLASSES = (SeeThroughHere, SeeThroughHereGroup)
