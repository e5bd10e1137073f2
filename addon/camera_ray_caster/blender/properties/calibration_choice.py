"""Choosing a calibration file for a camera, which also sets the camera's model."""

from typing import Any

from ...core.camera.calibration_file import FRAMES_SIZE, chosen_lens, has_size, model_of
from ...core.cameras import MODELS
from ...core.cameras.parts.calibration import FILE, FILE_CAMERA, FROM_FILE
from ...core.cameras.parts.settings import CAMERA, OWN
from ...core.programs.parts.lens import Lens
from ...core.programs.reading.lenses import lenses_of
from ...core.records import InputError
from .declared import BLENDERS_OWN, GROUP, MODEL
from .owners import owner_of

READING = {model.key: model.label for model in MODELS if FILE in model.SETTINGS}
"""Labels of the models that read calibration files, by key."""

KINDS_IN_FILES = "FLOAT", "INT", "BOOLEAN", "ENUM", "VECTOR", "TEXT"
"""Kinds of settings that a file can give; not objects and images of a .blend."""


def renew() -> None:
    """Add the models that were registered since."""
    READING.update({model.key: model.label for model in MODELS if FILE in model.SETTINGS})


def set_calibration(
    camera, path: str, name: str = "", picture_size: tuple[int, int] | None = None, model: str = ""
) -> str:
    """Set the calibration file and the matching model of a camera's data; return a line about the values read.

    A camera of a model that reads calibration files is linked to the file; of any other model, such as a panorama, the
    settings are set. name: of the camera in a file with several. picture_size: of the scene. model: key of the model
    that the file has to be for; default: any, and that of the camera if the file does not tell. Raises InputError if
    the file cannot be read or is for another model, or if none of several cameras is chosen; the message lists them.
    Nothing is changed then.
    """
    group = getattr(camera, GROUP)
    lens = chosen_lens(path, model or _key(group), name, picture_size)
    if model not in ("", lens.model):
        label = model_of(lens).label
        raise InputError(f"{path!r} is a calibration for {label}, not {READING[model]}: choose that model")
    if lens.model in READING:
        for setting, value in {MODEL.name: lens.model, FILE.name: path, FILE_CAMERA.name: name}.items():
            setattr(group, setting, value)
    else:
        set_lens(camera, lens)
    numbers = ", ".join(f"{name} {value:.6g}" for name, value in lens.settings.items() if isinstance(value, float))
    size = "" if has_size(lens) else f"; {FRAMES_SIZE}"
    return f"Camera {lens.name or 'without a name'}: {model_of(lens).label}, {numbers}{size}"


def set_lens(camera, lens: Lens) -> None:
    """Set the model and all of its settings for a camera's data, without a link to a file.

    Raises InputError for a model whose settings are objects or images, before anything is changed.
    """
    model, group = model_of(lens), getattr(camera, GROUP)
    settings = [setting for setting in model.SETTINGS if setting.owner in (OWN, CAMERA) and setting not in FROM_FILE]
    if others := [setting.label for setting in settings if setting.kind not in KINDS_IN_FILES]:
        raise InputError(f"{model.label} has objects or images of a .blend ({', '.join(others)}), which no file has")
    if model.number is None:
        is_type = model.key in {item.identifier for item in camera.bl_rna.properties["type"].enum_items}
        camera.type = model.key if is_type else "PANO"
        if not is_type:
            camera.panorama_type = model.key
    for setting in FROM_FILE:
        setattr(group, setting.name, "")
    setattr(group, MODEL.name, BLENDERS_OWN if model.number is None else model.key)
    for setting in settings:
        value = lens.settings.get(setting.name, setting.default)
        setattr(owner_of(setting, camera, None), setting.name, int(value) if setting.kind == "INT" else value)


def settings_in(camera, lens: Lens) -> list[tuple[Any, str]]:
    """Return the owner and the name of each number of a camera's data that ``set_lens`` sets."""
    numbers = [setting for setting in model_of(lens).SETTINGS if setting.kind in ("FLOAT", "INT", "VECTOR")]
    return [(owner_of(setting, camera, None), setting.name) for setting in numbers if setting.owner in (OWN, CAMERA)]


def cameras_in(camera, path: str) -> list[str]:
    """Return the names of the cameras in a calibration file, as ``set_calibration`` would read it for a camera's data.
    Raises InputError if the file cannot be read.
    """
    return [lens.name for lens in lenses_in(camera, path)]


def lenses_in(camera, path: str) -> list[Lens]:
    """Return the lenses in a calibration file: see ``cameras_in``."""
    return lenses_of(path, _key(getattr(camera, GROUP)))


def _key(group) -> str:
    """Return the model as which a file is read that does not state one."""
    return group.model if group.model in READING else ""
