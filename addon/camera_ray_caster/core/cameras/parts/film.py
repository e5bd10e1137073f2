"""The raster and the window on the image plane, from Blender's resolution, border, sensor fit and shift."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from ...conventions import gamma
from ...maths.recording.scalars import largest, least
from ...records import BlenderCamera, InputError, Raster
from .settings import ABOVE_ZERO, CAMERA, RENDER, Choice, Item, Number

BORDER = "border_min_x", "border_max_x", "border_min_y", "border_max_y"
FARTHEST_SHIFT = 1e6
"""Largest shift, in frames."""
FARTHEST_PIXELS = 2.0**24
"""Largest distance from the axis in pixels: beyond it float32, Blender's type, cannot tell a pixel from the next."""
STEEPEST = 2.0**30
"""Largest slope of a ray: its distance from the axis over its depth. float32 cannot distinguish a ray this steep from
the image plane; with still steeper rays, float64 soon cannot either.
"""


OFF_AXIS = "off_axis"
"""Key in a record's settings: the slope of ``Model.off_axis``, for a lens with a center of its own."""

ON_SENSOR: tuple[tuple[str, str], ...] = (("calibration_unit", "MILLIMETERS"),)
"""With which a calibration is that of a lens on Blender's sensor: see ``calibration``."""

LENS = Number(
    "lens", "Focal Length", "Distance from the eye to the sensor", 50.0, ABOVE_ZERO, unit="mm", owner=CAMERA,
    used_with=ON_SENSOR,
)  # fmt: skip
ORTHO_SCALE = Number(
    "ortho_scale", "Orthographic Scale", "Length of the fitted side of the frame", 6.0, ABOVE_ZERO, unit="length",
    owner=CAMERA,
)  # fmt: skip
SENSOR_FIT = Choice(
    "sensor_fit", "Sensor Fit", "Side of the frame to which the sensor is fitted",
    "AUTO",
    (
        Item("AUTO", "Auto", "Fit the sensor width to the longer side of the frame", 0),
        Item("HORIZONTAL", "Horizontal", "Fit the sensor width to the width of the frame", 1),
        Item("VERTICAL", "Vertical", "Fit the sensor height to the height of the frame", 2),
    ),
    owner=CAMERA,
    used_with=ON_SENSOR,
)  # fmt: skip
SENSOR_WIDTH = Number(
    "sensor_width", "Sensor Width", "Width of the sensor; used unless Sensor Fit is Vertical", 36.0, ABOVE_ZERO,
    unit="mm", owner=CAMERA, used_with=ON_SENSOR,
)  # fmt: skip
SENSOR_HEIGHT = Number(
    "sensor_height", "Sensor Height", "Height of the sensor; used if Sensor Fit is Vertical", 24.0, ABOVE_ZERO,
    unit="mm", owner=CAMERA, used_with=ON_SENSOR,
)  # fmt: skip
SHIFT_X, SHIFT_Y = (
    Number(
        name, label, f"Offset of the frame on the image plane, {way}", 0.0, -FARTHEST_SHIFT, FARTHEST_SHIFT,
        owner=CAMERA, used_with=ON_SENSOR,
    )
    for name, label, way in (("shift_x", "Shift X", "to the right"), ("shift_y", "Shift Y", "up"))
)  # fmt: skip
PIXEL_ASPECT_X, PIXEL_ASPECT_Y = (
    Number(f"pixel_aspect_{axis}", f"Pixel Aspect {axis.upper()}", f"{side} of a pixel", 1.0, 1e-6, 1e6, owner=RENDER)
    for axis, side in (("x", "Width"), ("y", "Height"))
)

SHIFT = SHIFT_X, SHIFT_Y
FILM = SENSOR_FIT, SENSOR_WIDTH, SENSOR_HEIGHT, *SHIFT
"""Blender's own settings that ``Film`` and the windows read. Shift is in units of the fitted side on both axes; in
panoramas, fisheyes and domes it is in fractions of the frame's width and height.
"""


def raster_from(raw: BlenderCamera) -> Raster:
    """Return the frame and the render window as Blender's pipeline computes them.

    The frame is resolution * percentage / 100, truncated. A border selects columns int(min * width) up to, but not
    including, int(max * width), and rows likewise from the bottom. The product is rounded to float32 first, as in
    Blender's C code (0.7 of 10 is column 7 there, 6 in float64). Cropping changes where the window is stored, not its
    rays.

    Raises InputError for a frame or a border without pixels, for a border that is not finite, and for an invalid pixel
    aspect or shift.
    """
    for shift in SHIFT:
        shift.read(raw)  # also for models that do not use it: a driver or a script may have set it to nan
    for name in BORDER:
        if not np.isfinite(getattr(raw, name)):
            raise InputError(f"{name} of camera {raw.name!r} is {getattr(raw, name)}: it must be a finite number")
    for aspect in (PIXEL_ASPECT_X, PIXEL_ASPECT_Y):
        aspect.read(raw)
    width = raw.resolution_x * raw.resolution_percentage // 100
    height = raw.resolution_y * raw.resolution_percentage // 100
    if width < 1 or height < 1:
        raise InputError(
            f"the picture has no pixels ({raw.resolution_x} x {raw.resolution_y} at {raw.resolution_percentage} %): "
            "raise the resolution or its percentage"
        )
    x0, x1, y0, y1 = 0, width, 0, height
    if raw.use_border:
        x0, x1 = _border(raw.border_min_x, raw.border_max_x, width)
        y0, y1 = _border(raw.border_min_y, raw.border_max_y, height)
        if x0 >= x1 or y0 >= y1:
            raise InputError("the render border contains no pixel: draw it larger (Ctrl B) or clear it (Ctrl Alt B)")
    return Raster(width, height, raw.pixel_aspect_y / raw.pixel_aspect_x, x0, y0, x1, y1, raw.use_crop_to_border)


def _border(low: float, high: float, size: int) -> tuple[int, int]:
    """Return the first pixel inside a border and the first pixel behind it."""
    return int(np.float32(low) * np.float32(size)), int(np.float32(high) * np.float32(size))


def farthest_from_one(numbers: dict[str, float]) -> str:
    """Return, for a message, the number whose magnitude is farthest from 1 in ratio, with its name; 0 counts as 1."""
    name, value = max(numbers.items(), key=lambda item: abs(math.log(abs(item[1]))) if item[1] else 0.0)
    return f"{name} is {value:.6g}"


def check_slope(raw: BlenderCamera, slope: float, numbers: Iterable[Number], limit: float = STEEPEST) -> None:
    """Raise InputError, which names the number that is farthest from 1, for a ray's slope beyond ``limit``."""
    if not slope <= limit:
        cause = farthest_from_one({number.name: number.read(raw) for number in (*numbers, *SHIFT)})
        raise InputError(
            f"the frame of camera {raw.name!r} looks along the image plane, to {slope:.3g} times the depth: {cause}, "
            "too large or too small for the rest"
        )


def _shift(shift: Number, raw: BlenderCamera, unit: float) -> float:
    """Return a shift whose unit is ``unit`` pixels. Raises InputError if it amounts to more than FARTHEST_PIXELS."""
    return shift.read(raw, -FARTHEST_PIXELS / unit, FARTHEST_PIXELS / unit)


def off_axis(raw: BlenderCamera, slope: float) -> BlenderCamera:
    """Return the record of an eye as Blender shifts it, whatever the sensor fit; see ``Model.off_axis``."""
    return replace(raw, shift_x=raw.shift_x + slope * raw.lens / SENSOR_WIDTH.read(raw))


@dataclass(frozen=True)
class Film:
    """The sensor as Blender fits it to the frame: the length of the fitted side in mm and in pixels.

    Source: Blender manual, Camera > Lens and Sensor; measured on calc_matrix_camera. AUTO fits the longer side (in
    square units, the width if both are equal) and uses the sensor's WIDTH for it, also in portrait format. Shift is in
    units of the fitted side on both axes.
    """

    size: float
    """Length of the fitted side, mm."""
    fitted_pixels: float
    """Length of the fitted side in pixel widths."""
    sensor: Number
    """Setting that gives the length."""

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Film:
        """Fit the sensor. Raises InputError, which names the setting, for an invalid sensor fit or size."""
        height = raster.height * raster.pixel_aspect
        sensor, fitted_pixels = {
            "HORIZONTAL": (SENSOR_WIDTH, raster.width),
            "VERTICAL": (SENSOR_HEIGHT, height),
            "AUTO": (SENSOR_WIDTH, max(raster.width, height)),
        }[SENSOR_FIT.read(raw)]
        return cls(sensor.read(raw), float(fitted_pixels), sensor)


@dataclass(frozen=True)
class Window:
    """An affine map from pixels to the image plane: X = (x - center_x) pitch_x, Y = (y - center_y) pitch_y.

    The difference is taken before scaling: it is exact for pixels near the center, and a frame far off the axis (shift)
    keeps the digits of its pixels. X and Y are right to 2 EPS relative to the parts of the difference.
    """

    center_x: float
    center_y: float
    pitch_x: float
    pitch_y: float

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster, fitted_length: float) -> Window:
        """Return the window whose fitted side has this length on the image plane."""
        fitted_pixels = Film.from_blender(raw, raster).fitted_pixels
        fitted_height = fitted_pixels / raster.pixel_aspect
        pitch = fitted_length / fitted_pixels
        return cls(
            raster.width / 2 - _shift(SHIFT_X, raw, fitted_pixels) * fitted_pixels,
            raster.height / 2 - _shift(SHIFT_Y, raw, fitted_height) * fitted_height,
            pitch,
            pitch * raster.pixel_aspect,
        )

    @classmethod
    def before_eye(cls, raw: BlenderCamera, raster: Raster, fitted_length: float, numbers: Iterable[Number]) -> Window:
        """Return the window of a pinhole whose fitted side has this length at depth 1.

        numbers: the settings that determine the length. Raises InputError for a frame that reaches beyond STEEPEST.
        """
        window = cls.from_blender(raw, raster, fitted_length)
        check_slope(raw, largest(*map(abs, window.extent(raster.size))), numbers)
        return window

    @classmethod
    def over_frame(cls, raw: BlenderCamera, raster: Raster, x_range, y_range) -> Window:
        """Return the window of a panorama, in which the frame spans these (low, high) ranges.

        Shift is in fractions of the frame's width and height, independent of the aspect.
        """
        (left, right), (bottom, top) = x_range, y_range
        return cls(
            raster.width * (-left / (right - left) - _shift(SHIFT_X, raw, raster.width)),
            raster.height * (-bottom / (top - bottom) - _shift(SHIFT_Y, raw, raster.height)),
            (right - left) / raster.width,
            (top - bottom) / raster.height,
        )

    @classmethod
    def round_pixels(cls, raw: BlenderCamera, raster: Raster, pitch: float) -> Window:
        """Return the window in which circles are round and a pixel is ``pitch`` wide, with shift as in over_frame."""
        half_width, half_height = raster.width * pitch / 2, raster.height * raster.pixel_aspect * pitch / 2
        return cls.over_frame(raw, raster, (-half_width, half_width), (-half_height, half_height))

    @classmethod
    def inscribed_circle(cls, raw: BlenderCamera, raster: Raster, radius: float) -> Window:
        """Return the window in which a circle of this radius touches the nearer sides of the frame."""
        return cls.round_pixels(raw, raster, 2 * radius / min(raster.width, raster.height * raster.pixel_aspect))

    def extent(self, size: tuple[int, int]) -> tuple[float, float, float, float]:
        """Return x_low, x_high, y_low, y_high on the image plane of a frame of this width and height in pixels; low <=
        high, also if the window is mirrored.
        """
        x, y = self.plane_from_pixels(*(np.array([0.0, side]) for side in size))
        return least(*x), largest(*x), least(*y), largest(*y)

    def corners(self, size: tuple[int, int]) -> np.ndarray:
        """Return the corners of a frame on the image plane, (4, 2), around it."""
        left, right, low, high = self.extent(size)
        return np.array([(left, low), (right, low), (right, high), (left, high)], np.float64)

    def matrix(self, height: int) -> np.ndarray:
        """Return K, (3, 3), from image-plane coordinates, y down, to pixels of a frame of this height in OpenCV's
        convention (y down, the origin in the center of the top left pixel).
        """
        return np.array([
            [1 / self.pitch_x, 0.0, self.center_x - 0.5],
            [0.0, 1 / self.pitch_y, height - self.center_y - 0.5],
            [0.0, 0.0, 1.0],
        ])  # fmt: skip

    def rounding(self, x, y, size: tuple[int, int]):
        """Return the rounding of the few operations from a pixel to the plane, as shifts of the pixel in x and in y. A
        center in the middle of the frame is exact.
        """
        places = (x, self.center_x, size[0] / 2), (y, self.center_y, size[1] / 2)
        across, up = (
            gamma(6) * np.abs(coordinate - center) + gamma(3) * (abs(center) if center != middle else 0.0)
            for coordinate, center, middle in places
        )
        return across, up

    def plane_from_pixels(self, x, y):
        """Return (X, Y) on the image plane of pixel coordinates; X has the shape of x, Y the shape of y."""
        return (x - self.center_x) * self.pitch_x, (y - self.center_y) * self.pitch_y

    def pixels_from_plane(self, plane_x, plane_y):
        """Return the pixel coordinates of image-plane points: the inverse."""
        return plane_x / self.pitch_x + self.center_x, plane_y / self.pitch_y + self.center_y

    def pixel_intervals(self, interval_x, interval_y):
        """Return the intervals in x and in y that hold the pixels of all points of the intervals on the plane."""
        ends = zip(*(self.pixels_from_plane(*end) for end in zip(interval_x, interval_y, strict=True)), strict=True)
        return tuple((np.minimum(first, second), np.maximum(first, second)) for first, second in ends)
