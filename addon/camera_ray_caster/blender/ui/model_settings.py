"""Which settings a camera uses: those of its model, or of its type for Blender's own models."""

from ...core.cameras import MODELS
from ...core.cameras.behind_port import takes_port
from ...core.cameras.model import Model
from ...core.cameras.parts.calibration import FILE, FILE_CAMERA, MILLIMETERS, SIZE
from ...core.cameras.parts.film import FILM, LENS, SENSOR_WIDTH
from ...core.cameras.parts.port_settings import PORT
from ...core.cameras.parts.port_settings import SETTINGS as PORTS
from ...core.cameras.parts.settings import CAMERA, OWN, STEREO, Setting
from ..cycles.shader import CUSTOM
from ..properties.declared import BLENDERS_OWN, ENGINE, GROUP
from ..read.camera_fields import shader_mark

SHOWN_FOR = {"lens": "PERSP", "ortho_scale": "ORTHO"}
"""Camera types by Blender setting, for settings that Blender's panel shows for one type only; film is always shown."""


def _of_model(key: str) -> tuple[Setting, ...]:
    return next((model.SETTINGS for model in MODELS if model.key == key), ())


def model_of(camera) -> type[Model] | None:
    """Return a camera's model; None for Blender's custom camera."""
    return next((model for model in MODELS if model.key == key_of(camera)), None)


def port_settings(camera) -> tuple[Setting, ...]:
    """Return the settings of the glass before a camera's lens; none for a model that cannot have any."""
    model = model_of(camera)
    if model is None or not takes_port(model):
        return ()
    return PORT, *PORTS.get(getattr(camera, GROUP).port, ())


def shown(setting: Setting, camera, engine: str) -> bool:
    """Return whether the model panel shows a setting: the add-on's own, or Blender's if no lens panel shows it."""
    if setting.owner == CAMERA:
        if engine == ENGINE:
            return False
        if camera.type == CUSTOM:
            return setting not in FILM
        return SHOWN_FOR.get(setting.name, camera.type) != camera.type
    return setting.owner in (OWN, STEREO)


def blender_type(camera) -> str:
    """Return the key of the model of a camera's Blender type. For a custom camera that this add-on made, that of the
    type before.
    """
    mark = shader_mark(camera)
    kind = camera.type if mark is None else mark.blender_type
    return camera.panorama_type if kind == "PANO" else kind


def key_of(camera) -> str:
    """Return the key of a camera's model, or of its type for Blender's own models: see ``blender_type``."""
    model = getattr(camera, GROUP).model
    return blender_type(camera) if model == BLENDERS_OWN else model


def settings_of(camera) -> tuple[Setting, ...]:
    """Return the settings of a camera's model."""
    return _of_model(key_of(camera))


def read_settings(camera) -> list[Setting]:
    """Return the settings of a camera's model that are used beside its calibration file, or without one. The focal
    length is also that of the aperture.
    """
    model, group = model_of(camera), getattr(camera, GROUP)
    if model is None:
        return []
    by_aperture = (LENS,) if camera.dof.use_dof else ()
    if FILE in model.SETTINGS and group.calibration_file:
        return [setting for setting in model.SETTINGS if setting in (*model.BESIDE_FILE, *by_aperture)]
    names = {setting.name for setting in model.SETTINGS}

    def is_used(setting: Setting) -> bool:
        values = ((getattr(group, name), value) for name, value in setting.used_with if name in names)
        return all((chosen.strip() if isinstance(chosen, str) else chosen) == value for chosen, value in values)

    return [
        setting for setting in model.SETTINGS
        if setting != FILE_CAMERA and (setting in by_aperture or is_used(setting))
    ]  # fmt: skip


def eye_settings(camera, scene) -> list[Setting]:
    """Return the settings that the eyes of a stereo scene read with Off-Axis convergence, and that the lens does not
    show otherwise: an orthographic camera's focal length, and the width of a sensor that is fitted by its height. See
    ``parts.film.off_axis``.
    """
    render, stereo = scene.render, camera.stereo
    if not render.use_multiview or render.views_format != "STEREO_3D" or stereo.convergence_mode != "OFFAXIS":
        return []
    width = [SENSOR_WIDTH] if camera.sensor_fit == "VERTICAL" else []
    of_kind = {"ORTHO": [LENS, *width], "PERSP": [] if stereo.use_spherical_stereo else width}
    return of_kind.get(key_of(camera), [])


def of_type(camera) -> tuple[Setting, ...]:
    """Return the settings of a camera's Blender type, whatever its model is."""
    return _of_model(blender_type(camera))


def not_used(camera) -> list[str]:
    """Return the labels of the Blender lens settings that a camera's model does not use."""
    if getattr(camera, GROUP).model == BLENDERS_OWN:
        return []
    read = read_settings(camera)
    unread = [setting for setting in dict.fromkeys((*of_type(camera), *FILM)) if setting not in read]
    return ["Type", *(setting.label for setting in unread if setting.owner == CAMERA)]


def lengths_in_words(group) -> str:
    """Return a description of the unit of a calibrated model's lengths."""
    if group.calibration_file:
        return "In pixels of the file's picture, scaled to the frame"
    if group.calibration_unit == MILLIMETERS:
        return "In millimeters on Blender's sensor; Shift sets the center"
    sides = [str(getattr(group, side.name) or "the frame's") for side in SIZE]
    return f"In pixels of a picture of {' × '.join(sides)}, scaled to the frame"


def missing(context, camera) -> list[Setting]:
    """Return the object settings of a camera object's model whose objects are missing."""
    if camera is None or camera.type != "CAMERA":
        return []
    settings = getattr(camera.data, GROUP)
    objects = [setting for setting in read_settings(camera.data) if setting.kind == "OBJECT"]
    return [setting for setting in objects if is_missing(context, settings, setting)]


def is_missing(context, owner, setting: Setting) -> bool:
    """Return whether the object of a setting is not set, or not in the view layer, as one that was deleted."""
    item = getattr(owner, setting.name)
    return item is None or context.view_layer.objects.get(item.name) != item


def lacks(setting: Setting) -> str:
    """Return a line that says that the object of a setting is missing."""
    return f"Missing: {setting.text[:1].lower()}{setting.text[1:]}"
