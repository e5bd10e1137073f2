"""Sidebar panels of the active camera: its choice, its model and settings, and its operators."""

import bpy

from ..properties.declared import BLENDERS_OWN, GROUP
from ..read.movie_clips import clips_of
from .camera_notes import notes
from .drawing import Sidebar, put_labels
from .export_operators import ExportMenu
from .gallery_operators import ExamplesMenu
from .gallery_panels import draw_model
from .model_drawing import PRESETS, draw_cycles, draw_lens, draw_model_settings, draw_port, draw_times
from .model_settings import missing
from .notes import Popover, draw_first, draw_notes, widen
from .operators import LensOfClip, LoadCalibration
from .rig_operators import AddCameras
from .see_through import SeeThrough, is_seen_through


class SidebarCamera(Sidebar, bpy.types.Panel):
    """The scene's active camera."""

    bl_idname = "CAMERA_RAY_CASTER_PT_camera"
    bl_label = "Camera"

    def draw_header_preset(self, context):
        camera = context.scene.camera
        if camera is not None and camera.type == "CAMERA":
            self.layout.context_pointer_set("camera", camera.data)  # the presets' target
            self.layout.emboss = "NONE"
            self.layout.popover(PRESETS, icon="PRESET", text="")

    def draw(self, context):
        layout, camera = self.layout, context.scene.camera
        layout.prop(context.scene, "camera", text="")
        if camera is not None and camera.type == "CAMERA":
            draw_model(layout, camera.data)
        if context.space_data is not None:
            layout.operator(SeeThrough.bl_idname, icon="CAMERA_DATA", depress=is_seen_through(context))
        row = layout.row(align=True)
        row.menu(ExportMenu.bl_idname, text="Export", icon="EXPORT")
        row.menu(ExamplesMenu.bl_idname, text="Examples", icon="FILE_BLEND")
        row = layout.row(align=True)
        row.operator(LoadCalibration.bl_idname, icon="FILE_FOLDER")
        row.operator(AddCameras.bl_idname, text="Add Cameras", icon="OUTLINER_OB_CAMERA")
        if camera is not None and camera.type == "CAMERA" and clips_of(context.scene, camera):
            layout.operator(LensOfClip.bl_idname, icon="TRACKER")
        if camera is not None and camera.type == "CAMERA":
            draw_cycles(layout, camera.data)
        draw_first(layout, context, notes(context), CameraNotes.bl_idname)


class CameraNotes(Popover, bpy.types.Panel):
    """All notes on the camera in full, with buttons that solve the problems"""

    bl_idname = "CAMERA_RAY_CASTER_PT_camera_notes"
    bl_label = "Notes"

    def draw(self, context):
        widen(self.layout, context)
        draw_notes(self.layout, context, notes(context))


class SidebarSettings(Sidebar, bpy.types.Panel):
    """The settings that the model reads, and the times of the pixels."""

    bl_idname = "CAMERA_RAY_CASTER_PT_settings"
    bl_label = "Settings"
    bl_parent_id = SidebarCamera.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.scene.camera is not None and context.scene.camera.type == "CAMERA"

    def draw(self, context):
        layout, camera = self.layout, context.scene.camera.data
        put_labels(layout, context)
        layout.use_property_decorate = False
        if getattr(camera, GROUP).model == BLENDERS_OWN:
            draw_lens(layout, context, camera)
        else:
            drawn = missing(context, context.scene.camera)
            draw_model_settings(layout, context, camera, beside_lens=False, drawn=drawn)
        draw_port(layout, context, camera)
        draw_times(layout, context, camera)


CLASSES = (SidebarCamera, CameraNotes, SidebarSettings)
