"""The prescription of a lens: its surfaces from the scene to the film, as lens files and patents list them.

A radius of curvature is positive if its center lies on the film's side. ``index`` is that of the medium behind a
surface, at the d line (587.5618 nm). All lengths are in millimeters.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf, isfinite

from ..records import InputError

D_LINE, F_LINE, C_LINE = 587.5618, 486.1327, 656.2725
"""Wavelengths in nm: of the refractive index, and of the dispersion in Abbe's number (n_d - 1) / (n_F - n_C)."""

LONGEST_LENGTH = 1e7
"""Largest length of a prescription in mm."""


@dataclass(frozen=True)
class Row:
    """A surface, and the gap to the next one."""

    curvature: float
    """1 / radius; 0 for a plane and for the stop."""
    gap: float
    """Distance to the next surface; that of the last one is the file's distance to the film, or 0."""
    index: float
    """Index of refraction behind the surface."""
    rim: float
    """Radius of the clear aperture; inf if it is unknown."""
    conic: float = 0.0
    asphere: tuple[tuple[int, float], ...] = ()
    """Powers of the distance from the axis with their coefficients, which are added to the conic's sag."""
    abbe: float = inf
    """Abbe's number; inf if the dispersion is unknown."""
    sellmeier: tuple[float, ...] = ()
    """B1, B2, B3, C1, C2, C3 of n^2 = 1 + sum B L^2 / (L^2 - C), with L in micrometers; empty if they are unknown."""
    label: str = ""
    """Name of the surface in messages."""

    def index_at(self, wavelength: float) -> float:
        """Return the index at a wavelength in nm: by Sellmeier's formula, or by Cauchy's n = p + q / L^2 through n_d
        and Abbe's number. Without dispersion it is the index at the d line.
        """
        if self.sellmeier:
            squared = (wavelength * 1e-3) ** 2
            terms = zip(self.sellmeier[:3], self.sellmeier[3:], strict=True)
            return (1 + sum(b * squared / (squared - c) for b, c in terms)) ** 0.5
        if not isfinite(self.abbe) or wavelength == D_LINE:
            return self.index
        q = (self.index - 1) / self.abbe / (F_LINE**-2 - C_LINE**-2)
        return self.index + q * (wavelength**-2.0 - D_LINE**-2)


@dataclass(frozen=True)
class Prescription:
    """A lens as its file gives it."""

    rows: tuple[Row, ...]
    stop: int
    """Place of the stop in ``rows``."""
    name: str = ""
    source: str = ""
    """Patent or book from which the numbers are taken."""
    before: float = 1.0
    """Index of the medium in front of the lens."""
    claims: dict[str, float] = field(default_factory=dict, hash=False)
    """What the file itself states: focal length, f-number, back focus, by the names of ``facts``."""
    states: tuple[tuple[str, tuple[tuple[int, float], ...]], ...] = ()
    """Configurations of a zoom or of floating elements: a name, and the rows whose gaps differ, with these gaps."""

    def in_state(self, state: float) -> Prescription:
        """Return the lens in a configuration: ``state`` counts them from 0, and between two of them the gaps are
        interpolated linearly. A lens without configurations is returned as it is.
        """
        if not self.states:
            return self
        state = min(max(state, 0.0), len(self.states) - 1.0)
        first = min(int(state), len(self.states) - 1)
        after = min(first + 1, len(self.states) - 1)
        share = state - first
        gaps, others = dict(self.states[first][1]), dict(self.states[after][1])
        rows = list(self.rows)
        for row, gap in gaps.items():
            rows[row] = replace(rows[row], gap=gap + share * (others.get(row, gap) - gap))
        return replace(self, rows=tuple(rows), states=())

    def at(self, wavelength: float) -> Prescription:
        """Return the lens with its indices at a wavelength in nm."""
        if wavelength == D_LINE:
            return self
        return replace(self, rows=tuple(replace(row, index=row.index_at(wavelength)) for row in self.rows))

    def in_words(self, row: int) -> str:
        """Return the name of a surface in messages, such as "surface 3"."""
        return f"surface {self.rows[row].label or row + 1}"


def checked(lens: Prescription) -> Prescription:
    """Return a prescription whose numbers are sound.

    Raises InputError, which names the surface, for numbers that are not finite or too large, for an index below 1, and
    for a rim beyond a sphere: a semi-diameter above the radius of curvature is a doubled diameter.
    """
    if len(lens.rows) < 2:
        raise InputError("a lens needs at least two surfaces: one that refracts, and the stop")
    if not any(row.curvature or row.asphere for row in lens.rows):
        raise InputError("no surface of the lens is curved: nothing focuses")
    for index, row in enumerate(lens.rows):
        name = lens.in_words(index)
        numbers = {"gap": row.gap, "curvature": row.curvature, "conic constant": row.conic, "index": row.index}
        numbers |= {f"coefficient of r^{power}": value for power, value in row.asphere}
        for quantity, value in numbers.items():
            if not (isfinite(value) and abs(value) <= LONGEST_LENGTH):
                raise InputError(f"{name} has the {quantity} {value:g}: it must be a finite number")
        if not 1 <= row.index <= 5:
            raise InputError(f"{name} has the index of refraction {row.index:g}: it must be from 1 to 5")
        if not row.rim > 0:
            raise InputError(f"{name} has the clear radius {row.rim:g} mm: it must be above 0")
        reach = (1 + row.conic) * row.curvature**2 * row.rim**2
        if reach > 1 + 1e-6 and isfinite(row.rim):
            raise InputError(
                f"{name} has a clear radius of {row.rim:g} mm on a radius of curvature of {1 / row.curvature:g} mm: it "
                "must not reach beyond the sphere; is it a diameter?"
            )
        if not row.abbe > 0:
            raise InputError(f"{name} has the Abbe number {row.abbe:g}: it must be above 0")
    if not isfinite(lens.rows[lens.stop].rim):
        raise InputError(f"{lens.in_words(lens.stop)}, the stop, has no radius: give its clear aperture")
    return lens
