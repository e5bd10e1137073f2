"""The twisted orthographic camera: parallel rays in each of a family of parallel planes, whose direction turns.

The planes stand across an axis, a slit object of the scene as it is seen in the picture. In the plane through the
object's point the rays look along -Z; ``twist`` is what their slope across the axis grows by over one unit along it.
No two rays of different planes are parallel, and no two rays meet: both slits are at infinity, in one.
With twist 0 it is the orthographic camera. Rays start on z = 0, whose frame is Blender's ORTHO frame.
Singular: nowhere.
Reference: J. Yu and L. McMillan, General Linear Cameras, ECCV 2004, of which this is one kind.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import BlenderCamera, Raster
from .general_linear import GeneralLinear
from .model import Step
from .orthographic import Orthographic
from .parts.film import ORTHO_SCALE, check_slope
from .parts.lines import SLIT, image_axes, slit_from
from .parts.settings import Number

TWIST = Number(
    "twist", "Twist", "How much steeper rays become across the axis over one unit along it; 0 is orthographic", 0.1
)


@dataclass(frozen=True)
class TwistedOrthographic(GeneralLinear):
    """The general linear camera of the rays at three corners of the orthographic frame."""

    key = "TWISTED_ORTHOGRAPHIC"
    label = "Twisted Orthographic"
    description = "Parallel rays whose direction turns along an axis"
    number = 14
    by_polynomials = True
    SETTINGS = (SLIT, TWIST, *Orthographic.SETTINGS)
    FORMULA = (
        Step("Origin, the pixel on the orthographic frame", "o = X u + Y v"),
        Step("Slope across the axis, l along it and n across", "m = twist (o - point) . l"),
        Step("Direction", "d = m n + w"),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> TwistedOrthographic:
        """Build it from ortho_scale, shift, the axis slit_1 and twist; InputError for what has no meaning."""
        window = Orthographic.from_blender(raw, raster).window
        point, direction = slit_from(raw)
        along, across = image_axes(raw, direction)
        corners = np.array(((0, 0), (raster.width, 0), (0, raster.height)), np.float64)
        places = np.stack(window.plane_from_pixels(*corners.T), axis=-1)
        slopes = TWIST.read(raw) * ((places - point[:2]) @ along[:2])
        check_slope(raw, float(np.abs(slopes).max()), (TWIST, ORTHO_SCALE))
        ends = places + slopes[:, None] * across[:2]
        return cls(raster.size, np.concatenate((places, ends), axis=1))
