"""The calibration file that a camera names: its numbers take the place of the settings, with all their digits."""

from __future__ import annotations

from dataclasses import replace

from ..cameras import MODELS
from ..cameras.files import lenses_of
from ..cameras.files.document import Lens
from ..cameras.model import Model
from ..cameras.parts.calibration import FILE, FILE_CAMERA, SIZE
from ..records import BlenderCamera, InputError, Raster


def with_file(raw: BlenderCamera, model: type[Model], raster: Raster) -> BlenderCamera:
    """Return the record with the settings of the file that it names; itself where it names none.

    Raises InputError for a file that cannot be read, that is for another model, for pictures of another shape than the
    frame, or has several cameras of which none is chosen.
    """
    path = FILE.read(raw) if FILE in model.SETTINGS else ""
    if not path:
        return raw
    lens = chosen_lens(path, model.key, FILE_CAMERA.read(raw))
    if lens.model != model.key:
        label = next(other.label for other in MODELS if other.key == lens.model)
        raise InputError(f"{path!r} is a calibration for {label}, not {model.label}: choose that model")
    _check_shape(path, lens, raster)
    given = model.SETTINGS[model.SETTINGS.index(FILE) + 1 :]
    return replace(raw, settings={**raw.settings, **{one.name: one.default for one in given}, **lens.settings})


def _check_shape(path: str, lens: Lens, raster: Raster) -> None:
    """Raise InputError where a calibrated picture has another shape than a frame of square pixels, by more than the
    pixel that a percentage of the resolution may have cut off. Other pixels may have been calibrated as they are, or as
    they are seen.
    """
    width, height = (lens.settings[side.name] for side in SIZE)
    if raster.pixel_aspect != 1 or abs(raster.width * height - raster.height * width) <= width + height:
        return
    sizes = f"{SIZE[0].name} and {SIZE[1].name} of calibration file {path!r} are {width:g} x {height:g}"
    raise InputError(
        f"{sizes}, and the frame is {raster.width} x {raster.height}, of another shape: set the resolution to that "
        "size, or a multiple of it"
    )


def chosen_lens(path: str, key: str, name: str = "") -> Lens:
    """Return the lens of this name in a calibration file, or the only one; ``key``: the model's, for formats that do
    not say theirs. Raises InputError for a file that cannot be read, and where none is chosen: it says which there are.
    """
    lenses = lenses_of(path, key)
    chosen = [lens for lens in lenses if name in ("", lens.name)]
    if len(chosen) != 1:
        names = ", ".join(lens.name for lens in lenses)
        said = f"no camera {name!r}" if name and not chosen else f"{len(chosen)} cameras"
        raise InputError(f"calibration file {path!r} has {said}: set {FILE_CAMERA.name} to one of {names}")
    return chosen[0]
