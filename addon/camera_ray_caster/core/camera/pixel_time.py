"""Time as a dimension of the picture: the frame at which each pixel's ray is cast.

Slit scan: the time is a linear function of the row or the column. Time displacement: the time is read from a gray
image. Rolling shutter: a slit scan of the rows, or columns, that a sensor reads one after another, as in Cycles (type
Top-Bottom). Row number k of H, counted from 1 in the order of reading, is cast at the fraction k / H of the shutter
interval, by row index and not by row center. With a duration d each row is exposed for the fraction d of the interval,
all rows are read within the rest, and the chief ray has the middle of its row's exposure. Other orders of reading give
the same picture turned. Scanner: beam by beam, as the model says; see ``cameras.scanner``.
Source: G. Levin, An Informal Catalogue of Slit-Scan Video Artworks (2005).
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..cameras.model import Firing
from ..cameras.parts.settings import ABOVE_ZERO, CYCLES, RENDER, Choice, Image, Item, Number, Setting, Whole, span
from ..conventions import LAST_FRAME
from ..memory import of_pixels, require
from ..records import BlenderCamera, InputError, Raster
from .times import ImageTime, LinearTime, PixelTime, SweepTime

NONE, ROWS, COLUMNS, IMAGE, ROLLING_SHUTTER, SWEEP = "NONE", "ROWS", "COLUMNS", "IMAGE", "ROLLING_SHUTTER", "SWEEP"
MODE = Choice(
    "time_mode", "Time", "Frame at which the ray of each pixel is cast",
    NONE,
    (
        Item(NONE, "One Time", "All pixels show the current frame", 0),
        Item(ROWS, "Slit Scan, Rows", "From the first row, at the bottom, to the last row", 1),
        Item(COLUMNS, "Slit Scan, Columns", "From the left column to the right column", 2),
        Item(IMAGE, "Time Displacement", "Black pixels of an image show the start, white pixels the end", 3),
        Item(
            ROLLING_SHUTTER, "Rolling Shutter",
            "Rows or columns in the order in which a sensor reads them, within the shutter interval of motion blur", 4,
        ),
        Item(SWEEP, "Scanner Sweep", "When each beam of a scanner fires; the sweep begins at the current frame", 5),
    ),
)  # fmt: skip
START = Number("time_start", "Start", "Frame of the first row, the first column, or black pixels", 1.0)
END = Number("time_end", "End", "Frame of the last row, the last column, or white pixels", 25.0)
GRAY = Image("time_image", "Image", "Grayscale image with the time of each pixel, stretched over the frame", None)
TOLERANCE = Number(
    "time_tolerance", "Tolerance", "Maximum error, in pixels, of motion interpolated between two evaluations of the "
                                   "scene",
    0.1, 1e-4, soft_high=10.0,
)  # fmt: skip
EVALUATIONS = Whole(
    "time_evaluations", "Max Evaluations",
    "Maximum number of frames at which the scene is evaluated. The report says in how many "
    "intervals the tolerance is not reached", 256, 2, soft_high=4096,
)  # fmt: skip
POSITION = Choice(
    "motion_blur_position", "Position", "Position of the frame in the shutter interval",
    "CENTER",
    (
        Item("START", "Start on Frame", "The shutter opens at the frame", 0),
        Item("CENTER", "Center on Frame", "The frame is in the middle of the shutter interval", 1),
        Item("END", "End on Frame", "The shutter closes at the frame", 2),
    ),
    owner=RENDER,
)  # fmt: skip
SHUTTER = Number(
    "motion_blur_shutter", "Shutter", "Time for which the shutter is open, in frames", 0.5, ABOVE_ZERO, owner=RENDER
)
DURATION = Number(
    "rolling_shutter_duration", "Rolling Shutter Duration",
    "Exposure time of each row, as a fraction of the shutter interval. 0 if Cycles is "
    "disabled", 0.0, 0.0, 1.0, owner=CYCLES,
)  # fmt: skip
READOUT = Choice(
    "readout", "Readout", "Order in which rows or columns are read within the shutter interval",
    "TOP_TO_BOTTOM",
    (
        Item("TOP_TO_BOTTOM", "Top to Bottom", "Rows are read from top to bottom, as in Cycles", 0),
        Item("BOTTOM_TO_TOP", "Bottom to Top", "Rows", 1),
        Item("LEFT_TO_RIGHT", "Left to Right", "Columns", 2),
        Item("RIGHT_TO_LEFT", "Right to Left", "Columns", 3),
    ),
)  # fmt: skip
FPS = Whole("fps", "Frame Rate", "Frames in a second, before it is divided by Base", 24, 1, owner=RENDER)
FPS_BASE = Number("fps_base", "Base", "Divisor of the frame rate", 1.0, 1e-5, owner=RENDER)

SETTINGS: dict[str, tuple[Setting, ...]] = {
    NONE: (),
    ROWS: (START, END, TOLERANCE, EVALUATIONS),
    COLUMNS: (START, END, TOLERANCE, EVALUATIONS),
    IMAGE: (GRAY, START, END, TOLERANCE, EVALUATIONS),
    ROLLING_SHUTTER: (READOUT, POSITION, SHUTTER, DURATION, TOLERANCE, EVALUATIONS),
    SWEEP: (FPS, FPS_BASE, TOLERANCE, EVALUATIONS),
}
"""The settings that each item of MODE reads, in the order of the panel."""

READ_BY_ROWS = "TOP_TO_BOTTOM", "BOTTOM_TO_TOP"

SHUTTER_STARTS = {"START": 0.0, "CENTER": -0.5, "END": -1.0}
"""Start of the shutter interval relative to the frame, in lengths of the interval."""

WHOLE_FRAME = "use fewer pixels: an image gives a time to all pixels of the frame, even outside a render border"

LEVELS = 256
"""Number of times to which a gray image is rounded, from black to white: the values of an 8 bit image."""


def groups(pixel_time: PixelTime, x, y):
    """Yield (frame, rows, columns, where) for each frame of the pixels x (1, columns), y (rows, 1). The slices contain
    all pixels of the frame, and ``where``, a bool array of their shape, marks these pixels. NaN is no frame.
    """
    frames = np.broadcast_to(pixel_time.frame_at(x, y), np.broadcast_shapes(x.shape, y.shape))
    if isinstance(pixel_time, LinearTime):
        along_rows = pixel_time.per_column == 0
        for i, frame in enumerate(frames[:, 0] if along_rows else frames[0]):
            if np.isnan(frame):
                continue
            lane = slice(i, i + 1)
            rows, columns = (lane, slice(None)) if along_rows else (slice(None), lane)
            yield float(frame), rows, columns, np.ones(frames[rows, columns].shape, bool)
        return
    for frame in np.unique(frames[~np.isnan(frames)]):
        same = frames == frame
        held = [np.flatnonzero(same.any(axis=axis)) for axis in (1, 0)]
        box = tuple(slice(lane[0], lane[-1] + 1) for lane in held)
        yield float(frame), *box, same[box]


def pixel_time_from(raw: BlenderCamera, raster: Raster, firing: Firing | None) -> PixelTime | None:
    """Return the pixel times that a camera's settings describe; None if all pixels have one time.

    Slit scan: the bottom or left edge of the frame has ``time_start``, the opposite edge ``time_end``. IMAGE: black is
    the start, white the end; the image is stretched over the frame, nearest pixel. SWEEP: column and row fire as the
    model says, from the current frame on. Raises InputError for an unknown mode, equal or non-finite ends, an image
    that is missing or has pixels that are not finite, and a sweep of a model that does not fire.
    """
    mode = MODE.read(raw) if MODE.name in raw.settings else NONE
    if mode == NONE:
        return None
    if mode == SWEEP:
        return _sweep(raw, raster, firing)
    if mode == ROLLING_SHUTTER:
        return _rolling_shutter(raw, raster)
    start, end = span(raw, START, END, low=-LAST_FRAME, high=LAST_FRAME)
    if mode == IMAGE:
        return ImageTime(start + _image_share(raw, raster) * (end - start), *_effort(raw))
    if mode == ROWS:
        return _linear(raw, start, 0.0, (end - start) / raster.height, raster)
    return _linear(raw, start, (end - start) / raster.width, 0.0, raster)


def _sweep(raw: BlenderCamera, raster: Raster, firing: Firing | None) -> SweepTime:
    if firing is None:
        raise InputError(
            f"camera {raw.name!r} has the times of a scanner's sweep, but is no scanner: set {MODE.name} to another of "
            "its items, or choose the model SCANNER"
        )
    rate = FPS.read(raw) / FPS_BASE.read(raw)
    step = firing.per_column * rate
    sweep = SweepTime(
        raw.settings["frame"] - step / 2, step, firing.rows * rate, raster.width, TOLERANCE.read(raw),
        int(EVALUATIONS.read(raw)),
    )  # fmt: skip
    _check_range(raw, sweep.first, sweep.last)
    return sweep


def _rolling_shutter(raw: BlenderCamera, raster: Raster) -> LinearTime:
    shutter, duration, readout = SHUTTER.read(raw), DURATION.read(raw), READOUT.read(raw)
    opened = raw.settings["frame"] + (SHUTTER_STARTS[POSITION.read(raw)] + duration / 2) * shutter
    by_rows = readout in READ_BY_ROWS
    count = raster.height if by_rows else raster.width
    step = shutter * (1 - duration) / count
    # row or column number k in the order of reading has its center k - 1/2 from the edge that is read first
    if readout in ("TOP_TO_BOTTOM", "RIGHT_TO_LEFT"):
        origin, step = opened + step * (count + 0.5), -step
    else:
        origin = opened + step / 2
    return _linear(raw, origin, 0.0, step, raster) if by_rows else _linear(raw, origin, step, 0.0, raster)


def rolling_shutter(readout: str, offsets: Sequence[float], size: Sequence[int]) -> tuple[dict[str, Any], np.ndarray]:
    """Return the settings of a rolling shutter whose first row, or column, that is read has the one offset, in frames
    from the camera's, and the last one the other; and the offsets that these settings have. A shutter opens at its
    frame, closes there, or has it in the middle: one that does not is moved to the nearest of these.
    """
    count = size[1 if readout in READ_BY_ROWS else 0]
    first, last = offsets
    read = (last - first) * count / max(1, count - 1)
    opened = first - read / count
    position = min(max(-1.0, round(2 * opened / read) / 2), 0.0)
    shutter = read + 2 * max(opened, -read - opened, 0.0)
    duration = 1 - read / shutter
    times = (position + duration / 2) * shutter + read * np.array((1 / count, 1.0))
    where = next(word for word, start in SHUTTER_STARTS.items() if start == position)
    values = {MODE: ROLLING_SHUTTER, READOUT: readout, POSITION: where, SHUTTER: shutter, DURATION: duration}
    defaults = {setting.name: setting.default for setting in SETTINGS[ROLLING_SHUTTER]}
    return defaults | {setting.name: value for setting, value in values.items()}, times


def _effort(raw: BlenderCamera) -> tuple[float, int]:
    return TOLERANCE.read(raw), int(EVALUATIONS.read(raw))


def _linear(raw: BlenderCamera, origin: float, per_column: float, per_row: float, raster: Raster) -> LinearTime:
    corners = [
        origin + per_column * x + per_row * y
        for x in (0.5, raster.width - 0.5)
        for y in (0.5, raster.height - 0.5)
    ]  # fmt: skip
    first, last = min(corners), max(corners)
    _check_range(raw, first, last)
    return LinearTime(origin, per_column, per_row, first, last, *_effort(raw))


def _check_range(raw: BlenderCamera, first: float, last: float) -> None:
    if not -LAST_FRAME <= first <= last <= LAST_FRAME:
        raise InputError(
            f"the times of camera {raw.name!r} are frames {first:g} to {last:g}: keep them between -{LAST_FRAME} and "
            f"{LAST_FRAME}, Blender's first and last frames"
        )


def _image_share(raw: BlenderCamera, raster: Raster) -> np.ndarray:
    gray = GRAY.given(raw)
    if gray is None:
        raise InputError(
            f"camera {raw.name!r} reads its time from an image, but has no image: choose a grayscale image"
        )
    gray = np.asarray(gray, np.float64)
    if not np.isfinite(gray).all():
        lost = f"{np.count_nonzero(~np.isfinite(gray))} of {gray.size} pixels are NaN or infinite"
        raise InputError(f"{GRAY.name} of camera {raw.name!r} gives no time where {lost}: choose another image")
    require(24 * raster.width * raster.height, of_pixels("the times", (raster.height, raster.width)), WHOLE_FRAME)
    rows = (2 * np.arange(raster.height) + 1) * gray.shape[0] // (2 * raster.height)
    columns = (2 * np.arange(raster.width) + 1) * gray.shape[1] // (2 * raster.width)
    return np.rint(np.clip(gray[np.ix_(rows, columns)], 0, 1) * (LEVELS - 1)) / (LEVELS - 1)
