"""The frame that a camera asks for: that of its calibrated pictures, or the shape in which its model stretches nothing.

Reference: Blender manual, Cameras > Panoramic, where an equirectangular picture is twice as wide as high.
"""

from typing import NamedTuple

from ..cameras import find_model
from ..cameras.model import Model
from ..cameras.parts.calibration import FILE, FILE_CAMERA, MILLIMETERS, SIZE, UNIT
from ..cameras.parts.film import raster_from
from ..records import BlenderCamera
from .calibration_file import chosen_lens, with_file

LEAST, MOST = 4, 65536
"""Range of Blender's resolution, in pixels."""


class AskedSize(NamedTuple):
    """The frame that a camera asks for, which is not the one it has."""

    width: int
    """Resolution in pixels, before the percentage."""
    height: int
    sentence: str
    """What is wrong, with both sizes."""


def asked_size(raw: BlenderCamera) -> AskedSize | None:
    """Return the frame that a camera asks for; None if its frame has that shape, to the pixel that a percentage of the
    resolution may cut off, or if any frame will do.

    A calibrated picture's size is taken as it is, and not on pixels that are not square: it may have been calibrated
    with these. Other frames lie within the present one. Raises InputError for a file that cannot be read, and for
    invalid settings.
    """
    model, raster = find_model(raw), raster_from(raw)
    width, height, aspect = raw.resolution_x, raw.resolution_y, raster.pixel_aspect
    if UNIT in model.SETTINGS:
        wide, high = calibrated_size(raw, model)
        shape = wide / high if wide and high and aspect == 1 else None
        asked = f"its calibrated pictures have {wide} × {high} pixels"
    else:
        lens = model.from_blender(with_file(raw, model, raster), raster)
        shape = lens.shape
        if lens.device_size is not None and lens.device_size != raster.size:
            wide, high = lens.device_size
            sentence = f"the frame has {raster.width} × {raster.height} pixels, and {model.label} {wide} × {high}"
            return AskedSize(wide, high, sentence)
        if shape is not None:
            shape *= aspect
            wide, high = within(width, height, shape)
            asked = f"{model.label} keeps its shapes in {wide} × {high}"
    if shape is None or abs(raster.width / (shape * raster.height) - 1) <= 1 / raster.width + 1 / raster.height:
        return None
    sentence = f"the picture is stretched: the frame has {raster.width} × {raster.height} pixels, and {asked}"
    wide, high = (min(max(side, LEAST), MOST) for side in (wide, high))
    return AskedSize(wide, high, sentence)


def within(width: int, height: int, shape: float) -> tuple[int, int]:
    """Return the largest frame of a shape, width over height, in another frame."""
    return (round(shape * height), height) if width > shape * height else (width, round(width / shape))


def calibrated_size(raw: BlenderCamera, model: type[Model]) -> tuple[int, int]:
    """Return width and height of the calibrated pictures of a model with a calibration; (0, 0) if no size is given.

    Raises InputError for a file that cannot be read, and if none of its cameras is chosen.
    """
    path = FILE.read(raw)
    if path:
        lens = chosen_lens(path, model.key, FILE_CAMERA.read(raw))
        wide, high = (int(lens.settings[side.name]) for side in SIZE)
    elif UNIT.read(raw) == MILLIMETERS:
        return 0, 0
    else:
        wide, high = (int(side.read(raw)) for side in SIZE)
    return (wide, high) if wide and high else (0, 0)
