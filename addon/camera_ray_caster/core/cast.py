"""Cast a camera's rays at shapes: plan, nearest hits, passes, tile by tile."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from threading import local
from time import perf_counter

import numpy as np

from .camera import Camera
from .hits import Scratch, nearest
from .passes import PASSES
from .plan import Plan, make_plan
from .records import Cancelled, Shapes
from .shading import MATERIAL


class Images(dict):
    """The passes by name, (rows, columns[, channels]) arrays, row 0 at the bottom; beside them how they were made."""

    plan: Plan
    seconds: dict[str, float]


def cast(
    camera: Camera,
    shapes: Shapes,
    passes: Sequence[str] = ("depth", "normal"),
    dtype=np.float32,
    *,
    shading: str = MATERIAL,
    threads: int | None = None,
    cull: bool = True,
    progress: Callable[[float], bool] | None = None,
) -> Images:
    """Return the passes of the camera's render window as a mapping of name to array.

    dtype is what passes of real numbers are stored as; the arithmetic is float64. object_index, material_index
    and shape_index are int32, valid is bool. ``progress(fraction)`` is called in the calling thread after each tile;
    where it returns False the cast stops within the tiles under way and raises Cancelled. ``cull=False`` tests
    every shape at every pixel: the same picture, slower. Raises InputError for an unknown pass.
    """
    started = perf_counter()
    plan = make_plan(camera, shapes, passes, tuple(PASSES), shading, cull)
    height, width = camera.raster.shape
    images = Images()
    for name in plan.passes:
        kind = PASSES[name]
        images[name] = np.empty((height, width, kind.channels)[: 3 if kind.channels else 2], kind.dtype or dtype)
    images.plan = plan
    images.seconds = {"plan": perf_counter() - started, "hits": 0.0, "passes": 0.0}

    threads_own = local()

    def tile(first_row: int) -> tuple[float, float]:
        with np.errstate(all="ignore"):  # NaN and inf are answers here: no ray, no hit
            began = perf_counter()
            last_row = min(first_row + plan.tile_rows, height)
            if not hasattr(threads_own, "scratch"):
                threads_own.scratch = Scratch()
            hits = nearest(plan, first_row, last_row, threads_own.scratch)
            found = perf_counter()
            for rows, block in hits.blocks():
                for name in plan.passes:
                    PASSES[name].write(block, images[name][first_row:last_row][rows])
            return found - began, perf_counter() - found

    workers = threads or os.cpu_count() or 1
    started = perf_counter()
    hits_time, passes_time = _run(tile, range(0, height, plan.tile_rows), workers, progress)
    busy = max(hits_time + passes_time, np.finfo(float).tiny)
    elapsed = perf_counter() - started
    images.seconds |= {"hits": elapsed * hits_time / busy, "passes": elapsed * passes_time / busy}
    return images


def _run(tile, starts, workers: int, progress) -> np.ndarray:
    """Run tiles on threads (numpy releases the interpreter) and return the sum of what they return."""
    total = np.zeros(2)
    with ThreadPoolExecutor(workers) as pool:
        waiting = {pool.submit(tile, start) for start in starts}
        done = 0
        try:
            while waiting:
                finished, waiting = wait(waiting, return_when=FIRST_COMPLETED)
                for future in finished:
                    total += future.result()
                    done += 1
                    if progress is not None and not progress(done / len(starts)):
                        raise Cancelled
        finally:
            for future in waiting:
                future.cancel()
    return total
