"""The twisted orthographic camera: rays are parallel in each of many parallel planes, and turn from plane to plane.

The planes are perpendicular to an axis: the slit, an object of the scene, as seen in the picture. In the plane through
the object's point the rays look along -Z; ``twist`` is the growth of their slope across the axis per unit along it. No
two rays of different planes are parallel, and no two rays meet: both slits coincide at infinity.
With twist 0 it is the orthographic camera. Rays start on z = 0, in Blender's ORTHO frame.
Singular: nowhere.
Reference: J. Yu and L. McMillan, General Linear Cameras, ECCV 2004, which has this camera as one kind.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..maths.recording import array
from ..maths.recording.scalars import largest
from ..records import BlenderCamera, Raster
from .general_linear import STEEPEST, GeneralLinear
from .model import IN_RAYS, Step
from .orthographic import PLANE, Orthographic
from .parts.film import ORTHO_SCALE, check_slope
from .parts.lines import SLIT, image_axes, slit_from
from .parts.settings import Number

TWIST = Number(
    "twist", "Twist", "Change of the slope of the rays, across the axis, per unit along the axis; 0 is orthographic",
    0.1,
)  # fmt: skip


@dataclass(frozen=True)
class TwistedOrthographic(GeneralLinear):
    """A general linear camera, given by its rays at three corners of the orthographic frame."""

    axis: np.ndarray
    """On the camera's plane, a point of the axis and the directions along and across it, (3, 3)."""

    key = "TWISTED_ORTHOGRAPHIC"
    label = "Twisted Orthographic"
    description = "Parallel rays whose direction turns along an axis"
    number = 14
    polynomials = IN_RAYS
    SETTINGS = (SLIT, TWIST, *Orthographic.SETTINGS)
    FORMULA = (
        *PLANE,
        Step("Origin", "o = X u + Y v"),
        Step("Slope across the axis, which goes through s; l along it, n across", "m = twist ((o - s) . l)"),
        Step("Direction", "r = m n + w"),
    )

    def formula_values(self, x, y):
        """See Model: the axis."""
        return dict(zip("sln", self.axis, strict=True))

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> TwistedOrthographic:
        window = Orthographic.from_blender(raw, raster).window
        point, direction = slit_from(raw)
        along, across = image_axes(raw, direction)
        corners = (0.0, 0.0), (float(raster.width), 0.0), (0.0, float(raster.height))
        places = array([window.plane_from_pixels(*corner) for corner in corners])
        slopes = TWIST.read(raw) * ((places - point[:2]) @ along[:2])
        check_slope(raw, largest(*map(abs, slopes)), (TWIST, ORTHO_SCALE), STEEPEST)
        ends = places + slopes[:, None] * across[:2]
        axis = np.stack((point, along, across)) * (1.0, 1.0, 0.0)
        return cls(raster.size, np.concatenate((places, ends), axis=1), axis)
