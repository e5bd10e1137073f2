"""Casting at given pixels: the lattice of some columns and rows, at one moment."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..camera.camera import Camera
from ..maths.speed import Scratch
from ..records import Shapes
from ..scene import Scene
from ..shapes.search_rays import Crossings
from .hits import Hits
from .pass_needs import pictures
from .passes import PASSES
from .plan import Plan, make_plan
from .rays import rays_of
from .request import Request
from .search import nearest_hits
from .store import store
from .tiles import shares


def hits_at(
    plan: Plan, columns: np.ndarray, rows: np.ndarray, met: list[Crossings] | None = None,
    listen: Callable[[], object] = bool,
) -> Hits:  # fmt: skip
    """Return the hits of chief rays at the pixels of columns (k,) and rows (l,), ascending, numbered in the full frame,
    within the render window of the plan. One plan serves any number of lattices, and the whole picture. ``met``: see
    ``SearchRays``; ``listen``: see ``nearest_hits``.
    """
    raster, camera = plan.camera.raster, plan.camera
    of_lattice = plan.at_pixels(columns - raster.x0, rows - raster.y0)
    with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
        rays = rays_of(camera, columns[None, :] + 0.5, rows[:, None] + 0.5, (0, 0), Scratch())
        return nearest_hits(of_lattice, rays, listen, met=met)


def is_hit(plan: Plan, scratch: Scratch) -> np.ndarray:
    """Return whether the chief ray of each pixel of a plan hits something, (rows, columns) bool, in this thread."""
    raster = plan.camera.raster
    is_seen, columns, rows = np.empty(raster.shape, bool), raster.columns(), raster.rows()
    with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
        for tile in shares(plan, threads=1):
            centers = columns[:, tile.columns], rows[tile.rows], (tile.columns.start, tile.rows.start)
            hits = nearest_hits(plan, rays_of(plan.camera, *centers, scratch))
            is_seen[tile.rows, tile.columns] = hits.seen
    return is_seen


def passes_at(
    camera: Camera, shapes: Shapes, columns: np.ndarray, rows: np.ndarray, passes: Sequence[str], **options
) -> dict[str, np.ndarray]:
    """Return passes, (l, k[, channels]) float64 or of the pass's own type, at columns (k,) and rows (l,) of the full
    frame, ascending, also outside of the render window. The camera is taken as it is now, without its pixel times.
    ``options`` are those of ``Request``.
    """
    still = window_of(camera, columns, rows)
    request = Request(tuple(passes), others=pictures(Scene(camera, shapes), passes), **options)
    return stored(hits_at(make_plan(still, shapes, request), columns, rows), passes)


def window_of(camera: Camera, columns: np.ndarray, rows: np.ndarray) -> Camera:
    """Return the camera as it is now, without its pixel times, with the smallest render window that has the pixels of
    columns (k,) and rows (l,) of the full frame, ascending.
    """
    ends = {"x0": columns[0], "x1": columns[-1] + 1, "y0": rows[0], "y1": rows[-1] + 1}
    return replace(camera, raster=replace(camera.raster, **ends), pixel_time=None)


def stored(hits: Hits, passes: Iterable[str]) -> dict[str, np.ndarray]:
    """Return some passes of hits, (rows, columns[, channels]) float64 or of the pass's own type."""
    images = {name: PASSES[name].empty(hits.rays.shape, np.float64) for name in passes}
    with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
        store(hits, images)
    return images
