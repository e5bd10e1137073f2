"""Casting in the 3D View's sidebar: which passes, the button, and the report of what was done."""

from __future__ import annotations

import bpy

from ..engine.passes import PASSES, ticked
from ..output import images, reports
from . import cast_operator
from .drawing import Sidebar, draw_message, draw_row
from .show_result import ResultsMenu


class SidebarCast(Sidebar, bpy.types.Panel):
    """Cast the passes into images."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast"
    bl_label = "Cast"

    def draw(self, context):
        """The button, or how far the cast is; below it what was made, in one line."""
        layout, fraction = self.layout, cast_operator.fraction()
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
        report = reports.latest()
        if report is not None:
            seconds = f"{sum(report.seconds.values()):.3g}\N{NO-BREAK SPACE}s"
            shapes = f"{report.shapes:,} {'shape' if report.shapes == 1 else 'shapes'}"
            draw_message(layout, context, f"{report.pixels:,} rays at {shapes} in {seconds}", "TIME")


class SidebarPasses(Sidebar, bpy.types.Panel):
    """The tick boxes of the passes: the same as in the View Layer properties."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast_passes"
    bl_label = "Passes"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """As many columns as there is room for."""
        grid = self.layout.grid_flow(columns=0, even_columns=True, align=True)
        for entry in PASSES:
            grid.prop(entry.settings(context.scene, context.view_layer), entry.tick)


class SidebarQuality(Sidebar, bpy.types.Panel):
    """How it is cast."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast_settings"
    bl_label = "Shading and Precision"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """How the combined pass is made, and how exactly."""
        layout, settings = self.layout, context.scene.camera_ray_caster
        layout.row().prop(settings, "shading", expand=True)
        for name in ("samples", "precision", "exact_shapes"):
            layout.prop(settings, name)


class SidebarReport(Sidebar, bpy.types.Panel):
    """The numbers of the latest cast or render."""

    bl_idname = "CAMERA_RAY_CASTER_PT_report"
    bl_label = "Report"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        """Show it once there is one."""
        return reports.latest() is not None

    def draw_header_preset(self, context):
        """A button that writes all of it into a text."""
        self.layout.operator("camera_ray_caster.write_report", text="", icon="TEXT", emboss=False)

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


CLASSES = (SidebarCast, SidebarPasses, SidebarQuality, SidebarReport, SidebarNotDone)
