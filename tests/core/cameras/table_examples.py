"""Examples of the ray table: see model_examples, which takes them in."""

import numpy as np

from .example_frames import BORDER, PORTRAIT, TURNED

NAN = float("nan")


def places(columns, rows):
    """The centers of entries, -1 to 1 over the table: x (1, columns) and y (rows, 1)."""
    return (2 * np.arange(columns) + 1)[None] / columns - 1, (2 * np.arange(rows) + 1)[:, None] / rows - 1


def stacked(*parts):
    return np.stack(np.broadcast_arrays(*parts), axis=-1).astype(float)


def pinhole(columns=24, rows=18, slope=0.8):
    x, y = places(columns, rows)
    return stacked(slope * x, slope * y, -1.0)


def fisheye(columns=25, rows=17, widest=1.4):
    """A round picture: no rays outside of it."""
    x, y = places(columns, rows)
    r = np.hypot(x, y)
    theta = widest * np.where(r <= 1, r, NAN)
    scale = widest * np.sinc(theta / np.pi)
    return stacked(x * scale, y * scale, -np.cos(theta))


def without_eye(columns=20, rows=15):
    """Origins and directions of rays that have no point in common."""
    x, y = places(columns, rows)
    return stacked(0.4 * x, 0.1 * y + 0.02 * x * x, 0.0), stacked(0.5 * x, 0.4 * y, -1.0)


def with_holes():
    table = pinhole()
    table[4:7, 10:13], table[0, 0], table[:, 20] = NAN, NAN, NAN
    return table


def shuffled():
    """A pinhole's table, whose 3 x 3 blocks stand in reverse order."""
    return np.block([[[block] for block in np.split(rows, 3, axis=1)[::-1]] for rows in np.split(pinhole(), 3)[::-1]])


ORIGINS, DIRECTIONS = without_eye()

ONLY_SOME = {"ray_directions": pinhole()}

EXAMPLES = {
    "RAY_TABLE": [
        {},
        {"ray_interpolation": "LINEAR", "ray_directions": pinhole(7, 5)},
        PORTRAIT | {"ray_directions": fisheye()},
        {"ray_directions": DIRECTIONS, "ray_origins": ORIGINS, "matrix_world": TURNED},
        {"ray_interpolation": "SPLINE", "ray_directions": DIRECTIONS, "ray_origins": ORIGINS},
        BORDER | {"ray_directions": with_holes()},
        {"ray_directions": pinhole(96, 54), "ray_area": (0.1, -0.2, 0.8, 1.0)},
        {"ray_directions": pinhole() * (1, -1, -1), "ray_axes": "OPENCV"},
        {"ray_directions": shuffled(), "ray_block_columns": 8, "ray_block_rows": 6},
    ],
}

FACTS = {
    "RAY_TABLE": [
        # 96 x 54 pixels have 24 x 18 entries: the center of column 3, row 5 is pixel coordinate (14, 16.5)
        ({}, (14, 16.5), (0, 0, 0), (0.8 * (7 / 24 - 1), 0.8 * (11 / 18 - 1), -1)),
        ({}, (94, 52.5), (0, 0, 0), (0.8 * 23 / 24, 0.8 * 17 / 18, -1)),
        ({"ray_origins": pinhole() * (1, 1, 0)}, (14, 16.5), (0.8 * (7 / 24 - 1), 0.8 * (11 / 18 - 1), 0),
         (0.8 * (7 / 24 - 1), 0.8 * (11 / 18 - 1), -1)),
        # in the middle between two entries of unit length, straight lines have the direction between them
        ({"ray_interpolation": "LINEAR", "ray_directions": [[[-1, 0, 0], [0, 0, -1]], [[-1, 0, 0], [0, 0, -1]]]},
         (48, 27), (0, 0, 0), (-1, 0, -1)),
        ({"ray_interpolation": "LINEAR", "ray_directions": [[[-1, 0, 0], [0, 0, -1]], [[-1, 0, 0], [0, 0, -1]]]},
         (36, 10), (0, 0, 0), (-3, 0, -1)),
        # the control points of a spline: 1, 4, 1 on an entry, and what is linear in the place stays so
        ({"ray_interpolation": "SPLINE", "ray_directions": np.full((4, 4, 3), (0, 0, -1.0)),
          "ray_origins": stacked(np.arange(4.0)[None], np.arange(4.0)[:, None], 0.0)},
         (36, 33.75), (1, 2, 0), (0, 0, -1)),
        ({"ray_directions": pinhole() * (1, -1, -1), "ray_axes": "OPENCV"}, (14, 16.5), (0, 0, 0),
         (0.8 * (7 / 24 - 1), 0.8 * (11 / 18 - 1), -1)),
        # without interpolation all of an entry's square has its ray
        ({"ray_interpolation": "NONE"}, (12.5, 17.5), (0, 0, 0), (0.8 * (7 / 24 - 1), 0.8 * (11 / 18 - 1), -1)),
        # at the edge between columns 3 and 4 the lines of the right block go on to where it begins
        ({"ray_interpolation": "LINEAR", "ray_block_columns": 4, "ray_origins": stacked(
            (np.arange(24) % 4)[None], np.zeros((18, 1)), 0.0), "ray_directions": np.full((18, 24, 3), (0, 0, -1.0))},
         (16, 27), (-0.5, 0, 0), (0, 0, -1)),
        # the left half of the frame alone has a table
        ({"ray_area": (0, 0, 0.5, 1)}, (7, 16.5), (0, 0, 0), (0.8 * (7 / 24 - 1), 0.8 * (11 / 18 - 1), -1)),
    ],
}  # fmt: skip

UNSEEN = {"RAY_TABLE": [(0, 0, 0), (0, 0, 1), (1, 0, 0), (3, 0, -1)]}

FOLDING = pinhole()
FOLDING[:, 14:] = FOLDING[:, 13:3:-1]
JUMP = pinhole()
JUMP[3, 4] = (0, 0, 1)


def changed(index, value):
    table = pinhole()
    table[index] = value
    return table


REFUSED = {
    "RAY_TABLE": [
        ({"ray_directions": None}, "Camera.*no table of rays.*Calibration.*ray_directions"),
        ({"ray_directions": [[[0, 0, -1]] * 3, [[0, 0, -1]] * 2]}, "ray_directions.*rows of equal length"),
        ({"ray_directions": "rays"}, "ray_directions.*rows of equal length"),
        ({"ray_directions": np.ones((5, 4))}, r"of shape \(5, 4\).*\(rows, columns, 3\)"),
        ({"ray_directions": np.ones(5), "ray_axes": "OPENCV"}, r"of shape \(5,\).*\(rows, columns, 3\)"),
        ({"ray_origins": np.ones((4, 4, 3, 2))}, r"ray_origins.*of shape \(4, 4, 3, 2\).*\(rows, columns, 3\)"),
        ({"ray_directions": np.ones((5, 1, 3))}, r"of shape \(5, 1, 3\).*2 or more rows"),
        ({"ray_directions": np.ones((3, 9, 3)), "ray_interpolation": "SPLINE"}, "4 or more rows"),
        ({"ray_directions": pinhole() * NAN}, "no ray: each entry has NaN"),
        ({"ray_directions": changed((2, 3), 0.0)}, "column 3, row 2.*length 0"),
        ({"ray_directions": changed((2, 3, 1), np.inf)}, "infinite"),
        ({"ray_directions": FOLDING}, "column 14, row 0.*fold"),
        ({"ray_directions": JUMP}, "column 4, row 2.*90 degrees"),
        ({"ray_origins": np.zeros((3, 3, 3))}, r"origins are of shape \(3, 3, 3\)"),
        ({"ray_origins": np.full((18, 24, 3), NAN)}, "no ray"),
        ({"ray_area": (0.5, 0, 0.5, 1)}, "ray_area.*ascending"),
        ({"ray_block_rows": 7}, "blocks of 24 x 7 entries do not divide a table of 24 x 18: fill it up with NaN"),
        ({"ray_block_columns": 1}, "blocks have 2 or more rows and columns"),
        ({"ray_block_columns": 8, "ray_interpolation": "SPLINE"}, "control points have no blocks"),
        ({"ray_block_columns": -8}, "ray_block_columns .*must be from 0"),
        ({"ray_directions": changed((6, 12, 2), 9.0), "ray_block_columns": 8}, "column 12, row 5.*90 degrees"),
        ({"ray_interpolation": "NEAREST"}, "ray_interpolation.*CUBIC, LINEAR, SPLINE"),
    ],
}
