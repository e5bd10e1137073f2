"""Forward error bounds of hits: how far, at most, t, the position and the normal are from the exact picture's.

Exact means: in real numbers, from the camera's and the shapes' numbers as they are stored. The bounds do not follow
the kernels' steps. They put the t that was found back into the shape's equation: its residual there, plus what rounding
may do to the residual, over the slope of the equation bounds the distance to the exact root, whichever way t was
computed. They hold for a root before and behind, from inside and outside, at a tangent as far as there is a hit at all.
What a shape's equation is, its kind says: see ``ShapeErrors``.
References: pbrt, section 6.8 (bounds beside the values); N. Higham, Accuracy and Stability of Numerical Algorithms, 2nd
ed., chapters 1 and 3; S. Rump, Verification Methods, Acta Numerica 19 (2010), section 2 (a residual bounds a root).
"""

from __future__ import annotations

import numpy as np

from ..camera.camera import Camera
from ..conventions import EPS, gamma
from ..maths.speed import lazy
from ..maths.vector import along, difference, norm
from ..shapes.frames import InCamera, WorldRays
from ..shapes.kind import HitPixels, Kind
from ..shapes.kinds import by_kind
from .rays import world_rays


class HitErrors:
    """The error bounds of pixels whose chief rays hit shapes of one kind; (m,) arrays over them.

    ``unit``: whether normals that come from constants keep the length they come with.
    """

    def __init__(self, camera: Camera, shapes: InCamera, kind: Kind, pixels: HitPixels, rays: WorldRays, unit: bool):
        self.t, self.rays, self._eye = pixels.t, rays, camera.pose.eye
        self._shape = kind.errors(shapes, pixels, rays, camera.model.central, unit)

    @lazy
    def t_error(self) -> np.ndarray:
        """Of t, the depth that Blender's pass shows; inf where nothing is known."""
        return np.fmin(self._shape.t, np.inf) + EPS * np.abs(self.t)

    @lazy
    def distance(self) -> np.ndarray:
        """Of the distance along the ray; bounds depth, too, since directions are not shorter than 1."""
        rays = self.rays
        return self.t_error * rays.length + np.abs(self.t) * (rays.direction_error + gamma(4) * rays.length)

    @lazy
    def point(self) -> np.ndarray:
        """Of the hit point relative to the eye, as a vector's length."""
        return self.distance + self.rays.origin_error + gamma(4) * norm(self.rays.origin)

    @lazy
    def far(self) -> np.ndarray:
        """How far the hit point is from the world's origin."""
        return norm(difference(along(self.rays.origin, self.rays.direction, self.t), -self._eye))

    @lazy
    def position(self) -> np.ndarray:
        """Of the hit point in the world, as a vector's length."""
        return self.point + EPS * self.far

    @lazy
    def normal(self) -> np.ndarray:
        """Of the unit normal, as a vector's length; 2 where nothing is known."""
        return np.fmin(self._shape.normal(self.point) + gamma(8), 2.0)


def decision(camera: Camera, shapes: InCamera, at: int, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return what decides whether rays at pixel coordinates x, y hit one shape, and the bound below which it is open.

    Positive on a hit, negative on a miss where the value is beyond the bound. For a sphere the discriminant, for a
    plane by how much the crossing is inside of its edges, for an infinite one how steep the ray is.
    """
    ((kind, _),) = by_kind(shapes.shapes.kind[[at]])
    with np.errstate(all="ignore"):
        rays = world_rays(camera, x, y)
        which = np.full(np.broadcast_shapes(np.shape(x), np.shape(y)), at)
        return kind.decision(shapes, which, rays, camera.model.central)
