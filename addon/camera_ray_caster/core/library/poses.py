"""Poses: the matrices from the frame of a camera, or of a mesh, to the world."""

import numpy as np

from ..arguments import keywords, numbers, shown
from ..cameras.parts.pose import pose_matrix
from ..conventions import FROM_BLENDER
from ..maths.rotations import transform
from ..records import InputError


@keywords
def look_at(eye, target, *, up=(0.0, 0.0, 1.0)) -> np.ndarray:
    """Return the pose, (4, 4) float64, of a camera at ``eye`` that looks at ``target``, with ``up`` upward in the
    picture. Raises InputError if they do not determine a direction.
    """
    eye, target, up = (_vector(value, name) for value, name in ((eye, "eye"), (target, "target"), (up, "up")))
    back = eye - target
    if not back.any():
        raise InputError("eye and target are the same point: give another target")
    right = np.cross(up, back)
    if not np.linalg.norm(right) > 1e-12 * np.linalg.norm(up) * np.linalg.norm(back):
        raise InputError("eye, target and up lie on one line: give another up")
    upward = np.cross(back, right)
    return transform(np.stack([axis / np.linalg.norm(axis) for axis in (right, upward, back)], axis=1), eye)


def pose_from_opencv(world_to_camera) -> np.ndarray:
    """Return the pose, (4, 4) float64, of a camera given by OpenCV's matrix from the world to x right, y down, z ahead:
    (3, 4) or (4, 4). It is the inverse of ``Camera.opencv_from_world``. Raises InputError for a matrix that is
    transposed, mirrored, sheared beyond float32's rounding, or no pose for another reason, which it names.
    """
    matrix = pose_matrix(world_to_camera, "world_to_camera", world_to_camera=True)
    return np.linalg.inv(FROM_BLENDER @ matrix)


def _vector(value, name: str) -> np.ndarray:
    vector = numbers(value, name)
    if vector.shape != (3,) or not np.isfinite(vector).all():
        raise InputError(f"{name} is {shown(value)}: it must be three finite numbers")
    return vector
