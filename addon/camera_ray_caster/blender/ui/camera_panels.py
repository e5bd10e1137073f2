"""The camera as the lecture describes it, in the 3D View's sidebar and in the camera's own properties."""

from __future__ import annotations

import bpy

from ...core.camera.facts import camera_facts
from ...core.records import InputError
from ..output import reports
from ..properties.declared import GROUP
from ..read.evaluated import camera_at
from .drawing import Sidebar, draw_message, draw_row, length
from .gallery_panels import draw_model

WITNESSES = {
    "view_frame": "View Frame",
    "calc_matrix_camera": "Camera Matrix",
    "world_to_camera_view": "View Position",
    "round trip": "Round Trip",
    "Cycles": "Cycles",
}
"""What the panel calls a witness, by its name in the report."""


def facts_of(context, camera_object) -> tuple[dict[str, object] | None, str]:
    """Return the facts of a camera as the window shows it, or None and in one line why there are none.

    A tenth of a millisecond: cheap enough to be read at every redraw, so that nothing has to be kept up to date.
    """
    try:
        _, camera = camera_at(camera_object, context.evaluated_depsgraph_get())
        return camera_facts(camera), ""
    except InputError as error:
        return None, str(error)


def draw_facts(layout, context, facts, camera) -> None:
    """Draw the facts of a camera object: one table, lengths and angles in the scene's units."""
    box = layout.box().column(align=True)
    vectors = [("Eye", [length(context, value) for value in facts["eye"]])]
    vectors += [(name, [f"{value:.4f}" for value in facts[name]]) for name in "uvw"]
    for name, cells in vectors:
        draw_row(box, name, cells, 0.16)
    box = layout.box().column(align=True)
    for name, text in scalars(context, facts, camera):
        draw_row(box, name, [text], 0.5)
    if "K" in facts:
        box = layout.box().column(align=True)
        box.label(text="K from the top left, y down")
        for name, row in zip(("K", "", ""), facts["K"], strict=True):
            draw_row(box, name, [f"{value:.6g}" for value in row], 0.16)


def scalars(context, facts, camera):
    """Yield the facts beside vectors and K, by Blender's names for them."""
    across, up = facts["raster"]
    yield "Model", facts["model"]
    own = getattr(camera.data, GROUP)
    if own.time_mode != "NONE":
        yield "Time of Pixels", own.bl_rna.properties["time_mode"].enum_items[own.time_mode].name
    yield "Raster", f"{across} × {up} px"
    x0, x1, y0, y1 = facts["window"]
    if (x0, x1, y0, y1) != (0, across, 0, up):
        yield "Render Region", f"{x0} to {x1}, {y0} to {y1}"
    if facts["pixel_aspect"] != 1:
        yield "Pixel Aspect", f"{facts['pixel_aspect']:.6g}"
    if "field_of_view" in facts:
        yield "Field of View", " × ".join(f"{angle:.4g}°" for angle in facts["field_of_view"])
    if "d" in facts:
        yield "Distance d", f"{facts['d']:.6g}"
        yield "Height / Width", f"{facts['aspect']:.6g}"
    if "kind" in facts:
        yield "Kind", facts["kind"]
    if "frame" in facts:
        yield "Frame", " × ".join(length(context, side) for side in facts["frame"])
    yield "Clip", " to ".join(length(context, distance) for distance in facts["clip"])


class SidebarCamera(Sidebar, bpy.types.Panel):
    """The scene's active camera."""

    bl_idname = "CAMERA_RAY_CASTER_PT_camera"
    bl_label = "Camera"

    def draw_header_preset(self, context):
        """The formats of exports, and a button that copies the facts."""
        row = self.layout.row(align=True)
        row.emboss = "NONE"
        row.menu("CAMERA_RAY_CASTER_MT_export", text="", icon="EXPORT")
        row.operator("camera_ray_caster.copy_facts", text="", icon="COPYDOWN")
        row.separator()

    def draw(self, context):
        """Which camera, and what it is, or why it is none."""
        layout = self.layout
        camera = context.scene.camera
        layout.prop(context.scene, "camera", text="")
        if camera is not None and camera.type == "CAMERA":
            draw_model(layout, camera.data)
        facts, reason = facts_of(context, camera)
        if facts is None:
            draw_message(layout, context, reason, "ERROR")
        else:
            draw_facts(layout, context, facts, camera)
            column = layout.column(align=True)
            column.operator("camera_ray_caster.copy_k")
            column.operator("camera_ray_caster.copy_world_to_camera")


class SidebarVerify(Sidebar, bpy.types.Panel):
    """The camera compared with Blender's own answers."""

    bl_idname = "CAMERA_RAY_CASTER_PT_verify"
    bl_label = "Verification"

    def draw(self, context):
        """The button, the verdict, and each witness's worst error beside its bound."""
        layout = self.layout
        row = layout.row(align=True)
        row.operator("camera_ray_caster.verify", icon="CHECKMARK")
        row.operator("camera_ray_caster.verify", text="With Cycles").with_cycles = True
        report = reports.verified()
        if report is None:
            return
        if report.camera != facts_of(context, context.scene.camera)[0]:
            draw_message(layout, context, "The camera has changed since it was verified")
            layout = layout.column()
            layout.active = False
        said = "All witnesses agree" if report.passed else "A witness disagrees with the rays"
        draw_message(layout, context, said, "CHECKMARK" if report.passed else "ERROR")
        box = layout.box().column(align=True)
        draw_row(box, "Pixels", ["Worst", "Bound"], 0.46)
        for finding in report.findings:
            errors = [f"{error:.1e}" for error in (finding.worst_pixels, finding.bound_pixels)]
            if finding.not_compared:
                errors = ["not compared"]
            row = box.row()
            row.alert = not finding.passed
            draw_row(row, WITNESSES.get(finding.witness, finding.witness), errors, 0.46)


class CameraData(bpy.types.Panel):
    """The same facts in the camera's tab of the Properties editor."""

    bl_idname = "CAMERA_RAY_CASTER_PT_camera_data"
    bl_label = "Ray Caster"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        """Show it for camera objects."""
        return context.object is not None and context.object.type == "CAMERA"

    def draw(self, context):
        """What this camera is, or why it is none."""
        facts, reason = facts_of(context, context.object)
        if facts is None:
            draw_message(self.layout, context, reason, "ERROR")
        else:
            draw_facts(self.layout, context, facts, context.object)


CLASSES = (SidebarCamera, SidebarVerify, CameraData)
