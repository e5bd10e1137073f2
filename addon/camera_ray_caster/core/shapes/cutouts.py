"""Surfaces with transparent points: a ray passes through these, so that they are no crossings in the search for hits.

The nearest crossing that counts is thus found directly, with the arithmetic and the error bounds of any other hit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..maths.vector import ALL, matvec
from .kind import HitPixels, Kind
from .shape_frames import InCamera
from .surface_places import KindPlaces, SurfacePlaces

Cross = Callable[[Any], tuple[Any, Any]]
"""A function that returns the first crossing at or beyond a start: see ``Cutouts.first_hit``."""


@dataclass(frozen=True, eq=False)
class Cutouts:
    """The transparent surfaces among shapes of one kind."""

    kind: Kind
    shapes: InCamera
    may: np.ndarray
    """(n,) bool: which rows of ``Shapes`` may have transparent points."""

    @classmethod
    def of(cls, kind: Kind, shapes: InCamera, at: np.ndarray) -> Cutouts | None:
        """Return the transparent surfaces of the shapes at some indices; None if all their points are hit."""
        record = shapes.shapes
        alpha = np.array([surface.alpha is not None for surface in record.surfaces] + [False])
        if not alpha.any():
            return None
        has_alpha = alpha[shapes.surfaces]
        may, count = has_alpha[: len(record)], len(record)
        if record.slots is not None:
            first = record.slots.first.astype(np.intp)
            of_slots = has_alpha[count:-1]
            starts = np.unique(first[first >= 0])
            any_of = np.zeros(len(of_slots) + 1, bool)
            any_of[starts] = np.logical_or.reduceat(of_slots, starts)
            may = np.where(first >= 0, any_of[first], may)
        return cls(kind, shapes, may) if may[at].any() else None

    def hit(self, pixels: HitPixels, camera_point: Any) -> np.ndarray:
        """Return which crossings, (m,), are hits; their points are three components in the camera's frame."""
        places = KindPlaces(self.kind, self.shapes, pixels, matvec(self.shapes.pose.basis, camera_point))
        hit = np.ones(len(pixels.at), bool)
        for number, indices in places.each_surface():
            surface = self.shapes.shapes.surfaces[number]
            hit[indices] = surface.is_hit(SurfacePlaces(places, indices), len(indices))
        return hit

    def first_hit(
        self, at: Any, origin: Any, direction: Any, nearest: Any, cross: Cross
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return t of the first crossing that is a hit, and where there is one, as ``AffineKind.intersect`` does.

        ``at`` are the indices of the shapes, which broadcast with the rays. Beyond ``nearest``, the t of hits on other
        shapes, there is no need of a hit; None if there are none. ``cross(start)`` returns the first
        crossing at or beyond ``start``, None for the clip start, as ``AffineKind.intersect`` does.
        """
        t, open_ = _crossed(cross(None), nearest)
        hit = open_.copy()
        while open_.any():
            where = np.nonzero(open_)
            span = t[where]
            pixels = crossings(np.broadcast_to(at, t.shape)[where], span, origin is None)
            point = [span * np.broadcast_to(component, t.shape)[where] for component in direction]
            if origin is not None:
                point = [p + np.broadcast_to(o, t.shape)[where] for p, o in zip(point, origin, strict=True)]
            open_[where] = ~self.hit(pixels, point)
            if self.kind.meets_once:
                return t, hit & ~open_
            beyond, crossed = _crossed(cross(np.nextafter(t, t.dtype.type(np.inf))), nearest)
            t = np.where(open_, beyond, t)
            hit = np.where(open_, crossed, hit)
            open_ &= crossed
        return t, hit


def crossings(at: np.ndarray, t: np.ndarray, from_eye: bool, **noted: Any) -> HitPixels:
    """Return crossings, (m,), in the form of hit pixels, with the notes of their kind."""
    where = np.ones((1, len(at)), bool)
    return HitPixels(where, (at[None], t[None]), (ALL, ALL), from_eye, noted=noted)


def _crossed(crossing: tuple[Any, Any], nearest: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return copies of t, and of where it is a crossing up to ``nearest`` as a bool array."""
    t, where = crossing
    t = np.array(t)
    crossed = t < np.inf if nearest is None else (t < np.inf) & (t <= nearest)
    return t, crossed if where is None else crossed & where
