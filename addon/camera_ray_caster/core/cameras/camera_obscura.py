"""The camera obscura: a dark box with a tiny hole, which projects the world upside down onto the back wall.

Assumption: light goes straight through the hole; diffraction is left out, so the picture only gets sharper as the hole
closes. The wall is perpendicular to the viewing direction, ``depth`` behind the hole.
Formula: the wall's point (X, Y, depth) sees along (-X, -Y, -depth): similar triangles, both axes inverted. A hole of
diameter h blurs a far point to a spot of diameter h on the wall, and a point at the distance s to h (1 + depth / s).
The picture shows the wall with u to the right and v up, like a ground glass seen from behind: it is the pinhole's
picture, turned by 180 degrees. (Somebody inside who faces the wall sees it upside down, but not mirrored.)
References: Gemma Frisius, De Radio Astronomico et Geometrico (1545); E. Hecht, Optics, 5th ed., section 5.7.6 (the
pinhole camera).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..records import BlenderCamera, Pose, Raster
from .model import Step
from .parts.aperture import Aperture
from .parts.film import FILM, Window
from .parts.settings import Number
from .perspective import Perspective

DEPTH = Number("obscura_depth", "Box Depth", "Distance from the hole to the back wall", 2.0, 1e-6, unit="length")
WIDTH = Number(
    "obscura_width", "Wall Size", "Length of the fitted side of the picture on the back wall", 3.0, 1e-6, unit="length"
)
HOLE = Number(
    "obscura_hole", "Hole Diameter", "Diameter of the hole. A larger hole lets in more light and blurs "
                                     "the picture", 0.02, 1e-9,
    unit="length", digits=4,
)  # fmt: skip


@dataclass(frozen=True)
class CameraObscura(Perspective):
    """A box whose picture is the pinhole's, turned by 180 degrees. The window is the wall, inverted through the hole
    and scaled to unit depth before it.
    """

    hole: Aperture

    key = "CAMERA_OBSCURA"
    label = "Camera Obscura"
    description = "A dark box with a tiny hole: the world upside down on its back wall"
    group = "Historical"
    number = 1
    SETTINGS = (DEPTH, WIDTH, HOLE, *FILM)
    FORMULA = (
        Step(
            "Point on the wall (V: pixels along its fitted side; p: pixel height / width)",
            "X = (x - W/2 + shift_x V) width / V, Y = ((y - H/2) p + shift_y V) width / V",
        ),
        Step("Direction, through the hole", "r = -X u - Y v + depth w"),
    )
    K = None

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> CameraObscura:
        """See Model. Shift moves the film on the wall, in units of its fitted side."""
        depth = DEPTH.read(raw)
        wall = Window.before_eye(raw, raster, WIDTH.read(raw) / depth, (WIDTH, DEPTH))
        turned = Window(wall.center_x, wall.center_y, -wall.pitch_x, -wall.pitch_y)
        return cls(raster.size, turned, Aperture(HOLE.read(raw) / 2, -depth))

    @classmethod
    def off_axis(cls, raw: BlenderCamera, slope: float) -> BlenderCamera:
        """See Model: the picture is inverted."""
        return replace(raw, shift_x=raw.shift_x - slope * DEPTH.read(raw) / WIDTH.read(raw))

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture:
        """Return the hole."""
        return self.hole

    def facts(self) -> dict[str, object]:
        """Return nothing: the facts of the perspective camera do not apply to an inverted picture."""
        return {}
