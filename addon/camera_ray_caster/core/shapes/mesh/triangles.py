"""Rays and triangles: which triangle a ray hits, decided consistently on both sides of an edge, and where.

A ray o + t d hits the triangle a, b, c if the three volumes d . (b x c), d . (c x a) and d . (a x b), of corners
relative to o, have one sign: they are proportional to the hit's barycentric coordinates. If the two corners of an edge
are swapped, its volume changes only its sign, in rounded arithmetic too. Where rounding could decide a sign, the exact
sign for the rounded corners is used. So all signs are those of one surface with slightly moved corners: no ray passes
between its triangles, without any epsilon. A ray through an edge hits both of its triangles.
References: F. P. Preparata and M. I. Shamos, Computational Geometry, 1985, section 2.2 (signs of volumes); S. Woop,
C. Benthin and I. Wald, Watertight Ray/Triangle Intersection, JCGT 2 (2013); M. Olano and T. Greer, Triangle Scan
Conversion using 2D Homogeneous Coordinates, 1997 (no clipping).
"""

from functools import reduce
from typing import Any

import numpy as np

from ...conventions import EPS
from ...maths.exact import volume_sign
from ...maths.speed import taken
from ...maths.vector import cross, difference, dot, norm

VOLUME_ROUNDING = 16 * EPS
"""Error bound of a volume, over the product of the lengths of its three vectors. The products have errors of at most
gamma(7), and their magnitudes add up to at most 6 / sqrt(27) of the lengths' product. Two rounded corners add as much,
and the lengths are rounded, too.
Reference: E. Carlen, E. H. Lieb and M. Loss, An inequality of Hadamard type for permanents, 2006.
"""

STEEP = 2.0**-16
"""If n . d is below this fraction of the product of the lengths of two edges and of d, as on slivers and on triangles
seen edge-on, t is clamped to the range of the t of the corners.
"""

IN_BOX = 2.0**-32
"""Relative distance by which t may then lie outside of the triangle's box: t that are right keep their bits."""

EDGES = (1, 2), (2, 0), (0, 1)
"""The corners of the edge opposite to each corner."""


def volume(d: Any, a: Any, b: Any) -> Any:
    """Return d . (a x b) of components that broadcast; swapping a and b changes the sign exactly.

    A component of d that is the number 0 for all rays costs nothing.
    """
    terms = (
        d[i] * (a[j] * b[k] - a[k] * b[j])
        for i, j, k in ((1, 2, 0), (2, 0, 1), (0, 1, 2))
        if np.ndim(d[i]) or d[i] != 0
    )  # y and z first: for a pinhole only one sum is two-dimensional
    return reduce(_added, terms)


def _added(total: Any, term: Any) -> Any:
    """Return the sum; in place of the first if that has its shape: new memory costs more than the addition."""
    return np.add(total, term, out=total if np.shape(total) == np.broadcast_shapes(total.shape, term.shape) else None)


def volumes(corners: Any, d: Any) -> tuple[Any, Any, Any]:
    """Return the volumes of the edges opposite to the three corners."""
    first, second, third = (volume(d, corners[i], corners[j]) for i, j in EDGES)
    return first, second, third


def edge_vectors(corners: Any, from_eye: bool) -> np.ndarray:
    """Return the vectors, (3, 3, k), whose products with a direction are the volumes of triangles, (3, 3, k): corner,
    component; unless all rays leave the eye, (3, 6, k), for direction and moment, o x d.

    With moments the corners are not relative to o: d . ((a - o) x (b - o)) is d . (a x b) + (o x d) . (b - a), where
    only d and the moment depend on the ray. The error of these volumes is at most VOLUME_ROUNDING |d| (r + |o|)^2, with
    r the length of the longest corner.
    """
    vectors = [np.array(cross(corners[i], corners[j])) for i, j in EDGES]
    if not from_eye:
        vectors = [np.append(vectors[k], corners[j] - corners[i], axis=0) for k, (i, j) in enumerate(EDGES)]
    return np.array(vectors)


def signs(corners: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Return the exact signs of ``volumes``, (3, m), of corners (3, 3, m) and directions (3, m)."""
    first, second = (np.concatenate([corners[edge[k]] for edge in EDGES], axis=1) for k in (0, 1))
    return volume_sign(np.tile(d, 3), first, second).reshape(3, -1)


def plane(corners: Any) -> tuple[Any, Any]:
    """Return n, the cross product of two edges, and the product of their lengths, which may be much longer than n."""
    first, second = difference(corners[1], corners[0]), difference(corners[2], corners[0])
    return cross(first, second), norm(first) * norm(second)


def side(corners: np.ndarray) -> np.ndarray:
    """Return the exact sign of a . (b x c), (m,), of corners (3, 3, m): the sign of all volumes of a ray from the
    origin that hits the triangle. It is 0 if the triangle is in a plane with the origin, from where no ray hits it.
    """
    product = volume(corners[0], corners[1], corners[2])
    lengths = norm(corners[0]) * norm(corners[1]) * norm(corners[2])
    sign = np.sign(product)
    open_ = np.flatnonzero(~(np.abs(product) > VOLUME_ROUNDING * lengths))
    if open_.size:
        sign[open_] = volume_sign(*corners[:, :, open_])
    return sign


def crossing(corners: Any, origin: Any, d: Any) -> np.ndarray:
    """Return t, (m,), at which rays meet the planes of their triangles; ``origin`` is None for rays from the eye. Where
    rounding could make t far wrong (see STEEP), it is clamped to the t of the corners, and to the t between which the
    ray is in the triangle's box: then no hit depends on which boxes are searched first.
    """
    normal, product = plane(corners)
    slope = dot(normal, d)
    t = dot(normal, from_origin(corners[0], origin)) / slope
    poor = np.flatnonzero(~(np.abs(slope) > STEEP * product * norm(d)))
    if poor.size:
        ahead, start = (None if vector is None else tuple(c[poor] for c in vector) for vector in (d, origin))
        away = np.array([from_origin([c[poor] for c in corner], start) for corner in corners])
        ends = [dot(corner, ahead) / dot(ahead, ahead) for corner in away]
        sides = [away.min(axis=0) / ahead, away.max(axis=0) / ahead]  # NaN, of sides along the ray, tells nothing
        enter = np.maximum(np.minimum.reduce(ends), np.fmax.reduce(np.minimum(*sides)))  # NaN without a direction
        leave = np.minimum(np.maximum.reduce(ends), np.fmin.reduce(np.maximum(*sides)))
        t[poor] = np.fmin(np.fmax(t[poor], enter - IN_BOX * np.abs(enter)), leave + IN_BOX * np.abs(leave))
    return t


class Planes:
    """The planes of k triangles, (3, 3, k), whose ``crossing`` many rays ask for: terms of each are computed once."""

    def __init__(self, corners: np.ndarray, from_eye: bool, longest: float):
        """``longest`` is an upper bound of the lengths of the rays' directions."""
        area, product = plane(corners)
        places = (dot(area, corners[0]),) if from_eye else corners[0]
        self._product = product
        self._corners, self._terms = corners, np.array((*area, STEEP * longest * product, *places))

    def heights(self, at: np.ndarray, origins: np.ndarray | None, rounding: float) -> np.ndarray:
        """Return lower bounds of the magnitudes of normal . (corner - o), (p,), of the triangles of these indices, for
        origins o in balls, (4, p), None for the eye; ``rounding``: their error over the product of the lengths.
        """
        corner, product = taken(self._corners[0], at), taken(self._product, at)
        limit = rounding * norm(corner)
        if origins is None:
            return np.abs(taken(self._terms[4], at)) - product * limit
        normal = taken(self._terms[:3], at)
        return np.abs(dot(normal, difference(corner, origins[:3]))) - product * (limit + origins[3])

    def crossings(self, at: np.ndarray, origin: Any, d: np.ndarray) -> np.ndarray:
        """Return ``crossing`` of rays, (m,), with the triangles of these indices."""
        first, second, third, steep, *places = taken(self._terms, at)
        normal = first, second, third
        slope = dot(normal, d)
        t = (places[0] if origin is None else dot(normal, difference(places, origin))) / slope
        poor = np.flatnonzero(~(np.abs(slope) > steep))
        if poor.size:
            start = None if origin is None else taken(origin, poor)
            t[poor] = crossing(taken(self._corners, taken(at, poor)), start, taken(d, poor))
        return t


def from_origin(point: Any, origin: Any) -> Any:
    """Return a point relative to rays' origins, None for the eye."""
    return point if origin is None else difference(point, origin)
