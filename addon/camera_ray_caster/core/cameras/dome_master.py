"""The dome master: what a planetarium's projectors are given, the half sphere above the audience as a disc.

Assumption: the camera is level and looks to the audience's front; the center of the picture is the dome's zenith, the
rim its edge, the bottom the front. ``tilt`` tips the dome towards the front, as over rising seats.
Formula: an equidistant fisheye, theta = r fov / 2 from the zenith, round, touching the nearer sides of the frame (which
should be square); no ray beyond. fov is 180 degrees for a half sphere.
Singular: with fov 360, the rim.
Reference: E. Lantz, A Survey of Large-Scale Immersive Displays (2007); IMERSA, Dome Master standard (2012).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from ..records import BlenderCamera, Raster
from .fisheye_equidistant import FisheyeEquidistant
from .parts.film import Window
from .parts.pitched import Pitched
from .parts.settings import FULL_TURN, number, positive


@dataclass(frozen=True)
class DomeMaster(Pitched, FisheyeEquidistant):
    """An equidistant fisheye that looks up."""

    key = "DOME_MASTER"

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> DomeMaster:
        """Build it from ``fov``, ``tilt`` and shift; InputError for an angle without meaning."""
        half_fov = positive(raw, "fov", FULL_TURN, "deg") / 2
        tilt = number(raw, "tilt", 0.0, pi / 2, "deg")
        return cls(Window.inscribed_circle(raw, raster, 1.0), 1.0, half_fov=half_fov, elevation=pi / 2 - tilt)
