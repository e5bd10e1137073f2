"""The engine's panels in the Properties editor, and Blender's panels that are also shown for this engine."""

from collections.abc import Iterator

import bpy

from ..output import reports
from ..properties.declared import ENGINE
from ..properties.pass_properties import PASSES
from .camera_notes import sample_note
from .cast_panels import summary
from .drawing import draw_message
from .facts_panels import camera_of
from .notes import draw_notes


class EnginePanel:
    """Base of the panels that are shown for this engine only."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"

    @classmethod
    def poll(cls, context):
        return context.engine == ENGINE


class RenderPanel(EnginePanel, bpy.types.Panel):
    """Render properties: the settings of the scene, and the time and accuracy of the latest render."""

    bl_idname = "CAMERA_RAY_CASTER_PT_render"
    bl_label = "Camera Ray Caster"
    bl_context = "render"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for setting in ("shading", "samples", "exact_shapes"):
            layout.prop(context.scene.camera_ray_caster, setting)
        note = sample_note(context.scene, camera_of(context, context.scene.camera)[0])
        draw_notes(layout, context, [] if note is None else [note])
        layout.prop(context.scene.render, "film_transparent")
        report = reports.latest(context.scene)
        if report is not None:
            layout.label(text=summary(report))
            layout.label(text=f"Worst distance error: {reports.relative_error(report, 'worst')}")
        layout.operator("camera_ray_caster.write_report")
        draw_message(layout, context, "Cycles renders materials and light through this camera")
        layout.operator("camera_ray_caster.use_in_cycles").set_engine = True


class PassesPanel(EnginePanel, bpy.types.Panel):
    """View Layer properties: the passes."""

    bl_idname = "CAMERA_RAY_CASTER_PT_passes"
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for heading, on_scene in (("Include", False), ("All View Layers", True)):
            column = layout.column(heading=heading, align=True)
            for entry in PASSES:
                if entry.on_scene == on_scene:
                    column.prop(entry.settings(context.scene, context.view_layer), entry.tick)
        layout.prop(context.view_layer, "pass_alpha_threshold")


CLASSES = (RenderPanel, PassesPanel)

BORROWED = {
    "EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface", "DATA_PT_EEVEE_light", "EEVEE_WORLD_PT_surface",
    "DATA_PT_camera_dof", "DATA_PT_camera_dof_aperture",
}  # fmt: skip
"""Panels of Blender's engines that are also shown for this engine: material slots, Base Color, a light's strength, the
world's color, depth of field.
"""

REPLACED = {"DATA_PT_camera", "DATA_PT_lens", "DATA_PT_light", "DATA_PT_preview"}
"""Blender panels that this engine replaces with its own, or with those that it borrows."""


def compatible() -> Iterator[set[str]]:
    """Yield the COMPAT_ENGINES of each panel that is BORROWED or for all engines (these panels name BLENDER_RENDER)."""
    for name in set(dir(bpy.types)) - REPLACED:
        engines = getattr(getattr(bpy.types, name), "COMPAT_ENGINES", ())
        if "BLENDER_RENDER" in engines or name in BORROWED:
            yield engines


def register(undo) -> None:
    for engines in compatible():
        engines.add(ENGINE)
        undo.callback(engines.discard, ENGINE)
