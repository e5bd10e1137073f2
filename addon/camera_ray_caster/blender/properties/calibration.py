"""Choosing a calibration file for a camera, which also sets the camera's model."""

from ...core.camera.calibration_file import chosen_lens
from ...core.cameras import MODELS
from ...core.cameras.files import lenses_of
from ...core.cameras.parts.calibration import FILE, FILE_CAMERA
from .declared import GROUP, MODEL

READING = {model.key: model.label for model in MODELS if FILE in model.SETTINGS}
"""Labels of the models that read calibration files, by key."""

PLAIN = "OPENCV_PINHOLE"
"""Model assumed for a file that does not name its model, unless a model of READING is already chosen."""


def set_calibration(camera, path: str, name: str = "") -> str:
    """Set the calibration file and the matching model of a camera's data; return a line about the values read.

    ``name`` is the name of the camera in a file with several cameras. Raises InputError if the file cannot be read, or
    if it has several cameras and none is chosen; the message names them. Nothing is changed then.
    """
    own = getattr(camera, GROUP)
    lens = chosen_lens(path, _key(own), name)
    values = {MODEL.name: lens.model, FILE.name: path, FILE_CAMERA.name: name}
    for setting, value in values.items():
        setattr(own, setting, value)
    numbers = ", ".join(f"{name} {value:.6g}" for name, value in lens.settings.items() if isinstance(value, float))
    return f"Camera {lens.name or 'without a name'}: {READING[lens.model]}, {numbers}"


def cameras_in(camera, path: str) -> list[str]:
    """Return the names of the cameras in a calibration file, as ``set_calibration`` would read it for a camera's data.
    Raises InputError if the file cannot be read.
    """
    return [lens.name for lens in lenses_of(path, _key(getattr(camera, GROUP)))]


def _key(own) -> str:
    """Return the model as which a file is read that does not state one."""
    return own.model if own.model in READING else PLAIN
