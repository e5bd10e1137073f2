"""Panels in the camera's tab: the choice of a model and the settings of the chosen model, lens, sensor and time."""

import bpy

from ...core.cameras.parts.film import SENSOR_FIT, SHIFT
from ..properties.declared import ENGINE
from .drawing import draw_field, put_labels
from .frame import frame_note
from .gallery_panels import draw_model
from .model_drawing import PRESETS, draw_cycles, draw_lens, draw_model_settings, draw_port, draw_times
from .model_settings import port_settings, read_settings
from .needs import camera_object_of
from .notes import draw_notes
from .operators import LoadCalibration
from .other_engine import engine_note


class CameraPanel:
    """Base of the panels in the camera's tab."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return context.camera is not None


class ModelPanel(CameraPanel, bpy.types.Panel):
    """Camera properties, above the lens: the model and its settings."""

    bl_idname = "CAMERA_RAY_CASTER_PT_model"
    bl_label = "Camera Model"
    bl_parent_id = "DATA_PT_context_camera"

    def draw_header_preset(self, context):
        self.layout.emboss = "NONE"
        self.layout.popover(PRESETS, icon="PRESET", text="")

    def draw(self, context):
        layout, camera = self.layout, context.camera
        row = draw_model(layout, camera)
        row.operator(LoadCalibration.bl_idname, text="", icon="FILEBROWSER")
        put_labels(layout, context)
        draw_model_settings(layout, context, camera)
        item = camera_object_of(context)
        draw_notes(layout, context, filter(None, (frame_note(context, item), engine_note(context.scene, item))))
        draw_cycles(layout, camera)


class LensPanel(CameraPanel, bpy.types.Panel):
    """Camera properties with this engine: the settings of Blender's own Lens panel, and the panorama settings that
    Blender shows for Cycles only. Settings that the model does not read are gray.
    """

    bl_idname = "CAMERA_RAY_CASTER_PT_lens"
    bl_label = "Lens"
    bl_parent_id = "DATA_PT_context_camera"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.engine == ENGINE

    def draw(self, context):
        layout, camera = self.layout, context.camera
        put_labels(layout, context)
        draw_lens(layout, context, camera)
        column = layout.column(align=True)
        column.active = set(SHIFT) <= set(read_settings(camera))
        column.prop(camera, "shift_x", text="Shift X")
        column.prop(camera, "shift_y", text="Y")
        column = layout.column(align=True)
        column.prop(camera, "clip_start", text="Clip Start")
        column.prop(camera, "clip_end", text="End")


class SensorPanel(CameraPanel, bpy.types.Panel):
    """Camera properties with this engine: the sensor, gray if the model does not read it, and Blender's presets."""

    bl_idname = "CAMERA_RAY_CASTER_PT_sensor"
    bl_label = "Camera"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.engine == ENGINE

    def draw_header_preset(self, context):
        bpy.types.CAMERA_PT_presets.draw_panel_header(self.layout)

    def draw(self, context):
        layout, camera = self.layout.column(), context.camera
        put_labels(layout, context)
        layout.active = SENSOR_FIT in read_settings(camera)
        draw_field(layout, context, camera, "sensor_fit")
        layout.prop(camera, "sensor_height" if camera.sensor_fit == "VERTICAL" else "sensor_width", text="Size")


class TimePanel(CameraPanel, bpy.types.Panel):
    """Camera properties: the time of each pixel."""

    bl_idname = "CAMERA_RAY_CASTER_PT_time"
    bl_label = "Time"
    bl_parent_id = ModelPanel.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        put_labels(self.layout, context)
        draw_times(self.layout, context, context.camera)


class PortPanel(CameraPanel, bpy.types.Panel):
    """Camera properties: the glass before the lens, for models whose rays leave one eye."""

    bl_idname = "CAMERA_RAY_CASTER_PT_port"
    bl_label = "Behind Glass"
    bl_parent_id = ModelPanel.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.camera is not None and bool(port_settings(context.camera))

    def draw(self, context):
        put_labels(self.layout, context)
        draw_port(self.layout, context, context.camera)


CLASSES = (ModelPanel, LensPanel, SensorPanel, PortPanel, TimePanel)
