"""Rays through the surfaces of a lens, one after the other, as in optical design.

A ray meets of each surface the sheet at the vertex, also behind it (thin air gaps make spheres overlap beyond their
rims). From the plane of the vertex at (x, y), with curvature c, conic constant k and the sign s of the light's way:
    F = c (x^2 + y^2), G = dz - c (x dx + y dy), t = F / (G + s sqrt(G^2 - c F (1 + k dz^2))),
which is stable, and exact for planes. An asphere follows by Newton's method from the conic. Refraction:
    d' = m d + (sqrt(1 - m^2 (1 - cos^2)) - m cos) n, m the quotient of the indices, n the normal along the light.
A root of a negative number is total reflection or a missed surface: NaN, no ray. The arithmetic is that of numpy on
numbers or arrays, and can be recorded.
References: W. Smith, Modern Optical Engineering, 4th ed. (2008), chapter 10; M. Born and E. Wolf, Principles of Optics.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

NEWTON_STEPS = 5
"""Steps of Newton's method on an asphere: for the strongest of six lenses 1 leaves 3e-4 mm, 2 3e-11, 3 2e-15."""


@dataclass(frozen=True)
class LensSurface:
    """A surface in its place; the indices are those on the scene's and on the film's side, numbers or an array of one
    for each ray.
    """

    z: float
    curvature: float
    conic: float
    asphere: tuple[tuple[int, float], ...]
    rim: float
    before: float
    behind: float

    def sag(self, squared):
        """Return z and dz / d(r^2) of the surface over its vertex, at r^2 = squared."""
        root = np.sqrt(1 - (1 + self.conic) * self.curvature**2 * squared)
        z, slope = self.curvature * squared / (1 + root), self.curvature / (2 * root)
        for power, coefficient in self.asphere:
            lower = _power(squared, power - 2)
            z, slope = z + coefficient * (lower * squared), slope + coefficient * (power / 2) * lower
        return z, slope


def _power(squared, power: int):
    """Return r^power of r^2, by products: a power of numpy takes as long as twenty of them."""
    value = np.sqrt(squared) if power % 2 else 1.0
    for _ in range(power // 2):
        value = value * squared
    return value


def trace(surfaces: Sequence[LensSurface], origin, direction, to_film: bool, clip: bool = True):
    """Return origin and direction, three numbers or arrays each, of rays behind the last of some surfaces, and whether
    they pass. Where they do not, the direction's x is NaN, if only a rim is in the way and ``clip`` is set.

    surfaces: in the order of the light. Directions have unit length; a ray's error is some EPS of the lens's length.
    """
    x, y, z = origin
    dx, dy, dz = direction
    side, passes = 1.0 if to_film else -1.0, None
    for surface in surfaces:
        along = (surface.z - z) / dz
        x, y = x + along * dx, y + along * dy
        curvature, conic = surface.curvature, surface.conic
        if curvature or surface.asphere:
            f, g = curvature * (x * x + y * y), dz - curvature * (x * dx + y * dy)
            root = g * g - curvature * f * (1 + conic * (dz * dz) if conic else 1.0)
            along = f / (g + side * np.sqrt(root))
            x, y, height = x + along * dx, y + along * dy, along * dz
            for _ in range(NEWTON_STEPS if surface.asphere else 0):
                sag, slope = surface.sag(x * x + y * y)
                along = (sag - height) / (dz - 2 * slope * (x * dx + y * dy))
                x, y, height = x + along * dx, y + along * dy, height + along * dz
            z = surface.z + height
        else:
            z, height = surface.z, 0.0
        if clip and surface.rim < np.inf:
            within = x * x + y * y <= surface.rim * surface.rim
            passes = within if passes is None else passes & within
        before, behind = surface.before, surface.behind
        if before is behind or (isinstance(before, float) and isinstance(behind, float) and before == behind):
            continue
        ratio = before / behind if to_film else behind / before
        dx, dy, dz = _refracted((dx, dy, dz), _normal(surface, x, y, height, side), ratio)
    if passes is not None:
        dx = np.where(passes, dx, np.nan)
    return (x, y, z), (dx, dy, dz)


def _normal(surface: LensSurface, x, y, height, side: float):
    """Return the unit normal along the light at a point of a surface, ``height`` over its vertex."""
    curvature, conic = surface.curvature, surface.conic
    if surface.asphere:
        squared = x * x + y * y
        _, slope = surface.sag(squared)
        size = side / np.sqrt(1 + 4 * slope * slope * squared)
        return -2 * slope * x * size, -2 * slope * y * size, size
    size = side / np.sqrt(1 - conic * curvature * curvature * (x * x + y * y)) if conic else side
    return -curvature * x * size, -curvature * y * size, (1 - (1 + conic) * curvature * height) * size


def _refracted(direction, normal, ratio):
    (dx, dy, dz), (nx, ny, nz) = direction, normal
    cosine = dx * nx + dy * ny + dz * nz
    along = np.sqrt(1 - ratio * ratio * (1 - cosine * cosine)) - ratio * cosine
    return ratio * dx + along * nx, ratio * dy + along * ny, ratio * dz + along * nz
