"""Triangles under rays on a lattice, such as a pinhole's or parallel rays: each row of a triangle is one span.

The volume of an edge is affine in the pixel then: in a row it changes its sign at one pixel coordinate. Where this
coordinate is so near to a pixel's center that rounding could decide, the exact sign decides, as for all other rays: see
``triangles``. t is computed as ``crossing`` computes it, so that it does not depend on which way finds a hit.
Reference: M. Olano and T. Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...conventions import EPS
from ...maths.speed import taken
from ...maths.vector import cross, dot, is_grid, is_lattice, is_one, norm
from ..search_rays import SearchRays
from ..windows import counted
from .triangles import EDGES, STEEP, VOLUME_ROUNDING, plane

CLEAR = 1 / 8
"""Pixels. If rounding moves the crossings of an edge with the rows by more than this, the edge is nearly parallel to
the rows. It then accepts or rejects whole rows of the bounds; rows that it leaves open are tested pixel by pixel.
"""


EVEN = 8 * EPS
"""Largest deviation of coordinates from even distances, over the largest coordinate. Their rounding reaches 5.7 EPS in
parts of a picture of 1920 columns. It changes the volumes by at most half of VOLUME_ROUNDING, which is doubled for it.
"""


@dataclass(frozen=True, eq=False)
class RayLattice:
    """The rays of a tile at even distances, as l = (first[0] + column step[0], first[1] + row step[1], 1).

    A pinhole's directions are (l[0], l[1], z); parallel rays have the origins (l[0], l[1], 0) and directions (0, 0, z).
    """

    x: np.ndarray
    """l[0] of each column, as it is: the formula is right to EVEN."""
    y: np.ndarray
    """l[1] of each row, as it is."""

    first: tuple[float, float]
    step: tuple[float, float]
    z: float
    """The z of all directions."""
    is_parallel: bool
    reach: float
    """The length of the longest l."""

    @classmethod
    def of(cls, rays: SearchRays) -> RayLattice | None:
        """Return the lattice of the rays; None if they are on no lattice, or not at even distances."""
        if rays.origin is None and is_lattice(rays.direction):
            x, y, z = rays.direction
        elif rays.origin is not None and is_one(rays.direction) and is_grid(*rays.origin[:2]):
            (x, y, height), z = rays.origin, rays.direction[2]
            if np.ndim(height) or height or rays.direction[0] or rays.direction[1]:
                return None
        else:
            return None
        x, y = x.ravel().astype(float), y.ravel().astype(float)
        first, step = [], []
        for places in (x, y):
            pitch = (places[-1] - places[0]) / max(len(places) - 1, 1)
            even = places[0] + pitch * np.arange(len(places))
            if not pitch or np.abs(places - even).max() > EVEN * np.abs(places).max():
                return None
            first.append(float(places[0]))
            step.append(float(pitch))
        reach = float(np.sqrt(np.square(x).max() + np.square(y).max() + 1))
        return cls(x, y, (first[0], first[1]), (step[0], step[1]), float(z), rays.origin is not None, reach)

    def edges(self, corners: np.ndarray) -> tuple[Any, Any, Any]:
        """Return the coefficients of the three volumes as linear functions of l, (3, k) each: edge, triangle."""
        a, b = (corners[[edge[end] for edge in EDGES]].swapaxes(0, 1) for end in (0, 1))
        if self.is_parallel:
            return self.z * (a[1] - b[1]), self.z * (b[0] - a[0]), self.z * (a[0] * b[1] - a[1] * b[0])
        x, y, z = cross(a, b)
        return x, y, z * self.z

    def scale(self, corners: np.ndarray) -> np.ndarray:
        """Return the scale of the volumes: their errors are at most VOLUME_ROUNDING times it."""
        longest = norm(corners.swapaxes(0, 1)).max(axis=0)
        return (longest + self.reach) ** 2 if self.is_parallel else longest**2 * self.reach


@dataclass(frozen=True, eq=False)
class Spans:
    """The pixels in which the rays of a lattice hit k triangles."""

    clear: np.ndarray
    """(k,) bool: the triangles that are handled here; the others have to be tested pixel by pixel."""
    met: tuple[np.ndarray, np.ndarray]
    """Triangles and the pixels of the tile in which they are hit, (m,) each."""
    t: np.ndarray
    open: tuple[np.ndarray, np.ndarray]
    """Triangles and the pixels in which they have to be tested exactly, since rounding could decide."""


def spans(lattice: RayLattice, corners: Any, bounds: np.ndarray, width: int) -> Spans:
    """Return the spans of triangles with corners (3, 3, k), seen within bounds (k, 4) of a tile of this width."""
    normal, product = plane(corners)
    height, slope = dot(normal, corners[0]), normal[2] * lattice.z
    scale = 2 * VOLUME_ROUNDING * lattice.scale(corners)
    edges = to_x, to_y, to_z = lattice.edges(corners)
    if lattice.is_parallel:
        for coefficient in edges:
            coefficient *= np.sign(slope)
        steep, clear = np.abs(slope), np.abs(slope) > scale
    else:
        steep, clear = np.abs(height) / np.abs(corners[:, 2]).max(axis=0), True
    clear = clear & (steep > STEEP * product * lattice.reach)
    inverse = 1 / (to_x * lattice.step[0])
    doubt = scale * np.abs(inverse)
    is_level = ~(doubt < CLEAR)
    x0, x1, y0, y1 = bounds.T
    at, row = counted(np.where(clear, y1 - y0, 0), y0)
    is_open = np.zeros(len(at), bool)
    if is_level.any():
        at, row, is_open = _level(lattice, edges, is_level, scale, bounds, at, row)
    start = -(to_x * lattice.first[0] + (to_y * lattice.first[1] + to_z)) * inverse
    moved = taken(np.where(is_level, 0.0, -to_y * lattice.step[1] * inverse), at)
    moved *= row
    low = (taken(np.where(~is_level & (inverse > 0), start, -np.inf), at) + moved).max(axis=0)
    high = (taken(np.where(~is_level & (inverse < 0), start, np.inf), at) + moved).min(axis=0)
    doubt = taken(np.where(is_level, 0, doubt).max(axis=0), at)
    first = np.maximum(np.ceil(low - doubt), taken(x0, at))
    last = np.minimum(np.floor(high + doubt), taken(x1, at) - 1)
    chosen = np.flatnonzero(first <= last)
    at, row, is_open = taken(at, chosen), taken(row, chosen), taken(is_open, chosen)
    left, right = taken(first < low + doubt, chosen), taken(last > high - doubt, chosen)
    first, last = taken(first, chosen).astype(np.intp), taken(last, chosen).astype(np.intp)
    begin = row * width
    untested = [(at[:0], at[:0])]
    if is_open.any() or left.any() or right.any():
        span, column = counted(np.where(is_open, last - first + 1, 0), first)
        untested.append((at[span], begin[span] + column))
        left, right = left & ~is_open, right & ~is_open & ((last > first) | ~left)  # a pixel is tested once
        untested += [(at[is_end], begin[is_end] + end[is_end]) for is_end, end in ((left, first), (right, last))]
        first += left
        last -= right
        last[is_open] = first[is_open] - 1
    span, column = counted(last - first + 1, first)
    t = _crossing(lattice, corners[0], normal, at, row, span, column)
    column += taken(begin, span)
    return Spans(
        clear=np.broadcast_to(clear, len(bounds)),
        met=(taken(at, span), column),
        t=t,
        open=(np.concatenate([values for values, _ in untested]), np.concatenate([values for _, values in untested])),
    )


def _crossing(lattice: RayLattice, corner: Any, normal: Any, at: np.ndarray, row, span, column) -> np.ndarray:
    """Return t, (m,), at columns of spans of some rows of triangles ``at``; equal to that of ``crossing``."""
    x, y = taken(lattice.x, column), taken(lattice.y, row)
    if lattice.is_parallel:
        terms = np.array((normal[0], normal[1], normal[2] * corner[2], normal[2] * lattice.z, corner[0], corner[1]))
        first, second, third, slope, right, up = taken(terms, at)
        first, constant, slope, right = taken(np.array((first, second * (up - y) + third, slope, right)), span)
        return (first * (right - x) + constant) / slope
    terms = np.array((normal[0], normal[1], normal[2] * lattice.z, dot(normal, corner)))
    first, second, third, height = taken(terms, at)
    first, constant, height = taken(np.array((first, second * y + third, height)), span)
    first *= x
    first += constant
    return np.divide(height, first, out=first)


def _level(lattice: RayLattice, edges: Any, is_level: np.ndarray, scale, bounds: np.ndarray, at, row):
    """Return the rows of triangles, as ``at`` and ``row``, without those that lie outside of an edge nearly parallel to
    the rows, and in which of them rounding could decide.
    """
    gone, is_open = np.zeros((2, len(at)), bool)
    rows = np.flatnonzero(is_level.any(axis=0)[at])
    k = at[rows]
    x = lattice.first[0] + lattice.step[0] * np.stack((bounds[k, 0], bounds[k, 1] - 1))
    y = lattice.first[1] + lattice.step[1] * row[rows]
    for to_x, to_y, to_z, meant in zip(*edges, is_level, strict=True):
        ends = to_x[k] * x + (to_y[k] * y + to_z[k])
        gone[rows] |= meant[k] & (ends.max(axis=0) < -scale[k])
        is_open[rows] |= meant[k] & (ends.min(axis=0) <= scale[k])
    stay = ~gone
    return at[stay], row[stay], is_open[stay]
