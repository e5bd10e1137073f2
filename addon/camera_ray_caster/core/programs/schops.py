"""The generic cameras of T. Schöps et al.: intrinsicsN.yaml, a grid of control points of a uniform cubic B-spline.

Pixels are measured from the top left corner, y down; rays have y down and z ahead. On the grid g = 1 + (grid_width - 3)
(x - min) / (max + 1 - min), so that the outermost control points lie beyond the calibrated area, which has all rays.
References: T. Schöps et al., Why having 10,000 parameters in your camera model is better than twelve, CVPR 2020; the
program camera_calibration.
"""

import numpy as np

from .parts.document import Document
from .parts.lens import Lens
from .parts.program import ProgramFiles
from .parts.ray_arrays import table

GRIDS = {"CentralGenericModel": ("grid", ""), "NoncentralGenericModel": ("direction_grid", "point_grid")}
"""Names of the grids of directions and of points, by the model's type in the file."""


def looks(document: Document) -> bool:
    return document.entries.text("type") in GRIDS


def read(document: Document) -> list[Lens]:
    entries = document.entries
    wide, high = (entries.whole(f"grid_{side}", 4) for side in ("width", "height"))
    width, height = (entries.whole(side, 1) for side in ("width", "height"))
    ends = []
    for axis, count, side in (("x", wide, width), ("y", high, height)):
        low, high_end = (entries.number(f"calibration_{end}_{axis}") for end in ("min", "max"))
        cell = (high_end + 1 - low) / (count - 3)
        if not cell > 0:
            least = f"calibration_min_{axis}, {low:g}"
            raise document.refusal(f"calibration_max_{axis} is {high_end:g}: it must not be below {least}")
        ends.append(((low - 1.5 * cell) / side, (low + (count - 1.5) * cell) / side))
    (left, right), (top, bottom) = ends
    directions, points = (
        None if not name else
        np.array(entries.numbers(name, 3 * wide * high)).reshape(high, wide, 3)[::-1].copy()
        for name in GRIDS[entries.text("type")]
    )  # fmt: skip
    assert directions is not None
    lens = table(document, directions, points, np.array((left, 1 - bottom, right, 1 - top)))
    size = document.size(float(width), float(height))
    return [lens._replace(settings=lens.settings | size | {"ray_axes": "OPENCV", "ray_interpolation": "SPLINE"})]


PROGRAM = ProgramFiles(
    "camera_calibration (Schöps)", "intrinsics .yaml", looks,
    marks="calibration_min_x calibration_max_x grid_width grid_height grid",
    reads="CentralGenericModel, NoncentralGenericModel", read=read,
)  # fmt: skip
