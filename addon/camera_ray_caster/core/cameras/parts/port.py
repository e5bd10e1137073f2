"""Ports: a flat plate or a dome of glass between a camera and another medium, such as water.

Light goes from the medium inside, such as air, through the glass into the medium. Refraction depends on the ratios of
indices alone: those of ports are relative to the medium inside. Where one is below 1, rays may be totally reflected,
and are none. Rays lie in planes through one axis, the plate's normal or the line from the dome's center to the eye. One
whose angle in a layer of index 1 has the tangent q runs away from a plate's axis by h q / sqrt(n^2 + (n^2 - 1) q^2) in
a layer of the depth h and the index n; through a dome n r sin i is the same all along it. Both give a place that
increases with the angle, so that each point has one direction inside; a dome near total reflection is refused.
References: A. Agrawal et al., A Theory of Multi-Layer Flat Refractive Geometry (2012); M. Born and E. Wolf, Principles
of Optics, 7th ed. (1999), section 3.2 (Bouguer's formula).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...maths.recording import cos, sin
from ...maths.vector import along, components, cross, difference, dot, norm, unit
from ...records import BlenderCamera
from .port_settings import DECENTER, DISTANCE, DOME, FLAT, GLASS, INSIDE, MEDIUM, RADIUS, THICKNESS, TILTS

MILLIMETER = 1e-3
"""In Blender units, as for a thin lens."""
NEWTON_STEPS, SETTLED_CHANGE = 200, 4e-16
"""Steps of the inverse at most, and the relative change at which it has settled. Most points take five; with the eye on
the plate more, as the direction nears the plate's own.
"""
ANGLE_MARGIN = 1e-9
"""Angle, rad, by which bounds are larger: far more than rounding."""
APART = 0.7
"""Share of the distance from the center at which a dome reflects totally, up to which an eye sees no point twice: of
60,000 random domes with relative indices from 0.1 to 10, two had rays that meet at 0.75, and none at 0.7.
"""


def indices_of(raw: BlenderCamera) -> tuple:
    """Return the indices of a record's glass and medium, relative to that inside; older files have air there."""
    inside = INSIDE.read(raw) if INSIDE.name in raw.settings else INSIDE.default
    return GLASS.read(raw) / inside, MEDIUM.read(raw) / inside


@dataclass(frozen=True)
class FlatPort:
    """A plate. Lengths are in Blender units, in the camera's frame."""

    normal: tuple[float, float, float]
    """Unit vector away from the eye."""
    distance: float
    thickness: float
    glass: float
    medium: float

    @classmethod
    def from_blender(cls, raw: BlenderCamera) -> FlatPort:
        """Return the plate of a record. Raises InputError for values without meaning."""
        x, y = (tilt.read(raw) for tilt in TILTS)
        distance, thickness = (length.read(raw) * MILLIMETER for length in (DISTANCE, THICKNESS))
        normal = -cos(x) * sin(y), sin(x), -cos(x) * cos(y)
        return cls(normal, distance, thickness, *indices_of(raw))

    @property
    def reach(self) -> float:
        """Distance of the outer face from the eye."""
        return self.distance + self.thickness

    @property
    def axis(self) -> np.ndarray:
        """The axis of symmetry, through the eye, (3,)."""
        return np.array(self.normal)

    def bent(self, origin, direction):
        """Return origin, on the outer face, and direction of rays in the medium; see ``Model.rays`` for their form."""
        c = dot(self.normal, direction)
        c = np.where(c > 0, c, np.nan)
        flat = along(direction, self.normal, -c)
        squares = [(index * index - 1) + c * c for index in (self.glass, self.medium)]
        passes = np.minimum(*squares) >= 0
        glass, medium = (np.sqrt(np.where(passes, square, np.nan)) for square in squares)
        inner = along(origin, direction, (self.distance - dot(self.normal, origin)) / c)
        share = self.thickness / glass
        outer = tuple(o + (share * k + self.thickness * n) for o, k, n in zip(inner, flat, self.normal, strict=True))
        return outer, unit(along(flat, self.normal, medium))

    def growth(self, direction):
        """Return how much a small turn of rays, unit vectors, moves their origins (a length) and turns them."""
        c = np.maximum(dot(self.normal, direction), np.finfo(float).tiny)
        squares = ((index * index - 1) + c * c for index in (self.glass, self.medium))
        glass, medium = (np.maximum(square, np.finfo(float).tiny) for square in squares)
        in_glass = self.thickness * self.glass**2 * c / (glass * np.sqrt(glass))
        return 2 * (self.distance / (c * c) + in_glass), np.maximum(1.0, c / np.sqrt(medium))

    def places(self, points):
        """Return where points (n, 3) are: behind the outer face and from the axis, (n,) each; the first is negative for
        points before it.
        """
        depth = points @ self.axis
        return depth - self.reach, norm(components(points - depth[:, None] * self.axis))

    def spread(self, behind, across, radii):
        """Return the least and the largest angle inside of what balls hold, and half the angle around the axis."""
        far, near = np.maximum(behind + radii, 0.0), np.maximum(behind - radii, 0.0)
        smallest, largest = self.angle(far, np.maximum(across - radii, 0.0)), self.angle(near, across + radii)
        around = np.arcsin(np.minimum(radii / np.maximum(across, np.finfo(float).tiny), 1.0))
        return smallest, largest, np.where(radii < across, around, np.pi)

    def angle(self, behind, across):
        """Return the angles from the axis inside of rays that meet points; pi / 2 where there is none.

        Newton's method from the axis, for the tangent q in the least of the indices: ``rho`` is concave, so that no
        step goes too far.
        """
        least = min(1.0, self.glass, self.medium)
        layers = (self.distance, 1 / least), (self.thickness, self.glass / least), (behind, self.medium / least)
        q = np.zeros(np.shape(across))
        for _ in range(NEWTON_STEPS):
            square = q * q
            rho, slope = np.zeros_like(q), np.zeros_like(q)
            for depth, index in layers:
                root = index * index + (index * index - 1) * square
                weight = depth / np.sqrt(root)
                rho, slope = rho + weight * q, slope + weight * (index * index) / root
            step = np.where(across > 0, (across - rho) / slope, 0.0)
            q = q + np.maximum(step, 0.0)
            if not (step > SETTLED_CHANGE * q).any():
                break
        inside = np.arctan(q * least / np.sqrt(1 + (1 - least * least) * q * q))
        return np.where(np.isfinite(q), inside, np.pi / 2)


@dataclass(frozen=True)
class DomePort:
    """A shell between two spheres about one center. Lengths are in Blender units, in the camera's frame."""

    center: tuple[float, float, float]
    inner: float
    thickness: float
    glass: float
    medium: float

    @classmethod
    def from_blender(cls, raw: BlenderCamera) -> DomePort:
        """Return the dome of a record. Raises InputError for values without meaning."""
        outer, thickness = RADIUS.read(raw), THICKNESS.read(raw)
        if not thickness < outer:
            raise THICKNESS.refusal(raw, f"{float(thickness):.6g}", f"below {RADIUS.name}, {float(outer):.6g}")
        x, y, z = DECENTER.read(raw)
        away = float(norm((float(x), float(y), float(z))))
        if not away < outer - thickness:
            limit = f"below {float(outer - thickness):.6g}, the inner radius, so that the eye is inside the dome"
            raise DECENTER.refusal(raw, f"{away:.6g} mm long", limit)
        center, shell = (x * MILLIMETER, y * MILLIMETER, z * MILLIMETER), (outer - thickness, thickness)
        port = cls(center, *(length * MILLIMETER for length in shell), *indices_of(raw))
        if port.least < port.inner and not port.away < APART * port.least:
            limit = f"below {float(APART * port.least / MILLIMETER):.6g}, so that no light is totally reflected"
            raise DECENTER.refusal(raw, f"{away:.6g} mm long", limit)
        return port

    @property
    def outer(self) -> float:
        """Radius of the outer face."""
        return self.inner + self.thickness

    @property
    def least(self) -> float:
        """Distance from the center below which a ray's line inside passes both faces."""
        return min(self.inner, self.glass * self.inner, self.medium * self.outer)

    @property
    def reach(self) -> float:
        """Largest distance of the outer face from the eye."""
        return self.outer + self.away

    @property
    def away(self) -> float:
        """Distance of the eye from the center."""
        return norm(self.center)

    @property
    def axis(self) -> np.ndarray:
        """The axis of symmetry, from the center to the eye, (3,); the viewing direction if they coincide."""
        return -np.array(self.center) / self.away if self.away else np.array((0.0, 0.0, -1.0))

    def bent(self, origin, direction):
        """See FlatPort. With p the distance of a ray's line from the center, sqrt(n^2 r^2 - p^2) is n r cos i."""
        start = difference(origin, self.center)
        p = cross(start, direction)
        square, inner, outer = dot(p, p), self.inner * self.inner, self.outer * self.outer
        glass, medium = self.glass * self.glass, self.medium * self.medium
        squares = (radius - square for radius in (inner, glass * inner, glass * outer, medium * outer))
        before, entering, leaving, behind = (np.sqrt(np.where(radius >= 0, radius, np.nan)) for radius in squares)
        first = along(start, direction, before - dot(start, direction))
        inside = along(direction, first, (glass - 1) / (entering + before))  # of length n
        last = along(first, inside, self.thickness * (self.outer + self.inner) / (entering + leaving))
        beyond = along(inside, last, (medium - glass) / (leaving + behind))
        return along(self.center, last, 1.0), unit(beyond)

    def growth(self, direction):
        """See FlatPort: most for the line that is farthest from the center."""
        faces = 1 if self.least == self.inner else 2
        turn = 1 + faces * self.away / np.sqrt(self.least**2 - self.away**2)
        return 2 * turn * self.outer, turn

    def places(self, points):
        """Return where points (n, 3) are: behind the outer face and, as an angle at the center, from the axis."""
        start = points - np.array(self.center)
        around = np.arctan2(norm(cross(components(start), self.axis)), start @ self.axis)
        return norm(components(start)) - self.outer, around

    def spread(self, behind, around, radii):
        """See FlatPort."""
        distance = np.maximum(behind + self.outer, np.finfo(float).tiny)
        half = np.where(radii < distance, np.arcsin(np.minimum(radii / distance, 1.0)), np.pi)
        far, near = np.maximum(behind + radii, 0.0), np.maximum(behind - radii, 0.0)
        low, high = around - half, around + half
        smallest, largest = self.angle(far, np.maximum(low, 0.0)), self.angle(near, np.minimum(high, np.pi))
        turn = np.arcsin(np.minimum(np.sin(half) / np.maximum(np.sin(around), np.finfo(float).tiny), 1.0))
        return smallest, largest, np.where((low > 0) & (high < np.pi), turn, np.pi)

    def angle(self, behind, around):
        """Return the angles from the axis inside of rays that meet points: Newton's method in a bracket."""
        if not self.away:
            return around
        radii = self.inner, self.glass * self.inner, self.glass * self.outer, self.medium * self.outer
        last = self.medium * (self.outer + behind)
        low, high = np.zeros(np.shape(around)), np.full(np.shape(around), np.pi)
        theta = np.array(around, np.float64)
        for _ in range(NEWTON_STEPS):
            p, turn = self.away * np.sin(theta), self.away * np.cos(theta)
            off, slope = theta - around, np.ones(np.shape(theta))
            for sign, reach in zip((-1, 1, -1, 1, -1), (*radii, last), strict=True):
                off = off + sign * np.arcsin(np.minimum(p / reach, 1.0))
                slope = slope + sign * turn / np.sqrt(np.maximum(reach * reach - p * p, np.finfo(float).tiny))
            low, high = np.where(off <= 0, theta, low), np.where(off >= 0, theta, high)
            moved = theta - off / slope
            moved = np.where((moved >= low) & (moved <= high), moved, (low + high) / 2)
            settled = ~(np.abs(moved - theta) > SETTLED_CHANGE * theta)
            theta = moved
            if settled.all():
                break
        return theta


PORTS = {FLAT: FlatPort, DOME: DomePort}
Port = FlatPort | DomePort


def rays_inside(port: Port, points: np.ndarray) -> np.ndarray:
    """Return the unit directions (n, 3) at the eye of the rays that meet points (n, 3); NaN for points that are not
    behind the port, and for those that no ray meets.
    """
    behind, across = port.places(points)
    theta = port.angle(behind, across)
    directions = _turned(port, points, theta)
    seen = (behind > 0) & ~((theta >= np.pi / 2) & isinstance(port, FlatPort))
    return np.where(seen[:, None], directions, np.nan)


def balls_inside(port: Port, centers: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return centers (n, 3) and radii (n,) of balls that hold, as the eye sees them inside, all that may be seen of
    balls behind the port; NaN for balls before it, and radii above 1, the distance, for balls that may be anywhere.
    """
    behind, across = port.places(centers)
    smallest, largest, around = port.spread(behind, across, radii)
    middle = (smallest + largest) / 2

    def away(theta):
        flat = np.sin(middle) * np.sin(theta) * np.sin(around / 2) ** 2
        return 2 * np.arcsin(np.minimum(np.sqrt(np.sin((theta - middle) / 2) ** 2 + flat), 1.0))

    on_axis = around > np.pi / 2
    middle = np.where(on_axis, 0.0, middle)
    angle = np.where(on_axis, largest, np.maximum(away(smallest), away(largest))) + ANGLE_MARGIN
    seen = behind + radii > 0
    grown = np.where(angle < np.pi / 2, np.sin(angle), 2.0)
    return _turned(port, centers, middle), np.where(seen, np.where(np.isnan(angle), 2.0, grown), np.nan)


def _turned(port: Port, points: np.ndarray, theta: np.ndarray) -> np.ndarray:
    """Return the unit vectors at angles from the port's axis towards points."""
    axis = port.axis
    beside = points - (points @ axis)[:, None] * axis
    beside = beside - (beside @ axis)[:, None] * axis
    length = norm(components(beside))[:, None]
    aside = np.where(length > 0, beside / np.where(length > 0, length, 1.0), 0.0)
    return np.cos(theta)[:, None] * axis + np.sin(theta)[:, None] * aside
