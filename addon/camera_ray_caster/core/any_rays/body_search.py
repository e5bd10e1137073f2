"""The hits of rays that are given one by one: the nearest, or all."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from math import inf
from threading import Lock
from typing import Any, NamedTuple, Self

import numpy as np

from ..maths.speed import Scratch, lazy, memoized, taken
from ..records import Shapes
from ..shapes.bodies import Bodies
from ..shapes.kinds import by_kind
from .balls import may_meet, pairs_may_meet, unit_directions
from .bundle import Limit, bundle_of
from .packets import coherent_order
from .ray_bodies import RayBodies, RayHits
from .traversal import Traversal
from .tree import Tree, enlarged, tree_of

RAYS = 1 << 16
"""Number of rays that descend a tree at once: it bounds the memory of packets and pairs. Not tuned."""

MOST_RAYS = 1 << 18
"""Number of rays that are searched at once: it bounds the memory of a bundle. Not tuned."""

BUNDLED = 0.125
"""Number of rays, for each body, from which they are tried as a bundle: of 150,000 triangles, 0.09 rays take as
long as by a tree, and 0.34 rays half as long.
"""

BODIES_WITHOUT_TREE = 12
"""Number of bodies that are tested one after the other at all rays, without a tree."""

PAIRS_WITHOUT_TREE = 1 << 12
"""Number of pairs of rays and bodies tested all at once, without a tree: a ray with a time of its own at a mesh
of 400 to 4,096 triangles that moves takes 2 to 3 ms, where its tree would make it 4 to 6.
"""


class SearchedRays(NamedTuple):
    """Rays, by origins and directions (3, n)."""

    origin: np.ndarray
    direction: np.ndarray
    from_eye: bool = False
    """Whether all rays have the same origin, so that ``only`` need not copy it."""

    def only(self, indices: np.ndarray) -> Self:
        """Return some of them, by index."""
        if self.from_eye:
            origin = np.broadcast_to(self.origin[:, :1], (3, len(indices)))
        else:
            origin = taken(self.origin, indices)
        return self._replace(origin=origin, direction=taken(self.direction, indices))


class BodySearch(RayBodies):
    """The bodies of all shapes, ready for rays; in the order of shapes and their triangles."""

    def __init__(self, shapes: Shapes, rays: float = inf):
        """rays: how many will be searched; of few, a tree would take longer than it saves."""
        super().__init__(shapes)
        self._kinds: list[Bodies] = [
            kind.bodies(self.placed, np.flatnonzero(of_kind)) for kind, of_kind in by_kind(shapes.kind)
        ]
        counts = [len(bodies.at) for bodies in self._kinds]
        at, number = (
            np.concatenate([getattr(bodies, name) for bodies in self._kinds] or [np.zeros(0, np.int64)])
            for name in ("at", "number")
        )
        order = np.lexsort((number, at)) if len(counts) > 1 else slice(None)
        self.at, self.number = at[order], number[order]
        self._kind = np.repeat(np.arange(len(counts), dtype=np.int8), counts)[order]
        self._own = np.concatenate([np.arange(count) for count in counts] or [np.zeros(0, np.intp)])[order]
        self._place = [np.flatnonzero(self._kind == k) for k in range(len(counts))]
        low, high = (
            np.concatenate([np.zeros((3, 0)), *(getattr(kind, end) for kind in self._kinds)], axis=1)[:, order]
            for end in ("low", "high")
        )
        inside = (np.isfinite(low) & np.isfinite(high)).all(axis=0)
        if rays * len(self.at) <= PAIRS_WITHOUT_TREE or np.count_nonzero(inside) <= BODIES_WITHOUT_TREE:
            inside[:] = False
        self._one_by_one, self._in_boxes = np.flatnonzero(~inside), np.flatnonzero(inside)
        self._boxes = enlarged(low[:, self._in_boxes], high[:, self._in_boxes])
        self._making = Lock()

    @property
    def _tree(self) -> Tree | None:
        with self._making:  # of several threads one makes it
            return self._made_tree

    @lazy
    def _made_tree(self) -> Tree | None:
        return tree_of(*self._boxes, self._in_boxes) if len(self._in_boxes) else None

    def nearest(self, origin, direction, near: float, far: float) -> tuple[np.ndarray, np.ndarray]:
        """Return t of the nearest hits from near to far of rays (3, n), inf for none, and their bodies, -1 for none.

        Of bodies at exactly the same t the first counts: that of the lowest shape, and its lowest triangle.
        """
        t, body = np.full(origin.shape[1], np.inf), np.full(origin.shape[1], -1)

        def keep(rays: np.ndarray, hits: RayHits) -> None:
            keep_nearest(hits, t, body, rays)

        self._search(origin, direction, near, far, lambda rays: np.minimum(taken(t, rays), far), keep)
        return t, body

    def all(self, origin: np.ndarray, direction: np.ndarray, near: float, far: float) -> RayHits:
        """Return all hits from near to far, by ray, t and body; a ray may hit a sphere twice."""
        kept: list[RayHits] = []

        def keep(rays: np.ndarray, new: RayHits) -> None:
            kept.append(RayHits(rays[new.ray], new.t, new.body))

        self._search(origin, direction, near, far, lambda rays: np.full(len(rays), far), keep, twice=True)
        hits = RayHits.joined(kept)
        return hits.only(np.lexsort((hits.body, hits.t, hits.ray)))

    def _search(
        self, origin, direction, near: float, far: float, limit: Limit, keep: Callable, twice: bool = False
    ) -> None:
        """Give all hits that may count to ``keep(rays, hits)``, where the hits count the given rays from 0."""
        finite = np.flatnonzero(np.isfinite(origin).all(axis=0) & np.isfinite(direction).all(axis=0))
        scratch = Scratch()
        with np.errstate(all="ignore"):  # NaN and inf mean no hit
            kinds = [bodies.prepared(origin[:, finite]) for bodies in self._kinds]
            for first in range(0, len(finite), MOST_RAYS):
                numbers = finite[first : first + MOST_RAYS]
                start, ahead = taken(origin, numbers), taken(direction, numbers)
                rays = SearchedRays(start, ahead, from_eye=bool((start == start[:, :1]).all()))
                for order, pairs in self._parts(rays, near):
                    chunk, of_chunk = numbers[order], rays.only(order)
                    in_boxes = pairs(lambda places, chunk=chunk: limit(taken(chunk, places)))
                    for ray, body in self._candidates(of_chunk, in_boxes, scratch):
                        for hits in self._met(kinds, ray, body, of_chunk, near, far, scratch, twice):
                            keep(chunk, hits)

    def _parts(self, rays: SearchedRays, near: float) -> Iterator[tuple[np.ndarray, Callable]]:
        """Yield the rays in parts, by index, with a function that yields rays of the part and bodies whose boxes they
        may meet, (m,) each, given a ``Limit``.
        """
        origin, direction, _ = rays
        count = origin.shape[1]
        if 0 < BUNDLED * len(self._in_boxes) < count:
            bundle = bundle_of(origin, direction, *self._boxes, self._in_boxes)
            if bundle is not None:
                yield bundle.order, bundle.pairs
                return
        every = np.arange(count) if self._tree is None else coherent_order(origin, direction, self._tree.reach)
        for first in range(0, count, RAYS):
            order = every[first : first + RAYS]
            yield order, partial(self._descended, rays.only(order), near)

    def _descended(self, rays: SearchedRays, near: float, limit: Limit) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        if self._tree is not None:
            every = np.arange(rays.origin.shape[1])
            yield from Traversal(self._tree, rays.origin, rays.direction, near, lambda: limit(every)).pairs()

    def _candidates(self, of_chunk: SearchedRays, in_boxes: Iterator, scratch: Scratch) -> Iterator[tuple[Any, Any]]:
        """Yield rays and bodies that may meet: (m,) each, or rays and one body."""
        origin, direction, from_eye = of_chunk
        rays, bodies = np.arange(origin.shape[1]), self._one_by_one
        start, ahead = origin[:, 0] if from_eye else origin, unit_directions(direction)
        if 0 < len(rays) * len(bodies) <= PAIRS_WITHOUT_TREE:
            yield np.repeat(rays, len(bodies)), np.tile(bodies, len(rays))
        elif len(rays):
            for shape in np.unique(self.at[bodies]).tolist():
                middle, radius = self.placed.center[shape], self.placed.radius[shape]
                close = np.flatnonzero(may_meet(middle, radius, start, ahead, scratch)) if radius < inf else rays
                for body in bodies[self.at[bodies] == shape].tolist():
                    yield close, body
        for ray, body in in_boxes:
            if not self._all_triangles:  # of a thousand spheres the balls leave 0.7 of the time
                whole = np.flatnonzero(~taken(self.is_triangle, body))
                balls, close = taken(self.at, taken(body, whole)), np.ones(len(ray), bool)
                of_pairs = self._middle, self.placed.radius, balls, start, ahead, taken(ray, whole)
                close[whole] = pairs_may_meet(*of_pairs, scratch)
                near = np.flatnonzero(close)
                ray, body = ray[near], body[near]
            yield ray, body

    @lazy
    def _all_triangles(self) -> bool:
        return bool(self.is_triangle[:-1].all())

    @lazy
    def _middle(self) -> np.ndarray:
        return np.ascontiguousarray(self.placed.center.T)

    def _met(
        self, kinds, ray, body, of_chunk: SearchedRays, near: float, far: float, scratch: Scratch, twice: bool
    ) -> Iterator[RayHits]:
        """Yield the hits among candidates, kind by kind."""
        rays = of_chunk.only(ray) if len(ray) != of_chunk.origin.shape[1] or np.ndim(body) else of_chunk
        kind, numbers = self._kind[body], self._own[body]
        for k, bodies in enumerate(kinds):
            of_kind = kind == k
            if not np.any(of_kind):
                continue
            candidates = numbers, ray, rays
            if not np.all(of_kind):
                pairs = np.flatnonzero(of_kind)
                candidates = numbers[pairs], ray[pairs], rays.only(pairs)
            for hits in met(bodies, *candidates, near, far, scratch, twice):
                yield RayHits(hits.ray, hits.t, self._place[k][hits.body])


@memoized
def search_of(shapes: Shapes) -> BodySearch:
    """Return the bodies of shapes with their tree, which is kept as long as the shapes are."""
    return BodySearch(replace(shapes))  # a copy: see ``memoized``


def met(
    bodies: Bodies, body: Any, ray: np.ndarray, rays: SearchedRays, near: float, far: float, scratch: Scratch,
    twice: bool,
) -> Iterator[RayHits]:  # fmt: skip
    """Yield the hits of m rays on bodies, (m,) or one for all: the nearest from ``near`` to ``far``, or ``twice``.
    ``ray`` are the numbers of the rays, (m,).
    """
    start: Any = near
    while len(ray):
        t = bodies.meet(body, rays.origin, rays.direction, start, scratch)
        hit = np.flatnonzero((t <= far) & (t < np.inf))
        ray, rays, t = ray[hit], rays.only(hit), t[hit]
        body = np.broadcast_to(body, (len(hit),)) if np.ndim(body) == 0 else body[hit]
        seen = bodies.is_hit(body, rays.origin, rays.direction, t)
        is_hit = np.flatnonzero(np.broadcast_to(seen, t.shape))
        yield RayHits(ray[is_hit], t[is_hit], body[is_hit])
        if not bodies.twice:
            break
        again = np.arange(len(t)) if twice else np.flatnonzero(~np.broadcast_to(seen, t.shape))
        ray, rays, body = ray[again], rays.only(again), body[again]
        start = np.nextafter(t[again], np.inf)


def keep_nearest(hits: RayHits, t: np.ndarray, body: np.ndarray, rays: np.ndarray) -> None:
    """Keep the hits that are the nearest so far; a ray may have several."""
    ray, hit_t, hit_body = rays[hits.ray], hits.t, hits.body
    while ray.size:
        before = taken(t, ray)
        closer = np.flatnonzero((hit_t < before) | ((hit_t == before) & (hit_body < taken(body, ray))))
        ray, hit_t, hit_body = taken(ray, closer), taken(hit_t, closer), taken(hit_body, closer)
        t[ray], body[ray] = hit_t, hit_body  # of several hits of a ray the last stays: others try again
        lost = np.flatnonzero(taken(body, ray) != hit_body)
        ray, hit_t, hit_body = taken(ray, lost), taken(hit_t, lost), taken(hit_body, lost)
