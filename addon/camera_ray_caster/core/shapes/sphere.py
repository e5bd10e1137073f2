"""The sphere and the ellipsoid, |q| = 1: size, normals, uv and error bounds; ``sphere_rays`` intersects them.

The normal at P has the direction of P - center on a round sphere, and of A^-T q with q = A^-1 (P - center) on an
ellipsoid. The latter is computed in these two steps: the product A^-T A^-1 would square the ratio of the axes, whereas
an error of q along a short axis is an error along the normal, which does not change its direction.
"""

from typing import Any

import numpy as np

from ..conventions import EPS, gamma
from ..maths.speed import Scratch, merged, taken
from ..maths.vector import cross, difference, dot, matvec, norm, unit
from ..records import SPHERE, Shapes
from ..shape_records import KIND_NAMES
from . import sphere_rays
from .affine import AffineErrors, AffineKind
from .kind import HitPixels, PixelNormals
from .local_rays import LocalRays
from .shape_frames import InCamera


class Sphere(AffineKind):
    """Spheres and ellipsoids."""

    number = SPHERE
    name = KIND_NAMES[SPHERE]

    def extent(self, shapes: Shapes, at: np.ndarray, axes: np.ndarray):
        """See ``Kind``. The radius is the root of the largest absolute row sum of the axes' Gram matrix (Gershgorin):
        the length of the longest axis if the axes are orthogonal.
        """
        gram = np.abs(np.einsum("nij,nkj->nik", axes, axes))
        ahead = axes[..., 2]
        return np.sqrt(gram.sum(axis=2).max(axis=1)), np.sqrt(np.einsum("ni,ni->n", ahead, ahead))

    def half_sides(self, axes: np.ndarray) -> np.ndarray:
        return np.sqrt((axes * axes).sum(axis=2))

    def is_close(self, offset: np.ndarray, shape_from_world: np.ndarray, away: np.ndarray) -> np.ndarray:
        """See ``Kind``: |N|^2 - 1 cancels near the surface."""
        return np.sqrt((offset * offset).sum(axis=-1)) < sphere_rays.CLOSE

    def constants(self, shapes: InCamera, at: np.ndarray, parallel: Any) -> sphere_rays.SphereConstants:
        return sphere_rays.constants(shapes, at, parallel)

    def intersect(self, constants: sphere_rays.SphereConstants, origin, direction, start: Any, scratch: Scratch):
        """See ``AffineKind``. Rays from inside hit the far side."""
        return sphere_rays.intersect(constants, origin, direction, start, scratch)

    def lattice(self, constants: sphere_rays.SphereConstants, direction) -> sphere_rays.SphereLattice:
        return sphere_rays.SphereLattice(constants, direction)

    def normals(self, shapes: InCamera, at: np.ndarray) -> tuple[np.ndarray, PixelNormals | None]:
        """See ``Kind``; the normals point outwards. The constants of a round sphere are 1 / radius and the vector from
        its center to the eye, in radii.
        """
        is_round = shapes.is_scalar[at]
        gain = 1 / np.abs(np.where(is_round, shapes.shapes.axes[at, 0, 0], np.nan))[:, None]
        offset = (shapes.pose.eye - shapes.shapes.center[at]) * gain + 0.0  # never -0
        curved = at[~is_round]
        return np.hstack((gain, offset)), _curved(shapes, curved) if curved.size else None

    def surface_coordinates(self, q):
        """Return u = longitude / 2 pi + 1/2 and v = latitude / pi + 1/2, both 0 .. 1; u is undefined at the poles."""
        x, y, z = q
        return np.arctan2(y, x) / (2 * np.pi) + 0.5, np.arctan2(z, np.hypot(x, y)) / np.pi + 0.5

    def root_error(self, hits: AffineErrors) -> np.ndarray:
        """Return an error bound of tau as a root of |tau D - N|^2 = 1."""
        local, tau = hits.local, hits.tau
        a, q, span = dot(local.d, local.d), local.q(tau), np.abs(tau)
        d, length = np.sqrt(a), norm(q)
        a_error = (2 * d + local.d_error) * local.d_error + gamma(4) * a
        q_error = span * local.d_error + local.n_error + gamma(2) * (span * d + local.offset.length)
        residual = np.abs((length - 1) * (length + 1)) + (2 * length + q_error) * q_error
        residual += gamma(6) * (length * length + 1)
        if (known := outside(hits.shapes, local)) is not None:
            (c, c_rest), b, b_error = known, local.inner, local.product_error()
            terms = a * tau * tau + 2 * np.abs(b * tau) + np.abs(c)
            near = np.abs((a * tau - 2 * b) * tau + c) + gamma(8) * terms + c_rest
            residual = np.fmin(residual, near + tau * tau * a_error + 2 * span * b_error)
        slope = np.abs(dot(q, local.d))
        slope_error = length * local.d_error + d * q_error + gamma(4) * length * d
        low, high = slope - slope_error, slope + slope_error
        rise = (a + a_error) * residual
        room = low * low - rise
        beside = (high + np.sqrt(high * high + rise)) / (a - a_error)
        return np.where((low > 0) & (room > 0), residual / (low + np.sqrt(room)), beside)

    def normal_error(self, hits: AffineErrors, point: np.ndarray) -> np.ndarray:
        """See ``AffineKind``: only errors of the gradient perpendicular to itself turn it."""
        local, frame, q = hits.local, hits.local.frame, hits.local.q(hits.tau)
        gradient = dot(frame.matrix, q)
        length = norm(gradient)
        turned = frame.rounding + gamma(8)
        span = hits.pixels.t * local.rays.length + local.offset.away
        moved = (point + turned * (point + span)) / frame.scale  # for a row of length 1, as all of these
        along = frame.size * frame.size * moved
        tilt = norm(cross(frame.matrix.swapaxes(0, 1), gradient / length))
        aside = (turned + gamma(8)) * along + dot(frame.rows, tilt * moved + turned * np.abs(q))
        error = np.where(along < length / 2, aside / (length - along), 2.0)
        if hits.unit:
            error += np.where(frame.is_scalar, along / length, 0.0)
        return error


def _curved(shapes: InCamera, at: np.ndarray) -> PixelNormals:
    """Return a function that gives the unit normals of hit pixels on the ellipsoids at these indices."""
    matrix = shapes.shape_from_world[at]
    power = -np.frexp(np.abs(matrix).max(axis=(1, 2), initial=0.0))[1]
    matrix = np.ldexp(matrix, power[:, None, None]).transpose(1, 2, 0).copy()  # about 1; long arrays, so fast ones
    center = np.ldexp(shapes.offset[at], power[:, None]).T.copy()
    entry = np.zeros(len(shapes.shapes), np.intp)
    entry[at] = np.arange(len(at))

    def normals(pixels: HitPixels, point, direction):
        here = entry[merged(pixels.at)]
        to_sphere = taken(matrix, here)
        q = difference(matvec(to_sphere, point), taken(center, here))
        normal = unit(matvec(to_sphere.swapaxes(0, 1), q))
        if direction is None:
            return normal
        towards = -np.sign(dot(normal, direction))
        return tuple(towards * component for component in normal)

    return normals


def outside(shapes: InCamera, local: LocalRays) -> tuple[Any, Any] | None:
    """Return |N|^2 - 1 of near shapes, NaN for other shapes, and the part of its error bound beyond gamma(4) of itself;
    None if no shape is near or the rays do not leave the eye.
    """
    near = local.offset.length < 1.9
    if not (local.from_eye and near.any()):
        return None
    c, parts = local.frame.of(sphere_rays.outside(shapes, slice(None))), local.offset.parts
    return np.where(near, c, np.nan), 64 * EPS * EPS * (1 + dot(parts, parts))


SPHERES = Sphere()
