"""The dome master: the input of a planetarium's projectors, the half sphere above the audience as a disc.

Assumption: the camera is level and looks to the audience's front. The center of the picture is the dome's zenith, the
rim is the dome's edge, the bottom is the front. ``tilt`` tips the dome towards the front, as over rising seats.
Formula: an equidistant fisheye, theta = r fov / 2 from the zenith, whose circle touches the nearer sides of the frame
(which should be square); no ray beyond. fov is 180 degrees for a half sphere.
Singular: the rim, if fov is 360 degrees.
Reference: E. Lantz, A Survey of Large-Scale Immersive Displays (2007); IMERSA, Dome Master standard (2012).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from ..records import BlenderCamera, Raster
from .fisheye_equidistant import FisheyeEquidistant
from .model import Step
from .parts.film import SHIFT, Window
from .parts.pitched import LENS_RAY, PITCH, TILT, Pitched
from .parts.radial import FOV, RADIUS, ROUND_PLANE


@dataclass(frozen=True)
class DomeMaster(Pitched, FisheyeEquidistant):
    """An equidistant fisheye that looks up."""

    key = "DOME_MASTER"
    label = "Dome Master"
    description = "The picture of a planetarium dome: the zenith in the middle, the front at the bottom"
    group = "Dome"
    number = 7
    SETTINGS = (FOV, TILT, *SHIFT)
    FORMULA = (
        ROUND_PLANE, RADIUS, Step("Angle from the zenith", "theta = rho fov / 2"), LENS_RAY, PITCH,
        Step("Elevation of the axis", "e = 90° - tilt"),
    )  # fmt: skip

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> DomeMaster:
        window = Window.inscribed_circle(raw, raster, 1.0)
        return cls(raster.size, window, 1.0, half_fov=FOV.read(raw) / 2, elevation=pi / 2 - TILT.read(raw))
