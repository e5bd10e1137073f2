"""An aperture whose rays are traced through glass: how far they come from the chief rays, measured for some pixels."""

from dataclasses import dataclass
from functools import reduce

import numpy as np

from ...maths.vector import norm
from .aperture import Aperture

GROWTH = 1.25
"""What the largest measured values are multiplied by: a step of a lens's grid at the rim changes third-order
aberrations by 1.15.
"""


@dataclass(frozen=True)
class TracedAperture(Aperture):
    """An aperture with the blur of some chief rays, in Blender units."""

    apart: tuple[float, ...] = ()
    """Largest distance of a ray's line from the origin of its chief ray."""
    sharp: tuple[float, ...] = ()
    """One over the distance along them at which their rays come together, or 0 or less if they spread."""
    spread: tuple[float, ...] = ()
    """Largest distance of a ray from the chief ray there, over that distance."""
    angles: tuple[float, ...] = ()
    """Angles of these chief rays from the axis, in radians, ascending; empty if they do not tell them apart."""
    reach: float = 0.0
    """Largest distance from the eye at which rays begin."""

    def blur(self, centers, radii, planar: bool):
        """See Aperture. At a distance s of a chief ray that is sharp at D another ray of the pixel is at most
        apart |1 - s / D| + spread s away: it is a line.
        """
        distance = np.sqrt((centers * centers).sum(axis=1))
        near, far = np.maximum(distance - radii - self.reach, 0.0), distance + radii + self.reach
        blurs = (
            apart * np.maximum(1 - (near if sharp > 0 else far) * sharp, far * sharp - 1) + far * spread
            for apart, sharp, spread in zip(self.apart, self.sharp, self.spread, strict=True)
        )
        if not self.angles:  # 289 of them behind a port: one at a time, as all would take 7 kB a ball
            return reduce(np.maximum, blurs)
        blur = np.stack(list(blurs), axis=1)
        worst = blur.max(axis=1)
        around = (radii + worst + self.reach) / distance
        angle = np.arccos(-centers[:, 2] / distance)
        half = np.where(around < 1, np.arcsin(np.minimum(around, 1)), np.pi)
        first = np.searchsorted(self.angles, angle - half) - 1
        last = np.maximum(np.searchsorted(self.angles, angle + half, "right"), first)
        index = np.arange(len(self.apart))
        last, first = np.minimum(last, index[-1])[:, None], np.minimum(first, index[-1])[:, None]
        return np.where((first <= index) & (index <= last), blur, 0.0).max(axis=1)


def lines(chief, origin, direction, passes):
    """Return ``apart``, ``sharp`` and ``spread`` of n chief rays, (n,) each; their rays are (n, ...).

    chief: origin and direction, each three arrays that broadcast to the rays. passes: which rays there are.
    """
    off = tuple(o - c for o, c in zip(origin, chief[0], strict=True))
    way = sum(o * d for o, d in zip(off, direction, strict=True))
    lines = np.where(passes, [o - way * d for o, d in zip(off, direction, strict=True)], 0.0)
    turned = np.where(passes, [d - u for d, u in zip(direction, chief[1], strict=True)], 0.0)
    others = tuple(axis for axis in range(lines.ndim) if axis != 1)
    total = (lines * lines).sum(axis=others)
    sharp = -(lines * turned).sum(axis=others) / np.where(total > 0, total, 1.0)
    beside = turned + lines * sharp.reshape(-1, *(1 for _ in others[1:]))
    apart, spread = (GROWTH * norm(each).max(axis=tuple(axis - 1 for axis in others[1:])) for each in (lines, beside))
    return apart, sharp, spread
