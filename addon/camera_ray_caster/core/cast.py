"""Cast a camera's rays at shapes: plan, nearest hits, passes, tile by tile."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace
from itertools import pairwise
from threading import local
from time import perf_counter

import numpy as np

from .camera.camera import Camera
from .camera.pixel_time import PixelTime, groups
from .casting.passes import PASSES, add_combined, put, store
from .casting.plan import Plan, make_plan
from .casting.search import nearest
from .casting.shading import MATERIAL
from .maths.speed import STRIP, Scratch, keep_memory, sharing
from .records import Cancelled, InputError, Shapes

STEPS = "rays", "cast", "passes"
"""What the seconds of a tile are spent on: rays, their nearest hits, the passes of these."""

TILE_PIXELS = 1 << 18, 1 << 20
"""The fewest and the most pixels of a tile, the unit of threads, progress and canceling."""

TILE_WORK = 1 << 23
"""The most work of a tile, all its samples counted: a tenth of a second. Below that a thread has one tile."""

ALONE = 1 << 18
"""Work that takes as long as what threads do one at a time for a tile, holding the interpreter: 0.4 to 3 ms, measured
with 1 to 15 tiles. Without heed to it 16 threads took two to four times as long as two.
"""

PLACED = 64
"""Work that takes as long as what a tile's own plan does for a shape without the interpreter."""


class Images(dict):
    """The passes by name, (rows, columns[, channels]) arrays, row 0 at the bottom; beside them how they were made."""

    plan: Plan
    seconds: dict[str, float]


@dataclass(frozen=True)
class Tile:
    """A part of the picture that is cast at once."""

    rows: slice
    columns: slice
    frame: float | None = None
    """The moment it is of; None where the picture has one time."""
    where: np.ndarray | None = None
    """The pixels of the part that are meant; None for all."""


def cast(
    camera: Camera,
    shapes: Shapes,
    passes: str | Sequence[str] = ("depth", "normal"),
    dtype=np.float32,
    *,
    shading: str = MATERIAL,
    samples: int = 1,
    threads: int | None = None,
    cull: bool = True,
    precision: str = "AUTOMATIC",
    progress: Callable[[float], bool] | None = None,
) -> Images:
    """Return the passes of the camera's render window as a mapping of name to array.

    dtype is what passes of real numbers are stored as; the arithmetic is float64, but ``precision="FAST"`` searches for
    hits with float32. object_index, material_index and shape_index are int32, valid is bool. With ``samples`` above 1
    the combined pass is the mean of as many rays a pixel, all over the pixel and the camera's aperture; all other
    passes are of the chief rays. ``threads``: so many at most, one a processor if None; fewer where they
    would wait for each other. ``progress(fraction)`` is called in the calling thread after each tile; where it returns
    False the cast stops within the tiles under way and raises Cancelled. ``cull=False`` tests every shape at every
    pixel: the same picture, slower.
    Raises InputError for an unknown pass, shading or precision and for less than one sample or thread.
    """
    if samples < 1:
        raise InputError(f"{samples} samples make no picture: ask for 1 or more")
    started = perf_counter()
    keep_memory()
    threads = (os.cpu_count() or 1) if threads is None else threads
    if threads < 1:
        raise InputError(f"{threads} threads make no picture: ask for 1 or more")
    passes = (passes,) if isinstance(passes, str) else passes
    known = tuple(PASSES)
    time = camera.pixel_time
    middle = _moment(camera, shapes, (time.first + time.last) / 2) if time else (camera, shapes)
    whole = make_plan(*middle, passes, known, shading, cull, False, precision)
    height, width = camera.raster.shape
    images = Images()
    for name in whole.passes:
        kind = PASSES[name]
        images[name] = np.empty((height, width, kind.channels)[: 3 if kind.channels else 2], kind.dtype or dtype)
    sampled = ("combined",) if samples > 1 and "combined" in passes else ()
    chief = tuple(name for name in whole.passes if name not in sampled)
    plans: dict[bool, Plan] = {}
    if camera.pixel_time is not None:
        tiles = list(_moments(camera, camera.pixel_time))
    else:
        plans[False] = whole
        if sampled:
            plans[True] = make_plan(*middle, passes, known, shading, cull, True, precision)
        tiles = list(_shares(plans.get(True, whole), threads, samples if sampled else 1))
    images.plan = whole
    images.seconds = {"plan": perf_counter() - started}
    own = local()

    def run(tile: Tile) -> np.ndarray:
        if not hasattr(own, "scratch"):
            own.scratch = Scratch(whole.real)
        seconds = np.zeros(len(STEPS))
        then = (camera, shapes) if tile.frame is None else _moment(camera, shapes, tile.frame)
        for names, count in ((chief, 1), (sampled, samples)):
            if names:
                with np.errstate(all="ignore"):  # NaN and inf are answers here: no ray, no hit
                    plan = plans.get(count > 1) or make_plan(*then, names, known, shading, cull, count > 1, precision)
                    seconds += _cast_tile(tile, plan, names, count, images, own.scratch)
        return seconds

    began = perf_counter()
    own_plan = 0 if camera.pixel_time is None else PLACED * len(shapes)
    others = round((whole.work.sum() / len(tiles) + own_plan) / ALONE)  # may hold the interpreter meanwhile
    busy = _in_threads(run, tiles, min(threads, 1 + others), progress)
    share = (perf_counter() - began) / max(busy.sum(), np.finfo(float).tiny)
    images.seconds |= dict(zip(STEPS, busy * share, strict=True))
    return images


def _shares(plan: Plan, threads: int, samples: int = 1) -> Iterator[Tile]:
    """Yield the picture in whole strips, for each thread that gains by it a share of about the same work.

    samples: how many rays each pixel has.
    """
    height, width = plan.camera.raster.shape
    least, most = TILE_PIXELS
    if samples > 1:
        most //= 2  # their sum takes as much memory as all else
    done = np.cumsum(plan.work)
    threads = sharing(threads, done[-1] / ALONE)
    count = min(threads * -(-int(done[-1] * samples) // (threads * TILE_WORK)), -(-height * width // least))
    cuts = np.searchsorted(done, done[-1] * np.arange(1, count) / count)
    cuts = np.unique(np.clip(np.rint(cuts / STRIP), 1, height // STRIP - 1).astype(int)) * STRIP
    for first, last in pairwise((0, *cuts[(cuts > 0) & (cuts < height)].tolist(), height)):
        yield from _bands(slice(first, last), slice(0, width), most)


def _bands(rows: slice, columns: slice, pixels: int) -> Iterator[Tile]:
    """Yield a part of the picture in whole rows, so many pixels at a time at most, all alike."""
    step = max(1, pixels // (columns.stop - columns.start))
    count = -(-(rows.stop - rows.start) // step)
    for first, last in pairwise(np.linspace(rows.start, rows.stop, count + 1).astype(int).tolist()):
        yield Tile(slice(first, last), columns)


def _moments(camera: Camera, pixel_time: PixelTime) -> Iterator[Tile]:
    """Yield the picture time by time."""
    for frame, rows, columns, where in groups(pixel_time, camera.raster.columns(), camera.raster.rows()):
        rows, columns = (slice(*s.indices(n)) for s, n in zip((rows, columns), camera.raster.shape, strict=True))
        for tile in _bands(rows, columns, TILE_PIXELS[0]):
            meant = where[tile.rows.start - rows.start : tile.rows.stop - rows.start]
            yield replace(tile, frame=frame, where=None if meant.all() else meant)


def _moment(camera: Camera, shapes: Shapes, frame: float) -> tuple[Camera, Shapes]:
    if camera.motion is shapes.motion and camera.motion is not None:
        return camera.motion.at(frame)
    return camera.at(frame), shapes if shapes.motion is None else shapes.motion.shapes_at(frame)


def _cast_tile(tile: Tile, plan: Plan, names, samples: int, images: Images, scratch: Scratch) -> np.ndarray:
    """Cast one tile and store its passes; return the seconds of STEPS."""
    camera = plan.camera
    raster = camera.raster
    x, y = raster.columns()[:, tile.columns], raster.rows()[tile.rows]
    corner = tile.columns.start, tile.rows.start
    part = tile.rows, tile.columns
    seconds = np.zeros(len(STEPS))
    total = np.zeros((y.size, x.size, 4)) if samples > 1 else None
    for sample in range(samples):
        began = perf_counter()
        if total is None:
            from_eye = camera.model.central
            origin, direction = camera.camera_rays(x, y)
        else:
            from_eye = camera.model.central and camera.aperture is None
            origin, direction = camera.sample_rays(x, y, sample)
        generated = perf_counter()
        hits = nearest(plan, origin, direction, from_eye, corner, scratch)
        found = perf_counter()
        if total is None:
            store(hits, {name: images[name][part] for name in names}, tile.where)
        else:
            add_combined(hits, total)
        seconds += generated - began, found - generated, perf_counter() - found
    if total is not None:
        total /= samples
        put(total, images["combined"][part], tile.where)
    return seconds


def _in_threads(run, tiles, workers: int, progress) -> np.ndarray:
    """Run tiles on threads (numpy releases the interpreter) and return the sum of what they return."""
    total = np.zeros(len(STEPS))
    with ThreadPoolExecutor(workers) as pool:
        waiting = [pool.submit(run, tile) for tile in tiles]
        try:
            for done, future in enumerate(as_completed(waiting), 1):
                total += future.result()
                if progress is not None and not progress(done / len(tiles)):
                    raise Cancelled
        finally:
            for future in waiting:
                future.cancel()
    return total
