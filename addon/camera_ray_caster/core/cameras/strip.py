"""The strip camera, a multiple-center-of-projection image: each column is seen from another place on a path.

The eye moves along the path, a curve of the scene, at constant speed from its first point, at the left edge, to its
last, at the right edge. A column is the middle column of a perspective camera at that place: its rows are those of the
perspective window, by lens, sensor and shift_y, and its rays lie in one plane through the up axis, the camera's +Y.
With ``follow_path`` the camera turns about the up axis to look to the left of its heading; otherwise it keeps its
orientation. Between the points at which Blender samples the curve, the place and the column's normal change linearly.
Singular: a point about which the columns' planes turn, so that no column or many columns see it. Refused: without
``follow_path``, a path along the viewing direction or up, since all its columns see one plane.
Reference: P. Rademacher and G. Bishop, Multiple-Center-of-Projection Images, SIGGRAPH 1998.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..conventions import EPS
from ..maths.intervals import Interval
from ..maths.recording import look_up, vector
from ..maths.recording.scalars import plain
from ..maths.vector import components
from ..records import BlenderCamera, InputError, Raster
from .model import Model, Step
from .parts.film import Window
from .parts.lines import LINE_ROUNDING, path_from
from .parts.settings import Flag, Line
from .parts.silhouette import MARGINS
from .perspective import PLANE, Perspective

PATH = Line(
    "path", "Path", "Curve along which the eye moves, from the left edge of the picture to the right edge", None,
    ("CURVE",), sampled=True,
)  # fmt: skip
FOLLOW = Flag(
    "follow_path", "Follow Path",
    "Turn the view about the camera's up axis, to look to the left of the path's direction", False,
)  # fmt: skip

BESIDE = 1e-9
"""Fraction of a stretch of the path by which a column may lie beyond its end if no stretch holds it: rounding must not
lose a column at a joint.
"""

PIECES = 64
"""Number of pieces of the path that are examined separately for the bounds of a sphere."""

BALLS = 256
"""Number of spheres bounded at once, a kilobyte or more each. Each takes 1.5 to 4 microseconds, with 4,096 twice that.
"""


@dataclass(frozen=True)
class Strip(Model):
    """A path by its knots: columns x (k,), the eye's places (k, 3), and the columns' normals (k, 2), in x and z."""

    rows: Window
    """The perspective window, of which only the rows are used."""
    columns: np.ndarray
    eyes: np.ndarray
    normals: np.ndarray

    key = "STRIP"
    label = "Strip"
    description = "Each column is seen from a different place on a path"
    group = "Multiperspective"
    number = 15
    central = False
    guarded = False
    smooth = False  # a path may bend between neighboring columns
    SETTINGS = (PATH, FOLLOW, *Perspective.SETTINGS)
    FORMULA = (
        Step("Place between the points A and B of the path, whose columns are x_A, x_B", "f = (x - x_A) / (x_B - x_A)"),
        Step("Origin", "o = A + f (B - A)"),
        Step("Normal of the column, level, between those at A and B", "n = (1 - f) n_A + f n_B"),
        Step("Where the column looks", "h = (n_z, 0, -n_x) / sqrt(n_x² + n_z²)"),
        Step("Row of the perspective window", PLANE[0].symbols.partition(", ")[2]),
        PLANE[1],
        Step("Direction", "r = h + Y v"),
    )

    def formula_values(self, x, y):
        """See Model: the stretch of the path on which the column is."""
        k, values = self._stretch(x), dict[str, Any]()
        for end, at in (("A", k), ("B", k + 1)):
            tables = self.columns, *self.eyes.T, *self.normals.T
            column, *eye, normal_x, normal_z = (plain(look_up(table, at)) for table in tables)
            values |= {f"x_{end}": column, end: vector(*eye), f"n_{end}": vector(normal_x, 0.0, normal_z)}
        return values

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Strip:
        """Build the camera from lens, sensor, shift_y, ``path`` and follow_path. InputError for a refused path."""
        eyes, closed = path_from(raw, PATH)
        lengths = np.linalg.norm(np.diff(eyes, axis=0), axis=1)
        walked = np.concatenate(([0.0], np.cumsum(lengths)))
        normals = np.tile((1.0, 0.0), (len(eyes), 1))
        if FOLLOW.read(raw):
            normals = _headings(np.diff(eyes, axis=0) / lengths[:, None], closed)[:, [0, 2]]
            size = np.linalg.norm(normals, axis=1, keepdims=True)
            if size.min() < 1e-6:
                raise InputError(
                    f"path of camera {raw.name!r} runs along the camera's up axis, or straight back, at point "
                    f"{int(size.argmin())}: bend it, or clear follow_path"
                )
            normals = normals / size
        elif np.ptp(eyes[:, 0]) <= LINE_ROUNDING * np.ptp(eyes, axis=0).max():
            raise InputError(
                f"path of camera {raw.name!r} leads only ahead or up, where all columns see one plane: turn it across "
                "the view, or set follow_path"
            )
        rows, columns = Perspective.from_blender(raw, raster).window, walked * (raster.width / walked[-1])
        return cls(raster.size, rows, columns, eyes, normals)

    def rays(self, x, y):
        """See Model: the origin has the shape of x. Both are NaN beyond the ends of the path. The origin is right to
        some EPS of the path's coordinates, the direction to some EPS.
        """
        eye, ahead_x, ahead_z = self._at(x)
        _, slope = self.rows.plane_from_pixels(0.0, y)
        scale = 1 / np.sqrt(slope * slope + 1)
        return eye, (ahead_x * scale, slope * scale, ahead_z * scale)

    def project(self, points):
        """See Model: the lowest of several columns. A column sees a point if (point - eye) . normal, a quadratic in the
        place on a stretch of the path, is zero; it is solved without iteration, right to some EPS of the place.
        """
        points = np.asarray(points, np.float64)
        x, least = np.full(points.shape[:-1], np.nan), np.full(points.shape[:-1], np.inf)
        for k in reversed(range(len(self.columns) - 1)):
            share, beyond = self._first_on_stretch(points, k)
            seen = ~np.isnan(share) & (beyond <= least)
            least[seen] = beyond[seen]
            x[seen] = self.columns[k] + share[seen] * (self.columns[k + 1] - self.columns[k])
        eye, ahead_x, ahead_z = self._at(x)
        depth = (points[..., 0] - eye[0]) * ahead_x + (points[..., 2] - eye[2]) * ahead_z
        slope = (points[..., 1] - eye[1]) / np.where(depth > 0, depth, np.nan)
        return np.stack((x, self.rows.pixels_from_plane(0.0, slope)[1]), axis=-1)

    def bounds(self, centers, radii):
        """See Model. The path is examined piece by piece: a piece counts if its columns' planes come within the radius
        of the center, and the sphere is not behind all of them.
        """
        marks = np.union1d(self.columns, np.linspace(0, self.columns[-1], PIECES + 1))
        eyes, normals = (
            np.stack([np.interp(marks, self.columns, row) for row in values.T], axis=1)
            for values in (self.eyes, self.normals)
        )
        radii = radii + 8 * EPS * (np.abs(centers).sum(axis=1) + np.abs(eyes).max())  # rounding of what follows
        planes, ahead = _from_pieces(eyes, normals), _from_pieces(eyes, normals[:, ::-1] * (1, -1))
        bounds = np.full((len(centers), 4), np.nan)
        for start in range(0, len(centers), BALLS):
            center, radius = centers[start : start + BALLS], radii[start : start + BALLS]
            beside = planes(center)
            touched = _on_pieces(beside <= radius) & _on_pieces(beside >= -radius)
            touched &= _on_pieces(ahead(center) >= -radius)
            ball, piece = np.nonzero(touched.T)
            if not len(ball):
                continue
            first = np.flatnonzero(np.diff(ball, prepend=-1))
            slope = _slopes(center[ball], radius[ball], eyes[piece], eyes[piece + 1])
            low, high = np.minimum.reduceat(slope.low, first), np.maximum.reduceat(slope.high, first)
            left, right = marks[piece[first]], marks[np.maximum.reduceat(piece, first) + 1]
            bottom, top = (self.rows.pixels_from_plane(0.0, end)[1] for end in (low, high))
            bounds[start + ball[first]] = np.stack((left, right, bottom, top), axis=1)
        return bounds + MARGINS

    def _stretch(self, x):
        return np.clip(np.searchsorted(self.columns, x, side="right") - 1, 0, len(self.columns) - 2)

    def _at(self, x):
        """Return the eye and the horizontal unit direction (x, z) of columns; NaN beyond the path."""
        k = self._stretch(x)
        start = look_up(self.columns, k)
        share = (x - start) / (look_up(self.columns, k + 1) - start)
        share = np.where((x >= 0) & (x <= self.columns[-1]), share, np.nan)
        between = lambda c: look_up(c, k) + share * (look_up(c, k + 1) - look_up(c, k))  # noqa: E731
        eye = tuple(between(c) for c in self.eyes.T)
        normal_x, normal_z = (between(c) for c in self.normals.T)
        size = np.hypot(normal_x, normal_z)
        size = np.where(size > 0, size, np.nan)
        return eye, normal_z / size, -normal_x / size

    def _first_on_stretch(self, points, k):
        """Return the lowest place 0 .. 1 on stretch k whose column sees the points, NaN if there is none, and how far
        that place lay beyond the stretch before it was clipped to its end.
        """
        eye, step = self.eyes[k], self.eyes[k + 1] - self.eyes[k]
        normal, turn = self.normals[k], self.normals[k + 1] - self.normals[k]
        c, b, a = _crossing(points, eye, step, normal, turn)
        first, beyond = np.full(points.shape[:-1], np.nan), np.full(points.shape[:-1], np.inf)
        with np.errstate(invalid="ignore", divide="ignore"):  # no root, or a root at infinity: NaN and inf are valid
            root = -(b + np.copysign(np.sqrt(b * b - 4 * a * c), b)) / 2
            for share in (root / a, c / root):
                free, share = share, np.clip(share, 0.0, 1.0)
                off = np.abs(free - share)
                beside_x, _, beside_z = components(points - (eye + share[..., None] * step))
                ahead = (normal[1] + share * turn[1]) * beside_x - (normal[0] + share * turn[0]) * beside_z
                lower = (off < beyond) | ((off == beyond) & (share < first))
                better = (off <= BESIDE) & (ahead > 0) & lower
                first, beyond = np.where(better, share, first), np.where(better, off, beyond)
        return first, beyond


def _from_pieces(eyes, normals):
    """Return a function from points p (n, 3) to coefficients (2 k + 1, n) of (p - eye) . normal on k pieces.

    Eyes (k + 1, 3) and normals change linearly on a piece, so that the product is a quadratic, which stays between its
    Bernstein coefficients: its values at both ends, and the mean of the two products of one end's eye and the other
    end's normal.
    """
    level = eyes[:, [0, 2]]
    rows, offset = np.empty((2 * len(eyes) - 1, 2)), np.empty((2 * len(eyes) - 1, 1))
    rows[::2], rows[1::2] = normals, (normals[:-1] + normals[1:]) / 2
    crossed = (level[:-1] * normals[1:] + level[1:] * normals[:-1]) / 2
    offset[::2, 0], offset[1::2, 0] = (level * normals).sum(axis=1), crossed.sum(axis=1)
    return lambda points: rows @ points[:, [0, 2]].T - offset


def _on_pieces(holds):
    """Return whether ``holds``, given for the coefficients, is true for any coefficient of each piece, (k, n)."""
    return holds[:-1:2] | holds[1::2] | holds[2::2]


def _slopes(centers, radii, before, after):
    """Return the intervals of slopes of rays that meet spheres (n, 3), from eyes on lines between two points (n, 3).

    An interval is infinite if the line comes inside the vertical cylinder around the sphere.
    """
    x, y, z = components(centers - (before + after) / 2)
    half_x, half_y, half_z = components((after - before) / 2)
    rise = Interval.around(y, radii + np.abs(half_y))
    return rise / Interval.around(np.hypot(x, z), radii + np.hypot(half_x, half_z))


def _crossing(points, eye, step, normal, turn):
    """Return c, b, a of (point - eye - f step) . (normal + f turn) = c + b f + a f^2, in x and z."""
    beside_x, _, beside_z = components(points - eye)
    c = beside_x * normal[0] + beside_z * normal[1]
    b = beside_x * turn[0] + beside_z * turn[1] - (step[0] * normal[0] + step[2] * normal[1])
    return c, b, -(step[0] * turn[0] + step[2] * turn[1])


def _headings(directions, closed):
    """Return the path's headings at its points: the mean of the unit directions of the two adjacent stretches."""
    first, last = (directions[-1], directions[0]) if closed else (directions[0], directions[-1])
    around = np.concatenate((first[None], directions, last[None]))
    return (around[1:] + around[:-1]) / 2
