"""Basis of a camera's verification: a sample of its rays, and the finding that a comparison results in."""

from dataclasses import dataclass
from typing import Any, Protocol, Self

import numpy as np

from ..records import Finding, Pose, Raster, Rays


class CameraRays(Protocol):
    """Part of a camera that verification uses."""

    @property
    def raster(self) -> Raster:
        """The frame and its render window."""

    def rays_at(self, x, y) -> Rays:
        """Return the world rays through pixel coordinates."""

    @property
    def pose(self) -> Pose:
        """Position and axes of the camera."""

    def project(self, points) -> np.ndarray:
        """Return the pixel coordinates of world points."""

    def pixel_rounding(self, x, y) -> tuple[Any, Any]:
        """Return the rounding that precedes a model's formula, in pixels; see ``Model``."""

    @property
    def formula_reach(self) -> float:
        """Largest distance from the eye of the formula's other geometry, such as slits; see ``Model``."""


@dataclass(frozen=True)
class Sample:
    """Rays of n pixels of the render window."""

    pixels: np.ndarray
    """Centers of the pixels (n, 2), computed from their indices without the camera."""
    origins: np.ndarray
    directions: np.ndarray
    valid: np.ndarray
    distance: float
    """Distance of the points along the rays: the largest coordinate of the rays' origins, at which float32 is best."""

    @classmethod
    def of(cls, camera: CameraRays, grid: int) -> Self:
        raster = camera.raster
        height, width = raster.shape
        i, j = _spread(width, grid), _spread(height, grid)
        rays = camera.rays_at(raster.columns()[:, i], raster.rows()[j])
        x, y = np.meshgrid(raster.x0 + i + 0.5, raster.y0 + j + 0.5)
        origins = rays.origins.reshape(-1, 3)
        far = float(np.nan_to_num(np.abs(origins)).max())
        pixels = np.stack((x.ravel(), y.ravel()), axis=1)
        return cls(pixels, origins, rays.directions.reshape(-1, 3), rays.valid.ravel(), far if far > 1e-20 else 1.0)

    @property
    def points(self) -> np.ndarray:
        return self.origins + self.distance * self.directions


def finding(name: str, errors, angles, bound_pixels, bound_radians, margin) -> Finding:
    """Return the finding of a comparison: worst and median errors, (n, 2) and (n,), and the bounds plus ``margin``."""
    pixels = length_of(errors)
    return Finding(
        witness=name,
        points=len(pixels),
        worst_pixels=largest(pixels),
        median_pixels=float(np.median(pixels)) if len(pixels) else 0.0,
        bound_pixels=largest(bound_pixels) + margin[0],
        worst_radians=largest(angles),
        median_radians=float(np.median(angles)) if len(angles) else 0.0,
        bound_radians=largest(bound_radians) + margin[1],
    )


def not_compared(name: str, reason: str) -> Finding:
    """Return the finding of a reference that has no answer."""
    return Finding(name, 0, *6 * (float("nan"),), not_compared=reason)


def largest(errors) -> float:
    """Return the largest error; 0 if there are none, NaN if any is NaN."""
    return float(np.max(errors, initial=0.0))


def _spread(count: int, grid: int) -> np.ndarray:
    """Return up to ``grid`` of the numbers 0 .. count - 1, evenly spaced, including the first and the last."""
    return np.unique(np.linspace(0, count - 1, grid).round().astype(int))


def length_of(vectors):
    """Return the lengths of vectors (n, m)."""
    return np.linalg.norm(vectors, axis=1)


def angles_between(left, right):
    """Return the angles between unit vectors (n, 3), from their difference, which keeps small angles accurate."""
    return 2 * np.arcsin(np.minimum(length_of(left - right) / 2, 1.0))
