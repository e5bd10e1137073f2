"""A real lens: rays are traced through the surfaces of a prescription, from a lens file.

Assumptions: geometric optics, centered surfaces that refract: spheres, conics, aspheres and planes; no reflections
between them, no diffraction. Chief rays pass the center of the stop, and are polynomials of the radius on the film
(``core.lenses.chief``); rays of the aperture are traced surface by surface (``parts.pupil``). The eye is the center of
the paraxial entrance pupil, so that framing and focus distance are those of a thin lens of the same focal length.
Blender's Focal Length scales the whole lens. The film stands where the plane at the focus distance is sharpest. A
tilted film tilts the plane of focus (``parts.tilted_film``).
Formula: with (a, b) the pixel on the film, upright, and h, z and q = tan(theta / 2) / r as functions of its length r,
o = (a h, b h, z), r = (2 q a, 2 q b, q^2 r^2 - 1) / (1 + q^2 r^2). There is no ray where a rim is in the way.
References: C. Kolb, D. Mitchell, P. Hanrahan, A Realistic Camera Model for Computer Graphics (1995);
W. Smith, Modern Optical Engineering, 4th ed. (2008).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..conventions import gamma
from ..lenses.chief import DEGREE, ChiefRays, chief_rays
from ..lenses.focus import chief_of, focused, optics_of, own_focal_length
from ..lenses.optics import Optics
from ..lenses.prescription import Prescription
from ..lenses.read import read_lens
from ..maths.recording import NotRecordable, is_recorded
from ..maths.speed import lazy
from ..maths.vector import components
from ..records import BlenderCamera, InputError, Pose, Raster
from .model import IN_RAYS, Step, WindowModel
from .parts.aperture import F_STOP, FOCUS_DISTANCE, Aperture, focus_of, thin_lens
from .parts.calibration import TAU_X, TAU_Y
from .parts.chief_search import ChiefSearch
from .parts.differences import varied_by
from .parts.film import FILM, LENS, Film, Window
from .parts.lens_facts import MILLIMETER, TILTED, UPRIGHT, facts_of
from .parts.lens_settings import COLOR, COLORS, FALLOFF, FOCUS, LENS_FILE, PARAXIAL, STATE, VIGNETTING, WAVELENGTH
from .parts.pose import pose_from
from .parts.pupil import Pupil, color_of, from_film, light_of, measured, of_color
from .parts.radial import RIM_SLACK
from .parts.silhouette import pixel_bounds, radial_intervals
from .parts.tilt import Tilt
from .parts.tilted_film import UPRIGHT_FILM, TiltedFilm

ROUNDED = 0.034
"""A tenth of a stop, as a share of the f-number: a lens that is called f/2 may open to 2.03."""

BLUR_SAMPLES = 9
"""Places of a tilted film across and up, at which its blur is measured."""

TRACED = LENS, FOCUS_DISTANCE, F_STOP, STATE, WAVELENGTH
"""Numbers that have a new family of chief rays; their derivatives are those of differences."""


@dataclass(frozen=True)
class RealLens(WindowModel):
    """The window gives the place on the film, upright, in mm of the lens file, in the film's own plane."""

    chief: ChiefRays
    optics: Optics
    film: float
    """z of the film in the lens frame, mm of the file."""
    pupil: float
    """z of the entrance pupil, mm of the file: the origin of the camera's frame."""
    unit: float
    """Blender units per mm of the file."""
    radius: float
    """Of the stop, mm of the file."""
    focus: float
    """Depth of the plane of focus, Blender units."""
    vignetting: bool = True
    falls_off: bool = True
    tilted: TiltedFilm = UPRIGHT_FILM
    prescription: Prescription | None = None

    key = "REAL_LENS"
    label = "Real Lens"
    description = "Rays traced through the glass of a lens file: distortion, vignetting and blur of the real lens"
    group = "Real Lens"
    number = 28
    central = False
    polynomials = IN_RAYS  # 0.1 of the time of a whole picture's rays
    SETTINGS = (
        LENS_FILE, LENS, FOCUS, FOCUS_DISTANCE, F_STOP, STATE, WAVELENGTH, VIGNETTING, FALLOFF, COLOR, TAU_X, TAU_Y,
        *FILM,
    )  # fmt: skip
    FORMULA = UPRIGHT

    @property
    def steps(self) -> tuple[Step, ...]:
        return (*TILTED, *self.FORMULA[1:]) if self.tilted else self.FORMULA

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> RealLens:
        """Build the lens of a file, focused. Raises InputError for a file that cannot be read, for a focus distance
        nearer than the lens allows, and for a film that is tilted into the lens.
        """
        prescription = read_lens(LENS_FILE.read(raw))
        if is_recorded(*(setting.read(raw) for setting in (*TRACED, TAU_X, TAU_Y))):
            raise NotRecordable("a lens is traced anew for these settings")
        try:
            optics = optics_of(prescription, STATE.read(raw), WAVELENGTH.read(raw))
            unit = LENS.read(raw) * MILLIMETER / own_focal_length(prescription)
            distance = focus_of(raw, pose_from(raw)) / unit
            if not distance > optics.nearest_focus:
                wanted, nearest = (f"{float(length * unit):.6g}" for length in (distance, optics.nearest_focus))
                raise FOCUS_DISTANCE.refusal(raw, wanted, f"above {nearest}, since nothing nearer has an image")
            sharpest = FOCUS.read(raw) != PARAXIAL
            film, radius, eye, exit_pupil, *numbers = varied_by(
                lambda *settings: focused(prescription, sharpest, *settings),
                STATE.read(raw), WAVELENGTH.read(raw), distance, F_STOP.read(raw),
            )  # fmt: skip
        except InputError as error:
            raise InputError(f"{error}; lens file {LENS_FILE.read(raw)!r}") from error
        size = Film.from_blender(raw, raster).size * MILLIMETER / unit
        window = Window.from_blender(raw, raster, size)
        chief = chief_of(numbers, chief_rays(optics, float(film)))
        tilted = TiltedFilm(Tilt(TAU_X.read(raw), TAU_Y.read(raw)), film - exit_pupil)
        tilted.check(raw, chief, float(film) - optics.rear.z, window, raster.size)
        flags = VIGNETTING.read(raw), FALLOFF.read(raw)
        return cls(
            raster.size, window, chief, optics, film, eye, unit, radius, distance * unit, *flags, tilted, prescription
        )

    @classmethod
    def following(cls, settings: Mapping[str, Any]) -> dict[str, Any]:
        """See Model: the focal length of the file."""
        return {LENS.name: own_focal_length(read_lens(settings.get(LENS_FILE.name, "")))}

    def rays(self, x, y):
        """See Model. The errors are those of the polynomials, beside rounding; see ``formula_rounding``."""
        _, (a, b) = self.on_film(x, y)
        squared = a * a + b * b
        rim = self.chief.rim * (1 + RIM_SLACK)  # as a share of it
        passes, squared = squared <= rim * rim, np.minimum(squared, rim * rim)
        height, front, tangent = self.chief.at(squared)
        share = 2 / (1 + tangent * tangent * squared)
        across, out = np.where(passes, tangent * share, np.nan), height * self.unit
        return (a * out, b * out, self._depth(front)), (a * across, b * across, 1 - share)

    def on_film(self, x, y):
        """Return a pixel's point on the film, x and y upright and z in the lens frame, mm of the file, and the point of
        the upright film that has the same chief ray.
        """
        a, b = self.window.plane_from_pixels(x, y)
        return self.tilted.places(a, b, self.film), self.tilted.upright(self.chief, a, b)

    def _depth(self, z):
        """Return z in the camera's frame of z in the lens frame."""
        return (z - self.pupil) * self.unit

    def project(self, points):
        """See Model: NaN also for points behind the ray's origin."""
        x, y, z = components(np.asarray(points, np.float64))
        shape = np.shape(x)
        x, y, z = (np.atleast_1d(coordinate) for coordinate in (x, y, z))
        across = np.hypot(x, y)
        with np.errstate(all="ignore"):
            r = self.search.radius_of(across / self.unit, z / self.unit + self.pupil)
            scale = np.where(across > 0, r / np.where(across > 0, across, 1.0), np.where(r == 0, 0.0, np.nan))
            film_point = self.tilted.onto(self.chief, x * scale, y * scale)
            pixels = np.stack(self.window.pixels_from_plane(*film_point), axis=-1)
        return pixels.reshape(*shape, 2)

    @lazy
    def _family(self):
        """The same to the corners of the frame: rays of the aperture come where a rim stops the chief ray, too. Beyond
        the family's end they are bounded by the ray there; see ``parts.pupil``.
        """
        radii, angles, heights, places = self.search.up_to(min(self._corner, self.chief.end))
        radii = np.append(radii, max(radii[-1], self._corner))
        return radii, np.append(angles, np.nextafter(angles[-1], np.inf)), heights, places

    @lazy
    def _corner(self) -> float:
        """Radius of the frame's farthest corner on the upright film, with a pixel around the frame."""
        pixel = abs(self.window.pitch_x) + abs(self.window.pitch_y)
        return self.tilted.farthest(self.chief, self.window.corners(self.size)) + pixel

    @lazy
    def search(self) -> ChiefSearch:
        """The inverse of the chief rays."""
        return ChiefSearch(self.chief, float(self.pupil), self.chief.rim * (1 + RIM_SLACK / 2))

    def bounds(self, centers, radii):
        """See Model. A chief ray that meets a ball, moved to the eye, meets the ball that is larger by the distance of
        the eye from the ray's line; from its origin, if the ball is near.
        """
        reach = self.formula_reach
        away = np.sqrt((centers * centers).sum(axis=1)) - radii
        grown = radii + np.where(away > 2 * reach, self._wander, reach)
        radii, angles, _, _ = self._family
        intervals = radial_intervals(centers, grown, lambda theta: np.interp(theta, angles, radii), angles[-1])
        return pixel_bounds(self.window, *self.tilted.intervals(self.chief, radii, *intervals))

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture | None:
        """Return the entrance pupil, with what of the lens passes; None without depth of field."""
        thin = thin_lens(raw, pose, False)
        if thin is None:
            return None
        wide = float(self.radius * abs(self.optics.entrance_pupil[1]) * self.unit)
        pupil = Pupil(wide, thin.focus, thin.blades, thin.rotation, thin.ratio)
        numbers = float(self.radius), float(self.unit), self._corner, float(self.film)
        grid = np.meshgrid(*(np.linspace(0.0, side, BLUR_SAMPLES) for side in self.size))
        places = self.on_film(*map(np.ravel, grid)) if self.tilted else None
        pupil = measured(self.optics, self.chief, pupil, *numbers, places)
        return replace(pupil, colors=self._colors) if COLOR.read(raw) else pupil

    @property
    def _colors(self) -> tuple[tuple[float, ...], ...]:
        """Return the indices of COLORS before the lens and behind each surface; empty if they are all the same."""
        if self.prescription is None:
            return ()
        rows = (self.prescription.at(length).rows for length in COLORS)
        media = tuple(zip(*((row.index for row in each) for each in rows), strict=True))
        before = self.prescription.before
        return ((before, before, before), *media) if any(len(set(indices)) > 1 for indices in media) else ()

    def through(self, aperture: Any, chief, x, y, point):
        """See Model: through a point of the disc in the exit pupil. No light passes where the direction's x is NaN."""
        disc_point = tuple(coordinate / aperture.radius for coordinate in point)
        color = color_of(x, y) if aperture.colors else None
        film, upright = self.on_film(x, y)
        (ox, oy, oz), direction = from_film(self.optics, self.chief, aperture, film, upright, disc_point, color)
        return (ox * self.unit, oy * self.unit, self._depth(oz)), direction

    def light(self, aperture: Any, x, y, point):
        disc_point = tuple(coordinate / aperture.radius for coordinate in point)
        normal, (film, upright) = self.tilted.rows[2], self.on_film(x, y)
        value = light_of(self.chief, aperture, film, upright, disc_point, normal, self.falls_off, self.vignetting)
        if not aperture.colors:
            return value
        return tuple(of_color(color_of(x, y), np.eye(3)[k]) * (3 * value) for k in range(3))

    def remark(self, raw: BlenderCamera) -> str:
        asked, widest = F_STOP.read(raw), self.optics.widest_f_number
        if not raw.settings.get("use_dof") or asked > widest * (1 - ROUNDED):
            return ""
        return f"the lens opens to f/{widest:.3g}: it is cast with that stop in place of f/{asked:.3g}"

    @property
    def focused_at(self) -> float:  # type: ignore[override]
        return float(self.focus)

    @property
    def K(self) -> np.ndarray:
        """The camera matrix of the paraxial lens; see Model."""
        matrix = self.window.matrix(self.size[1])
        matrix[:2, :2] /= 2 * float(self.chief.at(np.float64(0.0))[2])
        return matrix

    def facts(self) -> dict[str, object]:
        return facts_of(self.prescription, self.optics, self.chief, *map(float, (self.unit, self.radius, self.film)))

    def formula_values(self, x, y):
        _, (a, b) = self.on_film(x, y)
        rim = self.chief.rim * (1 + RIM_SLACK)
        height, front, tangent = self.chief.at(np.minimum(a * a + b * b, rim * rim))
        known = {"h": height, "z": front - self.pupil, "q": tangent, "unit": self.unit, "pitch": self.window.pitch_x}
        return known | self.tilted.values(self.chief, *self.window.plane_from_pixels(x, y))

    @lazy
    def _wander(self) -> float:
        """The largest distance of a chief ray's line from the eye."""
        beside = self.search.beside(self._family[0][:-1], 0.0, self.pupil)[0]
        return float(np.abs(beside).max() * self.unit) * (1 + 1e-9)

    @lazy
    def formula_reach(self) -> float:
        """See Model: the largest distance of a ray's origin from the eye."""
        _, _, heights, places = self._family
        return float(np.hypot(heights, places - self.pupil).max() * self.unit) * (1 + 1e-9)

    def formula_rounding(self, x, y):
        """See Model: the polynomials' error beside the trace, and the rounding of their sums."""
        chief, steps = self.chief, np.array([1, *range(3, DEGREE + 3)])  # the first coefficient is added last
        series = chief.height, chief.front, chief.tangent
        height, front, tangent = (gamma(4) * float((np.abs(values) * steps).sum()) for values in series)
        origin, turned = chief.errors[0] + height * chief.rim + front, chief.errors[1] + 2 * tangent * chief.rim
        if self.tilted:
            off = self.tilted.rounding(chief, self.window.corners(self.size))
            radii, angles, *origins = self.search.table
            origin += off * float(np.hypot(*(np.gradient(values, radii) for values in origins)).max())
            turned += off * float(np.gradient(angles, radii).max())
        return float(origin * self.unit), turned
