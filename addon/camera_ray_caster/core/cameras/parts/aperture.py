"""The opening of a camera: a thin lens, or the hole of a camera obscura. Without an opening every ray is a chief ray.

A point l of the opening sends its ray to the point where the chief ray meets the surface of focus, so that this surface
is sharp and everything else is blurred. For a lens the surface lies before the opening. For a camera obscura it is the
back wall, behind the opening at a negative distance: the ray of a wall's point through l runs away from that point.
Both are geometric optics, without diffraction.

Behind a tilted sensor the image distance differs from pixel to pixel, and with it the depth that is sharp: the plane of
focus is tilted, too (Scheimpflug). Where the image distance is no longer than the focal length, rays meet nowhere.

Sources: Blender manual, Cameras > Depth of Field; R. L. Cook, T. Porter, L. Carpenter, Distributed Ray Tracing (1984).
Cycles does the same: planar cameras are sharp on the plane at depth focus, panoramas on the sphere |p| = focus.
"""

from dataclasses import dataclass

import numpy as np

from ...maths.vector import along, cross, difference, dot, unit
from ...records import BlenderCamera, InputError, Pose
from .settings import FOCUS, Flag, Number, Setting, Whole

FORWARD = 0.0, 0.0, -1.0
SIDEWAYS = 1.0, 0.0, 0.0

NARROW = 1e-6
"""Angle in radians between a chief ray and the opening's axis, below which rounding would decide the opening's x."""


@dataclass(frozen=True)
class Aperture:
    """An opening in the plane of the eye, seen along the viewing direction."""

    radius: float
    """Radius of the disc, or of the polygon's corners, in Blender units."""
    focus: float
    """Distance of the surface of focus in Blender units; negative behind the opening (camera obscura), never 0."""
    blades: int = 0
    """Number of corners of a regular polygon; a disc below 3."""
    rotation: float = 0.0
    """Rotation of the polygon in radians: at 0 the middle of a side lies on the +x axis."""
    ratio: float = 1.0
    """Divisor of the width, for an anamorphic bokeh."""
    tilt: tuple[float, ...] = ()
    """Of a planar camera with a tilted sensor: the focal length; the slopes a, b of the sensor, whose image distance
    over that on the axis is 1 / (1 + a X + b Y) for the direction (X, Y, -1); and the image distance on the axis over
    that by which the model's image plane has its size. Empty if the sensor is upright.
    """
    nearest: tuple[float, ...] = ()
    """Of a tilted sensor: the least and the largest of one over the depth of the surface of focus in the frame."""
    axis: tuple[float, float, float] = FORWARD
    """Direction in the camera's frame whose part perpendicular to the chief ray is the x of a panorama's opening."""

    @property
    def is_hole(self) -> bool:
        """Whether the opening is the hole of a camera obscura."""
        return self.focus < 0

    @property
    def is_mirrored(self) -> bool:
        """Whether the shape is the lens's shape flipped upside down, as in Cycles' mirror ball."""
        return self.axis == SIDEWAYS

    @property
    def widest(self) -> float:
        """Largest distance from the opening's center to its border."""
        return max(self.radius, self.radius / self.ratio)

    def points(self, u, v):
        """Return points (x, y) of the opening for u, v in [0, 1): area-uniform, in Blender units.

        The disc is r = sqrt(u) at the angle 2 pi v. A polygon is cut into equal triangles from its center. u picks the
        triangle; the remainder of u, by the same square root, and v pick a point in it (Turk, Graphics Gems, 1990).
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

        If ``planar``, direction_z stays -1, the opening lies in z = origin_z and focus is a depth. Otherwise the
        opening is perpendicular to the chief ray, as in Cycles; directions keep unit length and focus is a distance.
        """
        if planar and self.tilt:
            sharp = self.sharpness(direction)
            there = direction[0] - x * sharp, direction[1] - y * sharp, direction[2]
            return (origin[0] + x, origin[1] + y, origin[2]), there
        if planar:
            return (origin[0] + x, origin[1] + y, origin[2]), (
                direction[0] - x / self.focus,
                direction[1] - y / self.focus,
                direction[2],
            )
        slant = dot(self.axis, direction)
        across = difference(self.axis, tuple(slant * component for component in direction))
        ahead = dot(across, across) < NARROW**2  # any perpendicular axis will do there
        turned = self.axis[1:] + self.axis[:1]
        across = unit(tuple(np.where(ahead, other, mine) for other, mine in zip(turned, across, strict=True)))
        upward = unit(cross(direction, across))
        opening = along(tuple(x * component for component in across), upward, y)
        focus = tuple(self.focus * component for component in direction)
        return along(origin, opening, 1.0), unit(difference(focus, opening))

    def sharpness(self, direction):
        """Return one over the depth that is sharp on a chief ray (X, Y, -1); 0 or less where rays meet nowhere.

        A point of the sensor beside the axis is as much farther from the lens as the tilted plane takes it.
        """
        focal, across, up, size = self.tilt
        further = 1 / (1 + across * direction[0] + up * direction[1]) - 1
        return 1 / focal - (1 / focal - 1 / self.focus) / (1 + further / size)

    def blur(self, centers, radii, planar: bool):
        """Return how much bounding spheres must grow so that, seen through the eye alone, they cover their blur.

        A point at distance s, seen through the point l of the opening, appears where the eye would see the point moved
        by -l (1 - s / focus); if ``planar``, s is a depth. centers (n, 3) in the camera's frame, radii (n,).
        """
        distance = -centers[:, 2] if planar else np.sqrt((centers**2).sum(axis=1))
        depths = distance - radii, distance + radii
        if self.nearest:
            ends = [np.abs(1 - depth * sharp) for depth in depths for sharp in self.nearest]
        else:
            ends = [np.abs(1 - depth / self.focus) for depth in depths]
        return self.widest * np.maximum.reduce([np.ones_like(distance), *ends])


SMALLEST = 1e-5
"""Blender's lower limit of f-stop and focus distance."""

FOCUS_DISTANCE = Number(
    "focus_distance", "Focus Distance", "Distance to the surface of focus", 10.0, 0.0, unit="length", owner=FOCUS
)
F_STOP = Number("aperture_fstop", "F-Stop", "Focal length over the diameter of the opening", 2.8, 0.0, owner=FOCUS)
DEPTH_OF_FIELD: tuple[Setting, ...] = (
    Flag("use_dof", "Depth of Field", "Send rays through the whole opening of a thin lens", False, owner=FOCUS),
    FOCUS_DISTANCE,
    F_STOP,
    Whole("aperture_blades", "Blades", "Corners of the opening; a disc below 3", 0, 0, 16, owner=FOCUS),
    Number("aperture_rotation", "Rotation", "Of the polygon of the blades", 0.0, unit="angle", owner=FOCUS),
    Number("aperture_ratio", "Ratio", "Divisor of the width of the opening", 1.0, 0.01, owner=FOCUS),
)
"""Blender's own settings of depth of field, which ``thin_lens`` reads besides ``focus_position``."""


def thin_lens(raw: BlenderCamera, pose: Pose, parallel: bool) -> Aperture | None:
    """Return the thin lens of a camera's depth of field; None if depth of field is off.

    The radius is the focal length in meters over twice the f-stop; 1 / (2 f-stop) if rays are ``parallel``. With a
    focus object, focus is that object's depth. Raises InputError for an aperture ratio that is not positive and finite.
    """
    settings = raw.settings
    if not settings.get("use_dof"):
        return None
    ratio, blades = float(settings["aperture_ratio"]), int(settings["aperture_blades"])
    if not 0 < ratio < np.inf:
        raise InputError(f"aperture_ratio of camera {raw.name!r} is {ratio}: it must be positive")
    focus = focus_of(raw, pose)
    size = 1.0 if parallel else raw.lens * 1e-3
    radius = size / (2 * max(float(settings["aperture_fstop"]), SMALLEST))
    rotation = float(settings["aperture_rotation"])
    return Aperture(radius, float(focus), blades, rotation, ratio)


def focus_of(raw: BlenderCamera, pose: Pose) -> float:
    """Return the focus distance in Blender units: with a focus object that object's depth."""
    position = raw.settings.get("focus_position")
    if position is not None:
        return max(abs(float((np.asarray(position) - pose.eye) @ pose.basis[:, 2])), SMALLEST)
    focus = FOCUS_DISTANCE.read(raw)
    return focus if focus > SMALLEST else SMALLEST
