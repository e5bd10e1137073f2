"""Blender's spherical stereo: each ray of a central camera begins to the left or right of the eye.

Assumption: D is the direction of the camera's own ray, in a frame whose y is up: the world's frame, turned, for
perspective cameras, the camera's frame for panoramas. D has unit length; for the central cylindrical panorama its
horizontal part has unit length instead.
Formula: side = (D x up) / |D x up|, offset e = -+ interocular distance / 2 for the left and the right eye; between the
altitudes |asin(D_up)| ``from`` and ``to`` of a pole merge, e is faded by cos(pi/2 (altitude - from) / (to - from)); it
is 0 above. Origin e side, direction D - (e / convergence distance) side, or D if the eyes are parallel.
As in Cycles, off-axis and toe-in are the same, the pivot and the shift of an eye are ignored, and the eyes of the
mirror ball are swapped. Depth is the distance from the ray's origin, also for perspective cameras. With depth of field
D is a ray through the lens, of unit length, and the eye moves with it.
Singular: straight up and down, where there is no side and no ray.
Inverse: with u the length along D and c the convergence distance, a point p = e side + u (D - (e / c) side) has
|p|^2 = u^2 + (1 - u / c)^2 e^2, which has one positive u for points farther away than e. With a pole merge e depends on
the altitude, which is found by bisection.
References: Blender manual, Stereoscopy; source of Cycles, kernel/camera; rays read out of Cycles.
"""

from dataclasses import dataclass, replace
from math import inf, pi, sin, sqrt, tan

import numpy as np

from ..cameras.central_cylindrical import CentralCylindrical
from ..cameras.mirrorball import Mirrorball
from ..cameras.model import IN_RAYS, NOWHERE, Model, Step
from ..cameras.parts.aperture import Aperture
from ..cameras.parts.settings import Number
from ..cameras.perspective import Perspective
from ..conventions import gamma
from ..maths.panels import Disc
from ..maths.recording import may_hold
from ..maths.vector import along, components, difference, dot, inverse, matvec, norm
from ..records import BlenderCamera, InputError, Pose

EYE = "spherical_eye"
"""Key in a record's settings: -1.0 for the left eye, 1.0 for the right eye; without it the camera has one eye."""

INTEROCULAR = Number(
    "interocular_distance", "Interocular Distance", "Distance between the eyes", 0.065, -1e50, 1e50, "length"
)
CONVERGENCE = Number(
    "convergence_distance", "Convergence Distance", "Distance at which the eyes converge", 1.95, 1e-5, unit="length"
)
"""Blender's own settings, which its cameras have whatever their model."""

TO_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""Matrix from the world's frame to a frame whose y is the world's up."""

HALVINGS = 60
"""Number of halvings of the altitude range of a pole merge: down to rounding."""

MET = 1e-9
"""Largest error of the altitude, radians, at which bisection has found a ray; beyond it the offset jumps there. An eye
that converges within its offset multiplies it.
"""

SHORTEST = 1e-300
"""Range of altitudes, radians, in place of an empty one: the offset jumps there."""

RAY_SPACING = 2.0**-10
"""Distance in pixels between the rays that measure how far a move of the pixel turns a ray."""

Matrix = tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class SphericalStereo(Model):
    """An eye: a central model, and the offset of the eye from each of its rays."""

    lens: Model
    upright: Matrix | None
    """(3, 3), from the camera's frame to a frame whose y is the world's up; None if the camera's y is up."""
    tilted: Matrix | None
    """Its inverse."""
    offset: float
    """Distance of the eye to the right of a ray; Blender units."""
    nearness: float
    """1 over the convergence distance; 0 for parallel eyes."""
    merge: tuple[float, float] | None
    """The altitudes, rad, at which the offset begins to fade and at which it ends; None without pole merge."""
    on_tube: bool
    """Whether the horizontal part of D has unit length, instead of D."""
    opening: Aperture | None = None
    """The aperture of the lens; None for a pinhole."""

    key = "SPHERICAL_STEREO"
    label = "Spherical Stereo"
    description = "An eye offset sideways from each of the camera's rays"
    group = "Blender's Own"
    central = False
    smooth = False  # not where the offset ends
    guarded = False  # the world's up is known to float32's rounding of the pose, 1e-7, and so is the inverse
    FORMULA = (
        Step("Direction without stereo, in a frame whose y is up", "D"),
        Step("Unit vector to the right of the direction", "side = D x up / |D x up|"),
        Step("Offset, faded by the pole merge", "e = -+ distance/2 cos(pi/2 (|asin(D_up)| - from) / (to - from))"),
        Step("Origin", "o = e side"),
        Step("Direction, of any length; parallel eyes: D", "d = D - (e / convergence distance) side"),
    )

    def rays(self, x, y):
        """See Model: unit length; no ray where the lens has none, and straight up and down."""
        return self._beside(self.lens.rays(x, y)[1], not self.lens.planar, self.on_tube)

    def through(self, aperture, chief, x, y, point):
        """See Model: the eye is offset from the ray that has passed the lens."""
        origin, ahead = self.lens.through(aperture, self.lens.rays(x, y), x, y, point)
        beside, direction = self._beside(ahead, False, False)
        return along(origin, beside, 1.0), direction

    def aperture(self, raw, pose):
        return self.opening

    def _beside(self, ahead, is_unit: bool, on_tube: bool):
        """Return origin and unit direction of the eye's ray that belongs to a ray of the lens with the direction
        ``ahead`` = ``size`` D, in the camera's frame. ``is_unit``: whether ``ahead`` has unit length.
        """
        x, up, z = upright = _turned(self.upright, ahead)
        across = np.sqrt(x * x + z * z)
        across = np.where(across > 0, across, np.nan)
        square = 1.0 if is_unit else dot(upright, upright)
        size = across if on_tube else np.sqrt(square)
        offset = self._offset_beside(np.abs(up) / across, on_tube) if self.merge else self.offset
        share = offset / across
        beside = _turned(self.tilted, (-z * share, 0.0, x * share))  # NaN straight up and down
        turn = self.nearness * size
        scale = 1 / np.sqrt(square + (turn * offset) ** 2)  # the side is perpendicular to D
        return beside, tuple(scale * (a - turn * b) for a, b in zip(ahead, beside, strict=True))

    def project(self, points):
        """See Model: in closed form, with a pole merge by bisection; NaN also for points nearer to the axis than any
        ray. Points within the offset of the camera (of its axis, for the central cylindrical panorama) may have no
        pixel; the pixel of a point that a ray grazes is right only to the square root of EPS.
        """
        with np.errstate(all="ignore"):  # NaN means no pixel
            x, up, z = _turned(self.upright, components(np.asarray(points, np.float64)))
            across = np.hypot(x, z)
            flat, aside = self._flat_and_aside(across, up, self._offset_towards(across, np.abs(up)))
            scale = np.where(across > 0, flat / np.where(across > 0, across, 1.0) ** 2, 0.0)
            ahead = (x * flat + z * aside) * scale, np.where(np.isnan(flat), flat, up), (z * flat - x * aside) * scale
            return self.lens.project(np.stack(_turned(self.tilted, ahead), axis=-1))

    def bounds(self, centers, radii):
        """See Model: u D is at most (1 - u / c) e away from the seen point; the lens blurs this distance, too."""
        there, back = (1.0 if matrix is None else float(np.linalg.norm(matrix, 2))
                       for matrix in (self.upright, self.tilted))  # fmt: skip
        offset, wide = abs(self.offset), self.opening.widest if self.opening else 0.0
        blur = wide / abs(self.opening.focus) if self.opening else 0.0
        farthest = there * (np.sqrt((centers * centers).sum(axis=1)) + radii + wide) + self.nearness * offset**2
        beside = offset * np.maximum(1.0, self.nearness * farthest - 1)
        return self.lens.bounds(centers, radii + back * beside * (1 + blur))

    def posed(self, pose):
        if not isinstance(self.lens, Perspective):
            return self
        upright = _rows(TO_Y_UP @ pose.basis)
        return replace(self, upright=upright, tilted=_rows(inverse(upright)))

    def settled(self):
        return replace(self, lens=self.lens.settled())

    def facts(self):
        return {"lens": self.lens.label, "eye_offset": self.offset, **self.lens.facts()}

    @property
    def disc(self) -> Disc | None:
        return self.lens.disc

    @property
    def polynomials(self) -> int:  # type: ignore[override]
        """See Model: not for the mirror ball: most panels lie at rim or poles; 1.9 times the time with polynomials."""
        return NOWHERE if isinstance(self.lens, Mirrorball) else IN_RAYS

    @property
    def endless(self) -> Model:
        return replace(self, lens=self.lens.endless)

    @property
    def ray_rounding(self) -> float:
        return self.lens.ray_rounding + gamma(32)

    def pixel_rounding(self, x, y):
        """See Model: the rounding of the lens, plus that of D in pixels, since ``side`` turns fast near a pole."""
        here = self.lens.rays(x, y)[1]
        beside = (x + RAY_SPACING, y), (x, y + RAY_SPACING)
        moves = [norm(difference(self.lens.rays(*pixel)[1], here)) for pixel in beside]
        rounding = self._amplified * gamma(32) * norm(here) * RAY_SPACING / np.maximum(*moves)
        return tuple(of_lens + rounding for of_lens in self.lens.pixel_rounding(x, y))

    @property
    def _amplified(self) -> float:
        """How much the rounding of D grows from a ray to a point and back: by the offset over the convergence distance
        each time, since beside this much of ``side`` D is a small part of the ray.
        """
        return 1 + (self.offset * self.nearness) ** 2

    def _offset_beside(self, slope, on_tube: bool):
        """Return the offset of the rays whose D has this vertical part, not negative, over its horizontal part."""
        begin, _ = self.merge or (inf, inf)
        fades = slope > (sin(begin) if on_tube else tan(begin))
        return self._offset_at(_altitude(slope, on_tube)) if may_hold(fades) else self.offset

    def _offset_at(self, altitude):
        if self.merge is None:
            return self.offset
        begin, end = self.merge
        quarter = pi / 4 / max(end - begin, SHORTEST)
        half = np.tan(np.minimum(np.maximum((end - altitude) * quarter, 0.0), pi / 4))
        return 2 * self.offset * half / (1 + half * half)  # sin of twice the angle: np.sin takes 9 times as long

    def _flat_and_aside(self, across, z, offset):
        """Return the horizontal distance of a point along its direction D, and the distance to the side of D."""
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
        seen = lambda offset: _altitude(z / self._flat_and_aside(across, z, offset)[0], self.on_tube)  # noqa: E731
        low, high = np.zeros(across.shape), np.full(across.shape, self.merge[1])
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            is_above = seen(self._offset_at(middle)) <= middle
            low, high = np.where(is_above, low, middle), np.where(is_above, middle, high)
        offset = self._offset_at(high)
        met = MET * sqrt(self._amplified)
        offset = np.where(np.abs(seen(offset) - high) <= met, offset, np.nan)
        return np.where(seen(0.0) > self.merge[1], 0.0, offset)


def with_eye(lens: Model, raw: BlenderCamera, pose: Pose) -> Model:
    """Return the model of an eye of spherical stereo if the record describes such an eye; else the lens.

    Raises InputError for a lens behind a port.
    """
    settings = raw.settings
    side = settings.get(EYE, 0.0)
    if not side or not settings.get(INTEROCULAR.name, 0.0):
        return lens
    if not lens.central:
        raise InputError(f"camera {raw.name!r} has Spherical Stereo and a port: disable one of them")
    distance = INTEROCULAR.read(raw)
    convergence = inf if settings["convergence_mode"] == "PARALLEL" else CONVERGENCE.read(raw)
    begin, end = (float(settings[f"pole_merge_angle_{word}"]) for word in ("from", "to"))
    eye = SphericalStereo(
        size=lens.size,
        lens=lens,
        upright=None,
        tilted=None,
        offset=side * distance / 2 * (-1 if isinstance(lens, Mirrorball) else 1),
        nearness=1 / convergence,
        merge=(min(begin, end), end) if settings["use_pole_merge"] and end > 0 else None,
        on_tube=isinstance(lens, CentralCylindrical),
        opening=lens.aperture(raw, pose),
    )
    return eye.posed(pose)


def _altitude(slope, on_tube: bool):
    """Return the altitude of a direction as Cycles computes it, from its vertical part over its horizontal part."""
    if not on_tube:
        return np.arctan(slope)
    within = slope < 1
    return np.where(within, np.arcsin(np.where(within, slope, 0.0)), pi / 2)  # with the derivative 0 beyond


def _turned(matrix: Matrix | None, vector):
    return vector if matrix is None else matvec(matrix, vector)


def _rows(matrix) -> Matrix:
    return tuple(tuple(row) for row in np.asarray(matrix, np.float64).tolist())
