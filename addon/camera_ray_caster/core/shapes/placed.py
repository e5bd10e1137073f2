"""Shapes as one camera sees them: centre and axes in the camera's frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import INFINITE_PLANE, PLANE, Pose, Shapes


@dataclass(frozen=True)
class Placed:
    """Shapes in the camera's frame: a ray o + t d there is q(t) = t D - N in a shape's own frame, with
    D = shape_from_camera d and N = shape_from_camera (centre - o). The eye's relative position is taken first, in
    world coordinates, where float32 input makes the difference exact or nearly so; it is scaled afterwards.
    """

    centre: np.ndarray
    """(n, 3) camera frame."""
    shape_from_camera: np.ndarray
    """(n, 3, 3)."""
    radius: np.ndarray
    """(n,): of a sphere about the centre that holds the shape, camera frame; inf for infinite planes. A parallelogram's
    reaches its farther corners, an ellipsoid's has the root of the sum of the squared axes, which no skew exceeds."""


def place(shapes: Shapes, pose: Pose) -> Placed:
    """Return the shapes as a camera at this pose sees them.

    Rounding: a component of ``centre`` is right to gamma(4) of |centre - eye| times the condition number of the
    basis (1 without shear); ``shape_from_camera`` to a few EPS times the condition number of the shape's axes.
    """
    camera_from_world = np.linalg.inv(pose.basis)
    axes = camera_from_world @ shapes.axes
    squares = (axes * axes).sum(axis=1)
    corner = np.sqrt(squares[:, 0] + squares[:, 1] + 2 * np.abs((axes[..., 0] * axes[..., 1]).sum(axis=1)))
    radius = np.where(shapes.kind == PLANE, corner, np.sqrt(squares.sum(axis=1)))
    return Placed(
        centre=(shapes.centre - pose.eye) @ camera_from_world.T,
        shape_from_camera=inverse(shapes.axes) @ pose.basis,
        radius=np.where(shapes.kind == INFINITE_PLANE, np.inf, radius),
    )


def inverse(axes):
    """Return the inverses of (n, 3, 3) matrices; those that are diagonal are inverted exactly to rounding."""
    result = np.zeros_like(axes)
    diagonal = np.einsum("nii->ni", axes)
    straight = np.count_nonzero(axes, axis=(1, 2)) == 3
    straight &= (diagonal != 0).all(axis=1)
    np.einsum("nii->ni", result)[straight] = 1 / diagonal[straight]
    result[~straight] = np.linalg.inv(axes[~straight])
    return result
