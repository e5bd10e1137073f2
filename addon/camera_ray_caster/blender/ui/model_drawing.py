"""Functions that draw the settings of a camera's model and lens, in the Properties editor and in the sidebar."""

from collections.abc import Sequence

from ...core.camera import pixel_time
from ...core.cameras.parts.calibration import UNIT
from ...core.cameras.parts.film import FILM, LENS, SENSOR_HEIGHT, SENSOR_WIDTH
from ...core.cameras.parts.lens_settings import LENS_FILE
from ...core.cameras.parts.settings import CAMERA, Setting
from ..cycles.shader import CUSTOM
from ..properties.declared import BLENDERS_OWN, ENGINE, GROUP
from ..properties.owners import owner_of
from ..read.camera_fields import shader_mark
from .add_line import AddGradient, AddLine, SelectLine
from .cycles_operators import AddProjector, BackToBlender, FitLens, UseInCycles
from .drawing import draw_field, draw_message
from .lens_operators import draw_lens_file
from .model_settings import (
    eye_settings,
    is_missing,
    lacks,
    lengths_in_words,
    not_used,
    of_type,
    port_settings,
    read_settings,
    settings_of,
    shown,
)

PRESETS = "CAMERA_RAY_CASTER_PT_presets"
"""Identifier of the presets' panel."""


def draw_model_settings(layout, context, camera, beside_lens: bool = True, drawn: Sequence[Setting] = ()) -> None:
    """Draw the settings of the chosen model; next to a panel of the lens (``beside_lens``), without the settings of
    that panel, and without those that are ``drawn`` elsewhere.
    """
    column = layout.column(align=True)
    other_side = SENSOR_WIDTH if camera.sensor_fit == "VERTICAL" else SENSOR_HEIGHT
    for setting in read_settings(camera):
        if setting not in (*drawn, other_side) and (not beside_lens or shown(setting, camera, context.engine)):
            draw_setting(column, context, camera, setting)
            if setting == LENS_FILE:
                draw_lens_file(column, camera)
    for setting in eye_settings(camera, context.scene) if beside_lens and context.engine != ENGINE else ():
        draw_setting(column, context, camera, setting)
    if UNIT in settings_of(camera):
        draw_message(layout, context, lengths_in_words(getattr(camera, GROUP)))
    if beside_lens and context.engine != ENGINE and camera.type != CUSTOM and (labels := not_used(camera)):
        draw_message(layout, context, f"The model does not use Blender's {', '.join(labels)}")


def draw_lens(layout, context, camera) -> None:
    """Draw Blender's camera type with its settings, and the other Blender settings that the model reads. Settings that
    the model does not read are gray.
    """
    by_eyes, offered = eye_settings(camera, context.scene), of_type(camera)
    read = [*read_settings(camera), *by_eyes]
    column = layout.column()
    column.active = getattr(camera, GROUP).model == BLENDERS_OWN
    draw_field(column, context, camera, "type")
    if camera.type == "PANO":
        draw_field(column, context, camera, "panorama_type")
    column = layout.column(align=True)
    for setting in dict.fromkeys((*offered, *read)):
        if setting.owner == CAMERA and (setting not in FILM or setting in by_eyes):
            row = column.row()
            row.active = setting in read
            by_angle = setting == LENS and camera.lens_unit == "FOV"
            draw_field(row, context, camera, *(("angle",) if by_angle else (setting.name, setting.label)))
    if LENS in (*offered, *read):
        row = column.row()
        row.active = LENS in read
        draw_field(row, context, camera, "lens_unit")


def draw_port(layout, context, camera) -> None:
    """Draw the choice of the glass before the lens, and its settings if it is chosen."""
    column = layout.column(align=True)
    for setting in port_settings(camera):
        draw_setting(column, context, camera, setting)


def draw_cycles(layout, camera) -> None:
    """Draw the button that makes a custom camera of Cycles, or the buttons that revert and update such a camera."""
    row = layout.row(align=True)
    if shader_mark(camera) is None:
        row.operator(UseInCycles.bl_idname, icon="SHADING_RENDERED")
        if getattr(camera, GROUP).model != BLENDERS_OWN:
            row.operator(FitLens.bl_idname)
        row.operator(AddProjector.bl_idname, text="", icon="LIGHT_SPOT")
        return
    row.operator(BackToBlender.bl_idname, icon="LOOP_BACK")
    row.operator(UseInCycles.bl_idname, text="", icon="FILE_REFRESH")


def draw_times(layout, context, camera) -> None:
    """Draw the list of pixel time modes; below it the settings of the chosen mode."""
    settings = getattr(camera, GROUP)
    draw_field(layout, context, settings, pixel_time.MODE.name)
    for setting in pixel_time.SETTINGS.get(settings.time_mode, ()):
        draw_setting(layout, context, camera, setting)


def draw_setting(layout, context, camera, setting: Setting) -> None:
    """Draw a setting of a camera, or nothing for a setting of Cycles while Cycles is disabled."""
    owner = owner_of(setting, camera, context.scene)
    if owner is not None:
        DRAWN_BY_KIND.get(setting.kind, _draw_property)(layout, context, owner, setting)


def _draw_property(layout, context, owner, setting) -> None:
    draw_field(layout, context, owner, setting.name)


def _draw_image(layout, context, owner, setting) -> None:
    layout.template_ID(owner, setting.name, open="image.open")
    if getattr(owner, setting.name) is None:
        layout.operator(AddGradient.bl_idname, icon="IPO_LINEAR")


def _draw_vector(layout, context, owner, setting) -> None:
    layout.label(text=setting.label)
    for i, name in enumerate(setting.components):
        layout.prop(owner, setting.name, index=i, text=name)


def _draw_object(layout, context, owner, setting) -> None:
    """Draw the object with a button that selects it. If there is none, draw a message and a button that adds one.
    """
    row = draw_field(layout, context, owner, setting.name)
    if not is_missing(context, owner, setting):
        row.operator(SelectLine.bl_idname, text="", icon="RESTRICT_SELECT_OFF").setting = setting.name
    else:
        draw_message(layout, context, lacks(setting), "ERROR")
        draw_add(layout, setting)


def draw_add(layout, setting: Setting) -> None:
    """Draw the button that adds the object of a setting."""
    layout.operator(AddLine.bl_idname, text=f"Add {setting.label}", icon="ADD").setting = setting.name


DRAWN_BY_KIND = {"IMAGE": _draw_image, "VECTOR": _draw_vector, "OBJECT": _draw_object}
"""Drawing functions by kind of setting; other kinds are drawn as plain properties."""
