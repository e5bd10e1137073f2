"""The panels in the camera's tab where a model is chosen, with the settings of the chosen one only."""

import bpy

from ...core.camera import pixel_time
from ...core.cameras import MODELS
from ...core.cameras.parts.calibration import IN_PIXELS, MILLIMETERS, SIZE, UNIT
from ...core.cameras.parts.film import FILM, LENS, SHIFT
from ...core.cameras.parts.settings import CAMERA, OWN, STEREO, Setting
from ..cycles.shader import CUSTOM
from ..properties.declared import BLENDERS_OWN, ENGINE, GROUP
from ..properties.owners import owner_of
from ..read.camera import shader_mark
from .add_line import AddLine
from .camera_panels import draw_message
from .cycles_operators import BackToBlender, UseInCycles
from .gallery_panels import draw_model
from .operators import LoadCalibration

SETTINGS = {model.key: model.SETTINGS for model in MODELS}

PRESETS = "CAMERA_RAY_CASTER_PT_presets"
"""The panel of the presets, which needs what is here."""

SHOWN_FOR = {"lens": "PERSP", "ortho_scale": "ORTHO"}
"""Blender's own settings that its panel shows for one type of camera only. Those of the film it always shows."""


def shown(setting: Setting, camera, engine: str) -> bool:
    """Return whether the panel shows a setting: the add-on's own, and Blender's that no panel of the lens shows."""
    if setting.owner == CAMERA:
        if engine == ENGINE:
            return False
        if camera.type == CUSTOM:
            return setting not in FILM
        return SHOWN_FOR.get(setting.name, camera.type) != camera.type
    return setting.owner in (OWN, STEREO)


def settings_of(camera) -> tuple[Setting, ...]:
    """Return the settings of a camera's model, or of its type where that is Blender's; of a custom camera that we made,
    those of the type that it was of.
    """
    mark, own = shader_mark(camera), getattr(camera, GROUP)
    if own.model != BLENDERS_OWN:
        return SETTINGS.get(own.model, ())
    kind = camera.type if mark is None else mark.blender_type
    return SETTINGS.get(camera.panorama_type if kind == "PANO" else kind, ())


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
        """The list; below it what the chosen model needs. A calibration file grays out the numbers that it replaces."""
        layout, camera = self.layout, context.camera
        layout.use_property_split = True
        own = getattr(camera, GROUP)
        row = draw_model(layout, camera)
        row.operator(LoadCalibration.bl_idname, text="", icon="FILEBROWSER")
        column, settings = layout.column(align=True), settings_of(camera)
        hidden = not_counted(settings, own)
        for setting in settings:
            if shown(setting, camera, context.engine) and setting not in hidden:
                draw_setting(column, context, setting)
            if setting.replaces_the_rest:
                column = layout.column(align=True)
                column.active = not getattr(own, setting.name)
        if UNIT in settings:
            layout.label(text=lengths_in_words(own))
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
        layout.use_property_split = True
        own, settings = getattr(camera, GROUP), settings_of(camera)
        read = [setting for setting in settings if setting not in not_counted(settings, own)]
        column = layout.column()
        column.active = own.model == BLENDERS_OWN
        column.prop(camera, "type")
        if camera.type == "PANO":
            column.prop(camera, "panorama_type")
        of_type = SETTINGS.get(camera.panorama_type if camera.type == "PANO" else camera.type, ())
        column = layout.column(align=True)
        for setting in dict.fromkeys((*of_type, *read)):
            if setting.owner == CAMERA and setting not in FILM:
                row = column.row()
                row.active = setting in read
                by_angle = setting == LENS and camera.lens_unit == "FOV"
                row.prop(camera, "angle" if by_angle else setting.name)
        if LENS in (*of_type, *read):
            row = column.row()
            row.active = LENS in read
            row.prop(camera, "lens_unit")
        column = layout.column(align=True)
        column.active = set(SHIFT) <= set(read)
        column.prop(camera, "shift_x", text="Shift X")
        column.prop(camera, "shift_y", text="Y")
        column = layout.column(align=True)
        column.prop(camera, "clip_start", text="Clip Start")
        column.prop(camera, "clip_end", text="End")


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
        layout, camera = self.layout, context.camera
        layout.use_property_split = True
        own = getattr(camera, GROUP)
        layout.prop(own, pixel_time.MODE.name)
        for setting in pixel_time.SETTINGS.get(own.time_mode, ()):
            draw_setting(layout, context, setting)


def draw_setting(layout, context, setting: Setting) -> None:
    """Draw a setting of the camera in the context; nothing for one of Cycles while that is disabled."""
    owner = owner_of(setting, context.camera, context.scene)
    if owner is not None:
        KINDS.get(setting.kind, _draw_property)(layout, context, owner, setting)


def _draw_property(layout, context, owner, setting) -> None:
    layout.prop(owner, setting.name)


def _draw_image(layout, context, owner, setting) -> None:
    layout.template_ID(owner, setting.name, open="image.open")


def _draw_vector(layout, context, owner, setting) -> None:
    layout.label(text=setting.label)
    for i, name in enumerate(setting.components):
        layout.prop(owner, setting.name, index=i, text=name)


def _draw_object(layout, context, owner, setting) -> None:
    """Draw the object; where there is none, what it should be, and a button that adds one."""
    layout.prop(owner, setting.name)
    if getattr(owner, setting.name) is None:
        draw_message(layout, context, f"Missing: {setting.text[:1].lower()}{setting.text[1:]}", "ERROR")
        layout.operator(AddLine.bl_idname, text=f"Add {setting.label}", icon="ADD").setting = setting.name


KINDS = {"IMAGE": _draw_image, "VECTOR": _draw_vector, "OBJECT": _draw_object}
"""How the kinds of settings are drawn that are not drawn as a plain property."""

CLASSES = (ModelPanel, LensPanel, TimePanel)
