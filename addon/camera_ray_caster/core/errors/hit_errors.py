"""Forward error bounds of hits: upper bounds of the errors of t, position and normal.

The exact picture is that of arithmetic with real numbers on the stored numbers of the camera and the shapes. The bounds
do not follow the steps of the kernels. They insert the computed t into the shape's equation: the residual there, plus
its own rounding error, divided by the slope of the equation bounds the distance to the exact root, however t was
computed. They hold for near and far roots, from inside and outside, and at a tangent as far as there is a hit at all.
Each kind of shape provides its own equation: see ``ShapeErrors``.
References: pbrt, section 6.8 (bounds next to values); N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd
ed., chapters 1 and 3; S. Rump, Verification Methods, Acta Numerica 19 (2010), section 2 (a residual bounds a root).
"""

from __future__ import annotations

import numpy as np

from ..conventions import EPS, gamma
from ..maths.speed import lazy
from ..maths.vector import along, difference, norm
from ..shapes.kind import HitPixels, Kind
from ..shapes.shape_frames import InCamera, WorldRays


class HitErrors:
    """The error bounds of the m pixels whose chief rays hit shapes of one kind, as (m,) arrays.

    ``unit``: whether normals from constants are used without being divided by their length.
    """

    def __init__(self, shapes: InCamera, kind: Kind, pixels: HitPixels, rays: WorldRays, unit: bool):
        self.t, self.rays, self._eye = pixels.t, rays, shapes.pose.eye
        self._shape = kind.errors(shapes, pixels, rays, pixels.from_eye, unit)

    @lazy
    def t_error(self) -> np.ndarray:
        """The bound of t, the depth in Blender's pass; inf where no bound is known."""
        return np.fmin(self._shape.t, np.inf) + EPS * np.abs(self.t)

    @lazy
    def distance(self) -> np.ndarray:
        """The bound of the distance along the ray, and of depth, since directions are not shorter than 1."""
        rays = self.rays
        return self.t_error * rays.length + np.abs(self.t) * (rays.direction_error + gamma(4) * rays.length)

    @lazy
    def point(self) -> np.ndarray:
        """The bound of the hit point relative to the eye, as a vector's length."""
        return self.distance + self.rays.origin_error + gamma(4) * norm(self.rays.origin)

    @lazy
    def far(self) -> np.ndarray:
        """Distance of the hit point from the world's origin."""
        return norm(difference(along(self.rays.origin, self.rays.direction, self.t), -self._eye))

    @lazy
    def position(self) -> np.ndarray:
        """The bound of the hit point in the world, as a vector's length."""
        return self.point + EPS * self.far

    @lazy
    def normal(self) -> np.ndarray:
        """The bound of the unit normal, as a vector's length; 2 where no bound is known."""
        return np.fmin(self._shape.normal(self.point) + gamma(8), 2.0)
