"""The lens of JPL's CAHVOR and CAHVORE: distortion about an axis of its own, o, that is not the camera's.

A direction at the angle theta from o is seen at the radius chi (1 + r0 + r1 chi^2 + r2 chi^4) in the plane across o,
which a matrix, that of H, V and A by rows, takes to the pixel: (0, 0) is the center of the first. chi is tan(theta) of
CAHVOR; with a linearity L it is tan(L theta) / L, below 0 sin(L theta) / L, and at 0 theta. The pupil of CAHVORE moves
along o, by (theta / sin(theta) - 1) (e0 + e1 theta^2 + e2 theta^4).
The frame of the lens has z along o. With L = 1 and a pupil that stands still, it is OpenCV's pinhole, whose tilted
sensor is just such a matrix; all other lenses are tables of rays.
References: D. Gennery, Generalized camera calibration including fish-eye lenses (2006); mrcal documentation, Lens
models.
"""

from math import asin, atan2
from typing import Any

import numpy as np

from ...cameras.parts.tilt import Tilt
from ...maths.rotations import rotation
from .document import Document
from .lens import Lens, matrix
from .ray_arrays import sampled

NEWTON_STEPS = 50
"""Of the secant method for the turn about o, and of Newton's for chi, which end sooner."""
ROUNDING = 1e-12
"""Part of a radius, or of the matrix, that is rounding."""
TINY = 1e-300
"""In place of a radius of 0."""


def lens_of(
    document: Document, size: dict[str, Any], rows, axis, radial, pupil=(0.0, 0.0, 0.0), linearity: float = 1.0
) -> tuple[Lens, np.ndarray]:
    """Return the lens, and its axes by columns, x right, y down, z along o, in the frame of the matrix, by rows, and of
    ``axis``. Raises InputError for a camera without a picture.
    """
    ahead = np.array(axis) / (np.linalg.norm(axis) or 1.0)
    right = np.cross(rows[1], rows[2])  # moves a pixel along x alone
    right = right - (right @ ahead) * ahead
    right /= np.linalg.norm(right) or 1.0
    axes = np.stack((right, np.cross(ahead, right), ahead), axis=1)
    seen = np.array(rows) @ axes
    if not (radial[0] > -1 and np.linalg.det(seen) > 0 and seen[2, 2] > 0):
        raise document.refusal("its camera is mirrored or looks away from its axis: check H, V, A, O and R")
    if linearity != 1 or any(pupil):
        sides = [int(side) for side in size.values()] if all(size.values()) else document.picture_size
        if sides is None:
            raise document.refusal("it does not tell the size of its pictures: give size=")
        return sampled(document, sides, _rays(seen, radial, pupil, linearity), "OPENCV"), axes
    seen[:, :2] *= 1 + radial[0]
    seen /= np.linalg.norm(seen[2])
    turn, before = 0.0, 1e-3
    (K, tilt), error = _on_sensor(seen, turn), _on_sensor(seen, before)[0][1, 0]
    for _ in range(NEWTON_STEPS):  # until the second row of K is without x
        if abs(K[1, 0]) <= ROUNDING * K[1, 1] or K[1, 0] == error:
            break
        before, turn, error = turn, turn - K[1, 0] * (turn - before) / (K[1, 0] - error), K[1, 0]
        K, tilt = _on_sensor(seen, turn)
    settings = matrix(K[0, 0], K[1, 1], K[0, 2], K[1, 2]) | {"skew": K[0, 1], "tau_x": tilt.tau_x, "tau_y": tilt.tau_y}
    settings = {name: float(value) for name, value in settings.items()}
    terms = {"k1": radial[1] / (1 + radial[0]), "k2": radial[2] / (1 + radial[0])}
    return Lens("", "OPENCV_PINHOLE", size | settings | terms), axes @ _about_z(turn)


def _about_z(turn: float) -> np.ndarray:
    return rotation(np.array([[0.0, 0.0, turn]]))[0]


def _on_sensor(seen: np.ndarray, turn: float) -> tuple[np.ndarray, Tilt]:
    """Return the matrix from a tilted sensor to the pixel, and the tilt, with the lens turned about its axis."""
    turned = seen @ _about_z(turn)
    tilt = Tilt(atan2(-turned[2, 1], turned[2, 2]), asin(turned[2, 0]))
    return turned @ tilt.columns.T, tilt


def _rays(seen: np.ndarray, radial, pupil, linearity: float):
    """Return the function from pixels to directions and origins; NaN beyond the radius where the polynomial folds."""
    back, (r0, r1, r2) = np.linalg.inv(seen), radial

    def rays(x, y):
        plane = np.stack((x, y, np.ones_like(x)), axis=-1) @ back.T
        with np.errstate(all="ignore"):
            q = np.where(plane[..., 2:] > 0, plane[..., :2] / plane[..., 2:], np.nan)
            radius = np.hypot(*np.moveaxis(q, -1, 0))
            chi = radius / (1 + r0)
            for _ in range(NEWTON_STEPS):
                square = chi * chi
                slope = 1 + r0 + square * (3 * r1 + square * 5 * r2)
                short = chi * (1 + r0 + square * (r1 + square * r2)) - radius
                chi = chi - short / slope
            chi = np.where((slope > 0) & (np.abs(short) <= ROUNDING * (1 + radius)), chi, np.nan)
            scaled = linearity * chi
            theta = (np.arcsin(scaled) if linearity < 0 else np.arctan(scaled)) / linearity if linearity else chi
            theta = np.where(theta < np.pi, theta, np.nan)
            sine = np.sin(theta)
            across = q * (sine / np.maximum(radius, TINY))[..., None]
            square = theta * theta
            moved = np.where(theta > 0, theta / sine - 1, 0.0) * (pupil[0] + square * (pupil[1] + square * pupil[2]))
        origins = np.zeros((*x.shape, 3))
        origins[..., 2] = moved
        return np.concatenate((across, np.cos(theta)[..., None]), axis=-1), origins

    return rays
