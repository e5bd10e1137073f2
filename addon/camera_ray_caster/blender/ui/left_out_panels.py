"""The popover of the objects that the latest cast left out."""

import bpy

from ..output import reports
from .drawing import draw_message
from .notes import Popover, widen
from .object_panels import draw_cast_as

LISTED = 6
"""Maximum number of objects that the panel names for each reason; the report has all of them."""


class LeftOut(Popover, bpy.types.Panel):
    """Objects that the latest cast left out, by reason, each with its Cast As setting"""

    bl_idname = "CAMERA_RAY_CASTER_PT_left_out"
    bl_label = "Left Out"

    @classmethod
    def poll(cls, context):
        report = reports.latest(context.scene)
        return report is not None and len(report.left_out) > 0

    def draw(self, context):
        widen(self.layout, context)
        for reason, names in reports.by_reason(reports.latest(context.scene)).items():
            column = self.layout.column(align=True)
            draw_message(column, context, reason, "DOT")
            users = reports.users_of(context.view_layer, reason, names)
            if users:  # a world has none
                count = f"{len(users)} {'Object' if len(users) == 1 else 'Objects'}"
                select = column.operator("camera_ray_caster.select", text=f"Select {count}", icon="RESTRICT_SELECT_OFF")
                select.reason = reason
            for name in names[:LISTED]:
                row = column.split(factor=0.5, align=True)
                row.label(text=name, icon="BLANK1")
                draw_cast_as(row, next((item for item in users if item.name == name), None), text="")
            if len(names) > LISTED:
                draw_message(column, context, f"and {len(names) - LISTED} more", "BLANK1")


CLASSES = (LeftOut,)
