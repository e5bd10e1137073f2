"""Error bounds of hits on triangles; ``errors.hit_errors`` explains what they bound and how."""

from dataclasses import dataclass

import numpy as np

from ...conventions import EPS, gamma
from ...maths.speed import lazy
from ...maths.vector import along, difference, dot, norm
from ..kind import ShapeErrors
from ..shape_frames import WorldRays
from .mesh_surface import HitTriangles


@dataclass(frozen=True, eq=False)
class TriangleErrors(ShapeErrors):
    """The error bounds of hits on the triangles found; that rounding may move a ray to a neighbor is not included."""

    triangles: HitTriangles
    hit_t: np.ndarray
    """(m,): t of the hits."""
    rays: WorldRays

    @lazy
    def _moved(self) -> np.ndarray:
        """Upper bound of how far rounding has moved a corner, (k,)."""
        triangles = self.triangles
        turned = norm([dot(np.abs(row), np.abs(triangles.local).max(axis=0)) for row in triangles.axes])
        return gamma(8) * (turned + norm(triangles.center))

    @lazy
    def _turned(self) -> np.ndarray:
        """Upper bound of the error of the edges' cross product, as a vector's length, (k,)."""
        first, second = map(norm, self.triangles.edges)
        return 2 * self._moved * (first + second + 2 * self._moved) + gamma(4) * first * second

    @property
    def t(self) -> np.ndarray:
        """The residual of the plane's equation over its slope, or ``_within`` where that is less."""
        each, rays, corners = self.triangles.each, self.rays, self.triangles.corners
        moved, turned, normal = each(self._moved), each(self._turned), each(np.array(self.triangles.area))
        corner = each(np.array(corners[0]))
        point = along(rays.origin, rays.direction, self.hit_t)
        offset, length, steep = difference(point, corner), norm(normal), norm(rays.direction)
        beside = np.abs(self.hit_t) * rays.direction_error + rays.origin_error
        place_error = beside + moved + gamma(4) * (norm(rays.origin) + np.abs(self.hit_t) * steep + norm(corner))
        residual = np.abs(dot(normal, offset)) + gamma(3) * length * norm(offset)
        residual += length * place_error + turned * (norm(offset) + place_error)
        slope = np.abs(dot(normal, rays.direction)) - gamma(3) * length * steep
        slope -= length * rays.direction_error + turned * (steep + rays.direction_error)
        return np.fmin(np.where(slope > 0, residual / slope, np.inf), self._within)

    @property
    def _within(self) -> np.ndarray:
        """The largest distance of t from the t of a corner: the exact t lies between the exact t of the corners."""
        rays, each = self.rays, self.triangles.each
        square = dot(rays.direction, rays.direction)
        worst = np.zeros(len(self.hit_t))
        for corner in self.triangles.corners:
            towards = difference(each(np.array(corner)), rays.origin)
            moved = each(self._moved) + rays.origin_error + EPS * norm(towards)
            error = moved / np.sqrt(square) + norm(towards) * (
                3 * rays.direction_error / square + gamma(8) / np.sqrt(square)
            )
            worst = np.maximum(worst, np.abs(dot(towards, rays.direction) / square - self.hit_t) + error)
        return worst

    def normal(self, point: np.ndarray) -> np.ndarray:
        """See ``ShapeErrors``: an error of the point changes the weights of the corners' normals."""
        triangles = self.triangles
        length = norm(triangles.area)
        turn = 2 * self._turned / length
        corner_normals = triangles.corner_normals
        spread = sum(norm(difference(corner_normals[k], corner_normals[0])) for k in (1, 2))
        edge = np.maximum(*map(norm, triangles.edges))
        weights = (edge / length) * (1 + edge * turn)
        reach = np.maximum.reduce([norm(corner) for corner in triangles.corners])
        each = triangles.each
        change = each(2 * spread * weights) * (point + each(self._moved + gamma(16) * reach))
        hit = along(self.rays.origin, self.rays.direction, self.hit_t)
        left = norm(triangles.interpolated(corner_normals, hit)) - change
        smooth = np.where(left > 0, change / left, 2.0) + gamma(64)
        return np.where(each(spread > 0), smooth, each(turn))
