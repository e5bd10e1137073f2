"""Blender's spherical stereo: each ray of a central camera begins beside the eye, across the way it looks.

Assumption: D is the camera's own ray, in a frame whose z is up: that of the world for perspective cameras, that of the
camera, y up, for panoramas. It has unit length; the central cylindrical panorama has it as long as 1 across instead.
Formula: side = (D x up) / |D x up|, offset e = -+ interocular distance / 2 for the left and the right eye; between the
altitudes |asin(D_up)| ``from`` and ``to`` of a pole merge it is faded by cos(pi/2 (altitude - from) / (to - from)),
and 0 above. Origin e side, direction D - (e / convergence distance) side, or D where the eyes are parallel.
As in Cycles, off-axis and toe-in are the same, the pivot and the shift of an eye do not count, and the eyes of the
mirror ball are swapped. Depth is the distance from the ray's origin, also of perspective cameras. With depth of field D
is a ray through the lens, which has unit length, and the eye moves with it.
Singular: straight up and down, where there is no side and no ray.
Inverse: with u the length along D, a point p = e side + u (D - (e / c) side) lies at |p|^2 = u^2 + (1 - u / c)^2 e^2,
which has one positive u for points farther away than e; with a pole merge the altitude, on which e depends, is sought
by bisection.
References: Blender manual, Stereoscopy; source of Cycles, kernel/camera; rays read out of Cycles.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np

from ..cameras.central_cylindrical import CentralCylindrical
from ..cameras.mirrorball import Mirrorball
from ..cameras.model import Model, Step
from ..cameras.parts.aperture import Aperture
from ..cameras.perspective import Perspective
from ..conventions import gamma
from ..maths.panels import Disc
from ..maths.speed import lazy
from ..maths.vector import along, components, difference, inverse, matvec, norm, unit
from ..records import BlenderCamera, Pose

EYE = "spherical_eye"
"""Of a record's settings: -1.0 for the left eye, 1.0 for the right one; without it the camera has one eye."""

Y_UP = (1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)
"""From the camera's frame to x right, y ahead, z up."""

HALVINGS = 60
"""Of the altitudes of a pole merge: down to rounding."""

MET = 1e-9
"""Radians of altitude within which a ray found by bisection is one; else the offset jumps there."""

STEP = 2.0**-10
"""Pixels between rays that tell how far a pixel turns them."""

Matrix = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class SphericalStereo(Model):
    """An eye: a central model, and where the eye is beside each of its rays."""

    lens: Model
    upright: Matrix
    """(3, 3), from the camera's frame to that in which z is up."""
    tilted: Matrix
    """Its inverse."""
    offset: float
    """To the right of a ray; Blender units."""
    nearness: float
    """1 over the convergence distance; 0 for parallel eyes."""
    merge: tuple[float, float] | None
    """The altitudes, rad, at which the offset begins to fade and ends, in this order; None without pole merge."""
    on_tube: bool
    """Whether D is as long as 1 across instead of 1."""
    in_world: bool
    """Whether up is the world's, so that ``upright`` goes with the pose."""
    opening: Aperture | None = None
    """The lens's; None for a pinhole."""

    key = "SPHERICAL_STEREO"
    label = "Spherical Stereo"
    description = "An eye that stands beside each of the camera's rays"
    group = "Blender's Own"
    central = False
    smooth = False  # where the offset ends
    by_polynomials = True
    FORMULA = (
        Step("Direction without stereo, in a frame whose z is up", "D"),
        Step("To its right", "side = D x up / |D x up|"),
        Step("Offset, faded by the pole merge", "e = -+ distance/2 cos(pi/2 (|asin(D_up)| - from) / (to - from))"),
        Step("Origin", "o = e side"),
        Step("Direction, of any length; parallel eyes: D", "d = D - (e / convergence distance) side"),
    )

    def rays(self, x, y):
        """See Model: unit length; without a ray where the lens has none, and straight up and down."""
        return self._beside(self.lens.rays(x, y)[1], self.on_tube)

    def through(self, aperture, chief, x, y, point):
        """See Model: the eye is beside the ray that has passed the lens."""
        origin, direction = self.lens.through(aperture, self.lens.rays(x, y), x, y, point)
        beside, direction = self._beside(direction, False)
        return along(origin, beside, 1.0), direction

    def aperture(self, raw, pose):
        """See Model."""
        return self.opening

    def _beside(self, direction, on_tube: bool):
        """Return origin and direction of the ray of an eye beside one of the lens, from the eye's place on."""
        ahead = unit(matvec(self.upright, direction))
        across = np.sqrt(ahead[0] * ahead[0] + ahead[1] * ahead[1])
        across = np.where(across > 0, across, np.nan)
        share = self._offset_at(_altitude(across, np.abs(ahead[2]), on_tube)) / across
        beside = ahead[1] * share, -ahead[0] * share, 0.0
        turn = self.nearness * across if on_tube else self.nearness
        turned = difference(ahead, tuple(turn * component for component in beside))
        return matvec(self.tilted, beside), unit(matvec(self.tilted, turned))

    def project(self, points):
        """See Model: in closed form, with a pole merge by bisection; NaN also where no ray comes as near to the axis.
        Points no farther than the offset from the camera (from its axis, for the central cylindrical panorama) may have
        no pixel, and those that a ray grazes only to the root of EPS.
        """
        with np.errstate(all="ignore"):  # NaN is an answer
            x, y, z = matvec(self.upright, components(np.asarray(points, np.float64)))
            across = np.hypot(x, y)
            flat, aside = self._flat_and_aside(across, z, self._offset_towards(across, np.abs(z)))
            scale = np.where(across > 0, flat / np.where(across > 0, across, 1.0) ** 2, 0.0)
            ahead = (x * flat - y * aside) * scale, (y * flat + x * aside) * scale, np.where(np.isnan(flat), flat, z)
            return self.lens.project(np.stack(matvec(self.tilted, ahead), axis=-1))

    def bounds(self, centers, radii):
        """See Model: u D lies no farther from a point that it sees than (1 - u / c) e, which the lens blurs, too."""
        there, back = (float(np.linalg.norm(matrix, 2)) for matrix in (self.upright, self.tilted))
        offset, wide = abs(self.offset), self.opening.widest if self.opening else 0.0
        blur = wide / abs(self.opening.focus) if self.opening else 0.0
        farthest = there * (np.sqrt((centers * centers).sum(axis=1)) + radii + wide) + self.nearness * offset**2
        beside = offset * np.maximum(1.0, self.nearness * farthest - 1)
        return self.lens.bounds(centers, radii + back * beside * (1 + blur))

    def posed(self, pose):
        """See Model."""
        return replace(self, upright=_rows(pose.basis), tilted=_rows(inverse(pose.basis))) if self.in_world else self

    def facts(self):
        """See Model."""
        return {"lens": self.lens.label, "eye_offset": self.offset, **self.lens.facts()}

    @property
    def disc(self) -> Disc | None:
        """See Model."""
        return self.lens.disc

    @lazy
    def endless(self) -> Model:
        """See Model."""
        return replace(self, lens=self.lens.endless)

    @property
    def ray_rounding(self) -> float:
        """See Model."""
        return self.lens.ray_rounding + gamma(32)

    def pixel_rounding(self, x, y):
        """See Model: that of the lens, and what the rounding of D is in pixels, since a side turns fast near a pole."""
        here = self.lens.rays(x, y)[1]
        moves = [norm(difference(self.lens.rays(*near)[1], here)) for near in ((x + STEP, y), (x, y + STEP))]
        rounding = gamma(32) * norm(here) * STEP / np.maximum(*moves)
        return tuple(own + rounding for own in self.lens.pixel_rounding(x, y))

    def _offset_at(self, altitude):
        if self.merge is None:
            return self.offset
        begin, end = self.merge
        fade = np.cos(pi / 2 * np.maximum(altitude - begin, 0.0) / (end - begin if end > begin else 1.0))
        return self.offset * np.where(altitude > end, 0.0, fade)

    def _flat_and_aside(self, across, z, offset):
        """Return how far across a point is along its direction D, and how far to the side of it."""
        size = across if self.on_tube else np.hypot(across, z)
        near, square = self.nearness, offset * offset
        stretch = 1 + near * near * square
        along = (near * square + np.sqrt(size * size * stretch - square)) / stretch
        aside = (1 - along * near) * offset
        return np.sqrt((across - aside) * (across + aside)), aside

    def _offset_towards(self, across, z):
        """Return the offset of the ray that sees a point; z is not negative."""
        if self.merge is None:
            return self.offset
        seen = lambda offset: _altitude(self._flat_and_aside(across, z, offset)[0], z, self.on_tube)  # noqa: E731
        low, high = np.zeros(across.shape), np.full(across.shape, self.merge[1])
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            found = seen(self._offset_at(middle)) <= middle
            low, high = np.where(found, low, middle), np.where(found, middle, high)
        offset = self._offset_at(high)
        offset = np.where(np.abs(seen(offset) - high) <= MET, offset, np.nan)
        return np.where(seen(0.0) > self.merge[1], 0.0, offset)


def with_eye(lens: Model, raw: BlenderCamera, pose: Pose) -> Model:
    """Return the model of an eye of spherical stereo, where the record is one of those; else the lens."""
    settings = raw.settings
    side, distance = settings.get(EYE, 0.0), float(settings.get("interocular_distance", 0.0))
    if not side * distance:
        return lens
    convergence = inf if settings["convergence_mode"] == "PARALLEL" else float(settings["convergence_distance"])
    begin, end = (float(settings[f"pole_merge_angle_{word}"]) for word in ("from", "to"))
    eye = SphericalStereo(
        frame=lens.frame,
        lens=lens,
        upright=Y_UP,
        tilted=_rows(inverse(Y_UP)),
        offset=side * distance / 2 * (-1 if isinstance(lens, Mirrorball) else 1),
        nearness=1 / convergence,
        merge=(min(begin, end), end) if settings["use_pole_merge"] and end > 0 else None,
        on_tube=isinstance(lens, CentralCylindrical),
        in_world=isinstance(lens, Perspective),
        opening=lens.aperture(raw, pose),
    )
    return eye.posed(pose)


def _altitude(across, up, on_tube: bool):
    """Return what Cycles takes for the altitude of a direction, given across and up."""
    return np.arcsin(np.minimum(up / across, 1.0)) if on_tube else np.arctan2(up, across)


def _rows(matrix) -> Matrix:
    return tuple(tuple(row) for row in np.asarray(matrix, np.float64).tolist())
