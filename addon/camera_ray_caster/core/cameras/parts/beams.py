"""The beams of a scanner: their table, the rays between two of them, and the way back from points.

Places in the rows count beams from the lower edge of the frame, 0: beam k is in the middle of its row, at k + 1/2.
Between the middles all numbers of the beams are linear, and beyond the outermost as before them.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from ...maths.recording import look_up
from ...maths.speed import lazy
from ...records import BlenderCamera, InputError
from .scanners import AHEAD, AZIMUTHS, DELAYS, RIGHT, UP, Table
from .silhouette import PIXEL_MARGIN

MICRO = 1e-6
"""Seconds in a microsecond."""

NARROWEST = 1e-9
"""Elevation, in radians, by which bounds are widened, so that beams at the same elevation are told apart."""

NEWTON_STEPS = 8
"""Number of steps of Newton's method between two beams: for 16 digits four are enough from a tenth of a meter on."""

MISSED = 1e-9
"""Rows by which a place between two beams may be off and still count."""


@dataclass(frozen=True)
class Beams:
    """The beams from the lowest up, (b,) arrays."""

    elevation: np.ndarray
    """Ascending, radians."""
    azimuth: np.ndarray
    """Clockwise from the head's when the column begins to the beam's when it fires, radians."""
    offsets: np.ndarray
    """(b, 3): origins ahead, to the right and up, in the azimuth of the beam."""
    delay: np.ndarray
    """Seconds from the column's begin until the beam fires."""
    ring: np.ndarray
    """int: numbers of the beams in files; see ``_rings``."""
    height: float
    """Elevation that the row of a single beam covers, radians."""

    @classmethod
    def of(cls, raw: BlenderCamera, elevations: np.ndarray, row_time: float, speed: float, height: float) -> Beams:
        """Return the beams of a record, given their elevations in the order of its tables, the seconds from row to row,
        and how fast the head turns clockwise, radians a second. Raises InputError for tables of unequal length, and for
        elevations that are all the same or beyond the zenith.
        """
        count, order = len(elevations), np.argsort(elevations, kind="stable")
        tables = AZIMUTHS, AHEAD, RIGHT, UP, DELAYS
        azimuth, ahead, right, up, delay = (_of_beams(raw, table, count)[order] for table in tables)
        lowest, highest = elevations[order[0]], elevations[order[-1]]
        if not -pi / 2 <= lowest <= highest <= pi / 2 or (lowest == highest and count > 1):
            raise InputError(
                f"beams of camera {raw.name!r} have elevations from {np.degrees(lowest):.6g} to "
                f"{np.degrees(highest):.6g} degrees: they must differ, between -90 and 90"
            )
        delay = MICRO * delay + row_time * np.arange(count)
        positions = np.stack((ahead, right, up), axis=1)
        azimuth = np.radians(azimuth)
        if delay.any():
            azimuth = azimuth + speed * delay
        return cls(elevations[order], azimuth, positions, delay, _rings(elevations)[order], height)

    def __len__(self) -> int:
        return len(self.elevation)

    def between(self, row):
        """Return elevation, azimuth, and origin ahead, to the right and up at places in the rows."""
        beam = np.searchsorted(np.arange(1.5, len(self)), row, side="right")
        share = row - (beam + 0.5)
        return [
            look_up(values, beam) + share * look_up(step, beam) if step.any() else look_up(values, beam)
            for values, step in zip(self.numbers, self.steps, strict=True)
        ]

    def towards(self, across: np.ndarray, up: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the places in the rows whose rays meet points, NaN where none does, and the azimuths of the points
        beside that of the head. Points are given by distances from the axis and heights; of several rows that meet
        them, near the device, it is the highest.

        Where all beams have one origin, the place is linear in the elevation; else Newton's method finds it.
        """
        beam, share, last = np.zeros(across.shape, int), np.zeros(across.shape), len(self) - 1
        is_linear = not np.ptp(self.offsets, axis=0).any()
        if is_linear:
            seen = self._looks(0, 0.0, across, up)[0] + self.elevation[0]
            beam = np.maximum(np.searchsorted(self.elevation, seen, side="right") - 1, 0)
        else:
            for k in range(1, len(self)):
                beam[self._looks(k, 0.0, across, up)[0] >= 0] = k
        low, high = np.where(beam == 0, -np.inf, 0.0), np.where(beam == last, np.inf, 1.0)
        for _ in range(1 if is_linear else NEWTON_STEPS):
            above, slope, _ = self._looks(beam, share, across, up)
            share = np.clip(share - above / slope, low, high)
        above, slope, past = self._looks(beam, share, across, up)
        met = np.abs(above) <= MISSED * np.abs(slope)
        return np.where(met, beam + 0.5 + share, np.nan), past + self.azimuth[beam] + share * self.steps[1][beam]

    def _looks(self, beam, share, across, up):
        """Return the elevation of points beside that of the ray that passes them at a place between two beams, its
        derivative by that place, and the azimuth of the points beside the ray's.
        """
        steps = [step[beam] for step in self.steps]
        numbers = [values[beam] + share * step for values, step in zip(self.numbers, steps, strict=True)]
        elevation, _, ahead, right, high = numbers
        way = np.sqrt(np.where(across >= np.abs(right), (across - right) * (across + right), np.nan))
        length, rise = way - ahead, up - high
        length = np.where((length > 0) | ((length == 0) & (rise != 0)), length, np.nan)
        farther = -right / np.where(way > 0, way, 1.0) * steps[3] - steps[2]
        turn = (-steps[4] * length - rise * farther) / (length * length + rise * rise)
        return np.arctan2(rise, length) - elevation, turn - steps[0], np.arctan2(right, way)

    def covering(self, bottom: np.ndarray, top: np.ndarray):
        """Return the lowest and the highest place in the rows between two elevations, and the least and the largest
        azimuth there, (n,) each.
        """
        rows = [np.interp(end, *self._profile) for end in (bottom - NARROWEST, top + NARROWEST)]
        first = np.maximum(np.floor(rows[0] + 0.5 - PIXEL_MARGIN).astype(int), 0)
        last = np.minimum(np.ceil(rows[1] + 0.5 + PIXEL_MARGIN).astype(int), len(self) + 1)
        level = np.frexp(last - first + 1.0)[1] - 1
        second, (low, high) = last + 1 - (1 << level), self._ranges
        least = np.minimum(low[level, first], low[level, second])
        return *rows, least, np.maximum(high[level, first], high[level, second])

    @lazy
    def numbers(self) -> tuple[np.ndarray, ...]:
        """Elevation, azimuth, and origin ahead, to the right and up, (b,) each."""
        return self.elevation, self.azimuth, *self.offsets.T.copy()

    @lazy
    def steps(self) -> tuple[np.ndarray, ...]:
        """What ``numbers`` change by from each beam to the next, and from the last as from the one before it."""
        if len(self) == 1:
            return np.array([self.height]), *(np.zeros(1) for _ in range(4))
        steps = [np.diff(np.append(values, 2 * values[-1] - values[-2])) for values in self.numbers]
        steps[0][-1] = steps[0][-1] or steps[0].max()  # the two highest may look at one elevation
        return tuple(steps)

    @lazy
    def ends(self) -> tuple[np.ndarray, ...]:
        """``numbers`` with those of the lower and the upper edge of the frame, (b + 2,) each."""
        return tuple(
            np.concatenate((values[:1] - step[:1] / 2, values, values[-1:] + step[-1:] / 2))
            for values, step in zip(self.numbers, self.steps, strict=True)
        )

    @lazy
    def _profile(self) -> tuple[np.ndarray, np.ndarray]:
        """Elevations, ascending, and their places in the rows, from edge to edge of the frame."""
        places = np.clip(np.arange(-0.5, len(self) + 1), 0, len(self))
        return self.ends[0] + NARROWEST / len(places) * np.arange(len(places)), places

    @lazy
    def _ranges(self) -> tuple[np.ndarray, np.ndarray]:
        """(levels, b + 2) each: least and largest azimuth of the 2 ** level entries of ``ends`` from each on."""
        low = high = self.ends[1]
        tables, step, index = [(low, high)], 1, np.arange(len(low))
        while 2 * step <= len(low):
            ahead = np.minimum(index + step, len(low) - 1)
            low, high = np.minimum(low, low[ahead]), np.maximum(high, high[ahead])
            tables.append((low, high))
            step *= 2
        return np.array([low for low, _ in tables]), np.array([high for _, high in tables])


def _of_beams(raw: BlenderCamera, table: Table, count: int) -> np.ndarray:
    """Return the numbers of a table, one for each beam. Raises InputError if it has another number of them."""
    values = np.array(table.read(raw) or (0.0,))
    if len(values) not in (1, count):
        raise table.refusal(raw, f"{len(values)} numbers", f"{count}, one for each beam, or one for all")
    return np.broadcast_to(values, count)


def _rings(elevations: np.ndarray) -> np.ndarray:
    """Return the numbers of beams in files: their places in a table that is in order, up as drivers of Velodyne have
    it, or down as Ouster and Hesai; of others, as Velodyne's lasers, their ranks from the lowest up.
    """
    falls = (np.diff(elevations) <= 0).all()
    rank = np.empty(len(elevations), int)
    rank[np.argsort(-elevations if falls else elevations, kind="stable")] = np.arange(len(elevations))
    return rank
