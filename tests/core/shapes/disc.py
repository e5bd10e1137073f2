"""A toy kind of shape, in one file: the disc q_z = 0, |q| <= 1, tested as spheres are, by a row of constants."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from camera_ray_caster.core.conventions import gamma
from camera_ray_caster.core.maths.vector import difference, matvec
from camera_ray_caster.core.shapes.affine import AffineKind


@dataclass(frozen=True)
class Constants:
    """Discs as the eye sees them; the last axis counts the discs."""

    matrix: np.ndarray
    center: np.ndarray
    offset: np.ndarray


class DiscKind(AffineKind):
    """Discs and, by an affine matrix, ellipses."""

    number = 7
    name = "disc"
    faces_eye = True

    def extent(self, shapes, at, axes):
        """Not farther than both axes together."""
        return np.sqrt((axes[:, :2] ** 2).sum(axis=(1, 2))), np.abs(axes[:, :2, 2]).sum(axis=1)

    def is_close(self, offset, shape_from_world, away):
        """No digit is computed twice."""
        return np.zeros(len(offset), bool)

    def constants(self, shapes, at, parallel):
        """The matrix, and where the center is from the eye in both frames."""
        return Constants(shapes.shape_from_camera[at].transpose(1, 2, 0), shapes.center[at].T, shapes.offset[at].T)

    def intersect(self, constants, origin, direction, start, scratch):
        """t = N_z / D_z, inside where |t D - N| <= 1."""
        d = matvec(constants.matrix, direction)
        n = constants.offset
        if origin is not None:
            n = matvec(constants.matrix, difference(constants.center, origin))
        t = n[2] / d[2]
        inside = (t * d[0] - n[0]) ** 2 + (t * d[1] - n[1]) ** 2 <= 1
        return t, inside & (t >= (start or 0.0)) & (t < np.inf)

    def normals(self, shapes, at):
        """The third row of the inverse axes, towards the eye."""
        normal = shapes.shape_from_world[at, 2] * -np.sign(shapes.offset[at, 2:])
        return np.hstack((np.zeros((len(at), 1)), normal / np.linalg.norm(normal, axis=1, keepdims=True))), None

    def surface_coordinates(self, q):
        """Half of the diameter is 1/2."""
        return (q[0] + 1) / 2, (q[1] + 1) / 2

    def root_error(self, hits):
        """The residual over the slope."""
        (d, n, d_error, n_error), tau = hits.local.z(), np.abs(hits.tau)
        residual = np.abs(hits.tau * d - n) + tau * d_error + n_error
        residual = residual + gamma(2) * (tau * np.abs(d) + np.abs(n))
        return residual / (np.abs(d) - d_error)

    def normal_error(self, hits, point):
        """A constant's."""
        return hits.local.frame.rounding


DISCS = DiscKind()
