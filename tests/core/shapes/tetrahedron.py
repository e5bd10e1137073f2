"""A toy kind of shape whose hits need more than a row: four triangles, of which each pixel keeps the one that it hits.

It is found by ``rest`` alone, for all shapes and a whole tile at once, and has normals, uv and errors per pixel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from camera_ray_caster.core.conventions import gamma
from camera_ray_caster.core.maths.vector import difference, dot, matrix_rows, matvec, norm, unit
from camera_ray_caster.core.shapes.kind import Candidates, HitPixels, Kind, ShapeErrors, ShapeSet, Visible
from camera_ray_caster.core.shapes.local_rays import LocalRays
from camera_ray_caster.core.shapes.shape_frames import InCamera

FACES = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], float)
"""The planes face . q = OFFSETS of the corner between the origin and the ends of the axes."""
OFFSETS = np.array([0, 0, 0, 1], float)


class Tetrahedron(Kind):
    """Tetrahedra with corners 0, (1, 0, 0), (0, 1, 0) and (0, 0, 1) in q."""

    number = 8
    name = "tetrahedron"

    def extent(self, shapes, at, axes):
        """The farthest corner."""
        return np.sqrt((axes**2).sum(axis=2)).max(axis=1), np.abs(axes[..., 2]).max(axis=1)

    def is_close(self, offset, shape_from_world, away):
        """No digit is computed twice."""
        return np.zeros(len(offset), bool)

    def shape_set(self, shapes, visible):
        """All in view."""
        return TetrahedronSet(shapes, visible)

    def normals(self, shapes, at):
        """None is a constant: each is its triangle's."""

        def normals(pixels, point, direction):
            matrix = matrix_rows(np.swapaxes(shapes.shape_from_world[pixels.at], 1, 2))
            normal = np.array(unit(matvec(matrix, FACES[pixels.in_tile(pixels.known[8])].T)))
            return -np.sign(dot(normal, direction)) * normal

        return np.full((len(at), 4), np.nan), normals

    def uv(self, shapes, pixels, point):
        """u counts the triangles, v is q_x."""
        away = np.array(point).T - (shapes.shapes.center - shapes.pose.eye)[pixels.at]
        q = np.einsum("nij,nj->ni", shapes.shape_from_world[pixels.at], away)
        return pixels.in_tile(pixels.known[8]).astype(float), q[:, 0]

    def errors(self, shapes, pixels, rays, from_eye, unit):
        """Of the triangles that are hit."""
        return TetrahedronErrors(pixels, LocalRays(shapes, pixels.at, rays, from_eye))


@dataclass(frozen=True, eq=False)
class TetrahedronSet(ShapeSet):
    """Those in view."""

    shapes: InCamera
    visible: Visible
    faces_eye = False

    def rest(self, rays, nearest):
        """One window, the tile; each of its pixels has its own shape and triangle."""
        best = np.full((1, *rays.shape), np.inf)
        at = np.zeros((1, *rays.shape), np.intp)
        face = rays.known[8] = np.zeros(rays.shape, np.int8)
        for shape in self.visible.at:
            matrix = self.shapes.shape_from_camera[shape]
            d = matvec(matrix, rays.direction)
            n = self.shapes.offset[shape]
            if rays.origin is not None:
                n = matvec(matrix, difference(self.shapes.center[shape], rays.origin))
            for i, (normal, offset) in enumerate(zip(FACES, OFFSETS, strict=True)):
                t = np.broadcast_to((dot(normal, n) + offset) / dot(normal, d), rays.shape)
                q = tuple(t * along - away for along, away in zip(d, n, strict=True))
                inside = t >= self.visible.clip_start
                for j, other in enumerate(FACES):
                    if j != i:
                        inside = inside & (dot(other, q) <= 1 if j == 3 else q[j] >= 0)
                closer = inside & (t < best[0])
                best[0][closer], at[0][closer], face[closer] = t[closer], shape, i
        yield Candidates(at, (np.array([0]), np.array([0])), best, None)


@dataclass(frozen=True, eq=False)
class TetrahedronErrors(ShapeErrors):
    """The residual of the triangle's plane over its slope."""

    pixels: HitPixels
    local: LocalRays

    @property
    def t(self):
        """See ``ShapeErrors``."""
        face = self.pixels.in_tile(self.pixels.known[8])
        normal, offset = FACES[face].T, OFFSETS[face]
        local, tau = self.local, self.pixels.t / self.local.frame.scale
        d, n = dot(normal, local.d), dot(normal, local.n)
        d_error = np.sqrt(3) * (local.d_error + gamma(4) * norm(local.d))
        n_error = np.sqrt(3) * (local.n_error + gamma(4) * (norm(local.n) + offset))
        residual = np.abs(tau * d - n - offset) + np.abs(tau) * d_error + n_error
        return residual / (np.abs(d) - d_error) * local.frame.scale

    def normal(self, point):
        """A constant's of the triangle, as far as the axes are not skew."""
        return 3 * self.local.frame.rounding + gamma(8)


TETRAHEDRA = Tetrahedron()
