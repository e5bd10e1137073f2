"""A table of rays: any camera by the rays of its pixels, as it was measured, computed or exported.

Assumption: rays change smoothly from entry to entry. The entries are the centers of pixels, or of squares of pixels,
that fill the frame; a frame of another size has the same rays, as a picture that is scaled. Between the entries unit
directions, and origins if there are any, are interpolated component by component, by a cubic spline or by straight
lines; half an entry beyond the outermost ones they are continued. Entries with NaN are squares without rays.
If the table has blocks, rays are interpolated within each and not across their edges, as behind microlenses.
Without interpolation each square has the ray of its entry, and neighbors may look anywhere; a
point is seen by the entry whose ray passes nearest, if it is nearer than half the way to an entry beside it.
A table may also have the control points of a cubic B-spline, as the generic cameras of T. Schöps et al.
The inverse is numerical. ``facts`` has the errors of the interpolation, estimated from every second row and column.
Singular: places where the table's rays do not change from entry to entry, such as the poles of a panorama.
Refused: tables that fold, where pixels next to each other see one point.
References: M. Grossberg and S. Nayar, A general imaging model and a method for finding its parameters, ICCV 2001;
T. Schöps et al., Why having 10,000 parameters in your camera model is better than twelve, CVPR 2020.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..conventions import FROM_BLENDER, gamma
from ..maths.recording import is_recorded, look_up, vector
from ..maths.recording.scalars import plain
from ..maths.speed import taken
from ..maths.vector import is_grid, norm
from ..records import BlenderCamera, InputError, Raster
from .model import Model, Step
from .parts.calibration import FROM_FILE
from .parts.ray_grid import BORDER_ENTRIES, LINEAR, NONE, SPLINE, RayGrid, weights_of
from .parts.ray_search import entries_of, places_of
from .parts.ray_settings import AREA, AXES, BLOCK_COLUMNS, BLOCK_ROWS, DIRECTIONS, INTERPOLATION, OPENCV, ORIGINS, SLIDE
from .parts.silhouette import MARGINS

BESIDE = 1e-9
"""Fraction of an entry by which a place may lie beyond the table: rounding must not lose the frame's edges."""

TABLES_KEPT, LARGE_KEPT, LARGE = 12, 4, 1 << 24
"""Number of tables that are kept, and of large ones, whose directions have so many numbers together: the cameras of a
rig read their tables for every frame. Eight of 96 x 54 entries take 1.6 s to prepare, and 15 MB each.
"""

_latest: dict[tuple, tuple] = {}


@dataclass(frozen=True)
class RayTable(Model):
    """A table over the frame: place u = x scale_x + shift_x of an entry, 0 to columns - 1, and v likewise."""

    grid: RayGrid
    scale: tuple[float, float]
    """Entries per pixel."""
    shift: tuple[float, float]
    """The place of the frame's corner (0, 0)."""

    key = "RAY_TABLE"
    label = "Ray Table"
    description = "Rays as a table gives them: measured, computed or exported, one for each pixel or fewer"
    group = "Calibrated"
    number = 26
    BESIDE_FILE = (*FROM_FILE, AXES, INTERPOLATION, BLOCK_COLUMNS, BLOCK_ROWS, SLIDE)
    SETTINGS = (*BESIDE_FILE, DIRECTIONS, ORIGINS, AREA)
    FORMULA = (
        Step("Place in the table, from the center of its first entry", "u = a x + g, v = c y + h"),
        Step("The rest beyond column i and row j, the entry before it", "s = u - i, t = v - j"),
        Step(
            "Weights of the four columns around it, and of rows by t",
            "w0 = (1 - s)³/6, w1 = (4 - 3 s² (2 - s))/6, w2 = (4 - 3 (1 - s)² (1 + s))/6, w3 = s³/6",
        ),
        Step("Direction: the sum m of the entries around it with both weights, over its length n", "r = m / n"),
    )
    LINES = Step("Weights of the two columns around it, and of rows by t", "w0 = 1 - s, w1 = s")
    ENTRY = Step("Direction: that of the nearest entry, m, over its length n", "r = m / n")
    ORIGIN = Step("Origin, the sum q of the origins with the same weights", "o = q")

    @property
    def steps(self):
        """See Model: a table with straight lines has other weights, and one with origins a sum of them."""
        position, entry, weights, direction = self.FORMULA
        weights = self.LINES if self.grid.kind == LINEAR else weights
        steps = (position, self.ENTRY) if self.is_by_entry else (position, entry, weights, direction)
        return *steps, *([] if self.central else [self.ORIGIN])

    @property
    def is_by_entry(self) -> bool:
        """Whether each pixel has the ray of an entry, without interpolation."""
        return self.grid.kind == NONE

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> RayTable:
        """See Model. A table that is missing is refused, and one that ``RayGrid`` refuses."""
        directions, origins = DIRECTIONS.read(raw), ORIGINS.read(raw)
        if directions is None:
            raise InputError(
                f"camera {raw.name!r} has no table of rays: choose its file (Calibration), or give {DIRECTIONS.name}"
            )
        (left, bottom, right, top), kind = AREA.read(raw), INTERPOLATION.read(raw)
        if not (right > left and top > bottom):
            raise AREA.refusal(raw, f"{AREA.read(raw)}", "left, bottom, right, top, in ascending order")
        try:
            block = int(BLOCK_ROWS.read(raw)), int(BLOCK_COLUMNS.read(raw))
            grid = _grid(directions, origins, kind, AXES.read(raw), SLIDE.read(raw), block)
        except InputError as error:
            raise InputError(f"table of rays of camera {raw.name!r}: {error}") from error
        rows, columns = grid.shape
        wide, high = columns / (right - left), rows / (top - bottom)
        scale, shift = (wide / raster.width, high / raster.height), (-left * wide - 0.5, -bottom * high - 0.5)
        return cls(raster.size, grid, scale, shift)

    @property
    def central(self) -> bool:  # type: ignore[override]  # a table tells by its origins
        return self.grid.origins is None

    @property
    def bounds_are_wide(self) -> bool:  # type: ignore[override]
        """See Model: if rays have origins of their own."""
        return not self.central

    @property
    def smooth(self) -> bool:  # type: ignore[override]
        """See Model: straight lines have kinks, and between blocks, or without interpolation, rays jump."""
        return self.grid.kind not in (LINEAR, NONE) and self.grid.blocks.many == 1

    @property
    def differentiable(self) -> bool:  # type: ignore[override]
        """See Model: without interpolation pixels are single rays."""
        return not self.is_by_entry

    @property
    def guarded(self) -> bool:  # type: ignore[override]
        """See Model: an entry sees what is nearer to its ray than to those of others."""
        return not self.is_by_entry

    def rays(self, x, y):
        """Return origin and unit direction; see Model."""
        inside, total = self._sums(x, y)
        length = norm(total[:3])
        length = np.where(inside & (length > 0), length, np.nan)
        return tuple(total[3:]) or (0.0, 0.0, 0.0), tuple(component / length for component in total[:3])

    def _sums(self, x, y):
        """Return whether there are entries at pixels, and the interpolated components: 3, or 6 with an origin.

        They are sums of differences from one entry, so that derivatives lose no digits where entries differ little.
        """
        grid, (rows, columns) = self.grid, self.grid.shape
        u, v = (pixel * scale + shift for pixel, scale, shift in zip((x, y), self.scale, self.shift, strict=True))
        margin = 1.0 if grid.kind == SPLINE else -0.5
        in_u, in_v = _is_within(u, columns, margin), _is_within(v, rows, margin)
        u, v, inside = np.where(in_u, u, margin + 0.25), np.where(in_v, v, margin + 0.25), in_u & in_v
        if grid.has_holes:
            near_u, near_v = (np.clip(np.floor(at + 0.5), 0, n - 1) for at, n in ((u, columns), (v, rows)))
            inside = inside & (look_up(grid.has_ray, _whole(near_v * columns + near_u)) > 0)
        if self.is_by_entry:
            u, v = u + 0.5, v + 0.5
        (rows, columns), wide = grid.blocks.size, grid.blocks.size[1] + 2 * BORDER_ENTRIES
        between_blocks = wide * (rows + 2 * BORDER_ENTRIES)
        s, column = _cell(u, columns, grid.blocks.per_axis[1], 1, between_blocks)
        t, row = _cell(v, rows, grid.blocks.per_axis[0], wide, between_blocks * grid.blocks.per_axis[1])
        across, up = weights_of(s, grid.kind), weights_of(t, grid.kind)
        column, spread = _shared(column, row)
        first, taps = BORDER_ENTRIES - (len(across) == 4), range(len(across))
        corner = _whole(row + column + first * (wide + 1))
        index = corner + (BORDER_ENTRIES - first) * (wide + 1)
        total = []
        for entries in grid.columns:
            base = look_up(entries, index)
            beside = (_sum(up, (look_up(entries, corner + (k * wide + i)) - base for k in taps)) for i in taps)
            total.append(spread(base) + _sum(across, map(spread, beside)))
        return inside, total

    def project(self, points):
        """See Model: the numerical inverse, from the entry whose ray passes nearest to the point."""
        points = np.asarray(points, np.float64)
        find = entries_of if self.is_by_entry else places_of
        with np.errstate(all="ignore"):  # NaN and inf are valid results: no ray
            places = find(self.grid, points.reshape(-1, 3))
            pixels = (places - self.shift) / self.scale
            pixels[np.isnan(self.rays(*pixels.T)[1][0])] = np.nan
        return pixels.reshape(*points.shape[:-1], 2)

    def bounds(self, centers, radii):
        """See Model: those of the parts of the table whose rays may meet the balls."""
        (a, c), (b, d) = self.scale, self.shift
        places = self.grid.seen_parts.bounds(centers, radii)
        return (places - (b, b, d, d)) / (a, a, c, c) + MARGINS

    @property
    def formula_reach(self) -> float:
        return self.grid.farthest

    @property
    def ray_rounding(self) -> float:
        """See Model: of weights (5 each), of sums of 4 products of them (4 each), and of the length and the quotient,
        over the length that the sum has at least.
        """
        return gamma(24) * self.grid.largest / self.grid.shortest

    def formula_rounding(self, x, y):
        """See Model: the rounding of origins, which are sums as directions are."""
        return gamma(20) * self.grid.farthest, 0.0

    def formula_values(self, x, y):
        """See Model: the numbers of the table's place in the frame, the entry, and the weighted sums."""
        (a, c), (g, h) = self.scale, self.shift
        sums = [plain(component) for component in self._sums(x, y)[1]]
        values = {"a": a, "g": g, "c": c, "h": h, "i": np.floor(x * a + g), "j": np.floor(y * c + h)}
        values |= {"m": vector(*sums[:3]), "n": plain(norm(sums[:3]))}
        return values | ({} if self.central else {"q": vector(*sums[3:])})

    def facts(self) -> dict[str, object]:
        """See Model: the size of the table, the number of entries without rays, and the estimated errors between
        entries: of directions, in radians, and of origins, a distance.
        """
        angle, distance = self.grid.errors
        rows, columns = self.grid.shape
        facts: dict[str, object] = {
            "table": [columns, rows],
            "entries_without_ray": int((~self.grid.known).sum()),
            "interpolation_error": angle,
        }
        return facts if self.central else facts | {"interpolation_error_of_origins": distance}


def _is_within(position, count: int, margin: float):
    return (position >= margin - BESIDE) & (position <= count - 1 - margin + BESIDE)


def _cell(position, side: int, count: int, step: int, between_blocks: int):
    """Return the place, 0 to 1, in the cell of places of entries, and the index of its entry in the flat table: of
    ``count`` blocks of ``side`` entries, whose entries are ``step`` and which are ``between_blocks`` apart.
    """
    block = np.clip(np.floor((position + 0.5) / side), 0, count - 1) if count > 1 else 0
    local = position - block * side
    entry = np.clip(np.floor(local), -1, side - 1)
    return local - entry, entry * step + block * between_blocks


def _shared(column, row) -> tuple[Any, Callable]:
    """Return columns whose values at the rows are needed, and a function that gives those of ``column`` from theirs:
    the pixels of a picture that lie in one cell share what does not depend on their place in it.
    """
    if is_recorded(column, row) or np.ndim(column) != 2 or not is_grid(column, row):
        return column, lambda values: values
    cells, inverse = np.unique(column, return_inverse=True)
    return cells[None], lambda values: taken(values, inverse.ravel())


def _whole(number):
    """Return a whole number or an array of them in the type of an index, for ``look_up``."""
    return number if is_recorded(number) else np.asarray(number).astype(np.intp)


def _sum(weights, values):
    total = 0.0
    for weight, value in zip(weights, values, strict=True):
        total = total + weight * value
    return total


def _grid(directions, origins, kind: str, axes: str, slide: bool, block: tuple[int, int]) -> RayGrid:
    """Return the table of some arrays, which are kept with it: the same arrays give the same table."""
    asked = (id(directions), id(origins), kind, axes, slide, block)
    kept = _latest.get(asked)  # other threads may clear the tables
    if kept is None:
        flip = FROM_BLENDER.diagonal()[:3] if axes == OPENCV else 1.0
        grid = RayGrid(directions * flip, None if origins is None else origins * flip, kind, block)
        numbers = sum(table[0].size for table in list(_latest.values()))
        if len(_latest) >= (LARGE_KEPT if numbers > LARGE else TABLES_KEPT):
            _latest.clear()
        kept = _latest[asked] = directions, origins, grid.slid() if slide else grid
    return kept[-1]
