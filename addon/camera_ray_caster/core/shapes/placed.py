"""Shapes as one camera sees them: the constants that every ray meets, computed once a shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import Pose, Shapes


@dataclass(frozen=True)
class Placed:
    """Shapes in the camera's frame. A ray o + t d there is, in a shape's own frame, q(t) = t D - N with
    D = shape_from_camera d and N = shape_from_camera (centre - o).

    The eye's relative position is taken before anything is scaled, and for rays from the eye (o = 0) all products of
    N are constants of the shape: the cross product N x D = cross_from_camera d keeps the digits that the textbook
    discriminant (N.D)^2 - |D|^2 (|N|^2 - 1) loses by subtraction.
    Reference: E. Haines et al., Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems (2019), chapter 7.
    """

    centre: np.ndarray
    """(n, 3) camera frame."""
    axes: np.ndarray
    """(n, 3, 3) camera frame."""
    shape_from_camera: np.ndarray
    """(n, 3, 3)."""
    offset: np.ndarray
    """(n, 3): N for rays from the eye."""
    cross_from_camera: np.ndarray
    """(n, 3, 3): d to N x D, for rays from the eye."""
    along_from_camera: np.ndarray
    """(n, 3): d to N . D, for rays from the eye."""
    outside: np.ndarray
    """(n,): |N|^2 - 1, positive where the eye is outside the unit sphere."""
    radius: np.ndarray
    """(n,): of the bounding sphere in the camera frame; inf for infinite planes (the caller sets it)."""

    def take(self, k) -> Placed:
        """Return the constants of one shape, or with an array of rows of one shape a ray."""
        return Placed(*(getattr(self, name)[k] for name in self.__dataclass_fields__))


def place(shapes: Shapes, pose: Pose) -> Placed:
    """Return the shapes as a camera at this pose sees them.

    Rounding: a component of ``centre`` is right to gamma(5) of |centre - eye|; ``shape_from_camera`` to a few EPS
    times the condition number of the shape's axes.
    """
    camera_from_world = np.linalg.inv(pose.basis)
    centre = (shapes.centre - pose.eye) @ camera_from_world.T
    axes = camera_from_world @ shapes.axes
    shape_from_camera = np.linalg.inv(axes)
    offset = (shape_from_camera @ centre[..., None])[..., 0]
    distance = np.sqrt((offset * offset).sum(axis=-1))
    return Placed(
        centre=centre,
        axes=axes,
        shape_from_camera=shape_from_camera,
        offset=offset,
        cross_from_camera=np.cross(offset[:, None, :], shape_from_camera.transpose(0, 2, 1)).transpose(0, 2, 1),
        along_from_camera=(offset[:, None, :] @ shape_from_camera)[:, 0],
        outside=(distance - 1) * (distance + 1),
        radius=np.sqrt((axes * axes).sum(axis=(1, 2))),
    )
