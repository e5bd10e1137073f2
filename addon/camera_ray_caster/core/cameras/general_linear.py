"""The general linear camera: all affine combinations of three rays.

A ray is given by (s, t, u, v): its points (s, t) on the plane through the camera, z = 0, and (u, v) on the plane at
unit depth before it, z = -1 (the camera looks along -Z). Ray 1 belongs to the frame's bottom left corner, ray 2 to the
bottom right corner, ray 3 to the top left corner. Pixel (x, y) of W x H has the ray
(1 - alpha - beta) ray_1 + alpha ray_2 + beta ray_3 with alpha = x / W, beta = y / H. Rays start on z = 0.

The place of a ray at a depth is a constant plus M (alpha, beta), with the 2 x 2 matrix M = S + depth D. At the roots of
det M = C + B depth + A depth^2, the left side of the characteristic equation, the rays meet slits.
Singular: points at those depths, which no pixel or many pixels see.
Reference: J. Yu and L. McMillan, General Linear Cameras, ECCV 2004.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from ..conventions import EPS32
from ..maths.intervals import Interval
from ..maths.recording import array, is_recorded
from ..maths.vector import components
from ..records import BlenderCamera, InputError, Raster
from .model import IN_RAYS, Model, Step
from .parts.settings import Numbers, Setting
from .parts.silhouette import MARGINS

RAY_ROUNDING = 16 * EPS32
"""Magnitude relative to the rays' numbers below which a value counts as zero: Blender stores the rays as float32."""

STEEPEST = 1e6
"""Largest slope of the three rays: with steeper ones the determinant keeps too few digits for a pixel."""

RAYS = tuple(
    Numbers(
        f"ray_{k}", f"Ray {k}",
        f"The ray at the {corner} of the frame: x and y on the camera's plane, x and y at depth 1", (0.0, 0.0, u, v),
        ("s, X on the plane", "t, Y on the plane", "u, X at depth 1", "v, Y at depth 1"),
    )
    for k, corner, u, v in (
        (1, "bottom left", -0.36, -0.2), (2, "bottom right", 0.36, -0.2), (3, "top left", -0.36, 0.2),
    )
)  # fmt: skip


@dataclass(frozen=True)
class GeneralLinear(Model):
    """Three rays (s, t, u, v), (3, 4), over the frame."""

    three: np.ndarray

    key = "GENERAL_LINEAR"
    label = "General Linear"
    description = "Each ray is an affine combination of three given rays"
    group = "Multiperspective"
    number = 10
    central = False
    polynomials = IN_RAYS
    SETTINGS: ClassVar[tuple[Setting, ...]] = RAYS
    FORMULA: ClassVar[tuple[Step, ...]] = (
        Step("Place in the frame", "alpha = x/W, beta = y/H"),
        Step("Origin, among those of the three rays", "o = (1 - alpha - beta) o_1 + alpha o_2 + beta o_3"),
        Step("At depth 1, among the points of the three rays", "q = (1 - alpha - beta) q_1 + alpha q_2 + beta q_3"),
        Step("Direction", "r = q - o"),
    )

    def formula_values(self, x, y):
        """See Model: where the three rays pierce the camera's plane, and the plane at depth 1."""
        origins = {f"o_{k}": np.array((s, t, 0.0)) for k, (s, t, _, _) in enumerate(self.three, 1)}
        return origins | {f"q_{k}": np.array((u, v, -1.0)) for k, (_, _, u, v) in enumerate(self.three, 1)}

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> GeneralLinear:
        """See Model. Rays that, as points, lie on one line are refused, and slopes beyond STEEPEST."""
        three = array([ray.read(raw) for ray in RAYS])
        if is_recorded(*three.flat):  # what is refused is that of who gives numbers to the record
            return cls(raster.size, three)
        rows = (three[1:] - three[0]).astype(np.float64)  # points in four dimensions, on one line if a value is 0
        if np.linalg.svd(rows, compute_uv=False)[-1] <= RAY_ROUNDING * np.abs(three).max():
            names, rays = ", ".join(ray.name for ray in RAYS), ", ".join(str(tuple(ray)) for ray in three.tolist())
            raise InputError(
                f"{names} of camera {raw.name!r} are dependent, {rays}: as points (s, t, u, v) they must "
                "not lie on one line"
            )
        slopes = np.abs(three[:, 2:] - three[:, :2]).max(axis=1)
        if slopes.max() > STEEPEST:
            ray = RAYS[int(slopes.argmax())]
            raise ray.refusal(raw, f"{ray.read(raw)}", f"of slopes (u - s, v - t) up to {STEEPEST:.0f}")
        return cls(raster.size, three)

    @property
    def smooth(self) -> bool:  # type: ignore[override]
        """See Model: a camera of kind EPI has rays, but no inverse."""
        return self.kind != "EPI"

    @property
    def kind(self) -> str:
        """The kind of this camera among the general linear cameras."""
        return classify(self.three)

    @cached_property
    def affine(self) -> np.ndarray:
        """An array (3, 4): s, t and the slopes u - s, v - t of ray 1, and their derivatives by alpha and by beta."""
        rows = self.three - np.outer((0, 1, 1), self.three[0])
        return np.concatenate((rows[:, :2], rows[:, 2:] - rows[:, :2]), axis=1)

    def rays(self, x, y):
        """See Model. The origin and the slopes are right to gamma(5) of the sum of the magnitudes of the three rays'
        numbers.
        """
        alpha, beta = x / self.size[0], y / self.size[1]
        s, t, slope_x, slope_y = (a + (alpha * b + beta * c) for a, b, c in self.affine.T.tolist())
        scale = 1 / np.sqrt(slope_x * slope_x + (slope_y * slope_y + 1))
        return (s, t, 0.0), (slope_x * scale, slope_y * scale, -scale)

    def project(self, points):
        """See Model: NaN behind z = 0, where there are no rays, and at the depths of the slits. A camera of kind EPI
        sees a single plane, and all its points are NaN.
        """
        x, y, z = components(np.asarray(points, np.float64))
        across, up, determinant = self._solved(x, y, z)
        determinant = np.where((z <= 0) & (determinant != 0), determinant, np.nan)
        return np.stack((across / determinant * self.size[0], up / determinant * self.size[1]), axis=-1)

    def bounds(self, centers, radii):
        across, up, determinant = self._solved(*(Interval.around(c, radii) for c in components(centers)))
        x, y = across / determinant * self.size[0], up / determinant * self.size[1]
        bounds = np.stack((x.low, x.high, y.low, y.high), axis=-1) + MARGINS
        bounds[centers[:, 2] > radii] = np.nan
        return bounds

    def facts(self) -> dict[str, object]:
        """Return the kind of this camera among the general linear cameras."""
        return {"kind": self.kind}

    def _solved(self, x, y, z):
        """Return alpha det M, beta det M and det M of points, or of intervals, by Cramer's rule."""
        (s, t, slope_x, slope_y), a, b = self.affine.tolist()
        beside_x, beside_y = x + slope_x * z - s, y + slope_y * z - t
        a_x, a_y, b_x, b_y = a[0] - a[2] * z, a[1] - a[3] * z, b[0] - b[2] * z, b[1] - b[3] * z
        return b_y * beside_x - b_x * beside_y, a_x * beside_y - a_y * beside_x, a_x * b_y - a_y * b_x


def classify(three) -> str:
    """Return the kind of the camera that three rays (3, 4) span, by its characteristic equation.

    Two real roots are two slits: cross-slit. A double root is a pinhole if M vanishes there, else a pencil. No real
    root: bilinear. With A = 0, one slit is at infinity: pushbroom if the other is not, twisted orthographic if both
    are, orthographic if all slopes are equal. EPI: every depth is a root, and the rays lie in one plane.
    """
    rows = np.asarray(three)[1:] - np.asarray(three)[0]
    s, d = rows[:, :2].T, (rows[:, 2:] - rows[:, :2]).T
    size_s, size_d = np.abs(s).max(), np.abs(d).max()
    if size_d <= RAY_ROUNDING * np.abs(three).max():
        return "orthographic"
    c, a = (differences[0, 0] * differences[1, 1] - differences[0, 1] * differences[1, 0] for differences in (s, d))
    b = s[0, 0] * d[1, 1] + d[0, 0] * s[1, 1] - s[0, 1] * d[1, 0] - d[0, 1] * s[1, 0]
    if abs(a) <= RAY_ROUNDING * size_d**2:
        if abs(b) > RAY_ROUNDING * size_s * size_d:
            return "pushbroom"
        return "twisted orthographic" if abs(c) > RAY_ROUNDING * size_s**2 else "EPI"
    discriminant = b * b - 4 * a * c
    if abs(discriminant) > RAY_ROUNDING * (b * b + 4 * abs(a * c) + (size_s * size_d) ** 2):
        return "cross-slit" if discriminant > 0 else "bilinear"
    depth = -b / (2 * a)
    apart = np.abs(s + depth * d).max()
    return "pinhole" if apart <= np.sqrt(RAY_ROUNDING) * (size_s + abs(depth) * size_d) else "pencil"
