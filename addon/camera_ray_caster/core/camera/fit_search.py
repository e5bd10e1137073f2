"""The search for the settings of a model that bring given rays to given pixels: the method of Levenberg and Marquardt.

Derivatives by the settings are exact (``maths.recording.varied``). A step that leaves the range of a setting, or loses
many rays from view, is not taken; the few that others lose at the rim count again once they are back. Steps are found
by orthogonal factors, not by normal equations, since the coefficients of a polynomial differ by many powers of ten.
Each is bent by the second derivative along it, since the least sums lie in curved valleys: focal length and shape of a
lens nearly replace each other.
References: J. Moré, The Levenberg-Marquardt Algorithm: Implementation and Theory (1978); M. Transtrum and J. Sethna,
Improvements to the Levenberg-Marquardt Algorithm for Nonlinear Least-Squares Minimization (2012).
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace

import numpy as np

from ..arguments import unknown
from ..cameras.model import Model
from ..cameras.parts.parameters import parameters_of, varied, with_parameters
from ..records import BlenderCamera, InputError, Pose, Raster
from .jacobian import of_settings

MOST_STEPS, MOST_ROUNDS = 500, 10
"""Largest numbers of steps, and of searches with more of the rays: those that come into view."""

DAMPED, LEAST, MOST = 1e-3, 1e-15, 1e15
"""First, least and largest damping, over the squares of the derivatives' norms."""

SETTLED, EXACT = 1e-10, 1e-12
"""A step ends the search if it is expected to change the residual by no more than this part of it, or by this part of
the largest pixel coordinate."""

FLAT = 1e-3
"""Largest cosine of the residuals with what changes of the parameters do, at a minimum for rays that come and go."""

KEPT_IN_STEP, KEPT_IN_ALL = 0.99, 0.5
"""Least part of the rays that a step must keep in view, of those that it had; and of all, or the search gives up."""

PROBE, BENT = 0.1, 0.4
"""Part of a step after which the residuals tell how they bend; and the largest length of the bend over the step's."""

STILL = Pose(np.zeros(3), np.eye(3))


@dataclass(frozen=True, eq=False)
class Search:
    """The rays and pixels of a fit, and the names of the parameters that it changes, from a record on."""

    kind: type[Model]
    start: BlenderCamera
    raster: Raster
    pixels: np.ndarray
    """(n, 2)"""
    rays: np.ndarray
    """(n, 3), in the camera's frame."""
    names: tuple[str, ...]

    @classmethod
    def of(
        cls, kind: type[Model], start: BlenderCamera, raster: Raster, pixels, rays,
        free: Collection[str] | None, held: Collection[str],
    ) -> Search:  # fmt: skip
        """Return the search for the free parameters; None: all but those that are held, or move no pixel.

        Raises InputError for a parameter that does not exist, if no parameter is left, and if the model sees fewer rays
        than it has parameters.
        """
        known = parameters_of(kind.SETTINGS, start)
        for name in free or ():
            if name not in known:
                raise unknown(f"parameter of {kind.key}", name, known)
        names = tuple(name for name in known if (name not in held if free is None else name in free))
        search = cls(kind, start, raster, pixels, rays, names)
        values = search.values
        seen = search.seen(values)
        if free is None and seen.any():
            moves = np.abs(search.derivatives(values, seen)).max(axis=0) > 0
            moving = tuple(name for name, is_moving in zip(names, moves, strict=True) if is_moving)
            search = replace(search, names=moving)
        if not search.names:
            raise InputError(f"{kind.label} has no parameter to fit: name some, or leave more of its settings open")
        if 2 * seen.sum() < len(search.names):
            count = f"{seen.sum()} of {len(seen)} rays"
            raise InputError(f"{kind.label} sees {count}, too few to fit: choose another region")
        return search

    @property
    def values(self) -> np.ndarray:
        """The parameters at the start."""
        known = parameters_of(self.kind.SETTINGS, self.start)
        return np.array([known[name] for name in self.names])

    def record(self, values: np.ndarray) -> BlenderCamera:
        """Return the record with other parameters."""
        known = parameters_of(self.kind.SETTINGS, self.start) | dict(zip(self.names, values.tolist(), strict=True))
        return with_parameters(self.kind.SETTINGS, self.start, known.values())

    def residual(self, values: np.ndarray) -> np.ndarray:
        """Return the vectors from the pixels to those that see the rays (n, 2): NaN for rays that are not seen, and for
        all if a setting is out of its range.
        """
        try:
            with np.errstate(all="ignore"):  # NaN means not seen
                return self.kind.from_blender(self.record(values), self.raster).project(self.rays) - self.pixels
        except InputError:
            return np.full(self.pixels.shape, np.nan)

    def seen(self, values: np.ndarray) -> np.ndarray:
        """Return which rays are seen."""
        return np.isfinite(self.residual(values)).all(axis=1)

    def derivatives(self, values: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """Return the derivatives of the residuals of some rays by the parameters, (2 n, k)."""
        raw = varied(self.kind.SETTINGS, self.record(values), self.names)
        with np.errstate(all="ignore"):  # of limits that are infinite
            model = self.kind.from_blender(raw, self.raster)
        pixels = (self.residual(values) + self.pixels)[seen]
        derivatives = of_settings(model, len(self.names), STILL, self.rays[seen], pixels)
        return np.nan_to_num(derivatives.reshape(-1, len(self.names)), nan=0.0, posinf=0.0, neginf=0.0)

    def near(self) -> np.ndarray:
        """Return which rays are seen at the start, and no farther from their pixels than the picture is large."""
        with np.errstate(invalid="ignore"):  # NaN means not seen
            return np.abs(self.residual(self.values)).max(axis=1) <= max(self.raster.size)

    def run(self) -> tuple[np.ndarray, bool, float]:
        """Return the parameters of the least sum of squares, whether the search ended at a minimum, and the part of the
        rays that counted; below KEPT_IN_ALL it has given up.

        Rays that are not near at the start count once the others have brought the lens nearer to them.
        """
        values, converged, seen = self.values, False, self.near()
        seen = seen if seen.mean() >= KEPT_IN_ALL else self.seen(values)
        for _ in range(MOST_ROUNDS):
            values, converged, counted = self._descended(values, seen)
            if counted.mean() < KEPT_IN_ALL:
                return values, False, counted.mean()
            seen = self.seen(values)
            if (seen == counted).all():
                return values, converged, counted.mean()
        return values, converged and self._is_least(values, seen), counted.mean()

    def _is_least(self, values: np.ndarray, seen: np.ndarray) -> bool:
        """Return whether no change of the parameters would lower the sum of squares of these rays by much."""
        off, slopes = self.residual(values)[seen].ravel(), self.derivatives(values, seen)
        size = np.linalg.norm(slopes, axis=0)
        along = np.linalg.qr(slopes[:, size > 0] / size[size > 0])[0].T @ off
        return bool(np.linalg.norm(along) <= FLAT * np.linalg.norm(off))

    def covariance(self, values: np.ndarray) -> np.ndarray:
        """Return the covariance of the parameters if each coordinate errs by itself with the residuals' variance."""
        seen = self.seen(values)
        slopes = self.derivatives(values, seen)
        size = np.linalg.norm(slopes, axis=0)
        size = np.where(size > 0, size, 1.0)
        upper = np.linalg.qr(slopes / size, mode="r")
        back = np.linalg.pinv(upper) / size[:, None]
        left = max(slopes.shape[0] - slopes.shape[1], 1)
        return back @ back.T * float((self.residual(values)[seen] ** 2).sum()) / left

    def _descended(self, values: np.ndarray, seen: np.ndarray) -> tuple[np.ndarray, bool, np.ndarray]:
        """See ``run``; of the rays that are seen at first, each counts until a step loses it. Last those that count."""
        damping, largest = DAMPED, np.zeros(len(values))
        off = self.residual(values)[seen].ravel()
        exact = EXACT * max(self.raster.size) * np.sqrt(len(off))
        for _ in range(MOST_STEPS):
            if seen.mean() < KEPT_IN_ALL:
                break
            slopes = self.derivatives(values, seen)
            largest = np.maximum(largest, np.linalg.norm(slopes, axis=0))
            size = np.where(largest > 0, largest, 1.0)
            while True:
                solve = _damped(slopes / size, damping)
                step = solve(-off)
                moved = slopes / size @ step
                if np.linalg.norm(moved) <= max(SETTLED * np.linalg.norm(off), exact):
                    return values, bool(damping <= 1), seen
                probe = self.residual(values + PROBE * step / size)[seen].ravel()
                bend = solve(np.nan_to_num((moved - (probe - off) / PROBE) / PROBE))
                if np.linalg.norm(bend) <= BENT * np.linalg.norm(step):
                    step = step + bend
                new = self.residual(values + step / size)[seen].ravel()
                kept = np.isfinite(new)
                if kept.mean() > KEPT_IN_STEP and new[kept] @ new[kept] < off[kept] @ off[kept]:
                    values, off, damping = values + step / size, new[kept], max(damping / 10, LEAST)
                    seen = seen.copy()
                    seen[seen] = kept[::2]
                    break
                damping *= 10
                if damping > MOST:
                    return values, False, seen
        return values, False, seen


def _damped(slopes: np.ndarray, damping: float) -> Callable[[np.ndarray], np.ndarray]:
    """Return the function from a change of the residuals to the damped step that makes it, nearly."""
    q, r = np.linalg.qr(np.concatenate((slopes, np.sqrt(damping) * np.eye(slopes.shape[1]))))
    back = np.linalg.pinv(r) @ q[: len(slopes)].T
    return lambda wanted: back @ wanted
