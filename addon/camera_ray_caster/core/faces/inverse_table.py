"""A table of a central camera's inverse: which place of its picture each direction belongs to.

The directions of each half space, ahead of the camera and behind it, are mapped stereographically, (x, y) / (1 + |z|),
to a square of texels. Only the squares that the camera sees are made, and no more of them than it sees. Between the
middles of texels a place is interpolated linearly; the error is measured halfway between four texels, where it is the
largest.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..camera.camera import Camera
from ..records import InputError
from .faces import refusal, turn_of

GOAL = 0.05
"""Pixels of error at which a table is fine enough."""
TABLE_SIDES = 128, 256, 512
"""Texels along a square, tried in this order."""
BREAK = 0.5
"""Pixels of error from which a place is not interpolated: a picture's seam or a pole."""
GRID_POINTS = 65
"""Directions along a side of the frame that tell how much of a square is seen."""
RIM = 1.02
"""What is mapped beyond the directions that are seen."""


@dataclass(frozen=True, eq=False)
class InverseTable:
    """Places of a picture by direction."""

    texels: np.ndarray
    """(side, squares * side, 3) float32, row 0 at the bottom: x and y as shares of the frame's width and height, and 1
    where they are known, else 0. The first square is ahead, the second behind.
    """
    reach: float
    """Half the side of a square, on the stereographic plane."""
    error: float
    """Largest error of a place between texels, in pixels."""

    @property
    def has_behind(self) -> bool:
        """Whether there is a second square."""
        return self.texels.shape[1] > self.texels.shape[0]


def inverse_table(camera: Camera) -> InverseTable:
    """Return the table of a camera's inverse. Its directions are in the frame of ``turn_of``.

    Raises InputError for a camera whose rays have many origins, are single beams, or do not exist.
    """
    if reason := refusal(camera):
        raise InputError(f"{reason}: a lamp, which shines from one point, cannot project its picture")
    width, height = camera.raster.size
    camera = replace(camera, pixel_time=None)
    rays = camera.rays_at(np.linspace(0, width, GRID_POINTS), np.linspace(0, height, GRID_POINTS)[:, None])
    seen = rays.directions[rays.valid] @ turn_of(camera)
    if not len(seen):
        raise InputError(f"no pixel of camera {camera.name!r} has a ray: nothing can be projected")
    has_behind = bool((seen[:, 2] > 0).any())
    reach = RIM if has_behind else min(RIM, RIM * float((np.abs(seen[:, :2]).max(axis=1) / (1 - seen[:, 2])).max()))
    for side in TABLE_SIDES:
        table = _table(camera, side, reach, has_behind)
        if table.error <= GOAL:
            break
    return table


def _table(camera: Camera, side: int, reach: float, has_behind: bool) -> InverseTable:
    size = np.array(camera.raster.size)
    middles = (np.arange(side) + 0.5) / side * 2 - 1
    between = (middles[1:] + middles[:-1]) / 2
    squares, error = [], 0.0
    for sign in (-1.0, 1.0)[: 1 + has_behind]:
        places = _places(camera, middles * reach, sign)
        exact = _places(camera, between * reach, sign)
        mean = (places[1:, 1:] + places[1:, :-1] + places[:-1, 1:] + places[:-1, :-1]) / 4
        off = np.abs(mean - exact).max(axis=-1)
        is_inside = ((exact >= 0) & (exact <= size)).all(axis=-1)
        is_good = off <= BREAK
        known = np.isfinite(places).all(axis=-1)
        for rows in (slice(1, None), slice(None, -1)):
            for columns in (slice(1, None), slice(None, -1)):
                known[rows, columns] &= is_good | np.isnan(off)
        error = max(error, float(off[is_good & is_inside].max(initial=0.0)))
        squares.append(np.dstack((np.where(known[..., None], places / size, 0.0), known)))
    return InverseTable(np.hstack(squares).astype(np.float32), reach, error)


def _places(camera: Camera, along: np.ndarray, sign: float) -> np.ndarray:
    """Return the pixel coordinates (n, n, 2) of the directions of a square, ahead if ``sign`` is -1."""
    x, y = np.meshgrid(along, along)
    square = x * x + y * y
    directions = np.stack((2 * x, 2 * y, sign * (1 - square)), axis=-1) / (1 + square)[..., None]
    return camera.project(camera.pose.eye + directions @ turn_of(camera).T)
