"""A calibration file chosen for a camera: the model follows from it."""

from ...core.camera.calibration_file import chosen_lens
from ...core.cameras import MODELS
from ...core.cameras.parts.calibration import FILE, FILE_CAMERA
from .declared import GROUP, MODEL

READING = {model.key: model.label for model in MODELS if FILE in model.SETTINGS}
"""The models that read calibration files."""

PLAIN = "OPENCV_PINHOLE"
"""Whose coefficients those of a file are that does not say its model, unless one of READING is chosen already."""


def set_calibration(camera, path: str, name: str = "") -> str:
    """Give a camera's data the model that a calibration file is for, and the file; return what was read, in a line.

    name: of the camera in a file with several. Raises InputError for a file that cannot be read, and for one with
    several cameras of which none is chosen: it names them. Nothing is changed then.
    """
    own = getattr(camera, GROUP)
    lens = chosen_lens(path, own.model if own.model in READING else PLAIN, name)
    values = {MODEL.name: lens.model, FILE.name: path, FILE_CAMERA.name: name}
    for setting, value in values.items():
        setattr(own, setting, value)
    numbers = ", ".join(f"{name} {value:.6g}" for name, value in lens.settings.items() if isinstance(value, float))
    return f"Camera {lens.name or 'without a name'}: {READING[lens.model]}, {numbers}"
