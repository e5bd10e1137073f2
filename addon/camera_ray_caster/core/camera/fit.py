"""The camera of another model nearest to a camera: least squares over the pixels of a region.

Assumption: the rays of both leave one eye; those of a real lens are taken to where they meet its plane of focus. The
residual of a pixel is the vector from it to the pixel at which the fitted camera sees the pixel's ray, in pixels. The
sum of squares that is made least is that of at most SAMPLED times SAMPLED pixels, even over the region, with those at
its edges; worst and mean are those of all pixels of the region.
Pixels without a ray do not count, nor do those whose rays the fitted camera does not see: they are counted apart.
Singular: parameters that move all pixels alike, such as focal length and sensor, are determined only together. Those of
HELD keep their values unless they are asked for.
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from math import degrees, floor
from typing import Any

import numpy as np

from ..arguments import shown
from ..cameras.model import Model
from ..maths.vector import stacked
from ..memory import of_pixels, require
from ..records import InputError
from .build import camera_from
from .camera import Camera
from .fit_search import KEPT_IN_ALL, Search
from .fit_start import guesses

SAMPLED = 61
"""Largest number of columns and of rows of pixels that are summed over."""

HELD = {"skew", "sensor_width", "sensor_height", "ftheta_d", "ftheta_e", "ocam_d", "ocam_e", "ocam_polynomial[1]"}
"""Parameters that are 0 for most lenses, or that another one replaces."""

HELD_OF = {"OPENCV_PINHOLE": {"k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"}}
"""Further ones of a model: those that OpenCV's calibration holds by default as well."""

LISTS = {"RAY_TABLE": "rays", "SCANNER": "beams"}
"""Models that are lists, not formulas, and of what."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A camera of another model, and how far its pixels are from those of the first camera."""

    camera: Camera
    """The fitted camera: at the same place, with a picture of the same size."""
    parameters: dict[str, float]
    """The numbers that were fitted, by name; the others of ``camera.parameters`` have kept their values."""
    covariance: np.ndarray
    """Their covariance, (n, n), if each coordinate of a pixel errs by itself with the variance of the residuals."""
    residual: np.ndarray
    """The vector from each pixel to where the fitted camera sees its ray, in pixels, (rows, columns, 2), y up, row 0 at
    the bottom; NaN outside of the region, without a ray, and where the fitted camera does not see it."""
    worst: float
    """Largest length of the residuals, in pixels."""
    mean: float
    """Mean length of the residuals, in pixels."""
    unseen: int
    """Number of pixels of the region whose rays the fitted camera does not see."""
    converged: bool
    """Whether the search ended at a minimum; else at an edge of the settings or of what the fitted camera sees."""

    def __repr__(self) -> str:
        return f"<Fit: {self.summary}>"

    @property
    def summary(self) -> str:
        """The model and its distance from the first camera, in one line."""
        line = f"{self.camera.model.label}, at most {self.worst:.2g} and in the mean {self.mean:.2g} pixels away"
        line += f", does not see {self.unseen} pixels" if self.unseen else ""
        return line if self.converged else f"{line}, at an edge of what it can be: fit a smaller region"


def fit_model(
    camera: Camera,
    kind: type[Model],
    region: np.ndarray | None = None,
    free: Collection[str] | None = None,
    explicit: Mapping[str, Any] | None = None,
) -> Fit:
    """Return the camera of a model nearest to a camera.

    region: bool, (rows, columns) of the full frame; None for all of it. free: names of the parameters to fit; None for
    all but HELD and those that are given. explicit: values in records of settings, from which the search starts.

    Raises InputError, in one line, if there is nothing to fit, for a parameter that does not exist, and if the model
    sees fewer than LEFT of the rays; it then names a smaller region.
    """
    if camera.pixel_time is not None:
        raise InputError(f"pixels of camera {camera.name!r} have their own times: fit that of one frame, at(frame)")
    if kind.key in LISTS:
        raise InputError(f"{kind.label} lists its {LISTS[kind.key]} and has no formula to fit: choose another model")
    for model, name in ((camera.model, f"camera {camera.name!r}"), (kind, kind.label)):
        if not (model.central or (model is camera.model and model.focused_at)):
            raise InputError(f"the rays of {name} have no eye in common: only cameras with one eye can be fitted")
    width, height = camera.raster.size
    require(64 * width * height, of_pixels("the residuals", (height, width)))
    region = np.ones((height, width), bool) if region is None else region
    rays = _rays(camera)
    there = region & np.isfinite(rays).all(axis=-1)
    if not there.any():
        raise InputError(f"camera {camera.name!r} has no ray in the region: there is nothing to fit")
    explicit = dict(explicit or {})
    held = HELD | HELD_OF.get(kind.key, set()) | explicit.keys()
    rows, columns = (_even(there.any(axis=axis)) for axis in (1, 0))
    region_rays = np.zeros_like(there)
    region_rays[np.ix_(rows, columns)] = there[np.ix_(rows, columns)]
    starts = guesses(camera, kind, explicit)
    for setting in kind.SETTINGS:
        if setting.name in explicit:
            setting.read(starts[0])  # refuses a value out of its range, by name
    sought = camera.raster, _pixels(region_rays), rays[region_rays]
    searches = [Search.of(kind, start, *sought, free, held) for start in starts]
    search, values, converged, counted = _best(searches)
    if counted < KEPT_IN_ALL:
        angles, near = _angles(rays[region_rays]), search.near()
        edge = floor(10 * (angles.max() if near.all() else angles[~near].min())) / 10
        remedy = f"fit those within {degrees(edge):.0f} degrees of the viewing direction (within={edge:g}), or fewer"
        problem = f"{kind.label} sees fewer than half of the rays"
        raise InputError(f"{problem}: {remedy if edge else 'choose another region, or another model'}")
    fitted = camera_from(search.record(values))
    residual = np.full((height, width, 2), np.nan)
    with np.errstate(all="ignore"):  # NaN means not seen
        residual[there] = fitted.model.project(rays[there]) - _pixels(there)
    lengths = np.hypot(*residual[there].T)
    seen = lengths[np.isfinite(lengths)]
    parameters = dict(zip(search.names, values.tolist(), strict=True))
    return Fit(
        fitted, parameters, search.covariance(values), residual, float(seen.max()), float(seen.mean()),
        len(lengths) - len(seen), converged,
    )  # fmt: skip


def region_of(camera: Camera, within, name: str = "within") -> np.ndarray:
    """Return a part of the picture as bool, (rows, columns), of one of the forms that ``crc.fit`` takes as ``within``.
    Raises InputError, which names the argument, for anything else.
    """
    width, height = camera.raster.size
    if isinstance(within, int | float | np.number) and not isinstance(within, bool):
        if not 0 < within <= np.pi:
            raise InputError(f"{name} is {shown(within)}: as an angle it must be above 0, up to pi")
        rays = _rays(camera)
        with np.errstate(invalid="ignore"):  # NaN means no ray
            return _angles(rays) <= float(within)
    try:
        region = np.asarray(within)
    except ValueError:  # lists of unequal length
        region = np.zeros(0)
    if region.dtype == bool and region.shape == (height, width):
        return region
    if region.shape == (4,) and region.dtype.kind in "iu":
        x0, y0, x1, y1 = region.tolist()
        if 0 <= x0 < x1 <= width and 0 <= y0 < y1 <= height:
            result = np.zeros((height, width), bool)
            result[y0:y1, x0:x1] = True
            return result
    raise InputError(
        f"{name} is {shown(within)}: it must be (x0, y0, x1, y1) within the frame of {width} x {height} pixels, a bool "
        f"array of shape ({height}, {width}), or an angle in radians"
    )


def _angles(rays: np.ndarray) -> np.ndarray:
    """Return the angles (...) of rays (..., 3) from the viewing direction."""
    return np.arctan2(np.hypot(rays[..., 0], rays[..., 1]), -rays[..., 2])


def _best(searches: list[Search]) -> tuple[Search, np.ndarray, bool, float]:
    """Return the search that keeps most rays in view, among equals the one with the least sum, and its result.

    Once one has ended at a minimum with all rays, those that begin with fewer are left out: they see no more.
    """
    results: list[tuple[Search, np.ndarray, bool, float]] = []
    for search in searches:
        if not any(converged and counted == 1 for *_, converged, counted in results) or search.near().all():
            results.append((search, *search.run()))
    offs = [search.residual(values) for search, values, *_ in results]
    ranks = [
        (counted < KEPT_IN_ALL, np.isnan(off).sum(), np.nansum(off**2))
        for (*_, counted), off in zip(results, offs, strict=True)
    ]
    return results[ranks.index(min(ranks))]


def _rays(camera: Camera) -> np.ndarray:
    """Return the directions of all pixels of the frame, (rows, columns, 3), in the camera's frame."""
    width, height = camera.raster.size
    x, y = np.arange(width)[None, :] + 0.5, np.arange(height)[:, None] + 0.5
    with np.errstate(all="ignore"):  # NaN means no ray
        origin, direction = camera.model.rays(x, y)
        if not camera.model.central:
            t = ((camera.model.focused_at or 0.0) + origin[2]) / -direction[2]
            direction = tuple(o + np.where(t > 0, t, np.nan) * d for o, d in zip(origin, direction, strict=True))
        rays = stacked(direction, (height, width))
        return rays / np.linalg.norm(rays, axis=-1, keepdims=True)


def _pixels(region: np.ndarray) -> np.ndarray:
    return np.argwhere(region)[:, ::-1] + 0.5


def _even(used: np.ndarray) -> np.ndarray:
    """Return at most SAMPLED indices, even from the first to the last that is used."""
    first, last = np.flatnonzero(used)[[0, -1]]
    return np.unique(np.linspace(first, last, min(last - first + 1, SAMPLED)).round().astype(int))
