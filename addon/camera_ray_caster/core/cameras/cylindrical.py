"""The cylindrical panorama over chosen angles, as in stitched photographs.

Formula: the frame spans the longitudes ``pan_min`` .. ``pan_max``, also whole turns and more. Its height is the tangent
of the latitude, from ``latitude_bottom`` to ``latitude_top``. Vertical lines and the horizon stay straight.
Singular: the directions straight up and down, which no row reaches.
Reference: Snyder (1987), page 105; R. Szeliski, Image Alignment and Stitching (2006), section 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, radians

from ..maths.recording import tan
from ..records import BlenderCamera, Raster
from .central_cylindrical import CentralCylindrical
from .model import Step
from .parts.film import SHIFT
from .parts.meridians import RAY, longitude
from .parts.settings import Number, span

STEEPEST, WIDEST = radians(89), 10 * pi
PAN = tuple(
    Number(name, label, f"Longitude of the picture's {side} edge; 0 is straight ahead", default, -WIDEST, WIDEST,
           "angle", 4)
    for name, label, side, default in (("pan_min", "Pan Min", "left", -pi), ("pan_max", "Max", "right", pi))
)  # fmt: skip
LATITUDES = tuple(
    Number(f"latitude_{end}", label, f"Latitude of the picture's {side} edge", default, -STEEPEST, STEEPEST, "angle", 4,
           partner=f"latitude_{other}")
    for end, other, label, side, default in (
        ("bottom", "top", "Latitude Bottom", "lower", -pi / 4), ("top", "bottom", "Top", "upper", pi / 4),
    )
)  # fmt: skip


@dataclass(frozen=True)
class Cylindrical(CentralCylindrical):
    """A panorama whose height on the image plane is the tangent of the latitude."""

    key = "CYLINDRICAL"
    label = "Panorama Cylindrical"
    description = "A range of longitudes and latitudes; vertical lines and the horizon stay straight"
    group = "Panorama"
    number = 8
    SETTINGS = (*PAN, *LATITUDES, *SHIFT)
    FORMULA = (
        longitude("pan_min", "pan_max"),
        Step("Tangent of the latitude", "h = tan(bottom) + (y/H + shift_y) (tan(top) - tan(bottom))"),
        Step("Latitude", "lat = atan(h)"),
        RAY,
    )

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Cylindrical:
        """Build the camera from the angles and shift. Raises InputError for equal or too steep angles."""
        low, high = span(raw, *LATITUDES)
        return cls.over_frame(raw, raster, span(raw, *PAN), (tan(low), tan(high)))
