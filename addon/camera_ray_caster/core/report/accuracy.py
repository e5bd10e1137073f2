"""Accuracy of the hits of a cast: error bounds at an even sample of its pixels, computed in milliseconds."""

from dataclasses import dataclass, field, replace
from math import isqrt
from typing import Self

import numpy as np

from ..camera.camera import Camera
from ..camera.pixel_time import groups
from ..casting.coincident import coincident
from ..casting.hit_values import HitValues
from ..casting.hits import Hits
from ..casting.pixels import hits_at
from ..casting.plan import Plan, make_plan
from ..conventions import EPS32
from ..records import Raster, Shapes
from ..shapes.search_rays import Crossings

PIXELS = 4096
"""Maximum number of pixels in the sample."""

MOMENTS = 64
"""Maximum number of sampled moments if pixels have their own times: the shapes are placed anew at each moment."""

UNNOTED_SHARE = 1e-3
"""Share of the pixels up to which coincident surfaces are not noted."""

COINCIDENT = (
    "another surface is in the same place at {count:,} of the {pixels:,} pixels{sampled}: it is arbitrary which one is "
    "seen there, also in uv, indices and colors"
)

QUANTITIES = {
    "distance": "world units",
    "relative_distance": "of the distance",
    "position": "world units, as a vector's length",
    "normal": "of the unit normal, as a vector's length",
}
"""Quantities with error bounds, and the units of the bounds."""


@dataclass(frozen=True, eq=False)
class Accuracy:
    """Error bounds of the sampled pixels that hit something.

    The bounds hold for the numbers as calculated. Storing them adds up to ``stored`` of each number.
    """

    pixels: int = 0
    """Number of sampled pixels; 0 if nothing was cast."""
    bounds: np.ndarray = field(default_factory=lambda: np.zeros((0, len(QUANTITIES))))
    """Bounds (hits, 4), one column for each of QUANTITIES; inf where no bound is known."""
    stored: float = EPS32
    """The unit roundoff of the numbers that are stored: Blender's are float32."""
    coincident: int = 0
    """Number of sampled pixels in which another surface is in the same place as the nearest one."""
    names: tuple[str, ...] = ()
    """The names of the objects with these surfaces."""

    @property
    def hits(self) -> int:
        """Number of sampled pixels that hit something."""
        return len(self.bounds)

    def median(self, quantity: str) -> float | None:
        """Return the median bound of one of QUANTITIES; None if nothing is hit."""
        return float(np.median(self._column(quantity))) if self.hits else None

    def worst(self, quantity: str) -> float | None:
        """Return the largest bound of one of QUANTITIES; None if nothing is hit."""
        return float(self._column(quantity).max()) if self.hits else None

    def as_data(self) -> dict[str, object]:
        """Return the entry of a report's file; its bounds are None if nothing is hit."""
        bounds = {
            name: {"unit": unit, "median_bound": self.median(name), "worst_bound": self.worst(name)}
            for name, unit in QUANTITIES.items()
        }
        return {
            "sampled_pixels": self.pixels,
            "hits": self.hits,
            **bounds,
            "rounding_when_stored": self.stored,
            "coincident_pixels": self.coincident,
        }

    def notes(self, pixels: int) -> tuple[tuple[str, str], ...]:
        """Return the notes on surfaces in the same place, each with its object's name, given the pixels of the picture.
        There are none below UNNOTED_SHARE: where two surfaces only touch, single pixels may see both.
        """
        if self.coincident <= UNNOTED_SHARE * self.pixels:
            return ()
        whole = pixels <= self.pixels
        count = self.coincident if whole else round(self.coincident * pixels / self.pixels)
        sampled = "" if whole else f", estimated from {self.pixels:,}"
        note = COINCIDENT.format(count=count, pixels=pixels, sampled=sampled)
        return tuple((name, note) for name in self.names)

    def _column(self, quantity: str) -> np.ndarray:
        return self.bounds[:, list(QUANTITIES).index(quantity)]

    def __add__(self, other: Self) -> Self:
        """Return both samples as one."""
        return replace(
            self,
            pixels=self.pixels + other.pixels,
            bounds=np.concatenate((self.bounds, other.bounds)),
            coincident=self.coincident + other.coincident,
            names=tuple(dict.fromkeys((*self.names, *other.names))),
        )


def accuracy(camera: Camera, shapes: Shapes, plan: Plan) -> Accuracy:
    """Return the error bounds of the hits of a cast with this plan, or with plans like it.

    The bounds are evaluated at up to PIXELS pixels, evenly spread over the render window, or at all if there are no
    more. The chief rays of these pixels are cast again, by the same kernels. With a clock each pixel is evaluated at
    its own moment. If the sample has more than MOMENTS moments, only the pixels of evenly chosen moments are evaluated.
    The worst bound is that of the sample.
    """
    x, y = sample(camera.raster)
    if camera.pixel_time is None:
        return _at(plan, x, y)
    total = Accuracy()
    moments = list(groups(camera.pixel_time, x, y))
    for frame, rows, columns, where in moments[:: -(-len(moments) // MOMENTS)]:
        moment_plan = make_plan(camera.at(frame), shapes.at(frame), plan.request)
        total += _at(moment_plan, x[:, columns], y[rows], where)
    return total


def sample(raster: Raster) -> tuple[np.ndarray, np.ndarray]:
    """Return the x (1, columns) and y (rows, 1) of at most PIXELS pixel centers, evenly over the render window.

    Rows and columns have the same step. A lattice of rays thus remains a lattice, which the search of meshes by spans
    needs: see ``shapes.mesh.spans``.
    """
    height, width = raster.shape
    step = isqrt(max(0, height * width - 1) // PIXELS) + 1
    while -(-height // step) * -(-width // step) > PIXELS:
        step += 1
    rows, columns = (slice((side - 1) % step // 2, None, step) for side in (height, width))
    return raster.columns()[:, columns], raster.rows()[rows]


def _at(plan: Plan, x: np.ndarray, y: np.ndarray, where: np.ndarray | bool = True) -> Accuracy:
    """Return the accuracy at the pixels of x (1, columns) and y (rows, 1) at which ``where`` is true."""
    met: list[Crossings] = []
    hits = hits_at(plan, np.floor(x[0]).astype(int), np.floor(y[:, 0]).astype(int), met)
    meant = np.broadcast_to(where, hits.t.shape)
    pixel, coincident_index = coincident(hits, met)
    here = meant.reshape(-1)[pixel]
    pixel, coincident_index, shapes = pixel[here], coincident_index[here], plan.shapes
    rows = np.unique(np.concatenate((hits.index.reshape(-1)[pixel], coincident_index)).astype(np.intp))
    names = tuple(shapes.names[name] for name in np.unique(shapes.name_index[rows]).tolist())
    return Accuracy(int(np.count_nonzero(meant)), _bounds(hits, meant), coincident=len(np.unique(pixel)), names=names)


def _bounds(hits: Hits, meant: np.ndarray) -> np.ndarray:
    """Return the bounds, (hits, 4), at the pixels that are meant."""
    bounds = [np.zeros((0, len(QUANTITIES)))]
    with np.errstate(all="ignore"):
        for seen, errors in HitValues(hits).errors:
            relative = errors.distance / (np.abs(errors.t) * errors.rays.length)
            of_kind = np.stack((errors.distance, relative, errors.position, errors.normal), axis=1)
            bounds.append(np.where(np.isnan(of_kind), np.inf, of_kind)[meant[seen]])
    return np.concatenate(bounds)
