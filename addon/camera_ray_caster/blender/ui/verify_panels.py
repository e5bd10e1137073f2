"""The sidebar panel of the verification: the camera compared with Blender's own results."""

import bpy

from ..output import reports
from .drawing import Sidebar, draw_message, draw_row
from .facts_panels import facts_of

WITNESSES = {
    "view_frame": "View Frame",
    "calc_matrix_camera": "Camera Matrix",
    "world_to_camera_view": "View Position",
    "round trip": "Round Trip",
    "Cycles": "Cycles",
}
"""Labels of the independent references, by name in the report."""


class SidebarVerify(Sidebar, bpy.types.Panel):
    """The camera compared with Blender's own results."""

    bl_idname = "CAMERA_RAY_CASTER_PT_verify"
    bl_label = "Verification"

    def draw(self, context):
        """Draw the buttons and the verdict; in a folded panel, the worst error and the bound of each reference."""
        layout = self.layout
        row = layout.row(align=True)
        row.operator("camera_ray_caster.verify", icon="CHECKMARK")
        row.operator("camera_ray_caster.verify", text="With Cycles").with_cycles = True
        report = reports.verified(context.scene)
        if report is None:
            return
        if report.camera != facts_of(context, context.scene.camera)[0]:
            draw_message(layout, context, "The camera has changed since the last verification")
            layout = layout.column()
            layout.active = False
        said = (
            "All reference checks passed"
            if report.passed
            else "A reference check failed: the rays differ by more than its error bound"
        )
        draw_message(layout, context, said, "CHECKMARK" if report.passed else "ERROR")
        header, body = layout.panel("camera_ray_caster errors", default_closed=True)
        header.label(text="Errors in Pixels")
        if body:
            draw_findings(body, report.findings)


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
        draw_row(row, WITNESSES.get(finding.witness, finding.witness), errors, 0.46)


CLASSES = (SidebarVerify,)
