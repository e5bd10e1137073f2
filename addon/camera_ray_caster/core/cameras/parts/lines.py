"""Lines of the scene as a camera sees them: slits to look through, a path to move on, given by objects.

A setting that names an object holds (points, matrix_world): points (n, 3) in the object's space, as Blender stores
them, and the object's evaluated (4, 4) world matrix; None if no object is set. An empty has two points, its origin and
the end of its X axis. A curve has the first and the last control point of its first spline. A path has a third entry,
the (m, 2) edges between its points.
"""

from typing import Any

import numpy as np

from ...conventions import EPS32
from ...records import BlenderCamera, InputError
from .pose import pose_from
from .settings import Line

SLIT = Line(
    "slit_1",
    "Slit",
    "Line that determines the origins of the rays: the X axis of an empty, or the straight line between the ends of "
    "a curve",
    None,
    ("EMPTY", "CURVE"),
)
SECOND_SLIT = Line(
    "slit_2", "Second Slit",
    "Second line that all rays meet: the X axis of an empty, or the straight line between the ends of a curve", None,
    ("EMPTY", "CURVE"),
)  # fmt: skip

LINE_ROUNDING = 16 * EPS32
"""Sine of the angle below which the directions of objects, stored as float32, cannot be told apart."""


def points_in_camera(raw: BlenderCamera, line: Line, choose: str) -> np.ndarray:
    """Return the points (n, 3) of a setting's object in the camera's frame, right to some EPS of their coordinates.

    Raises InputError if there is no object (the message asks to choose ``choose``), and for an object whose place is
    not finite or too far away for its size.
    """
    line_data: Any = line.given(raw)
    if line_data is None:
        raise InputError(
            f"{line.name} of camera {raw.name!r} is not set, or its object is deleted or disabled: choose {choose} "
            "that is in the view layer (to make a line invisible, hide it with H)"
        )
    pose = pose_from(raw)
    points, matrix = (np.asarray(array, np.float64) for array in line_data[:2])
    if not (np.isfinite(points).all() and np.isfinite(matrix).all()):
        raise InputError(f"{line.name} of camera {raw.name!r} has infinite or NaN numbers: clear its transform")
    points, away = points @ matrix[:3, :3].T, matrix[:3, 3] - pose.eye
    size, far = np.ptp(points, axis=0).max() if len(points) else 0.0, np.abs(away).max()
    if 0 < size <= EPS32 * far:
        raise InputError(
            f"{line.name} of camera {raw.name!r} is {size:.3g} long and {far:.3g} away, where float32 cannot "
            "distinguish its ends: move it and the camera closer together"
        )
    return (points + away) @ np.linalg.inv(pose.basis).T


def slit_from(raw: BlenderCamera, slit: Line = SLIT) -> tuple[np.ndarray, np.ndarray]:
    """Return a point and the unit direction of a slit, an endless line, in the camera's frame.

    Raises InputError for an object that ``points_in_camera`` refuses, or whose ends coincide.
    """
    points = points_in_camera(raw, slit, "an empty or a curve")
    if len(points) < 2 or not np.any(points[-1] - points[0]):
        raise InputError(
            f"{slit.name} of camera {raw.name!r} has no direction: its two ends must lie apart (scale above 0)"
        )
    along = points[-1] - points[0]
    along = along / np.abs(along).max()
    return points[0], along / np.linalg.norm(along)


def image_axes(raw: BlenderCamera, direction) -> tuple[np.ndarray, np.ndarray]:
    """Return the unit vectors (3,) along a slit's picture in the image plane and across it, a quarter turn to the left.

    Raises InputError if the slit is seen end on.
    """
    length = np.hypot(direction[0], direction[1])
    if length <= LINE_ROUNDING:
        raise InputError(
            f"{SLIT.name} of camera {raw.name!r} runs along the viewing direction: turn it across the view"
        )
    along = np.array((direction[0], direction[1], 0.0)) / length
    return along, np.array((-along[1], along[0], 0.0))


def path_from(raw: BlenderCamera, path: Line) -> tuple[np.ndarray, bool]:
    """Return the corners (n, 3) of a path in the camera's frame, no two in a row equal, and whether the path is closed.

    The path is the chain of edges from the first point on. Raises InputError if it has no length.
    """
    points = points_in_camera(raw, path, "a curve")
    path_data: Any = path.given(raw)
    edges = {tuple(edge) for edge in np.asarray(path_data[2]).reshape(-1, 2).tolist()}
    last = 0
    while (last, last + 1) in edges:
        last += 1
    closed = last > 0 and not edges.isdisjoint({(last, 0), (0, last)} - {(0, 1)})
    points = points[[*range(last + 1), *([0] if closed else [])]] if len(points) else points
    apart = np.any(points[1:] != points[:-1], axis=1) if len(points) else np.zeros(0, bool)
    if not apart.any():
        raise InputError(
            f"{path.name} of camera {raw.name!r} has no length: it must be a curve with a spline to move along"
        )
    return points[np.concatenate(([True], apart))], closed
