"""Sidebar panels of the active camera: its choice, its model and settings, and its operators."""

import bpy

from ...core.cameras.parts.settings import Setting
from ..properties.declared import BLENDERS_OWN, GROUP
from .drawing import Sidebar, draw_message, put_labels
from .export_operators import ExportMenu
from .facts_panels import camera_of
from .frame import draw_frame
from .gallery_operators import ExamplesMenu
from .gallery_panels import draw_model
from .model_drawing import PRESETS, draw_cycles, draw_lens, draw_model_settings, draw_setting, draw_times, is_missing
from .model_settings import read_settings
from .operators import LoadCalibration
from .other_engine import draw_ignored
from .see_through import SeeThrough, is_seen_through


class SidebarCamera(Sidebar, bpy.types.Panel):
    """The scene's active camera."""

    bl_idname = "CAMERA_RAY_CASTER_PT_camera"
    bl_label = "Camera"

    def draw_header_preset(self, context):
        """Draw the button of the model presets."""
        camera = context.scene.camera
        if camera is not None and camera.type == "CAMERA":
            self.layout.context_pointer_set("camera", camera.data)  # the presets' target
            self.layout.emboss = "NONE"
            self.layout.popover(PRESETS, icon="PRESET", text="")

    def draw(self, context):
        """Draw the camera and its model, missing objects or the reason why it cannot be cast, and the operators."""
        layout, camera = self.layout, context.scene.camera
        layout.prop(context.scene, "camera", text="")
        if camera is not None and camera.type == "CAMERA":
            draw_model(layout, camera.data)
        found, reason = camera_of(context, camera)
        seen = context.space_data is not None and is_seen_through(context)
        if context.space_data is not None:
            layout.operator(SeeThrough.bl_idname, icon="CAMERA_DATA", depress=seen)
        row = layout.row(align=True)
        row.menu(ExportMenu.bl_idname, text="Export", icon="EXPORT")
        row.menu(ExamplesMenu.bl_idname, text="Examples", icon="FILE_BLEND")
        layout.operator(LoadCalibration.bl_idname, icon="FILE_FOLDER")
        if camera is not None and camera.type == "CAMERA":
            draw_cycles(layout, camera.data)
        lacking = missing(context, camera) if reason else ()
        for setting in lacking:  # from here on what comes and goes: it moves no button above
            draw_setting(layout, context, camera.data, setting)
        if reason and not lacking:
            draw_message(layout, context, reason, "ERROR")
        draw_frame(layout, context, camera, is_refused=bool(reason))
        draw_ignored(layout, context, camera)
        draw_samples(layout, context, found)
        if seen and not drawn_alike(camera):
            draw_message(layout, context, "A click selects what is seen; Blender draws its gizmos in perspective")


def draw_samples(layout, context, camera) -> None:
    """Draw the number of samples beside a note if a camera with an opening is rendered with one ray per pixel."""
    settings = context.scene.camera_ray_caster
    if camera is not None and camera.aperture is not None and settings.samples == 1:
        draw_message(layout, context, "With 1 sample nothing is blurred: rays pass the middle of the opening only")
        layout.prop(settings, "samples")


def drawn_alike(camera) -> bool:
    """Return whether Blender's overlays match the picture of a camera object's model."""
    if camera is None or camera.type != "CAMERA":
        return True
    return getattr(camera.data, GROUP).model == BLENDERS_OWN and camera.data.type in {"PERSP", "ORTHO"}


def missing(context, camera) -> list[Setting]:
    """Return the object settings of a camera object's model whose objects are not there."""
    if camera is None or camera.type != "CAMERA":
        return []
    own = getattr(camera.data, GROUP)
    return [it for it in read_settings(camera.data) if it.kind == "OBJECT" and is_missing(context, own, it)]


class SidebarSettings(Sidebar, bpy.types.Panel):
    """The settings that the model reads, and the times of the pixels."""

    bl_idname = "CAMERA_RAY_CASTER_PT_settings"
    bl_label = "Settings"
    bl_parent_id = SidebarCamera.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        """Show the panel for cameras."""
        return context.scene.camera is not None and context.scene.camera.type == "CAMERA"

    def draw(self, context):
        """Draw the settings of the model, or the lens for Blender's own models; then the pixel times."""
        layout, camera = self.layout, context.scene.camera.data
        put_labels(layout, context)
        layout.use_property_decorate = False
        if getattr(camera, GROUP).model == BLENDERS_OWN:
            draw_lens(layout, context, camera)
        else:
            drawn = missing(context, context.scene.camera)
            draw_model_settings(layout, context, camera, beside_lens=False, drawn=drawn)
        draw_times(layout, context, camera)


CLASSES = (SidebarCamera, SidebarSettings)
