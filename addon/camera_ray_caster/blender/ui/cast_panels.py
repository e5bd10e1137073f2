"""Sidebar panels for casting: the passes, the button and the report."""

import bpy

from ...core.report.pass_notes import sentences
from ..output import image_datablocks, reports
from ..properties.pass_properties import PASSES, ticked
from . import cast_operator
from .drawing import Sidebar, draw_message, draw_row
from .left_out_panels import LeftOut
from .notes import Popover, draw_line, widen
from .other_engine import engine_label
from .show_result import ResultsMenu


class SidebarCast(Sidebar, bpy.types.Panel):
    """Cast the passes into images."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast"
    bl_label = "Cast"

    def draw(self, context):
        layout, fraction = self.layout, cast_operator.fraction()
        row = layout.row()
        row.scale_y = 1.4
        if fraction is None:
            count = len(ticked(context.scene, context.view_layer))
            row.operator("camera_ray_caster.cast", text=f"Cast {count} {'Pass' if count == 1 else 'Passes'}",
                         icon="RENDER_STILL")  # fmt: skip
        else:
            row.progress(factor=fraction, text=f"{fraction:.0%}, Esc: stop")
        row = layout.row()
        row.enabled = bool(image_datablocks.results())
        row.menu(ResultsMenu.bl_idname, icon="IMAGE_DATA")
        report = reports.latest(context.scene)
        text, left_out = ("", ()) if report is None else (summary(report), report.left_out)
        draw_line(layout, context, text, CastReport.bl_idname, "TIME", "No cast yet")
        nothing = text and "Nothing left out"
        draw_line(layout, context, reports.left_out_count(left_out), LeftOut.bl_idname, "ERROR", nothing)


def summary(report) -> str:
    """Return the time of a cast, and its numbers of rays and shapes: where a row is too short, these are cut off.
    Of another engine's picture without passes it has the engine in place of the rays.
    """
    rays = f"{_short(report.rays / 1e6)} M" if report.rays >= 1e6 else f"{report.rays:,}"
    made = f"{rays} rays" if report.rays else f"{engine_label(report.combined['engine'])} picture"
    shapes = f"{report.shapes:,} {'shape' if report.shapes == 1 else 'shapes'}"
    return f"{_short(sum(report.seconds.values()))} s: {made}, {shapes}"


def _short(number: float) -> str:
    """Return three digits of a number, and all before its point."""
    return f"{number:.3g}" if number < 100 else f"{number:,.0f}"


class SidebarPasses(Sidebar, bpy.types.Panel):
    """Check boxes of the passes, the same as in the View Layer properties."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast_passes"
    bl_label = "Passes"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        grid = self.layout.grid_flow(columns=2, even_columns=True, align=True)
        for entry in PASSES:
            grid.prop(entry.settings(context.scene, context.view_layer), entry.tick)


class SidebarQuality(Sidebar, bpy.types.Panel):
    """Shading, samples and exact shapes."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cast_settings"
    bl_label = "Shading"
    bl_parent_id = SidebarCast.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.camera_ray_caster
        layout.row().prop(settings, "shading", expand=True)
        for name in ("samples", "exact_shapes"):
            layout.prop(settings, name)


class CastReport(Popover, bpy.types.Panel):
    """Times, error bounds and notes of the latest cast or render"""

    bl_idname = "CAMERA_RAY_CASTER_PT_report"
    bl_label = "Report"

    @classmethod
    def poll(cls, context):
        return reports.latest(context.scene) is not None

    def draw(self, context):
        widen(self.layout, context)
        report = reports.latest(context.scene)
        box = self.layout.box().column(align=True)
        for step, seconds in report.seconds.items():
            draw_row(box, step.capitalize(), [f"{seconds:.4f} s"], 0.5)
        if report.rays_per_second is not None:
            draw_row(box, "Rays per Second", [f"{report.rays_per_second / 1e6:.3g} million"], 0.5)
        box.label(text="Relative Error of Distances")
        for name in ("median", "worst"):
            draw_row(box, name.capitalize(), [reports.relative_error(report, name)], 0.5)
        noted = [*report.warnings, *sentences(report.notes, report.exact)]
        not_done = [line.replace("_", " ") for line in report.not_done]
        for title, lines in (("Noted", noted), ("Not Needed", not_done)):
            if lines:
                self.layout.label(text=title)
            for line in lines:
                draw_message(self.layout, context, line, "DOT")
        self.layout.operator("camera_ray_caster.write_report", icon="TEXT")


CLASSES = (CastReport, SidebarCast, SidebarPasses, SidebarQuality)
