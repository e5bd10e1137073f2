"""Poses in files: where a camera of a file stands, in which frame or at which time.

A pose is the matrix (4, 4) float64 from the camera's frame, x right, y down, z ahead as in OpenCV, to the file's: the
world of a reconstruction, or the body of a rig. Lengths are in the file's unit.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ...conventions import FROM_BLENDER as FROM_BLENDER  # programs take it from here
from ...maths.rotations import from_quaternion, rotation, transform
from ...text_forms.content import flat
from .fields import Fields
from .lens import numbers_of
from .source import FileSource

SHORTEST = 1e-100
"""Quaternions that are shorter are 0: their squares underflow."""

NOT_TURNED = 1e-3
"""Largest departure of a rotation's products of columns from those of a rotation: files have from 4 digits on."""


class Rolling(NamedTuple):
    """A rolling shutter, from the first row or column that is read to the last."""

    readout: str
    """Order in which they are read: TOP_TO_BOTTOM, BOTTOM_TO_TOP, LEFT_TO_RIGHT or RIGHT_TO_LEFT."""
    offsets: tuple[float, float]
    """Times of the first and the last one, in seconds from that of the frame."""
    pose: np.ndarray
    """(4, 4): the pose at the last one."""


class Placed(NamedTuple):
    """A camera at a place."""

    camera: str
    """Name of its lens in the file; see ``Lens``."""
    image: str
    """Name of its picture without folders and ending, or "" of a camera that stands still in a rig."""
    frame: float | None
    """Frame, if the file tells it."""
    pose: np.ndarray
    time: float | None = None
    """Seconds, if the file tells them."""
    moves: bool = False
    """Whether it is of a trajectory with frames; one with times has these."""
    rolling: Rolling | None = None
    """Of a rolling shutter, whose ``pose`` is that of the first row that is read."""

    def changed(self, change: Callable[[np.ndarray], np.ndarray]) -> Placed:
        """Return the camera with other poses, as a function of each."""
        rolling = None if self.rolling is None else self.rolling._replace(pose=change(self.rolling.pose))
        return self._replace(pose=change(self.pose), rolling=rolling)


def pose_of(document: FileSource, value, name: str) -> np.ndarray:
    """Return the pose that a file has as a matrix of 3 or 4 rows, flat or not. Raises InputError, with ``name``."""
    numbers = numbers_of(flat(value, name, document.path))
    if len(numbers) not in (12, 16):
        raise document.refusal(f"{name} has {len(numbers)} numbers: a pose has 3 or 4 rows of 4 finite numbers")
    document.numbers(numbers, name)
    if numbers[12:] not in ([], [0.0, 0.0, 0.0, 1.0]):
        last = " ".join(f"{number:g}" for number in numbers[12:])
        raise document.refusal(f"the last row of {name} is {last}: it must be 0 0 0 1, of a matrix by rows")
    rows = np.reshape(numbers, (-1, 4))
    return checked(document, transform(rows[:3, :3], rows[:3, 3]), name)


def pose_in(entries: Fields, name: str) -> np.ndarray:
    """Return the pose that an entry has as a matrix of 3 or 4 rows, flat or not. Raises InputError."""
    if not entries.has(name):
        raise entries.document.refusal(f"it has no {entries.said(name)}")
    return pose_of(entries.document, entries.values[name], entries.said(name))


def of_quaternion(document: FileSource, quaternion, translation, name: str) -> np.ndarray:
    """Return the pose of a quaternion w, x, y, z, of any length, and a translation. Raises InputError, with a name."""
    w, x, y, z = document.numbers(quaternion, f"rotation of {name}", 4)
    if max(map(abs, (w, x, y, z))) < SHORTEST:
        raise document.refusal(f"the rotation of {name} is 0: it must be a quaternion")
    return transform(from_quaternion((w, x, y, z)), document.numbers(translation, f"translation of {name}", 3))


def of_rotation(document: FileSource, turn, translation, name: str) -> np.ndarray:
    """Return the pose of a rotation, as a vector or as 9 numbers by rows, and a translation. Raises InputError, with a
    name, for what is no rotation.
    """
    axes = rotation(np.array([turn]))[0] if np.size(turn) == 3 else np.reshape(turn, (3, 3))
    return checked(document, transform(axes, translation), name)


def of_camera(document: FileSource, turn, center, name: str) -> np.ndarray:
    """Return the pose of a rotation by rows, 9 numbers, from the world to the camera, and the camera's place. Raises
    InputError, with a name.
    """
    rows = np.reshape(document.numbers(turn, f"rotation of {name}", 9), (3, 3))
    return of_rotation(document, rows.T, document.numbers(center, f"center of {name}", 3), f"rotation of {name}")


def checked(document: FileSource, pose: np.ndarray, name: str) -> np.ndarray:
    """Return the pose. Raises InputError unless its axes are those of a rotation, up to NOT_TURNED."""
    axes = pose[:3, :3]
    if np.abs(axes.T @ axes - np.eye(3)).max() > NOT_TURNED or np.linalg.det(axes) < 0:
        raise document.refusal(f"{name} is no rotation: its axes must be of length 1 and at right angles")
    return pose


def inverted(pose: np.ndarray) -> np.ndarray:
    """Return the inverse of a pose, with the transposed axes."""
    return transform(pose[:3, :3].T, -pose[:3, :3].T @ pose[:3, 3])
