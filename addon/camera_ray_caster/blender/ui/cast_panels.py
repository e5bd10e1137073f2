"""Sidebar panels for casting: the passes, the button and the report."""

from __future__ import annotations

import bpy

from ...core.report.notes import sentences
from ..output import images, reports
from ..properties.passes import PASSES, ticked
from . import cast_operator
from .drawing import Sidebar, draw_message, draw_row
from .show_result import ResultsMenu


class SidebarCast(Sidebar, bpy.types.Panel):
    """Cast the passes into images."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast"
    bl_label = "Cast"

    def draw(self, context):
        """Draw the button or the progress; below it a menu of the images and one line about the latest cast."""
        layout, fraction = self.layout, cast_operator.fraction()
        row = layout.row()
        row.scale_y = 1.4
        if fraction is None:
            count = len(ticked(context.scene, context.view_layer))
            row.operator("camera_ray_caster.cast", text=f"Cast {count} {'Pass' if count == 1 else 'Passes'}",
                         icon="RENDER_STILL")  # fmt: skip
        else:
            row.progress(factor=fraction, text=f"{fraction:.0%}, Esc: stop")
        if images.results():
            layout.menu(ResultsMenu.bl_idname, icon="IMAGE_DATA")
        report = reports.latest(context.scene)
        if report is not None:
            seconds = f"{sum(report.seconds.values()):.3g}\N{NO-BREAK SPACE}s"
            shapes = f"{report.shapes:,} {'shape' if report.shapes == 1 else 'shapes'}"
            draw_message(layout, context, f"{report.pixels:,} rays at {shapes} in {seconds}", "TIME")


class SidebarPasses(Sidebar, bpy.types.Panel):
    """Check boxes of the passes, the same as in the View Layer properties."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast_passes"
    bl_label = "Passes"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Draw the check boxes in as many columns as fit."""
        grid = self.layout.grid_flow(columns=0, even_columns=True, align=True)
        for entry in PASSES:
            grid.prop(entry.settings(context.scene, context.view_layer), entry.tick)


class SidebarQuality(Sidebar, bpy.types.Panel):
    """Shading, samples and precision."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast_settings"
    bl_label = "Shading"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Draw the settings."""
        layout, settings = self.layout, context.scene.camera_ray_caster
        layout.row().prop(settings, "shading", expand=True)
        for name in ("samples", "exact_shapes"):
            layout.prop(settings, name)


class SidebarReport(Sidebar, bpy.types.Panel):
    """Times and error bounds of the latest cast or render."""

    bl_idname = "CAMERA_RAY_CASTER_PT_report"
    bl_label = "Report"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        """Show the panel if there is a report."""
        return reports.latest(context.scene) is not None

    def draw_header_preset(self, context):
        """Draw a button that writes the whole report into a text datablock."""
        self.layout.operator("camera_ray_caster.write_report", text="", icon="TEXT", emboss=False)

    def draw(self, context):
        """Draw the seconds per step, the rays per second and the relative error bounds of the distances."""
        report = reports.latest(context.scene)
        box = self.layout.box().column(align=True)
        for step, seconds in report.seconds.items():
            draw_row(box, step.capitalize(), [f"{seconds:.4f} s"], 0.5)
        if report.rays_per_second is not None:
            draw_row(box, "Rays per Second", [f"{report.rays_per_second / 1e6:.3g} million"], 0.5)
        box.label(text="Relative error of the distances")
        for name in ("median", "worst"):
            draw_row(box, name.capitalize(), [reports.relative_error(report, name)], 0.5)


class SidebarNotes(Sidebar, bpy.types.Panel):
    """Warnings of the latest render, and what its passes show otherwise than expected."""

    bl_idname = "CAMERA_RAY_CASTER_PT_notes"
    bl_label = "Noted"
    bl_parent_id = SidebarReport.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        """Show the panel if there is a note."""
        return bool(_notes(context))

    def draw(self, context):
        """Draw a message for each note."""
        for line in _notes(context):
            draw_message(self.layout, context, line, "DOT")


def _notes(context) -> list[str]:
    report = reports.latest(context.scene)
    return [] if report is None else [*report.warnings, *sentences(report.notes, report.exact)]


class SidebarNotDone(Sidebar, bpy.types.Panel):
    """Steps that the latest cast did not need, and why."""

    bl_idname = "CAMERA_RAY_CASTER_PT_not_done"
    bl_label = "Not Needed"
    bl_parent_id = SidebarReport.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """Draw a message for each step."""
        for line in reports.latest(context.scene).not_done:
            draw_message(self.layout, context, line.replace("_", " "), "DOT")


CLASSES = (SidebarCast, SidebarPasses, SidebarQuality, SidebarReport, SidebarNotes, SidebarNotDone)
