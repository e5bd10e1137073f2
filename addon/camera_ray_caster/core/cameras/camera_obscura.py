"""The camera obscura: a dark box with a tiny hole, and on its back wall the world upside down.

Assumption: light goes straight through the hole; diffraction is left out, so the picture only gets sharper as the hole
closes. The wall is perpendicular to the viewing direction, ``depth`` behind the hole.
Formula: the wall's point (X, Y, depth) sees along (-X, -Y, -depth): similar triangles, both axes inverted. A hole of
diameter h blurs a far point to h on the wall, and one at the distance s to h (1 + depth / s).
The picture shows the wall with u to the right and v up, as a ground glass is seen from behind: what the eye sees,
turned by half a turn. (Somebody inside who turns round to the wall sees it upside down, with left and right in place.)
References: the lecture (Gemma Frisius 1545); E. Hecht, Optics, 5th ed., section 5.7.6 (the pinhole camera).
"""

from __future__ import annotations

from dataclasses import dataclass

from ..records import BlenderCamera, Pose, Raster
from .model import Step
from .parts.aperture import Aperture
from .parts.film import FILM, Window
from .parts.settings import Number
from .perspective import Perspective

DEPTH = Number("obscura_depth", "Box Depth", "From the hole to the back wall", 2.0, 1e-6, unit="length")
WIDTH = Number(
    "obscura_width", "Wall Size", "The fitted side of the picture on the back wall", 3.0, 1e-6, unit="length"
)
HOLE = Number(
    "obscura_hole", "Hole Diameter", "A larger hole lets in more light and blurs the picture", 0.02, 1e-9,
    unit="length", digits=4,
)  # fmt: skip


@dataclass(frozen=True)
class CameraObscura(Perspective):
    """The box: its picture is the pinhole's, turned by half a turn. The window is the wall, turned over and brought to
    unit depth before the hole.
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
            "Pixel on the wall, V pixels on its fitted side, p times as high as wide",
            "X = (x - W/2 + shift_x V) width / V, Y = ((y - H/2) p + shift_y V) width / V",
        ),
        Step("Direction, through the hole", "r = -X u - Y v + depth w"),
    )
    K = None

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> CameraObscura:
        """Build it from depth, width (the wall's fitted side) and hole (its diameter), all in Blender units.

        Shift moves the film on the wall, in lengths of its fitted side.
        """
        depth = DEPTH.read(raw)
        wall = Window.before_eye(raw, raster, WIDTH.read(raw) / depth, (WIDTH, DEPTH))
        turned = Window(wall.center_x, wall.center_y, -wall.pitch_x, -wall.pitch_y)
        return cls(raster.size, turned, Aperture(HOLE.read(raw) / 2, -depth))

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture:
        """Return the hole."""
        return self.hole

    def facts(self) -> dict[str, object]:
        """Return nothing: an inverted picture has no K in OpenCV's sense."""
        return {}
