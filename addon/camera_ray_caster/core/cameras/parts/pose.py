"""The pose of a camera, as Blender takes it from an evaluated world matrix."""

from __future__ import annotations

import numpy as np

from ...records import BlenderCamera, InputError, Pose


def pose_from(raw: BlenderCamera) -> Pose:
    """Return the pose of an evaluated world matrix, as Blender takes it: each axis is normalized separately.

    Scale is ignored, a negative scale mirrors, shear stays. Each component is right to gamma(4).
    Raises InputError for a matrix that is not finite, has an axis of length zero, or has its axes in one plane.
    """
    matrix = np.asarray(raw.matrix_world, dtype=np.float64)
    if not np.isfinite(matrix).all():
        raise InputError(f"the matrix of camera {raw.name!r} is not finite: clear its transform or its constraints")
    axes = matrix[:3, :3]
    largest = np.abs(axes).max(axis=0)
    if not (largest > 0).all():
        raise InputError(f"camera {raw.name!r} has a scale of zero: apply or clear its scale (Alt S)")
    axes = axes / largest
    axes = axes / np.sqrt((axes * axes).sum(axis=0))
    if abs(np.linalg.det(axes)) < np.finfo(np.float32).eps:
        raise InputError(f"the axes of camera {raw.name!r} lie in one plane: clear its scale, or its parents' (Alt S)")
    return Pose(eye=matrix[:3, 3].copy(), basis=axes)
