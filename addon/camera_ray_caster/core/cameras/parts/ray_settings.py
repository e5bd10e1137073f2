"""The settings of a table of rays: its entries, their axes, and what lies between them."""

from __future__ import annotations

from .ray_grid import CUBIC, LINEAR, NONE, SPLINE
from .settings import FROM_A_FILE, Choice, Flag, Item, Numbers, Whole
from .vectors import Vectors

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
