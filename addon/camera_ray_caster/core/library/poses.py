"""Poses: the matrices from the frame of a camera, or of a mesh, to the world."""

from __future__ import annotations

import numpy as np

from ..arguments import numbers, shape_of, shown
from ..records import InputError


def look_at(eye, target, up=(0.0, 0.0, 1.0)) -> np.ndarray:
    """Return the pose, (4, 4) float64, of a camera at ``eye`` that looks at ``target``, with ``up`` upward in the
    picture. Raises InputError if they do not determine a direction.
    """
    eye, target, up = (_vector(value, name) for value, name in ((eye, "eye"), (target, "target"), (up, "up")))
    back = eye - target
    right = np.cross(up, back)
    if not np.linalg.norm(right) > 1e-12 * np.linalg.norm(up) * np.linalg.norm(back):
        raise InputError("eye, target and up lie on one line: give another up")
    upward = np.cross(back, right)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([axis / np.linalg.norm(axis) for axis in (right, upward, back)], axis=1)
    pose[:3, 3] = eye
    return pose


def pose_from_opencv(world_to_camera) -> np.ndarray:
    """Return the pose, (4, 4) float64, of a camera given by OpenCV's matrix from the world to x right, y down, z ahead:
    (3, 4) or (4, 4). It is the inverse of ``Camera.world_to_opencv``. Raises InputError for a matrix without inverse.
    """
    matrix = pose_matrix(world_to_camera, "world_to_camera")
    try:
        return np.linalg.inv(np.diag([1.0, -1.0, -1.0, 1.0]) @ matrix)
    except np.linalg.LinAlgError as error:
        raise InputError("world_to_camera has no inverse: give a rotation and a translation") from error


def pose_matrix(pose, name: str = "pose") -> np.ndarray:
    """Return a pose as (4, 4) float64; None is the identity."""
    if pose is None:
        return np.eye(4)
    matrix = numbers(pose, name)
    if matrix.shape not in ((4, 4), (3, 4)) or not np.isfinite(matrix).all():
        raise InputError(f"{name} is {shape_of(matrix)}: it must be (4, 4) or (3, 4) finite numbers")
    return np.vstack((matrix[:3], (0.0, 0.0, 0.0, 1.0)))


def _vector(value, name: str) -> np.ndarray:
    vector = numbers(value, name)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise InputError(f"{name} is {shown(value)}: it must be three finite numbers")
    return vector
