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

from ..records import BlenderCamera, Raster
from .parts.aperture import Aperture
from .parts.film import Window
from .parts.settings import positive
from .perspective import Perspective


@dataclass(frozen=True)
class CameraObscura:
    """The box: its picture is the pinhole's, turned by half a turn; the hole is its aperture."""

    pinhole: Perspective
    """Its window is the wall, turned over and brought to unit depth before the hole."""
    hole: Aperture

    key = "CAMERA_OBSCURA"
    planar = True
    central = True

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> CameraObscura:
        """Build it from ``obscura_depth``, ``obscura_width`` (the wall's fitted side) and ``obscura_hole`` (diameter).

        All in Blender units. Shift moves the film on the wall, in lengths of its fitted side. InputError where one of
        the three is not positive.
        """
        depth, width, hole = (positive(raw, f"obscura_{name}") for name in ("depth", "width", "hole"))
        wall = Window.from_blender(raw, raster, width / depth)
        turned = Window(wall.center_x, wall.center_y, -wall.pitch_x, -wall.pitch_y)
        return cls(Perspective(turned), Aperture(hole / 2, -depth))

    def rays(self, x, y):
        """Return the chief rays, through the middle of the hole; as ``Perspective.rays``."""
        return self.pinhole.rays(x, y)

    def project(self, points):
        """Return where the chief ray of camera-frame points falls; as ``Perspective.project``."""
        return self.pinhole.project(points)

    def bounds(self, centers, radii):
        """Return the pixel bounds of spheres; as ``Perspective.bounds``."""
        return self.pinhole.bounds(centers, radii)
