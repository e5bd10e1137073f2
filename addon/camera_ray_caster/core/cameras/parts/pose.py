"""The pose of a camera: as Blender takes it from an evaluated matrix, and the check of matrices from elsewhere."""

import numpy as np

from ...arguments import numbers, shape_of
from ...records import BlenderCamera, InputError, Pose

SHEARED = 1e-5
"""Largest cosine between two axes that counts as rounding: float32 causes a hundredth of it."""


def flaw_of(matrix: np.ndarray, world_to_camera: bool = False) -> str | None:
    """Return what is wrong with a finite matrix, (4, 4) or (3, 4), as the pose of a camera; None if nothing is.

    Axes may be of any length above 0, as scales of Blender. They are the columns of a pose, and up to their lengths the
    rows of a matrix from the world to the camera.
    """
    axes = matrix[:3, :3].T if world_to_camera else matrix[:3, :3]
    largest = np.abs(axes).max(axis=0)
    if not largest.all():
        return "has a scale of zero: an axis has no length"
    last_row = flaw_of_last_row(matrix)
    if last_row is not None:
        return last_row
    axes = axes / largest
    axes = axes / np.linalg.norm(axes, axis=0)
    cosines = axes.T @ axes - np.eye(3)
    if np.abs(cosines).max() > SHEARED:
        return f"is sheared: the cosine between two axes is {np.abs(cosines).max():.2g}; give a rotation"
    if np.linalg.det(axes) < 0:
        return "is mirrored, with left-handed axes: change the sign of one axis"
    return None


def flaw_of_last_row(matrix: np.ndarray) -> str | None:
    """Return what is wrong with the last row of a matrix, (4, 4), or (3, 4), which has none."""
    if len(matrix) == 3 or np.allclose(matrix[3], (0.0, 0.0, 0.0, 1.0), rtol=0, atol=1e-6):
        return None
    if matrix[3, :3].any() and not matrix[:3, 3].any():
        return "is transposed, with its translation in the last row: give its transpose, matrix.T"
    return f"has the last row {', '.join(f'{number:g}' for number in matrix[3])}: it must be 0, 0, 0, 1"


def pose_matrix(pose, name: str = "pose", world_to_camera: bool = False) -> np.ndarray:
    """Return a pose as (4, 4) float64; None is the identity. Raises InputError for what is none: see ``flaw_of``."""
    if pose is None:
        return np.eye(4)
    matrix = numbers(pose, name)
    if matrix.shape not in ((4, 4), (3, 4)) or not np.isfinite(matrix).all():
        raise InputError(f"{name} is {shape_of(matrix)}: it must be (4, 4) or (3, 4) finite numbers")
    flaw = flaw_of(matrix, world_to_camera)
    if flaw:
        raise InputError(f"{name} {flaw}")
    return np.vstack((matrix[:3], (0.0, 0.0, 0.0, 1.0)))


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
