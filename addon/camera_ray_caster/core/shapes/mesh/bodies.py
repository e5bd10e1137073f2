"""The triangles of meshes as bodies, decided as those of a picture are: see ``triangles``."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...maths.speed import Scratch
from ...maths.vector import along, difference, norm
from ...memory import require
from ..bodies import Bodies, places_of
from ..cutouts import Cutouts, crossings
from ..frames import InCamera
from .surface import TRIANGLES, HitTriangles
from .triangles import VOLUME_ROUNDING, crossing, signs, volumes

BYTES = 144
"""Upper bound of the memory of each triangle, with its box and its share of the tree."""

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
        require(BYTES * int(count.sum()), f"{int(count.sum()):,} triangles", FEWER)
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
        corners = np.array([
            difference(places_of(self._places, vertices), origin) for vertices in places_of(self._corners, body)
        ])  # fmt: skip
        some = _met(corners, direction)
        t = np.full(corners.shape[2], np.nan)
        t[some] = crossing(corners[:, :, some], None, tuple(part[some] for part in direction))
        t[~(t >= start)] = np.nan
        return t

    def is_hit(self, body: np.ndarray, origin: Any, direction: Any, t: np.ndarray, scratch: Scratch) -> Any:
        """See ``Bodies``."""
        if self._cutouts is None:
            return True
        found, at = np.ones(len(t), bool), self.at[body]
        some = np.flatnonzero(self._cutouts.may[at])
        at, own_t = at[some], t[some]
        triangles = HitTriangles(self._shapes, np.arange(len(some)), at, self.number[body[some]], from_eye=False)
        point = along(tuple(part[some] for part in origin), tuple(part[some] for part in direction), own_t)
        found[some] = self._cutouts.hit(crossings(at, own_t, False, **{TRIANGLES: triangles}), point)
        return found


def _placed(shapes: InCamera, at: Any, q: np.ndarray) -> list[np.ndarray]:
    """Return places of meshes in the world, three components, given vectors from their middles, (3, m), and the shape,
    or one for each.
    """
    axes, center = shapes.shapes.axes[at].T, shapes.center[at].T
    return [axes[0, i] * q[0] + (axes[1, i] * q[1] + axes[2, i] * q[2]) + center[i] for i in range(3)]


def _met(corners: np.ndarray, direction: Any) -> np.ndarray:
    """Return which rays hit triangles with corners relative to the rays' origins, (3, 3, m), by index."""
    first, second, third = volumes(corners, direction)
    inner = np.minimum(np.minimum(first, second), third)
    np.maximum(inner, -np.maximum(np.maximum(first, second), third), out=inner)
    longest = np.maximum.reduce([norm(corner) for corner in corners])
    doubt = VOLUME_ROUNDING * longest**2 * norm(direction)
    met = inner > doubt
    open_ = np.flatnonzero(np.abs(inner) <= doubt)
    if open_.size:
        exact = signs(corners[:, :, open_], np.array([part[open_] for part in direction]))
        met[open_] = ((exact >= 0).all(axis=0) | (exact <= 0).all(axis=0)) & exact.any(axis=0)
    return np.flatnonzero(met)
