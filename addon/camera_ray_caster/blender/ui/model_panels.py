"""The panels in the camera's tab where a model is chosen, with the settings of the chosen one only."""

import bpy

from ...core.cameras.parts.film import SENSOR_FIT, SHIFT
from ..properties.declared import ENGINE
from ..read.camera import shader_mark
from .cycles_operators import BackToBlender, UseInCycles
from .drawing import draw_field, put_labels
from .gallery_panels import draw_model
from .model_drawing import PRESETS, draw_lens, draw_model_settings, draw_times
from .model_settings import read_settings
from .operators import LoadCalibration


class CameraPanel:
    """What the panels of a camera's properties have in common."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        """Show it for cameras."""
        return context.camera is not None


class ModelPanel(CameraPanel, bpy.types.Panel):
    """Camera properties, above the lens: the model and its settings."""

    bl_idname = "CAMERA_RAY_CASTER_PT_model"
    bl_label = "Camera Model"
    bl_parent_id = "DATA_PT_context_camera"

    def draw_header_preset(self, context):
        """The presets."""
        self.layout.emboss = "NONE"
        self.layout.popover(PRESETS, icon="PRESET", text="")

    def draw(self, context):
        """The list; below it what the chosen model needs."""
        layout, camera = self.layout, context.camera
        row = draw_model(layout, camera, text="")
        row.operator(LoadCalibration.bl_idname, text="", icon="FILEBROWSER")
        put_labels(layout, context)
        draw_model_settings(layout, context, camera)
        draw_cycles(layout, camera)


class LensPanel(CameraPanel, bpy.types.Panel):
    """Camera properties with our engine: what Blender's own panel of that name has, and the settings of panoramas,
    which that shows for Cycles only. What the model does not read is gray.
    """

    bl_idname = "CAMERA_RAY_CASTER_PT_lens"
    bl_label = "Lens"
    bl_parent_id = "DATA_PT_context_camera"

    @classmethod
    def poll(cls, context):
        """Show it with this engine only, in place of Blender's."""
        return super().poll(context) and context.engine == ENGINE

    def draw(self, context):
        """The type of Blender's, its settings and those of the model that Blender has; shift; clip."""
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
    """Camera properties with our engine: the sensor, gray where the model does not read it, and Blender's presets."""

    bl_idname = "CAMERA_RAY_CASTER_PT_sensor"
    bl_label = "Camera"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        """Show it with this engine only, in place of Blender's."""
        return super().poll(context) and context.engine == ENGINE

    def draw_header_preset(self, context):
        """Blender's presets of sensors."""
        bpy.types.CAMERA_PT_presets.draw_panel_header(self.layout)

    def draw(self, context):
        """How the sensor is fitted, and the side that counts."""
        layout, camera = self.layout.column(), context.camera
        put_labels(layout, context)
        layout.active = SENSOR_FIT in read_settings(camera)
        draw_field(layout, context, camera, "sensor_fit")
        layout.prop(camera, "sensor_height" if camera.sensor_fit == "VERTICAL" else "sensor_width", text="Size")


def draw_cycles(layout, camera) -> None:
    """Draw what makes a camera one of Cycles; of one that it is already, what makes it anew and takes it back."""
    if shader_mark(camera) is None:
        layout.operator(UseInCycles.bl_idname, icon="SHADING_RENDERED")
        return
    row = layout.row(align=True)
    row.operator(BackToBlender.bl_idname, icon="LOOP_BACK")
    row.operator(UseInCycles.bl_idname, text="", icon="FILE_REFRESH")


class TimePanel(CameraPanel, bpy.types.Panel):
    """Camera properties: the time of each pixel."""

    bl_idname = "CAMERA_RAY_CASTER_PT_time"
    bl_label = "Time"
    bl_parent_id = ModelPanel.bl_idname
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """The list; below it what the chosen mode needs."""
        put_labels(self.layout, context)
        draw_times(self.layout, context, context.camera)


CLASSES = (ModelPanel, LensPanel, SensorPanel, TimePanel)
