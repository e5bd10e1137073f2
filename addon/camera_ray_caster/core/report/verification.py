"""A camera's rays compared with references: errors in pixels and radians, and the bound of each reference.

The comparison uses a camera's public ``rays_at``, ``project``, ``raster`` and ``pose`` and the rounding that its model
reports; it uses no model's formula. Blender's own answers are the references of ``report.witness``. The round trip
needs no reference. Its bound is our own float64 rounding, so it is added to every other bound. It is the sum of

* the change of the pixel if the point moves by 32 EPS (|eye| + |origin| + |point| + ``formula_reach``),
* the model's rounding of a pixel, there and back,
* the rounding of the pixel itself.
"""

from typing import Any

import numpy as np

from ..conventions import gamma
from ..records import Finding
from .sample import CameraRays, Sample, angles_between, finding, largest, length_of
from .witness import Witness, findings_of

GRID_PIXELS = 9
"""Number of pixels per side at which rays are compared, spread evenly from edge to edge of the window."""

RAY_SPACING = 2.0**-4
"""Distance in pixels between neighboring rays, whose angle converts an error in pixels to radians."""

ENLARGED = 2.0**15
"""Factor by which a point's rounding is enlarged to measure the effect of the rounding on its pixel."""

MOVES = ENLARGED, 2.0**5
"""Both factors are used. The second one is for pixels that change so fast that the first leaves the linear range."""

PART = 0.38
"""Fraction of the way to another pixel with the same point. At a simple fraction, rays might be a full turn apart."""


def verify(camera: CameraRays, witness: Witness | None = None, grid: int = GRID_PIXELS) -> list[Finding]:
    """Return one finding per reference on the camera's rays, at ``grid`` x ``grid`` pixels of the render window.

    ``witness`` has Blender's answers, or is None if Blender has none. The round trip needs no reference.
    Errors in radians are angles between directions in the world; errors in pixels are distances to the place in the
    frame where the reference sees the ray. A pixel without a ray fails (NaN) if there is a reference, and is left out
    of the round trip.
    """
    sample = Sample.of(camera, grid)
    margin, round_trip = _round_trip(camera, sample)
    if witness is None:
        return [round_trip]
    return [*findings_of(camera, sample, witness, margin), round_trip]


def _round_trip(camera: CameraRays, sample: Sample) -> tuple[tuple[Any, Any], Finding]:
    """Go from pixels along their rays to points and back; return the float64 bounds (pixels, radians) and the finding.

    A point that several pixels see may come back to another pixel. It is left out if that pixel's ray meets it.
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
        bound += np.fmax.reduce(slips)  # at the picture's rim some points have no pixel
    steps = RAY_SPACING * np.concatenate((np.eye(2), -np.eye(2)))
    turns = [angles_between(camera.rays_at(*(pixels + step).T).directions, directions) for step in steps]
    turned = np.fmax.reduce(turns) / RAY_SPACING * bound + gamma(32)
    near = ENLARGED * moved + sample.distance * np.nan_to_num(turned)
    turned[np.isnan(turned)] = np.pi  # no neighbor has a ray: only the error in pixels counts
    margin = largest(bound), largest(turned)
    keep = ~_seen_elsewhere(camera, pixels, points, back, near)
    errors, angles = (back - pixels)[keep], angles_between(again, directions)[keep]
    return margin, finding("round trip", errors, angles, bound[keep], turned[keep], (0.0, 0.0))


def _seen_elsewhere(camera: CameraRays, pixels, points, back, near):
    """Return which points come back to another pixel whose ray meets them too, within ``near``, (n,) bool.

    The other pixel is more than one pixel away, or a ray between the two pixels misses the point.
    """

    def is_met(share: float):
        rays = camera.rays_at(*(pixels + share * (back - pixels)).T)
        return length_of(np.cross(points - rays.origins, rays.directions)) <= near

    return is_met(1.0) & ((length_of(back - pixels) > 1) | ~is_met(PART))


def _moved(camera: CameraRays, sample: Sample):
    """Return the distance by which rounding may move each point, (n,)."""
    places = camera.pose.eye[None], sample.origins, sample.points
    return gamma(32) * (sum(np.abs(position).sum(axis=1) for position in places) + camera.formula_reach)
