"""The sidebar panel of the verification: the camera compared with Blender's own results."""

import bpy

from ..output import reports
from .drawing import Sidebar, draw_message, draw_row
from .facts_panels import facts_of
from .notes import Popover, draw_line, widen

WITNESSES = {"calc_matrix_camera": "Camera Matrix", "world_to_camera_view": "View Position"}
"""Labels of the references whose names in the report are no titles."""


class SidebarVerify(Sidebar, bpy.types.Panel):
    """The camera compared with Blender's own results."""

    bl_idname = "CAMERA_RAY_CASTER_PT_verify"
    bl_label = "Verification"

    def draw(self, context):
        layout = self.layout
        row = layout.row(align=True)
        row.operator("camera_ray_caster.verify", icon="CHECKMARK")
        row.operator("camera_ray_caster.verify", text="With Cycles").with_cycles = True
        report = reports.verified(context.scene)
        text, icon = ("", "NONE") if report is None else verdict(context, report)
        draw_line(layout, context, text, VerifyErrors.bl_idname, icon, "Not verified yet")


def verdict(context, report) -> tuple[str, str]:
    """Return what a verification found, in words, and an icon."""
    if report.camera != facts_of(context, context.scene.camera)[0]:
        return "Camera has changed since", "INFO"
    return report.verdict.partition(":")[0], "CHECKMARK" if report.passed else "ERROR"


class VerifyErrors(Popover, bpy.types.Panel):
    """The worst error of the latest verification, and its bound, for each reference"""

    bl_idname = "CAMERA_RAY_CASTER_PT_verify_errors"
    bl_label = "Errors in Pixels"

    def draw(self, context):
        widen(self.layout, context)
        report = reports.verified(context.scene)
        if not report.passed:
            draw_message(self.layout, context, "The rays differ by more than their error bound", "ERROR")
        draw_findings(self.layout, report.findings)


def draw_findings(layout, findings) -> None:
    """Draw a table of the findings of each reference."""
    box = layout.box().column(align=True)
    draw_row(box, "", ["Worst", "Bound"], 0.46)
    for finding in findings:
        errors = [f"{error:.1e}" for error in (finding.worst_pixels, finding.bound_pixels)]
        if finding.not_compared:
            errors = ["not compared"]
        row = box.row()
        row.alert = not finding.passed
        title = WITNESSES.get(finding.witness, finding.witness.replace("_", " ").title())
        draw_row(row, title, errors, 0.46)


CLASSES = (SidebarVerify, VerifyErrors)
