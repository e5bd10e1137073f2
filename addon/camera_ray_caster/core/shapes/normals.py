"""Unit normals of many shapes at once: one table row a shape, looked up by each pixel's shape index.

The normal at a world point P is A^-T A^-1 (P - centre) for the sphere A and A^-T z for the plane A, as far as its
direction goes; both are gain (P - eye) + offset with constants of the shape. A last row of zeros serves the pixels
that hit nothing (index -1).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import SPHERE, Pose, Shapes
from ..vector import dot, matvec, rows
from .placed import inverse


@dataclass(frozen=True)
class NormalTable:
    """The constants of the normals, world frame, with a row of zeros at the end."""

    gain: np.ndarray
    """(n + 1,) where all spheres are round, else (n + 1, 3, 3)."""
    offset: np.ndarray
    """(3, n + 1): towards the eye for planes."""

    def look_up(self, index, point):
        """Return unit normals as components for shape indices and eye-relative world points of the same shape.

        Zero where index is -1. Outward on spheres, towards the eye on planes. Right to EPS (distance / radius).
        """
        gain = np.take(self.gain, index, axis=0)
        is_round = gain.ndim == index.ndim
        curved = (gain * component for component in point) if is_round else matvec(rows(gain), point)
        turned = tuple(c + np.take(o, index) for c, o in zip(curved, self.offset, strict=True))
        length = np.sqrt(dot(turned, turned))
        np.maximum(length, np.finfo(float).tiny, out=length)
        return tuple(component / length for component in turned)


def normal_table(shapes: Shapes, pose: Pose) -> NormalTable:
    """Return the table of these shapes as seen from a pose."""
    n = len(shapes)
    to_shape = inverse(shapes.axes)
    centre = shapes.centre - pose.eye
    sphere = shapes.kind == SPHERE
    plane_normal = to_shape[:, 2, :] * -np.sign((to_shape[:, 2, :] * centre).sum(axis=1, keepdims=True))
    gain = np.zeros((n + 1, 3, 3))
    gain[:n][sphere] = (np.swapaxes(to_shape, 1, 2) @ to_shape)[sphere]
    size = np.maximum(np.abs(gain).max(axis=(1, 2), keepdims=True), np.finfo(float).tiny)
    gain /= np.where(gain.any(axis=(1, 2), keepdims=True), size, 1.0)
    offset = np.zeros((n + 1, 3))
    offset[:n] = np.where(sphere[:, None], -(gain[:n] @ centre[..., None])[..., 0], plane_normal)
    round_gain = gain[:, 0, 0]
    if np.array_equal(gain, round_gain[:, None, None] * np.eye(3)):
        gain = round_gain
    return NormalTable(gain, np.ascontiguousarray(offset.T))

