"""The calibration file of a camera: its numbers replace the settings, with all their digits."""

from ..cameras import MODELS
from ..cameras.model import Model
from ..cameras.parts.calibration import CENTER, FILE, FILE_CAMERA, SIZE
from ..cameras.parts.parameters import defaults_of, with_values
from ..programs.parts.lens import FRAME_SIZE, Lens
from ..programs.reading.lenses import lenses_of
from ..records import BlenderCamera, InputError, Raster

FRAMES_SIZE = "the file does not tell the size of its pictures: it is taken to be the frame's"

MOST_NAMED = 12
"""Number of cameras of a file that a message names."""


def with_file(raw: BlenderCamera, model: type[Model], raster: Raster) -> BlenderCamera:
    """Return the record with the settings of its calibration file, or the record itself if it names no file.

    Raises InputError for a file that cannot be read, is for another model or for pictures of another shape than the
    frame, or has several cameras if none of them is chosen.
    """
    path = FILE.read(raw) if FILE in model.SETTINGS else ""
    if not path:
        return raw
    lens = chosen_lens(path, model.key, FILE_CAMERA.read(raw), raster.size)
    if lens.model != model.key:
        raise InputError(f"{path!r} is a calibration for {model_of(lens).label}, not {model.label}: choose that model")
    _check_shape(path, lens, raster)
    defaults = defaults_of(setting for setting in model.SETTINGS if setting not in model.BESIDE_FILE)
    return with_values(raw, defaults | lens.settings)


def _check_shape(path: str, lens: Lens, raster: Raster) -> None:
    """Raise InputError if the shape of the calibrated picture differs from a frame of square pixels by more than the
    pixel that a percentage of the resolution may have cut off. Frames of other pixels are not checked: they may have
    been calibrated with their own or with square pixels. Of a file that does not tell the size, the center has to lie
    in the frame.
    """
    if CENTER[0].name not in lens.settings:
        return
    width, height = (lens.settings[side.name] for side in SIZE)
    x, y = (lens.settings[setting.name] for setting in CENTER)
    if not width and not (0 <= x < raster.width and 0 <= y < raster.height):
        raise InputError(
            f"cx and cy of calibration file {path!r}, which has no size, are {x:g} and {y:g}, outside the frame of "
            f"{raster.width} x {raster.height}: set the resolution to the size of the calibrated pictures"
        )
    if raster.pixel_aspect != 1 or abs(raster.width * height - raster.height * width) <= width + height:
        return
    sizes = f"{SIZE[0].name} and {SIZE[1].name} of calibration file {path!r} are {width:g} x {height:g}"
    raise InputError(
        f"{sizes}, and the frame is {raster.width} x {raster.height}, of another shape: set the resolution to that "
        f"size (--resolution {width:g}x{height:g}), or a multiple of it"
    )


def has_size(lens: Lens) -> bool:
    """Whether the lens does not depend on the frame, as that of a file without the size of its pictures does."""
    return not FRAME_SIZE.items() <= lens.settings.items()


def model_of(lens: Lens) -> type[Model]:
    """Return the model of a lens."""
    return next(model for model in MODELS if model.key == lens.model)


def chosen_lens(path: str, key: str = "", name: str = "", picture_size: tuple[int, int] | None = None) -> Lens:
    """Return the lens of this name in a calibration file, or its only lens; key, picture_size: see ``lenses_of``.

    Raises InputError for a file that cannot be read, and without a lens of this name; the message lists the lenses.
    """
    lenses = lenses_of(path, key, picture_size)
    chosen = [lens for lens in lenses if name in ("", lens.name)]
    if len(chosen) != 1:
        names = [repr(lens.name)[1:-1] for lens in lenses]  # what is not printable is escaped
        if not names or len(set(names)) < len(names):
            problem = "two cameras of one name: give each its own" if names else "no camera: choose another file"
            raise InputError(f"calibration file {path!r} has {problem}")
        names = names if len(names) <= MOST_NAMED else [*names[:MOST_NAMED], f"{len(names) - MOST_NAMED} more"]
        problem = f"no camera {name!r}" if name and not chosen else f"{len(chosen)} cameras"
        setting = f"{FILE_CAMERA.label} (--calibration-camera, in Python camera=)"
        remedy = f"set {setting} to one of {', '.join(names)}" if names != [""] else f"leave {setting} empty"
        raise InputError(f"calibration file {path!r} has {problem}: {remedy}")
    if chosen[0].refusal is not None:
        raise chosen[0].refusal
    return chosen[0]
