"""A lens at one wavelength: its surfaces in their places, paraxial optics, and where the film has to be.

Paraxial rays are (y, n u), height and slope times index, and surfaces and gaps are 2 x 2 matrices. With the whole
lens's matrix (A, B; C, D) an object at the distance s before the front has its image -n' (A s + B) / (C s + D) behind
the last vertex. The paraxial image is not where the blur of a fast lens is least. With heights h and slopes u, at z =
0, of rays of equal pupil areas from the axis' point, the blur's RMS radius is least at z = -sum(h u) / sum(u^2).
Reference: W. Smith, Modern Optical Engineering, 4th ed. (2008), chapters 2 to 4.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..records import InputError
from .prescription import D_LINE, Prescription
from .trace import LensSurface, trace

PUPIL_RAYS = 64
"""Rays of equal areas of the pupil for the best focus. With 256 the film moves by less than 1e-4 of its way there."""

LEAST_F_NUMBER = 1e-5
"""Below it an f-number counts as this: Blender allows 0."""

BISECTIONS = 60
"""Halvings of an interval: down to the rounding of its ends."""


def bisected(holds: Callable, low: float, high: float) -> float:
    """Return the largest number from low to high up to which a condition of arrays (1,) holds, which holds at low."""
    if holds(np.array([high]))[0]:
        return float(high)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(np.array([middle]))[0] else (low, middle)
    return float(low)


@dataclass(frozen=True)
class Optics:
    """A lens at a wavelength, with the whole stop open."""

    surfaces: tuple[LensSurface, ...]
    stop: int

    @classmethod
    def of(cls, lens: Prescription, wavelength: float = D_LINE) -> Optics:
        """Return the optics of a prescription in one configuration. Raises InputError if it does not focus."""
        z, before, surfaces = 0.0, lens.before, []
        for row in lens.at(wavelength).rows:
            surfaces.append(LensSurface(z, row.curvature, row.conic, row.asphere, row.rim, before, row.index))
            z, before = z + row.gap, row.index
        optics = cls(tuple(surfaces), lens.stop)
        if not 0 < optics.focal_length < np.inf:
            raise InputError(
                f"the lens has a focal length of {optics.focal_length:.6g} mm: it must be positive; are radii, gaps "
                "or their order wrong?"
            )
        return optics

    def matrix(self, first: int, last: int) -> np.ndarray:
        """Return the paraxial matrix, (2, 2), from just before one surface to just behind another."""
        matrix = np.eye(2)
        passed = self.surfaces[first : last + 1]
        for surface, after in zip(passed, (*passed[1:], None), strict=True):
            curvature = surface.curvature + 2 * sum(value for power, value in surface.asphere if power == 2)
            matrix = np.array([[1.0, 0.0], [-(surface.behind - surface.before) * curvature, 1.0]]) @ matrix
            if after is not None:
                matrix = np.array([[1.0, (after.z - surface.z) / surface.behind], [0.0, 1.0]]) @ matrix
        return matrix

    @cached_property
    def whole(self) -> np.ndarray:
        """The paraxial matrix of all surfaces."""
        return self.matrix(0, len(self.surfaces) - 1)

    @property
    def front(self) -> LensSurface:
        """The first surface."""
        return self.surfaces[0]

    @property
    def rear(self) -> LensSurface:
        """The last surface."""
        return self.surfaces[-1]

    @cached_property
    def focal_length(self) -> float:
        """The effective focal length in mm, in the medium before the lens; inf without power."""
        power = -float(self.whole[1, 0])
        return self.front.before / power if power else np.inf

    @cached_property
    def back_focus(self) -> float:
        """Distance from the last vertex to the film for an object at infinity, paraxial, in mm."""
        return float(-self.rear.behind * self.whole[0, 0] / self.whole[1, 0])

    @cached_property
    def entrance_pupil(self) -> tuple[float, float]:
        """z of the image of the stop that the scene sees, and its magnification."""
        if self.stop == 0:
            return 0.0, 1.0
        last, stop = self.surfaces[self.stop - 1 : self.stop + 1]
        to_stop = np.array([[1.0, (stop.z - last.z) / last.behind], [0.0, 1.0]])
        (a, b), _ = to_stop @ self.matrix(0, self.stop - 1)
        return float(b * self.front.before / a), float(1 / a)

    @cached_property
    def exit_pupil(self) -> tuple[float, float]:
        """z of the image of the stop that the film sees, and its magnification."""
        (_, b), (_, d) = self.matrix(self.stop, len(self.surfaces) - 1)
        return float(self.rear.z - self.rear.behind * b / d), float(1 / d)

    @cached_property
    def widest_f_number(self) -> float:
        """The f-number with the whole stop open, paraxial."""
        return self.focal_length / (2 * self.surfaces[self.stop].rim * abs(self.entrance_pupil[1]))

    def stop_radius(self, f_number: float) -> float:
        """Return the radius of the stop for an f-number, at most the lens's own."""
        asked = self.focal_length / (2 * max(f_number, LEAST_F_NUMBER) * abs(self.entrance_pupil[1]))
        return min(self.surfaces[self.stop].rim, asked)

    @property
    def nearest_focus(self) -> float:
        """Distance before the entrance pupil below which a point has no image, in mm; 0 if any has one."""
        front_focus = self.front.before * float(self.whole[1, 1] / self.whole[1, 0])  # z, before the front: negative
        return max(self.entrance_pupil[0] - front_focus, 0.0)

    def paraxial_film(self, distance: float) -> float:
        """Return z of the paraxial image of the plane at a distance before the entrance pupil, in mm."""
        (a, b), (c, d) = self.whole
        s = (distance - self.entrance_pupil[0]) / self.front.before
        return float(self.rear.z - self.rear.behind * (a * s + b) / (c * s + d))

    def sharpest_film(self, distance: float, radius: float) -> float:
        """Return z of the film with the least RMS blur of the axis' point, for a stop of this radius, in mm.

        It is the paraxial film if no ray but that on the axis passes the lens.
        """
        widest = bisected(lambda height: np.isfinite(self._from_axis(distance, height, radius)[1][1]),
                          0.0, 2.0 * abs(self.entrance_pupil[1]) * radius)  # fmt: skip
        heights = np.sqrt((np.arange(PUPIL_RAYS) + 0.5) / PUPIL_RAYS) * widest
        (_, y, z), (_, dy, dz) = self._from_axis(distance, heights, radius)
        slope, height = dy / dz, y - z * dy / dz
        total = float((slope * slope).sum())
        if not total > 0:
            return self.paraxial_film(distance)
        return -float((height * slope).sum()) / total

    def _from_axis(self, distance: float, height, radius: float):
        """Return rays behind the lens, from the axis' point at a distance to heights in the entrance pupil; NaN in the
        direction's y where a rim or the stop is in the way.
        """
        start = np.zeros_like(height)
        direction = start, height, start + distance
        length = np.sqrt(height * height + distance * distance)
        surfaces, stop = [*self.surfaces], self.surfaces[self.stop]
        surfaces[self.stop] = replace(stop, rim=min(radius, stop.rim))
        with np.errstate(invalid="ignore", divide="ignore"):
            point = start, start, start + self.entrance_pupil[0] - distance
            ahead = tuple(component / length for component in direction)
            origin, (dx, dy, dz) = trace(surfaces, point, ahead, to_film=True)
        return origin, (dx, np.where(np.isnan(dx), np.nan, dy), dz)
