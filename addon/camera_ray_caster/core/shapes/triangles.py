"""Rays and triangles: which triangle a ray meets, decided alike on both sides of an edge, and where.

A ray o + t d meets the triangle a, b, c where the three volumes d . (b x c), d . (c x a) and d . (a x b), of corners
relative to o, have one sign: they are in proportion to the hit's barycentric coordinates. The volume of an edge changes
its sign, and nothing else, when the two corners are swapped, in rounded arithmetic too. Where rounding could decide a
sign the exact one of the rounded corners does. The signs are those of one surface with corners a little moved, so
that no ray falls between its triangles; there is no epsilon. A ray through an edge meets both of its triangles.
References: F. P. Preparata and M. I. Shamos, Computational Geometry, 1985, section 2.2 (signs of volumes); S. Woop,
C. Benthin and I. Wald, Watertight Ray/Triangle Intersection, JCGT 2 (2013); M. Olano and T. Greer, Triangle Scan
Conversion using 2D Homogeneous Coordinates, 1997 (no clipping).
"""

from __future__ import annotations

from functools import reduce
from typing import Any

import numpy as np

from ..conventions import EPS
from ..maths.exact import volume_sign
from ..maths.vector import cross, difference, dot, norm

ROUNDING = 16 * EPS
"""A volume is right to this times the product of the lengths of its three vectors: gamma(7) at most for its products,
whose magnitudes add up to 6 / sqrt(27) of that, as much for two rounded corners, and rounding of the lengths.
Reference: E. Carlen, E. H. Lieb and M. Loss, An inequality of Hadamard type for permanents, 2006.
"""

STEEP = 2.0**-16
"""Where n . d is below this part of the product of two edges' and the ray's lengths, as on slivers and on triangles
seen edge-on, t is held between those of the corners.
"""

EDGES = (1, 2), (2, 0), (0, 1)
"""The corners of the edge opposite to each corner."""


def volume(d: Any, a: Any, b: Any) -> Any:
    """Return d . (a x b) of components that broadcast; the same with the other sign when a and b are swapped.

    Axes along which all rays have no direction cost nothing.
    """
    terms = (
        d[i] * (a[j] * b[k] - a[k] * b[j])
        for i, j, k in ((1, 2, 0), (2, 0, 1), (0, 1, 2))
        if np.ndim(d[i]) or d[i] != 0
    )  # y and z first: for a pinhole only one sum is two-dimensional
    return reduce(np.add, terms)


def volumes(corners: Any, d: Any, moment: Any = None) -> tuple[Any, Any, Any]:
    """Return those of the edges opposite to the three corners.

    With the rays' moments, o x d, the corners are not relative to o: d . ((a - o) x (b - o)) is
    d . (a x b) + (o x d) . (b - a), where only d and the moment have a value for each pixel. These volumes are right to
    ROUNDING times the square of the longest corner's length and o's added, times that of d.
    """
    first, second, third = (_edge_volume(d, moment, corners[i], corners[j]) for i, j in EDGES)
    return first, second, third


def _edge_volume(d: Any, moment: Any, a: Any, b: Any) -> Any:
    own = volume(d, a, b)
    return own if moment is None else own + dot(moment, difference(b, a))


def signs(corners: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Return the exact signs of ``volumes``, (3, m), of corners (3, 3, m) and directions (3, m)."""
    first, second = (np.concatenate([corners[edge[k]] for edge in EDGES], axis=1) for k in (0, 1))
    return volume_sign(np.tile(d, 3), first, second).reshape(3, -1)


def plane(corners: Any) -> tuple[Any, Any]:
    """Return n, an edge's vector times another's, and the product of their lengths: n may be much shorter."""
    first, second = difference(corners[1], corners[0]), difference(corners[2], corners[0])
    return cross(first, second), norm(first) * norm(second)


def side(corners: np.ndarray) -> np.ndarray:
    """Return the exact sign of a . (b x c), (m,), of corners (3, 3, m): the sign of all volumes where a ray from the
    origin meets the triangle; 0 for those in a plane with it, which no ray from there meets.
    """
    found = volume(corners[0], corners[1], corners[2])
    most = norm(corners[0]) * norm(corners[1]) * norm(corners[2])
    sign = np.sign(found)
    open_ = np.flatnonzero(~(np.abs(found) > ROUNDING * most))
    if open_.size:
        sign[open_] = volume_sign(*corners[:, :, open_])
    return sign


def crossing(corners: Any, d: Any) -> np.ndarray:
    """Return t where rays meet the planes of their triangles, held between the t of the corners where rounding could
    carry it away; (m,) of corners, relative to the rays' origins, and directions.
    """
    normal, product = plane(corners)
    slope = dot(normal, d)
    t = dot(normal, corners[0]) / slope
    poor = np.flatnonzero(~(np.abs(slope) > STEEP * product * norm(d)))
    if poor.size:
        own = tuple(np.broadcast_to(component, t.shape)[poor] for component in d)
        ends = [dot([c[poor] for c in corner], own) / dot(own, own) for corner in corners]
        t[poor] = np.fmax(np.fmin(t[poor], np.maximum.reduce(ends)), np.minimum.reduce(ends))
    return t
