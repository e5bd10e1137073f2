"""The panel in the camera's tab where a model is chosen, with the settings of the chosen one only."""

import bpy

from ...core.camera import pixel_time
from ...core.cameras import MODELS
from ...core.cameras.parts.settings import CAMERA, OWN, STEREO, Setting
from ..properties.declared import GROUP, MODEL
from ..properties.owners import owner_of

SETTINGS = {model.key: model.SETTINGS for model in MODELS}

SHOWN_FOR = {"lens": "PERSP", "ortho_scale": "ORTHO"}
"""Blender's own settings that its panel shows for one type of camera only. Those of the film it always shows."""


def shown(setting: Setting, camera) -> bool:
    """Return whether the panel shows a setting: the add-on's own, and Blender's that Blender's panel does not show."""
    if setting.owner == CAMERA:
        return SHOWN_FOR.get(setting.name, camera.type) != camera.type
    return setting.owner in (OWN, STEREO)


class ModelPanel(bpy.types.Panel):
    """Camera properties: the model and its settings."""

    bl_idname = "CAMERA_RAY_CASTER_PT_model"
    bl_label = "Ray Caster Model"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        """Show it for cameras."""
        return context.camera is not None

    def draw(self, context):
        """The list; below it what the chosen model needs. A calibration file grays out the numbers that it replaces."""
        layout, camera = self.layout, context.camera
        layout.use_property_split = True
        own = getattr(camera, GROUP)
        layout.prop(own, MODEL.name)
        column = layout.column(align=True)
        for setting in SETTINGS.get(own.model, ()):
            if shown(setting, camera):
                draw_setting(column, setting, camera, context.scene)
            if setting.replaces_the_rest:
                column = layout.column(align=True)
                column.active = not getattr(own, setting.name)


class TimePanel(bpy.types.Panel):
    """Camera properties: the time of each pixel."""

    bl_idname = "CAMERA_RAY_CASTER_PT_time"
    bl_label = "Time"
    bl_parent_id = ModelPanel.bl_idname
    bl_space_type = ModelPanel.bl_space_type
    bl_region_type = ModelPanel.bl_region_type
    bl_context = ModelPanel.bl_context
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        """The list; below it what the chosen mode needs."""
        layout, camera = self.layout, context.camera
        layout.use_property_split = True
        own = getattr(camera, GROUP)
        layout.prop(own, pixel_time.MODE.name)
        for setting in pixel_time.SETTINGS.get(own.time_mode, ()):
            draw_setting(layout, setting, camera, context.scene)


def draw_setting(layout, setting: Setting, camera, scene) -> None:
    """Draw a setting where it is; nothing for one of Cycles while that is disabled."""
    owner = owner_of(setting, camera, scene)
    if owner is not None:
        KINDS.get(setting.kind, _draw_property)(layout, owner, setting.name)


def _draw_property(layout, owner, name: str) -> None:
    layout.prop(owner, name)


def _draw_image(layout, owner, name: str) -> None:
    layout.template_ID(owner, name, open="image.open")


KINDS = {"IMAGE": _draw_image}
"""How the kinds of settings are drawn that are not drawn as a plain property."""

CLASSES = (ModelPanel, TimePanel)
