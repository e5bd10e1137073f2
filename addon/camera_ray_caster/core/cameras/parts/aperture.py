"""The opening of a camera: a thin lens, or the hole of a camera obscura. Without one every ray is the chief ray.

A point l of the opening sends its ray to where the chief ray meets the surface of focus, so that this surface is
sharp and every other one is blurred. For a lens the surface lies before the opening; the back wall of a camera
obscura is the same with the surface behind it, at a negative distance: the ray of a wall's point through l runs away
from that point. Diffraction is left out: both are geometric optics.

Sources: Blender manual, Cameras > Depth of Field; R. L. Cook, T. Porter, L. Carpenter, Distributed Ray Tracing (1984).
Cycles gives the same: planar cameras are sharp on the plane z = focus, panoramas on the sphere |p| = focus.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...maths.vector import along, cross, difference, dot, unit
from ...records import BlenderCamera, InputError, Pose

FORWARD = 0.0, 0.0, -1.0
SIDEWAYS = 1.0, 0.0, 0.0

NARROW = 1e-6
"""Radians between a chief ray and the axis of its opening below which rounding would decide what is across."""


@dataclass(frozen=True)
class Aperture:
    """An opening in the plane of the eye, seen along the viewing direction."""

    radius: float
    """Of the disc, or to the corners of the polygon; Blender units."""
    focus: float
    """Distance of the surface of focus; negative behind the opening (camera obscura). Blender units, never 0."""
    blades: int = 0
    """Corners of a regular polygon; a disc below 3."""
    rotation: float = 0.0
    """Of the polygon, radians: at 0 the middle of a side lies on the +x axis."""
    ratio: float = 1.0
    """Width is divided by this: an anamorphic bokeh."""
    axis: tuple[float, float, float] = FORWARD
    """What of the camera's space the x of a panorama's opening points to, as far as the chief ray allows."""

    @property
    def is_hole(self) -> bool:
        """Whether it is that of a camera obscura."""
        return self.focus < 0

    @property
    def is_mirrored(self) -> bool:
        """Whether its shape is that of the lens mirrored up and down, as Cycles has it for the mirror ball."""
        return self.axis == SIDEWAYS

    @property
    def widest(self) -> float:
        """How far from its center the opening reaches at most."""
        return max(self.radius, self.radius / self.ratio)

    def points(self, u, v):
        """Return points (x, y) of the opening for u, v in [0, 1): area-uniform, in Blender units.

        The disc is r = sqrt(u) at the angle 2 pi v. A polygon is cut into equal triangles from its center; u picks
        the triangle, what is left of it and v a point in it by the same square root (Turk, Graphics Gems, 1990).
        """
        if self.blades < 3:
            radius, angle = np.sqrt(u), 2 * np.pi * v
            x, y = radius * np.cos(angle), radius * np.sin(angle)
        else:
            corner = np.floor(u * self.blades)
            from_center, across = np.sqrt(u * self.blades - corner), v
            first = 2 * np.pi / self.blades * (corner - 0.5) + self.rotation
            second = first + 2 * np.pi / self.blades
            x = from_center * ((1 - across) * np.cos(first) + across * np.cos(second))
            y = from_center * ((1 - across) * np.sin(first) + across * np.sin(second))
        return self.radius * x / self.ratio, self.radius * y

    def through(self, origin, direction, planar: bool, x, y):
        """Return the ray through (x, y) of the opening that belongs to a chief ray, camera frame.

        planar: direction_z stays -1, the opening lies in z = origin_z and focus is a depth. Else the opening is
        perpendicular to the chief ray, as Cycles has it, directions stay unit and focus is a distance.
        """
        if planar:
            return (origin[0] + x, origin[1] + y, origin[2]), (
                direction[0] - x / self.focus,
                direction[1] - y / self.focus,
                direction[2],
            )
        slant = dot(self.axis, direction)
        across = difference(self.axis, tuple(slant * component for component in direction))
        ahead = dot(across, across) < NARROW**2  # any axis across will do there
        turned = self.axis[1:] + self.axis[:1]
        across = unit(tuple(np.where(ahead, other, mine) for other, mine in zip(turned, across, strict=True)))
        upward = unit(cross(direction, across))
        opening = along(tuple(x * component for component in across), upward, y)
        focus = tuple(self.focus * component for component in direction)
        return along(origin, opening, 1.0), unit(difference(focus, opening))

    def blur(self, distance, radius):
        """Return by how much a bounding sphere seen through the opening has to grow to be seen through the eye alone.

        A point at distance s seen through l appears where the point moved by -l (1 - s / focus) would through the
        eye. (n,) arrays; distance and radius of the spheres, along the axis for planar cameras.
        """
        ends = np.abs(1 - (distance - radius) / self.focus), np.abs(1 - (distance + radius) / self.focus)
        return self.widest * np.maximum(1.0, np.maximum(*ends))


SMALLEST = 1e-5
"""Blender's floor under f-stop and focus distance."""


def thin_lens(raw: BlenderCamera, pose: Pose, parallel: bool) -> Aperture | None:
    """Return the thin lens of a camera's depth of field; None where that is off.

    The radius is the lens in meters over twice the f-stop; 1 / (2 f-stop) where rays are ``parallel``. A focus object
    counts by its depth. InputError for an aperture ratio that is not positive.
    """
    settings = raw.settings
    if not settings.get("use_dof"):
        return None
    ratio, blades = float(settings["aperture_ratio"]), int(settings["aperture_blades"])
    if not 0 < ratio < np.inf:
        raise InputError(f"aperture_ratio of camera {raw.name!r} is {ratio}: it must be positive")
    focus = float(settings["focus_distance"])
    if settings["focus_position"] is not None:
        focus = abs(float((np.asarray(settings["focus_position"]) - pose.eye) @ pose.basis[:, 2]))
    size = 1.0 if parallel else raw.lens * 1e-3
    radius = size / (2 * max(float(settings["aperture_fstop"]), SMALLEST))
    rotation = float(settings["aperture_rotation"])
    return Aperture(radius, max(focus, SMALLEST), blades, rotation, ratio)
