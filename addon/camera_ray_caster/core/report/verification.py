"""A camera's rays compared with witnesses: errors in pixels and radians, beside the bound that each witness can reach.

It knows a camera by its public ``rays_at``, ``project`` and ``raster`` alone and no model's formula. Blender's own
answers are the witnesses of ``report.witness``; the round trip needs none:

round trip             float64: what moving the point by 32 EPS (|origin| + |point|) does to its pixel. It is our own
                       rounding, so it is added to every other bound.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..conventions import gamma
from ..records import Finding
from .sample import CameraRays, Sample, angles_between, finding, largest, length_of
from .witness import Witness, findings_of

GRID = 9
"""Pixels a side at which rays are compared: the window's edges, its middle and between."""

STEP = 2.0**-4
"""Pixels between neighboring rays, whose angle tells how an error in pixels counts in radians."""

ENLARGED = 2.0**15
"""How many times its rounding a point is moved to see what the rounding does to its pixel."""


def verify(camera: CameraRays, witness: Witness | None = None, grid: int = GRID) -> list[Finding]:
    """Return what each witness says of the camera's rays, at ``grid`` x ``grid`` pixels of the render window.

    ``witness`` is Blender's, or None where Blender has none: an object with ``size``, ``matrix_world``, ``frame``,
    ``matrix`` and ``view_coordinates(points)``. The round trip needs none.
    Errors in radians are angles between directions in the world; errors in pixels say where in the frame the witness
    sees the ray. A pixel without a ray fails (NaN) where there is a witness, and is left out of the round trip.
    """
    sample = Sample.of(camera, grid)
    own, round_trip = _round_trip(camera, sample)
    if witness is None:
        return [round_trip]
    return [*findings_of(camera, sample, witness, own), round_trip]


def _round_trip(camera: CameraRays, sample: Sample) -> tuple[tuple[Any, Any], Finding]:
    """Go from pixels along their rays to points and back; return the float64 bounds too, in pixels and radians.

    A point that several pixels see may come back to another one: where the ray of that one meets it, it is left out.
    """
    keep = sample.valid & ~_seen_elsewhere(camera, sample)
    pixels, points, directions = sample.pixels[keep], sample.points[keep], sample.directions[keep]
    back = camera.project(points)
    again = camera.rays_at(back[:, 0], back[:, 1]).directions
    moved = _moved(sample)[keep]
    bound = np.zeros(len(points))
    for side in np.eye(3):
        step = (ENLARGED * moved)[:, None] * side
        slips = [length_of(camera.project(points + near) - back) for near in (step, -step)]
        bound += np.fmax(*slips) / ENLARGED  # at the picture's rim one of the two has no pixel
    steps = STEP * np.concatenate((np.eye(2), -np.eye(2)))
    turns = [angles_between(camera.rays_at(*(pixels + step).T).directions, directions) for step in steps]
    turned = np.fmax.reduce(turns) / STEP * bound + gamma(32)
    own = largest(bound), largest(turned)
    return own, finding("round trip", back - pixels, angles_between(again, directions), bound, turned, (0.0, 0.0))


def _seen_elsewhere(camera: CameraRays, sample: Sample):
    """Return which points come back to another pixel whose ray meets them too."""
    back = camera.project(sample.points)
    rays = camera.rays_at(back[:, 0], back[:, 1])
    beside = length_of(np.cross(sample.points - rays.origins, rays.directions))
    return (length_of(back - sample.pixels) > 1) & (beside <= ENLARGED * _moved(sample))


def _moved(sample: Sample):
    """Return how far rounding may move each point, (n,)."""
    return gamma(32) * (np.abs(sample.origins).sum(axis=1) + np.abs(sample.points).sum(axis=1))
