"""The triangles of meshes as bodies, decided as those of a picture are: see ``triangles``."""

from typing import Any

import numpy as np

from ...maths.speed import Scratch
from ...maths.vector import along, cross, difference, dot, norm
from ...memory import require
from ..bodies import Bodies, places_of
from ..cutouts import Cutouts, crossings
from ..shape_frames import InCamera
from .mesh_surface import TRIANGLES, HitTriangles
from .triangles import VOLUME_ROUNDING, crossing, edge_vectors, signs, volumes

TRIANGLE_BYTES = 192
"""Upper bound of the memory of each triangle, with its boxes and its share of the tree."""

PREPARED = 0.25
"""Number of rays, for each triangle, from which the triangles are prepared for them. Not tuned."""

MOST_PREPARED = 1 << 20
"""Largest number of triangles that are prepared: they take half a gigabyte."""

MOVED = 2
"""Factor of the error bound of volumes by moments: their origins are rounded when the middle is subtracted."""

FEWER = "cast at fewer instances, or reduce the subdivision"


class TriangleBodies(Bodies):
    """The triangles of some shapes that show meshes, (k,) indices."""

    twice = False

    def __init__(self, shapes: InCamera, at: np.ndarray, parts: np.ndarray | None, cutouts: Cutouts | None):
        """Take all triangles of the shapes, or one of each by its number, in ``parts``."""
        self._shapes, self._cutouts = shapes, cutouts
        if parts is None:
            self._take_all(at)
        else:
            self._take_parts(at, parts)
        ends = [self._places[:, corner] for corner in self._corners]
        self.low, self.high = np.minimum.reduce(ends), np.maximum.reduce(ends)

    def _take_all(self, at: np.ndarray) -> None:
        shapes = self._shapes
        meshes = [shapes.shapes.meshes[k] for k in shapes.shapes.mesh[at].tolist()]
        count = np.array([len(mesh) for mesh in meshes])
        require(TRIANGLE_BYTES * int(count.sum()), f"{int(count.sum()):,} triangles", FEWER)
        self.at = np.repeat(at, count)
        self.number = np.concatenate([np.arange(number, dtype=np.int32) for number in count.tolist()])
        start = np.cumsum([0, *(mesh.vertices.shape[1] for mesh in meshes)])
        self._places = np.empty((3, start[-1]))
        corners = []
        for row, mesh, first in zip(at.tolist(), meshes, start.tolist(), strict=False):
            q = mesh.vertices - mesh.middle[:, None]
            self._places[:, first : first + q.shape[1]] = _placed(shapes, row, q)
            corners.append(mesh.triangles + np.intp(first))
        self._corners = np.concatenate(corners, axis=1)

    def _take_parts(self, at: np.ndarray, parts: np.ndarray) -> None:
        self.at, self.number = at, parts
        triangles = HitTriangles(self._shapes, np.arange(len(at)), at, parts, from_eye=False)
        self._places = np.concatenate([np.array(_placed(self._shapes, at, q)) for q in triangles.local], axis=1)
        self._corners = np.arange(3 * len(at)).reshape(3, -1)

    def meet(self, body: Any, origin: Any, direction: Any, start: Any, scratch: Scratch) -> np.ndarray:
        """See ``Bodies``: the signs of three volumes decide, exact where rounding could decide."""
        corners = self.corners(body, origin)
        longest = np.maximum.reduce([norm(corner) for corner in corners])
        met, open_ = _inside(volumes(corners, direction), VOLUME_ROUNDING * longest**2 * norm(direction))
        met[open_] = _is_met(corners[:, :, open_], [component[open_] for component in direction])
        hit = np.flatnonzero(met)
        return _crossings(len(met), hit, corners[:, :, hit], direction, start)

    def prepared(self, origin: np.ndarray) -> Bodies:
        is_worth_it = PREPARED * len(self.at) < origin.shape[1] and len(self.at) <= MOST_PREPARED
        return PreparedTriangles(self, origin) if is_worth_it else self

    def corners(self, body: np.ndarray, origin: Any) -> np.ndarray:
        """Return the corners of triangles relative to origins, (3, 3, m): corner, component."""
        return np.array([difference(places_of(self._places, k), origin) for k in places_of(self._corners, body)])

    def is_hit(self, body: np.ndarray, origin: Any, direction: Any, t: np.ndarray) -> Any:
        if self._cutouts is None:
            return True
        hit, at = np.ones(len(t), bool), self.at[body]
        cut = np.flatnonzero(self._cutouts.may[at])
        at, t_there = at[cut], t[cut]
        triangles = HitTriangles(self._shapes, np.arange(len(cut)), at, self.number[body[cut]], from_eye=False)
        point = along(tuple(c[cut] for c in origin), tuple(c[cut] for c in direction), t_there)
        hit[cut] = self._cutouts.hit(crossings(at, t_there, False, **{TRIANGLES: triangles}), point)
        return hit


def _placed(shapes: InCamera, at: Any, q: np.ndarray) -> list[np.ndarray]:
    """Return places of meshes in the world, three components, given vectors from their middles, (3, m), and the shape,
    or one for each.
    """
    axes, center = shapes.shapes.axes[at].T, shapes.center[at].T
    return [axes[0, i] * q[0] + (axes[1, i] * q[1] + axes[2, i] * q[2]) + center[i] for i in range(3)]


class PreparedTriangles(Bodies):
    """Triangles for many rays: what a volume takes of the triangle is computed once for all, relative to the middle of
    the rays' origins. If all rays leave one point, that is the point.
    """

    twice = False

    def __init__(self, triangles: TriangleBodies, origin: np.ndarray):
        self._triangles = triangles
        self.at, self.number, self.low, self.high = triangles.at, triangles.number, triangles.low, triangles.high
        self._middle = (origin.min(axis=1) / 2 + origin.max(axis=1) / 2)[:, None]
        self._from_one = bool((origin == self._middle).all())
        corners = triangles.corners(np.arange(len(self.at)), self._middle)
        self._edges = edge_vectors(corners, self._from_one)
        self._longest = np.maximum.reduce([norm(corner) for corner in corners])

    def meet(self, body: Any, origin: Any, direction: Any, start: Any, scratch: Scratch) -> np.ndarray:
        longest = places_of(self._longest, body)
        if self._from_one:
            volumes = tuple(dot(direction, places_of(edge, body)) for edge in self._edges)
            met, open_ = _inside(volumes, VOLUME_ROUNDING * longest**2 * norm(direction))
        else:
            away = difference(origin, self._middle)
            factors = np.concatenate((direction, cross(away, direction)))
            edges = (places_of(edge, body) for edge in self._edges)
            volumes = tuple(dot(factors[:3], edge[:3]) + dot(factors[3:], edge[3:]) for edge in edges)
            met, open_ = _inside(volumes, MOVED * VOLUME_ROUNDING * (longest + norm(away)) ** 2 * norm(direction))
        body = np.broadcast_to(body, len(met))
        corners = self._triangles.corners(body[open_], origin[:, open_])
        met[open_] = _is_met(corners, [component[open_] for component in direction])
        hit = np.flatnonzero(met)
        return _crossings(len(met), hit, self._triangles.corners(body[hit], origin[:, hit]), direction, start)

    def is_hit(self, body: np.ndarray, origin: Any, direction: Any, t: np.ndarray) -> Any:
        return self._triangles.is_hit(body, origin, direction, t)


def _inside(volumes: Any, doubt: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return whether three volumes have one sign, and the indices of those within their rounding of 0."""
    first, second, third = volumes
    inner = np.minimum(np.minimum(first, second), third)
    np.maximum(inner, -np.maximum(np.maximum(first, second), third), out=inner)
    return inner > doubt, np.flatnonzero(np.abs(inner) <= doubt)


def _is_met(corners: np.ndarray, direction: Any) -> np.ndarray:
    """Return whether rays hit triangles with corners relative to the rays' origins, (3, 3, m), exactly."""
    exact = signs(corners, np.array(direction))
    return ((exact >= 0).all(axis=0) | (exact <= 0).all(axis=0)) & exact.any(axis=0)


def _crossings(count: int, hit: np.ndarray, corners: np.ndarray, direction: Any, start: Any) -> np.ndarray:
    """Return t of the rays that hit, by index, from ``start`` on, NaN of the others; the corners are those of hits."""
    t = np.full(count, np.nan)
    t[hit] = crossing(corners, None, tuple(component[hit] for component in direction))
    t[~(t >= start)] = np.nan
    return t
