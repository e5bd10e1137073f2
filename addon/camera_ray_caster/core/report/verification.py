"""A camera's rays compared with witnesses: errors in pixels and radians, beside the bound that each witness can reach.

It knows a camera by its public ``rays_at``, ``project``, ``raster`` and ``pose`` and by what its model says of its
rounding, and no model's formula. Blender's own answers are the witnesses of ``report.witness``; the round trip needs
none:

round trip             float64: what moving the point by 32 EPS (|eye| + |origin| + |point| + what else the formula has)
                       does to its pixel, what the model rounds away of a pixel, there and back, and the rounding of the
                       pixel itself. It is our own rounding, so it is added to every other bound.
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

MOVES = ENLARGED, 2.0**5
"""The second where pixels turn so fast that the first would leave what is straight."""

PART = 0.38
"""Of the way to another pixel that sees a point: no simple fraction, or rays might have turned all the way round."""


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
    valid = sample.valid
    pixels, points, directions = sample.pixels[valid], sample.points[valid], sample.directions[valid]
    back = camera.project(points)
    again = camera.rays_at(back[:, 0], back[:, 1]).directions
    moved = _moved(camera, sample)[valid]
    bound = 2 * np.hypot(*camera.pixel_rounding(*pixels.T)) + gamma(4) * length_of(pixels)
    for side in np.eye(3):
        slips = []
        for times in MOVES:
            step = (times * moved)[:, None] * side
            slips += [length_of(camera.project(points + near) - back) / times for near in (step, -step)]
        bound += np.fmax.reduce(slips)  # at the picture's rim some have no pixel
    steps = STEP * np.concatenate((np.eye(2), -np.eye(2)))
    turns = [angles_between(camera.rays_at(*(pixels + step).T).directions, directions) for step in steps]
    turned = np.fmax.reduce(turns) / STEP * bound + gamma(32)
    near = ENLARGED * moved + sample.distance * np.nan_to_num(turned)
    turned[np.isnan(turned)] = np.pi  # no neighbor has a ray: the error in pixels says it all
    own = largest(bound), largest(turned)
    keep = ~_seen_elsewhere(camera, pixels, points, back, near)
    errors, angles = (back - pixels)[keep], angles_between(again, directions)[keep]
    return own, finding("round trip", errors, angles, bound[keep], turned[keep], (0.0, 0.0))


def _seen_elsewhere(camera: CameraRays, pixels, points, back, near):
    """Return which points come back to another pixel whose ray comes as near to them: farther than the next pixel, or
    with rays between them that do not.
    """

    def is_met(part: float):
        rays = camera.rays_at(*(pixels + part * (back - pixels)).T)
        return length_of(np.cross(points - rays.origins, rays.directions)) <= near

    return is_met(1.0) & ((length_of(back - pixels) > 1) | ~is_met(PART))


def _moved(camera: CameraRays, sample: Sample):
    """Return how far rounding may move each point, (n,)."""
    places = camera.pose.eye[None], sample.origins, sample.points
    return gamma(32) * (sum(np.abs(place).sum(axis=1) for place in places) + camera.formula_reach)
