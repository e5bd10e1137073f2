"""Convex hulls of points, such as triangles and boxes: the pixels in which they may be seen, and their least t."""

import numpy as np

from .. import tuning
from ..conventions import EPS
from ..maths.speed import taken
from .kind import PixelBounds
from .shape_frames import BOUNDS_FACTOR
from .windows import pixels_in

MIDPOINT_ROUNDING = 4 * EPS
"""Error bound of the corners of quarters of quarters of triangles, over the largest coordinate of the triangle."""


class HullPoints:
    """Points in the camera's frame whose hulls are bounded by their images, or by balls if a line may look curved."""

    def __init__(self, pixels: PixelBounds, count: int):
        self.places = np.empty((3, count))
        self._pixels = pixels
        self.type = np.int16 if pixels.whole.max() < 2**15 else np.int32
        self._images = np.empty((count, 4), self.type) if pixels.has_straight_lines else None

    @property
    def _unknown(self) -> int:
        """Marks the x0 of a point without an image."""
        return np.iinfo(self.type).min

    def write(self, at: slice | np.ndarray, places: np.ndarray) -> None:
        """Write the places, (3, m), of some points, which may be given by index, and their images."""
        self.places[:, at] = places
        if self._images is None:
            return
        images = np.empty((places.shape[1], 4), self.type)
        others = np.flatnonzero(~self._pixels.of_points(places.T, images))
        images[others] = self._pixels.whole
        _turn_ends(images)  # the bounds of a hull are the minima over its corners then
        images[others, 0] = self._unknown
        self._images[at] = images

    def at(self, corners: np.ndarray) -> np.ndarray:
        """Return the places of the corners, (c, 3, k): corner, component."""
        return self.places.take(corners, axis=1).swapaxes(0, 1)

    def hulls(self, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the pixel bounds of hulls, (k, 4), lower bounds of their t, (k,), and their indices, (k,): those that
        some pixel may see, among the hulls with the corners given, (c, n) indices of points.
        """
        if self._images is None:
            return self._in_balls(corners)
        least = self._images.take(corners[0], axis=0)
        for corner in corners[1:]:
            np.minimum(least, self._images.take(corner, axis=0), out=least)
        seen = np.flatnonzero((least[:, 0] < -least[:, 1]) & (least[:, 2] < -least[:, 3]))
        bounds, corners = least.take(seen, axis=0), corners.take(seen, axis=1)
        _turn_ends(bounds)
        near = -np.maximum.reduce([taken(self.places[2], corner) for corner in corners])
        unknown = bounds[:, 0] == self._unknown
        if not unknown.any():
            return bounds, near, seen
        known, unknown = np.flatnonzero(~unknown), np.flatnonzero(unknown)
        ball_bounds, ball_near, in_balls = self._in_balls(corners[:, unknown])
        position = np.concatenate((known, unknown[in_balls]))
        order = np.argsort(position)
        bounds, near = np.concatenate((bounds[known], ball_bounds)), np.concatenate((near[known], ball_near))
        return bounds[order], near[order], seen[position[order]]

    def _in_balls(self, corners: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the same as ``hulls``, from balls around the corners."""
        places = self.at(corners)
        bounds, near, seen = self._around(places, MIDPOINT_ROUNDING * np.abs(places).max(axis=(0, 1)), tuning.HALVINGS)
        at = np.flatnonzero(seen)
        return bounds[at].astype(self.type), near[at], at

    def _around(
        self, places: np.ndarray, rounding: np.ndarray, halvings: int
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return bounds, (k, 4), lower bounds of t, (k,), and whether some pixel may see them, (k,), of hulls of places
        (c, 3, k), which are uncertain by ``rounding``, (k,). Triangles in many pixels are bounded by the balls of their
        quarters, and these by those of theirs, at most ``halvings`` times.
        """
        low, high = np.minimum.reduce(places), np.maximum.reduce(places)
        middle = low / 2 + high / 2
        radius = BOUNDS_FACTOR * np.sqrt(np.maximum.reduce([((corner - middle) ** 2).sum(axis=0) for corner in places]))
        radius += rounding
        bounds, seen = self._pixels.of_balls(middle.T, radius)
        near = self._pixels.least_t(middle.T, radius)
        wide = np.flatnonzero(seen & (pixels_in(bounds) > tuning.HALVED_PIXELS))
        if len(places) != 3 or not halvings or not wide.size:
            return bounds, near, seen
        a, b, c = places[..., wide]
        ab, bc, ca = a / 2 + b / 2, b / 2 + c / 2, c / 2 + a / 2
        quarters = np.concatenate(np.array(((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))), axis=-1)
        parts, least, inside = self._around(quarters, np.tile(rounding[wide], 4), halvings - 1)
        parts[~inside] = bounds.max(), 0, bounds.max(), 0  # of no pixel
        for side, within, over in (0, np.maximum, np.minimum), (1, np.minimum, np.maximum):
            bounds[wide, side::2] = within(bounds[wide, side::2], over.reduce(parts[:, side::2].reshape(4, -1, 2)))
        near[wide] = np.maximum(near[wide], least.reshape(4, -1).min(axis=0))
        seen[wide] = inside.reshape(4, -1).any(axis=0)
        return bounds, near, seen


def _turn_ends(bounds: np.ndarray) -> None:
    """Turn x0, x1, y0, y1 into x0, -x1, y0, -y1 or back, in place."""
    for column in bounds.T[1::2]:
        np.negative(column, out=column)
