"""The settings of a table of rays: its entries, their axes, and what lies between them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...arguments import shown
from ...records import BlenderCamera
from .ray_grid import CUBIC, LINEAR, NONE, SPLINE
from .settings import FROM_A_FILE, Choice, Flag, Item, Numbers, Setting, Whole


@dataclass(frozen=True)
class Vectors(Setting):
    """A table of vectors, (rows, columns, 3) from the bottom left, or None."""

    kind = "VECTORS"

    def read(self, raw: BlenderCamera) -> np.ndarray | None:
        """Return the table as float64. Raises InputError, which names the setting, for what is no such table."""
        table = self.given(raw)
        if table is None:
            return None
        try:
            vectors = np.asarray(table, np.float64)
        except (TypeError, ValueError) as error:
            raise self.refusal(raw, shown(table), "rows of equal length, of three numbers each entry") from error
        if vectors.ndim != 3 or vectors.shape[2] != 3:
            raise self.refusal(raw, f"of shape {vectors.shape}", "(rows, columns, 3)")
        return vectors

    def reported(self, raw: BlenderCamera) -> Any:
        """Return the shape of the table for a report, which would be too long with all numbers; None without one."""
        table = self.read(raw)
        return None if table is None else list(table.shape)


DIRECTIONS = Vectors(
    "ray_directions", "Directions",
    "Directions of the rays in the camera's frame, of any length; NaN where there is no ray", None, owner=FROM_A_FILE,
)  # fmt: skip
ORIGINS = Vectors(
    "ray_origins", "Origins", "Origins of the rays in the camera's frame; without them all leave the eye", None,
    owner=FROM_A_FILE,
)  # fmt: skip
AREA = Numbers(
    "ray_area", "Area", "Part of the frame that the entries fill, 0 to 1 from the bottom left", (0.0, 0.0, 1.0, 1.0),
    ("Left", "Bottom", "Right", "Top"), owner=FROM_A_FILE,
)  # fmt: skip
OPENCV = "OPENCV"
AXES = Choice(
    "ray_axes", "Axes", "Axes of the rays in a file that does not state them", "BLENDER",
    (
        Item("BLENDER", "Blender", "X right, Y up, the camera looks along -Z", 0),
        Item(OPENCV, "OpenCV", "X right, Y down, the camera looks along Z", 1),
    ),
)  # fmt: skip
INTERPOLATION = Choice(
    "ray_interpolation", "Interpolation", "Rays between the entries of the table", CUBIC,
    (
        Item(CUBIC, "Cubic", "A cubic spline through the entries, smooth", 0),
        Item(LINEAR, "Linear", "Straight lines between the entries", 1),
        Item(SPLINE, "Control Points", "The entries are the control points of a cubic B-spline", 2),
        Item(NONE, "None", "The ray of the nearest entry: rays may jump from pixel to pixel, as behind microlenses", 3),
    ),
)  # fmt: skip
BLOCK_COLUMNS, BLOCK_ROWS = (
    Whole(
        f"ray_block_{side}", f"Block {side.title()}", f"{side.title()} of entries behind one microlens: rays are "
        "interpolated within such blocks, not across their edges; 0: all", 0, 0, 1 << 20,
    )
    for side in ("columns", "rows")
)  # fmt: skip
SLIDE = Flag(
    "ray_slide",
    "Slide Origins",
    "Move each origin along its ray, near the mean of all origins: for tables whose origins jump along the rays. "
    "Distances are measured from there",
    False,
)
