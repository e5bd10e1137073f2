"""A scanner: a head that turns, with a row for each beam and a column for each step of the azimuth.

The camera looks ahead, up is up: azimuths a grow clockwise, seen from above, 0 is ahead. A beam has an elevation e, an
azimuth and an origin beside the head, and a time at which it fires; in the meantime the head turns on. Row 0 is the
lowest beam. The ray at the middle of a pixel is that of the beam; from there to the next row all is linear.
Formula: with the head's azimuth h of the column, a = h + azimuth of the beam + what the head turns until it fires,
o = (ahead sin a + right cos a, up, right sin a - ahead cos a), r = (cos e sin a, sin e, -cos e cos a).
The frame's width and height are those of the device, or any others, to which its columns and rows are stretched.
Singular: the axis, and the circle of the beams' origins. Near it beams whose origins differ may cross.
No derivatives and no flow: pixels sample a scene by beams, not by areas.
References: Velodyne, VLP-16 User Manual, section 9; Ouster, Software User Manual, Lidar Range to XYZ.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np

from ..conventions import gamma
from ..maths.recording.scalars import plain
from ..maths.speed import lazy
from ..maths.vector import components
from ..records import BlenderCamera, Raster
from .model import Firing, Model, Step
from .parts import scanners
from .parts.beams import MICRO, Beams
from .parts.calibration import FROM_FILE
from .parts.devices import DEVICE, DEVICES, Device
from .parts.settings import FULL_TURN
from .parts.silhouette import PIXEL_MARGIN, longitude_latitude, turned


@dataclass(frozen=True)
class Scanner(Model):
    """The beams, and the columns of a sweep."""

    beams: Beams
    start: float
    """Azimuth of the first column."""
    step: float
    """From column to column, radians clockwise."""
    columns: int
    """Of a sweep: the frame shows them all."""
    period: float
    """Seconds from column to column."""
    span: tuple[float, float]
    """The least and the largest range that is measured."""
    device: Device | None = None
    """None of one by the settings, or by a file."""

    key = "SCANNER"
    label = "Lidar Scanner"
    description = "Beams on a turning head: rows are beams, columns are steps of the azimuth"
    group = "Multiperspective"
    number = 27
    guarded = False
    smooth = False
    differentiable = False
    BESIDE_FILE = (*FROM_FILE, scanners.RATE, scanners.START)
    SETTINGS = (*FROM_FILE, DEVICE, scanners.RATE, scanners.START, *scanners.OF_DEVICE)
    FORMULA = (
        Step("Azimuth of the column and the row, clockwise", "a = start + (columns x/W - 1/2) step + azimuth"),
        Step("Elevation, linear between the beams", "e = elevation"),
        Step("Origin", "o = (ahead sin(a) + right cos(a), up, right sin(a) - ahead cos(a))"),
        Step("Direction", "r = (cos(e) sin(a), sin(e), -cos(e) cos(a))"),
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Scanner:
        """See Model: by the tables of its device, or its own. A sweep without a column is refused."""
        device = DEVICES.get(DEVICE.read(raw))
        if device is not None:
            values = {setting.name: setting.default for setting in scanners.OF_DEVICE} | device.settings
            raw = replace(raw, settings={**raw.settings, **values})
        elevations = np.radians(scanners.ELEVATIONS.read(raw))
        if not len(elevations):
            elevations = np.linspace(scanners.LOW.read(raw), scanners.HIGH.read(raw), raster.height)
        rate, sweep = scanners.RATE.read(raw), scanners.SWEEP.read(raw)
        period, columns = MICRO * scanners.PERIOD.read(raw), int(scanners.COLUMNS.read(raw)) or raster.width
        if period:
            columns = int(1 / (rate * period) + 1e-9)  # what fits in but for rounding
            if not columns:
                raise scanners.PERIOD.refusal(raw, "longer than a sweep", f"up to {1e6 / rate:.6g} microseconds")
        else:
            period = 1 / (rate * columns)
        speed = sweep * rate * (1.0 if scanners.DIRECTION.read(raw) == scanners.CLOCKWISE else -1.0)
        row_time = scanners.ROW_SHARE.read(raw) * period / len(elevations)
        beams = Beams.of(raw, elevations, row_time, speed, abs(speed * period))
        if np.abs(beams.delay).max() * rate > 1:
            raise scanners.DELAYS.refusal(raw, "longer than a sweep", f"up to {1e6 / rate:.6g} microseconds")
        limits = scanners.NEAREST.read(raw), scanners.FARTHEST.read(raw) or inf
        return cls(raster.size, beams, scanners.START.read(raw), speed * period, columns, period, limits, device)

    @property
    def central(self) -> bool:  # type: ignore[override]
        """See Model: unless a beam has an origin of its own."""
        return not self.beams.offsets.any()

    @property
    def limits(self) -> tuple[float, float]:
        return self.span

    @property
    def device_size(self) -> tuple[int, int]:
        """See Model: columns and beams."""
        return self.columns, len(self.beams)

    @property
    def firing(self) -> Firing:
        rows = ((np.arange(self.size[1]) + 0.5) * self._down).astype(int)
        return Firing(self.period * self._across, self.beams.delay[np.minimum(rows, len(self.beams) - 1)])

    def facts(self) -> dict[str, object]:
        return {
            "columns": self.columns, "beams": len(self.beams), "azimuth step, degrees": np.degrees(self.step),
            "column period, microseconds": self.period / MICRO,
        }  # fmt: skip

    def formula_values(self, x, y):
        names = "elevation", "azimuth", "ahead", "right", "up"
        rows = dict(zip(names, map(plain, self.beams.between(y * self._down)), strict=True))
        return {"start": self.start, "step": self.step, "columns": self.columns, **rows}

    def rays(self, x, y):
        """See Model: sines and cosines are those of rows and of columns. Each component of a direction is right to some
        EPS of 1 + the azimuth, that of an origin to some EPS of its length.
        """
        head = self.start + (x * self._across - 0.5) * self.step
        elevation, azimuth, ahead, right, up = self.beams.between(y * self._down)
        elevation = np.where(np.abs(elevation) <= pi / 2, elevation, np.nan)
        sine, cosine, level = np.sin(head), np.cos(head), np.cos(elevation)
        turn_sine, turn_cosine = np.sin(azimuth), np.cos(azimuth)
        along, beside = level * turn_cosine, level * turn_sine
        direction = sine * along + cosine * beside, np.sin(elevation), sine * beside - cosine * along
        if self.central:
            return (0.0, 0.0, 0.0), direction
        along, beside = ahead * turn_cosine - right * turn_sine, ahead * turn_sine + right * turn_cosine
        return (sine * along + cosine * beside, up, sine * beside - cosine * along), direction

    def project(self, points):
        """See Model: NaN where no beam looks outwards at a point, as on the axis. The nearest beam is that of the row,
        and of several columns, of a sweep of more than a turn, the first counts.
        """
        x, y, z = components(np.asarray(points, np.float64))
        row, beside = self.beams.towards(np.hypot(x, z), y)
        column = (np.arctan2(x, -z) - beside - self.start) / self.step + 0.5
        turn = FULL_TURN / abs(self.step)
        column = np.where(np.isnan(row), np.nan, column - turn * np.floor(column / turn))
        return np.stack((column / self._across, row / self._down), axis=-1)

    def bounds(self, centers, radii):
        """See Model. A ray from an origin beside the center meets a sphere only if the ray from the center, moved
        there, meets the sphere enlarged by the distance. A sphere that holds the axis or crosses the seam covers all
        columns.
        """
        ahead, right, up = self.beams.ends[2:]
        middle = (up.min() + up.max()) / 2
        beside = np.sqrt(ahead * ahead + right * right + (up - middle) ** 2).max()
        (left, right), elevations = longitude_latitude(centers - (0.0, middle, 0.0), radii + beside)
        low, high, least, greatest = self.beams.covering(*elevations)
        ends = sorted((self.start - self.step / 2, self.start + (self.columns - 0.5) * self.step))
        heads = turned((left - greatest, right - least), ends, FULL_TURN)
        heads = heads if self.step > 0 else heads[::-1]
        x0, x1 = (((head - self.start) / self.step + 0.5) / self._across for head in heads)
        margin_x, margin_y = PIXEL_MARGIN / min(1.0, self._across), PIXEL_MARGIN / min(1.0, self._down)
        y0, y1 = low / self._down, high / self._down
        return np.stack((x0 - margin_x, x1 + margin_x, y0 - margin_y, y1 + margin_y), axis=-1)

    def pixel_rounding(self, x, y):
        """See Model: also that of the start angle and of the beams' azimuths."""
        turned_by = (abs(self.start) + np.abs(self.beams.ends[1]).max()) / abs(self.step * self._across)
        return gamma(8) * (self.size[0] + turned_by), gamma(8) * self.size[1]

    @property
    def ray_rounding(self) -> float:
        """See Model: two more products, and the elevation's."""
        return gamma(32)

    def formula_rounding(self, x, y):
        """See Model: that of the origin's parts, which may cancel."""
        return gamma(32) * float(np.abs(self.beams.offsets).max()), 0.0

    @lazy
    def _across(self) -> float:
        return self.columns / self.size[0]

    @lazy
    def _down(self) -> float:
        return len(self.beams) / self.size[1]
