"""Which settings of a camera count: by its model, or by its type where that is Blender's."""

from ...core.cameras import MODELS
from ...core.cameras.parts.calibration import IN_PIXELS, MILLIMETERS, SIZE, UNIT
from ...core.cameras.parts.film import FILM, LENS
from ...core.cameras.parts.settings import CAMERA, OWN, STEREO, Setting
from ..cycles.shader import CUSTOM
from ..properties.declared import BLENDERS_OWN, ENGINE, GROUP
from ..read.camera import shader_mark

SETTINGS = {model.key: model.SETTINGS for model in MODELS}

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


def read_settings(camera) -> list[Setting]:
    """Return those of a model's settings that count, as the unit of its lengths is."""
    settings = settings_of(camera)
    hidden = not_counted(settings, getattr(camera, GROUP))
    return [setting for setting in settings if setting not in hidden]


def of_type(camera) -> tuple[Setting, ...]:
    """Return the settings of the type that Blender gives a camera, whatever its model is."""
    return SETTINGS.get(camera.panorama_type if camera.type == "PANO" else camera.type, ())


def not_used(camera) -> list[str]:
    """Return the labels of Blender's settings of a camera's lens that its model does not use."""
    if getattr(camera, GROUP).model == BLENDERS_OWN:
        return []
    read = read_settings(camera)
    labels = [it.label for it in dict.fromkeys((*of_type(camera), *FILM)) if it.owner == CAMERA and it not in read]
    return ["Type", *labels]


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
