"""The camera's numbers, in the 3D View's sidebar and in the camera's tab of the Properties editor."""

import bpy

from ...core.camera.camera import Camera
from ...core.camera.facts import camera_facts
from ..properties.declared import GROUP
from ..read.evaluated import camera_or_reason
from ..read.lengths import length
from .drawing import Sidebar, draw_message, draw_row


def camera_of(context, camera_object) -> tuple[Camera | None, str]:
    """Return a camera as the window shows it and "", or None and the reason in one line."""
    _, camera, reason = camera_or_reason(camera_object, context.evaluated_depsgraph_get())
    return camera, reason


def facts_of(context, camera_object) -> tuple[dict[str, object] | None, str]:
    """Return the facts of a camera as the window shows it and "", or None and the reason in one line."""
    camera, reason = camera_of(context, camera_object)
    return (None if camera is None else camera_facts(camera)), reason


def draw_facts(layout, context, facts, camera) -> None:
    """Draw the facts of a camera object as tables, with lengths in the scene's units and angles in degrees."""
    box = layout.box().column(align=True)
    for name, value in zip(("Eye X", "Y", "Z"), facts["eye"], strict=True):
        draw_row(box, name, [length(context, value)], 0.3)
    for name in "uvw":
        draw_row(box, name, [f"{value:z.4f}" for value in facts[name]], 0.16)
    box = layout.box().column(align=True)
    for name, text in scalars(context, facts, camera):
        draw_row(box, name, [text], min(0.5, max(0.3, len(name) / len(name + text))))
    if "K" in facts:
        box = layout.box().column(align=True)
        box.label(text="K from the top left, y down")
        for name, row in zip(("K", "", ""), facts["K"], strict=True):
            draw_row(box, name, [f"{value:.6g}" for value in row], 0.16)


def scalars(context, facts, camera):
    """Yield (label, text) of the facts other than the vectors and K."""
    across, up = facts["raster"]
    yield "Model", facts["model"]
    settings = getattr(camera.data, GROUP)
    if settings.time_mode != "NONE":
        yield "Time of Pixels", settings.bl_rna.properties["time_mode"].enum_items[settings.time_mode].name
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


class SidebarFacts(Sidebar, bpy.types.Panel):
    """The numbers of the active camera."""

    bl_idname = "CAMERA_RAY_CASTER_PT_facts"
    bl_label = "Camera in Numbers"

    @classmethod
    def poll(cls, context):
        return context.scene.camera is not None

    def draw_header_preset(self, context):
        self.layout.operator("camera_ray_caster.copy_facts", text="", icon="COPYDOWN", emboss=False)

    def draw(self, context):
        layout, camera = self.layout, context.scene.camera
        facts, _ = facts_of(context, camera)
        if facts is not None:
            draw_facts(layout, context, facts, camera)
            column = layout.column(align=True)
            if "K" in facts:
                column.operator("camera_ray_caster.copy_k")
            column.operator("camera_ray_caster.copy_world_to_camera")


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
        return context.object is not None and context.object.type == "CAMERA"

    def draw(self, context):
        facts, reason = facts_of(context, context.object)
        if facts is None:
            draw_message(self.layout, context, reason, "ERROR")
        else:
            draw_facts(self.layout, context, facts, context.object)


CLASSES = (SidebarFacts, CameraData)
