"""Casting in the 3D View's sidebar: which passes, the button, and the report of what was done."""

from __future__ import annotations

import bpy

from ..engine.passes import PASSES, ticked
from ..output import images, reports
from . import cast_operator
from .drawing import Sidebar, draw_message, draw_row
from .object_panels import draw_cast_as
from .show_result import ResultsMenu

LISTED = 6
"""Objects that the panel names for each reason; the report has them all."""


class SidebarCast(Sidebar, bpy.types.Panel):
    """Cast the passes into images."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast"
    bl_label = "Cast"

    def draw(self, context):
        """The button, or how far the cast is; and how the combined pass is made."""
        layout = self.layout
        fraction = cast_operator.fraction()
        row = layout.row()
        row.scale_y = 1.4
        if fraction is None:
            count = len(ticked(context.scene, context.view_layer))
            row.operator("camera_ray_caster.cast", text=f"Cast {count} {'Pass' if count == 1 else 'Passes'}",
                         icon="RENDER_STILL")  # fmt: skip
        else:
            row.progress(factor=fraction, text=f"{fraction:.0%}, Esc stops")
        if images.results():
            layout.menu(ResultsMenu.bl_idname, icon="IMAGE_DATA")
        settings = context.scene.camera_ray_caster
        layout.row().prop(settings, "shading", expand=True)
        layout.prop(settings, "samples")
        layout.prop(settings, "precision")
        layout.prop(settings, "exact_shapes")


class SidebarPasses(Sidebar, bpy.types.Panel):
    """The tick boxes of the passes: the same as in the View Layer properties."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast_passes"
    bl_label = "Passes"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Two columns."""
        grid = self.layout.grid_flow(columns=2, even_columns=True, align=True)
        for entry in PASSES:
            grid.prop(entry.settings(context.scene, context.view_layer), entry.tick)


class SidebarReport(Sidebar, bpy.types.Panel):
    """What the latest cast or render took, in one line."""

    bl_idname = "CAMERA_RAY_CASTER_PT_report"
    bl_label = "Report"

    @classmethod
    def poll(cls, context):
        """Show it once there is one."""
        return reports.latest() is not None

    def draw_header_preset(self, context):
        """A button that writes all of it into a text."""
        self.layout.operator("camera_ray_caster.write_report", text="", icon="TEXT", emboss=False)

    def draw(self, context):
        """How many rays in how many seconds, and how exact."""
        report = reports.latest()
        text = f"{report.pixels:,} rays at {report.shapes:,} shapes in {sum(report.seconds.values()):.3g} s"
        draw_message(self.layout, context, text, "TIME")


class SidebarDetails(Sidebar, bpy.types.Panel):
    """The numbers of the report."""

    bl_idname = "CAMERA_RAY_CASTER_PT_report_details"
    bl_label = "Details"
    bl_parent_id = SidebarReport.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Seconds a step, rays a second, and the error bounds of the distances, in parts of these."""
        report = reports.latest()
        box = self.layout.box().column(align=True)
        for step, seconds in report.seconds.items():
            draw_row(box, step.capitalize(), [f"{seconds:.4f} s"], 0.5)
        if report.rays_per_second is not None:
            draw_row(box, "Rays per Second", [f"{report.rays_per_second / 1e6:.3g} million"], 0.5)
        box.label(text="Error of the distances, relative")
        for name in ("median", "worst"):
            draw_row(box, name.capitalize(), [reports.relative_error(report, name)], 0.5)


class SidebarLeftOut(Sidebar, bpy.types.Panel):
    """What the latest cast left out of the scene, by reason."""

    bl_idname = "CAMERA_RAY_CASTER_PT_left_out"
    bl_label = "Left Out"
    bl_parent_id = SidebarReport.bl_idname

    @classmethod
    def poll(cls, context):
        """Show it where something was left out."""
        return reports.latest() is not None and len(reports.latest().left_out) > 0

    def draw_header_preset(self, context):
        """How many."""
        self.layout.label(text=str(len(reports.latest().left_out)))

    def draw(self, context):
        """Each reason once, with a button that selects its objects; below it their names, and what each is cast as."""
        for reason, names in reports.by_reason(reports.latest()).items():
            column = self.layout.column(align=True)
            draw_message(column, context, reason, "DOT")
            count = f"{len(names)} {'Object' if len(names) == 1 else 'Objects'}"
            select = column.operator("camera_ray_caster.select", text=f"Select {count}", icon="RESTRICT_SELECT_OFF")
            select.reason = reason
            for name in names[:LISTED]:
                item = context.view_layer.objects.get(name)
                row = column.split(factor=0.5, align=True)
                row.label(text=name, icon="BLANK1")
                draw_cast_as(row, item, text="")
            if len(names) > LISTED:
                draw_message(column, context, f"and {len(names) - LISTED} more", "BLANK1")


class SidebarNotDone(Sidebar, bpy.types.Panel):
    """What the latest cast had no need to do, and why."""

    bl_idname = "CAMERA_RAY_CASTER_PT_not_done"
    bl_label = "Not Needed"
    bl_parent_id = SidebarReport.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """A line each."""
        for line in reports.latest().not_done:
            draw_message(self.layout, context, line.replace("_", " "), "DOT")


CLASSES = (SidebarCast, SidebarPasses, SidebarReport, SidebarLeftOut, SidebarDetails, SidebarNotDone)
