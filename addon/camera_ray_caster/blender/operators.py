"""The operators: each a line or three around the walk."""

import bpy

from . import reports


class WriteReport(bpy.types.Operator):
    """Write the report of the latest render into a text datablock"""

    bl_idname = "camera_ray_caster.write_report"
    bl_label = "Report to Text"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Greyed out before the first render."""
        cls.poll_message_set("Render with the Camera Ray Caster first (F12)")
        return reports.latest() is not None

    def execute(self, context):
        """Write it, and say where it is."""
        text = reports.write_text(reports.latest())
        self.report({"INFO"}, f"The report is the text {text.name!r}, in the Text Editor")
        return {"FINISHED"}


CLASSES = (WriteReport,)


def register() -> None:
    """See ``registration``."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """See ``registration``."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
