"""The hits of rays that are given one by one, and their passes and error bounds, by the code that writes pictures."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..casting.hit_values import HitValues
from ..casting.hits import NOTHING, Hits
from ..casting.passes import PASSES
from ..casting.rays import TileRays, given_rays
from ..casting.request import Request
from ..casting.store import store
from ..casting.target import RayTarget
from ..maths.speed import Scratch, lazy
from ..records import MESH, Pose, Shapes
from ..shapes.in_camera import in_camera
from ..shapes.mesh.nearest import SeenTriangles

Span = tuple[float, float]
"""The least and the largest t of hits."""

CHUNK = 1 << 15
"""Number of rays whose passes are written at once."""

WORLD = Pose(np.zeros(3), np.eye(3))
"""The frame in which the rays are given."""


@dataclass(frozen=True, eq=False)
class RayHits:
    """Hits of rays, (m,) arrays."""

    ray: np.ndarray
    t: np.ndarray
    body: np.ndarray
    """Indices into the bodies of ``RayBodies``."""

    @classmethod
    def of(cls, t: np.ndarray, body: np.ndarray) -> RayHits:
        """Return the nearest hits of rays, given t and bodies of all rays, -1 for none."""
        hit = np.flatnonzero(body >= 0)
        return cls(hit, t[hit], body[hit])

    @classmethod
    def joined(cls, parts: list[RayHits]) -> RayHits:
        """Return the hits of all parts, one after the other."""
        kinds = (("ray", np.intp), ("t", float), ("body", np.intp))
        return cls(*(
            np.concatenate([getattr(hits, name) for hits in parts] or [np.zeros(0, kind)]) for name, kind in kinds
        ))  # fmt: skip

    def only(self, indices: np.ndarray) -> RayHits:
        """Return some of them, by index."""
        return RayHits(self.ray[indices], self.t[indices], self.body[indices])


class RayBodies:
    """Bodies of shapes, on which rays have hits."""

    at: np.ndarray
    """(b,): the shape of each body."""
    number: np.ndarray
    """(b,): its triangle."""

    def __init__(self, shapes: Shapes):
        self.shapes = shapes
        self.placed = in_camera(shapes, WORLD)
        self.target = RayTarget(self.placed, np.arange(len(shapes)), Request(()))

    @lazy
    def is_triangle(self) -> np.ndarray:
        """(b + 1,) bool: whether a body is a triangle of a mesh; False at the end, for no body."""
        return np.append(self.shapes.kind[self.at] == MESH, False)

    def write(self, origin, direction, t, body, images: dict[str, np.ndarray], rays: np.ndarray) -> None:
        """Write the passes of hits, one for each ray (3, n), at the places ``rays``, (n,), of images with one row."""
        for chunk, hits in self._hits(origin, direction, t, body):
            outs = {name: PASSES[name].empty((1, len(t[chunk])), image.dtype) for name, image in images.items()}
            store(hits, outs)
            for name, out in outs.items():
                images[name][:, rays[chunk]] = out

    def t_errors(self, origin, direction, hits: RayHits) -> np.ndarray:
        """Return the error bounds of the t of hits, one for each ray (3, n)."""
        bounds = np.full(hits.t.shape, np.inf)
        for chunk, block in self._hits(origin, direction, hits.t, hits.body):
            for where, errors in HitValues(block).errors:
                bounds[chunk][where[0]] = errors.t_error
        return bounds

    def _hits(self, origin, direction, t, body) -> Iterator[tuple[slice, Hits]]:
        """Yield the hits of rays (3, n), CHUNK at a time, given their t and bodies, (n,), -1 for none."""
        scratch = Scratch()
        with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
            for first in range(0, len(t), CHUNK):
                chunk = slice(first, first + CHUNK)
                rays = given_rays(origin[:, chunk], direction[:, chunk], scratch)
                yield chunk, self.hits_of(self.target, rays, t[None, chunk], body[None, chunk])

    def hits_of(self, target: RayTarget, rays: TileRays, t: np.ndarray, body: np.ndarray) -> Hits:
        """Return the hits of rays on these shapes, given their t and bodies, (rows, columns), -1 for none."""
        index, of_pixel = np.full(body.shape, NOTHING), np.zeros(body.shape, np.int32)
        index[body >= 0] = self.at[body[body >= 0]]
        triangles = self.is_triangle[body]
        met, of_pixel[triangles] = np.unique(body[triangles], return_inverse=True)
        return Hits(target, rays, t, index, known={MESH: SeenTriangles(self.at[met], self.number[met], of_pixel)})
