"""The panel in the camera's tab where a model is chosen, with the settings of the chosen one only."""

import bpy

from ...core.camera import pixel_time
from ...core.cameras import MODELS
from ...core.cameras.parts.calibration import IN_PIXELS, MILLIMETERS, SIZE, UNIT
from ...core.cameras.parts.film import FILM, LENS
from ...core.cameras.parts.settings import CAMERA, OWN, STEREO, Setting
from ..cycles.shader import CUSTOM
from ..properties.declared import BLENDERS_OWN, GROUP, MODEL
from ..properties.owners import owner_of
from ..read.camera import shader_mark
from .cycles_operators import BackToBlender, UseInCycles
from .operators import LoadCalibration

SETTINGS = {model.key: model.SETTINGS for model in MODELS}

SHOWN_FOR = {"lens": "PERSP", "ortho_scale": "ORTHO"}
"""Blender's own settings that its panel shows for one type of camera only. Those of the film it always shows."""


def shown(setting: Setting, camera) -> bool:
    """Return whether the panel shows a setting: the add-on's own, and Blender's that Blender's panel does not show."""
    if setting.owner == CAMERA:
        if camera.type == CUSTOM:
            return setting not in FILM
        return SHOWN_FOR.get(setting.name, camera.type) != camera.type
    return setting.owner in (OWN, STEREO)


def settings_of(camera) -> tuple[Setting, ...]:
    """Return the settings of a camera's model; of a custom one that was of a type of Blender's, those of that type."""
    mark, own = shader_mark(camera), getattr(camera, GROUP)
    if mark is None or own.model != BLENDERS_OWN:
        return SETTINGS.get(own.model, ())
    return SETTINGS[camera.panorama_type if mark.blender_type == "PANO" else mark.blender_type]


def not_counted(settings, own) -> tuple[Setting, ...]:
    """Return what does not count of a model's settings, by the unit of its lengths where it has one."""
    if UNIT not in settings:
        return ()
    return IN_PIXELS if in_millimeters(own) else (LENS,)


def in_millimeters(own) -> bool:
    """Whether the lengths of a calibrated model are: a calibration file's are in pixels."""
    return own.calibration_unit == MILLIMETERS and not own.calibration_file


def lengths_in_words(own) -> str:
    """Return what the lengths of a calibrated model are measured in."""
    if own.calibration_file:
        return "Pixels of the file's picture, scaled to the frame"
    if in_millimeters(own):
        return "Millimeters on Blender's sensor, the center by its Shift"
    sides = [str(getattr(own, side.name) or "the frame's") for side in SIZE]
    return f"Pixels of a picture of {' × '.join(sides)}, scaled to the frame"


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
        row = layout.row(align=True)
        row.prop(own, MODEL.name)
        row.operator(LoadCalibration.bl_idname, text="", icon="FILEBROWSER")
        column, settings = layout.column(align=True), settings_of(camera)
        hidden = not_counted(settings, own)
        for setting in settings:
            if shown(setting, camera) and setting not in hidden:
                draw_setting(column, setting, camera, context.scene)
            if setting.replaces_the_rest:
                column = layout.column(align=True)
                column.active = not getattr(own, setting.name)
        if UNIT in settings:
            layout.label(text=lengths_in_words(own))
        draw_cycles(layout, camera)


def draw_cycles(layout, camera) -> None:
    """Draw what makes a camera one of Cycles; of one that it is already, what makes it anew and takes it back."""
    if shader_mark(camera) is None:
        layout.operator(UseInCycles.bl_idname, icon="SHADING_RENDERED")
        return
    row = layout.row(align=True)
    row.operator(BackToBlender.bl_idname, icon="LOOP_BACK")
    row.operator(UseInCycles.bl_idname, text="", icon="FILE_REFRESH")


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
