"""The rays of a scanner that moves while it sweeps: each beam leaves from where the scanner is when it fires."""

from dataclasses import replace
from typing import Any

import numpy as np

from ..maths.vector import norm
from ..records import InputError, Rays
from .evaluation import rays_through
from .pixel_coordinates import in_blocks
from .times import SweepTime

RAYS_AT_ONCE = 1 << 14
"""Number of rays computed at once."""


def rays_in_sweep(camera: Any, time: SweepTime, x, y, shape: tuple[int, ...]) -> Rays:
    """Return the world rays at pixel coordinates that broadcast to a shape, each at its own time; see
    ``Camera.rays_at``. Raises InputError for a scanner whose settings change during the sweep.
    """
    frames = np.clip(time.frame_at(x, y), *time.span)
    motion = camera.motion
    if motion is None:
        return replace(rays_through(camera, x, y, shape), time=np.broadcast_to(frames, shape))
    x, y, each = (np.broadcast_to(array, shape).reshape(-1) for array in (x, y, frames))
    origins, directions = np.empty((2, len(each), 3))

    def put(block: slice) -> None:
        poses = motion.poses_at(np.nan_to_num(each[block]))
        if poses is None:
            raise InputError(f"settings of camera {camera.name!r} change during the sweep: remove their keyframes")
        with np.errstate(all="ignore"):  # NaN means no ray
            eyes, bases = poses
            origin, direction = camera.model.rays(x[block], y[block])
            ahead = _turned(bases, direction)
            ahead /= norm(ahead.T)[:, None]
            ahead[np.isnan(each[block])] = np.nan
            directions[block], origins[block] = ahead, eyes + _turned(bases, origin)

    in_blocks(put, (len(each), 1), RAYS_AT_ONCE)
    lost = ~np.isfinite(directions).all(axis=-1)
    directions[lost] = np.nan
    origins, directions = (vectors.reshape(*shape, 3) for vectors in (origins, directions))
    return Rays(origins, directions, ~lost.reshape(shape), each.reshape(shape))


def _turned(bases: np.ndarray, vector) -> np.ndarray:
    """Return vectors in the world, (n, 3), given their components in the frames of bases, (n, 3, 3)."""
    parts = (bases[..., axis] * np.asarray(component)[..., None] for axis, component in enumerate(vector))
    return sum(parts, start=np.zeros(()))
