"""The settings of scanners: what a device determines, and how it is run."""

from dataclasses import dataclass
from math import pi, radians
from typing import Any

from ...records import BlenderCamera
from .settings import ABOVE_ZERO, FULL_TURN, LARGEST_ANGLE, Choice, Coefficients, Item, Number, Whole


class Table(Coefficients):
    """A number for each beam, in the order of the device's channels; one number holds for all beams."""

    limit = 4096
    order = ""

    def read(self, raw: BlenderCamera) -> tuple[float, ...]:
        """See Coefficients; () for an empty text."""
        return super().read(raw) if str(self.given(raw)).strip() else ()


@dataclass(frozen=True)
class Angles(Table):
    """A table of angles: text has degrees; numbers of Python are radians, as all angles there."""

    widest: float = FULL_TURN
    """Largest magnitude in radians: numbers beyond it are degrees."""


BY_SETTINGS: tuple[tuple[str, Any], ...] = (("scanner_device", "CUSTOM"),)
"""With which what a device determines is set by hand."""

RATE = Number("scanner_rate", "Rate", "Sweeps per second", 10.0, 1e-6, 1e6, soft_high=20.0)
START = Number(
    "scanner_start", "Start Angle", "Angle by which the first column is turned clockwise, seen from above",
    0.0, unit="angle",
)  # fmt: skip
ELEVATIONS = Angles(
    "scanner_elevations", "Elevations", "Elevation of each beam, degrees. If empty, the rows of the frame are beams "
                                        "from the lowest to the highest elevation", "",
    used_with=BY_SETTINGS, widest=pi / 2,
)  # fmt: skip
LOW, HIGH = (
    Number(
        f"scanner_{name}", f"{name.title()}est", f"Elevation of the {name}est row", default, -pi / 2, pi / 2, "angle",
        partner=f"scanner_{other}", used_with=(*BY_SETTINGS, (ELEVATIONS.name, "")),
    )
    for name, other, default in (("low", "high", radians(-15)), ("high", "low", radians(15)))
)  # fmt: skip
AZIMUTHS = Angles("scanner_azimuths", "Azimuths", "Azimuth of each beam from the head's, degrees clockwise", "0",
                 used_with=BY_SETTINGS)  # fmt: skip
AHEAD, RIGHT, UP = (
    Table(f"scanner_{name}", name.title(), f"Origin of each beam, Blender units {where}", "0", used_with=BY_SETTINGS)
    for name, where in (
        ("ahead", "from the axis in the beam's azimuth"),
        ("right", "to the right of the beam's azimuth"),
        ("up", "above the scanner's center"),
    )
)
DELAYS = Table("scanner_delays", "Delays", "Time at which each beam fires after its column begins, microseconds", "0",
               used_with=BY_SETTINGS)  # fmt: skip
ROW_SHARE = Number(
    "scanner_row_share", "Row Share", "Part of the time from column to column in which the rows fire one after the "
                                      "other, upwards, as a mirror turns; in addition to the delays", 0.0, 0.0, 1.0,
    used_with=BY_SETTINGS,
)  # fmt: skip
SWEEP = Number("scanner_sweep", "Sweep", "Angle of a sweep", FULL_TURN, ABOVE_ZERO, LARGEST_ANGLE, "angle",
               used_with=BY_SETTINGS)  # fmt: skip
COLUMNS = Whole("scanner_columns", "Columns", "Number of columns of a sweep; 0 is the frame's width", 0, 0, 1 << 20,
                used_with=(*BY_SETTINGS, ("scanner_period", 0.0)))  # fmt: skip
PERIOD = Number(
    "scanner_period", "Period", "Time from column to column, microseconds; then a sweep has as many columns as fit. "
                                "0 divides the sweep by its columns", 0.0, 0.0, digits=3,
    used_with=BY_SETTINGS,
)  # fmt: skip
CLOCKWISE = "CLOCKWISE"
DIRECTION = Choice(
    "scanner_direction", "Direction", "How the head turns, seen from above",
    CLOCKWISE,
    (Item(CLOCKWISE, "Clockwise", "To the right", 0), Item("COUNTERCLOCKWISE", "Counterclockwise", "To the left", 1)),
    used_with=BY_SETTINGS,
)  # fmt: skip
NEAREST, FARTHEST = (
    Number(f"scanner_{name}", name.title(), text, 0.0, 0.0, unit="length", used_with=BY_SETTINGS)
    for name, text in (("nearest", "Least range that is measured"), ("farthest", "Largest range; 0 is no limit"))
)

OF_DEVICE = (
    ELEVATIONS, LOW, HIGH, AZIMUTHS, AHEAD, RIGHT, UP, DELAYS, ROW_SHARE, SWEEP, COLUMNS, PERIOD, DIRECTION, NEAREST,
    FARTHEST,
)  # fmt: skip
"""The settings that a device determines."""
