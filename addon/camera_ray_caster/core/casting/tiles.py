"""Division of a picture into tiles, and their casting in threads."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, replace
from itertools import pairwise
from threading import Lock, local
from time import perf_counter

import numpy as np

from .. import tuning
from ..camera.camera import Camera
from ..camera.pixel_time import PixelTime, groups
from ..maths.speed import STRIP, Scratch, lending, sharing
from ..records import Cancelled
from .plan import Plan
from .rays import chief_rays, sampled_rays
from .search import nearest_hits
from .store import add_combined, put, store

STEPS = "rays", "cast", "passes"
"""The steps whose seconds are measured per tile: making the rays, finding the nearest hits, writing the passes."""


LISTEN = 0.05
"""Maximum seconds between two calls of ``progress`` in the calling thread."""


class Effort:
    """The progress of a cast, and whether it is to stop; its threads report each finished sample of a tile."""

    def __init__(self, steps: int):
        self._steps, self._done, self._lock, self._stopped = steps, 0, Lock(), False

    @property
    def fraction(self) -> float:
        """The finished fraction, 0 to 1."""
        return self._done / self._steps if self._steps else 1.0

    def step(self) -> None:
        """Count a finished step. Raises Cancelled as ``listen`` does."""
        with self._lock:
            self._done += 1
        self.listen()

    def listen(self) -> None:
        """Raise Cancelled if the cast is to stop."""
        if self._stopped:
            raise Cancelled

    def stop(self) -> None:
        """Make every thread end the next time that it calls ``listen``."""
        self._stopped = True


@dataclass(frozen=True)
class Tile:
    """A part of the picture that is cast at once."""

    rows: slice
    columns: slice
    frame: float | None = None
    """The frame at which the tile is cast; None if the picture has one time."""
    where: np.ndarray | None = None
    """Which pixels of the part are written, bool; None for all."""


def shares(plan: Plan, threads: int, samples: int = 1) -> Iterator[Tile]:
    """Yield the picture in whole strips of rows, with about the same work for each thread that speeds up the cast.

    samples: number of rays per pixel.
    """
    height, width = plan.camera.raster.shape
    least, most = tuning.TILE_PIXELS
    if samples > 1 or height * width > 8 * most:
        most //= 2  # a sum doubles the memory; smaller tiles suffice if there are many, and stop sooner
    done = np.cumsum(plan.work)
    threads = sharing(threads, done[-1] / tuning.SERIAL_WORK)
    count = min(threads * -(-int(done[-1] * samples) // (threads * tuning.TILE_WORK)), -(-height * width // least))
    cuts = np.searchsorted(done, done[-1] * np.arange(1, count) / count)
    cuts = np.unique(np.clip(np.rint(cuts / STRIP), 1, height // STRIP - 1).astype(int)) * STRIP
    for first, last in pairwise((0, *cuts[(cuts > 0) & (cuts < height)].tolist(), height)):
        yield from _bands(slice(first, last), slice(0, width), most)


def moments(camera: Camera, pixel_time: PixelTime) -> Iterator[Tile]:
    """Yield the tiles of each frame of the pixel times."""
    for frame, rows, columns, where in groups(pixel_time, camera.raster.columns(), camera.raster.rows()):
        rows, columns = (slice(*s.indices(n)) for s, n in zip((rows, columns), camera.raster.shape, strict=True))
        for tile in _bands(rows, columns, tuning.TILE_PIXELS[0]):
            meant = where[tile.rows.start - rows.start : tile.rows.stop - rows.start]
            yield replace(tile, frame=frame, where=None if meant.all() else meant)


def listening(tiles: Iterable[Tile], progress: Callable[[float], bool] | None) -> Iterator[Tile]:
    """Yield tiles, and call ``progress(0)`` meanwhile as a cast does: those of 65,536 columns with times of their own
    take many seconds to find. Raises Cancelled if it returns False.
    """
    told = perf_counter()
    for tile in tiles:
        if progress is not None and perf_counter() - told > LISTEN:
            if not progress(0.0):
                raise Cancelled
            told = perf_counter()
        yield tile


def _bands(rows: slice, columns: slice, pixels: int) -> Iterator[Tile]:
    """Yield a part of the picture in bands of whole rows, of about equal size and at most ``pixels`` pixels."""
    step = max(1, pixels // (columns.stop - columns.start))
    count = -(-(rows.stop - rows.start) // step)
    for first, last in pairwise(np.linspace(rows.start, rows.stop, count + 1).astype(int).tolist()):
        yield Tile(slice(first, last), columns)


def cast_tile(
    plan: Plan, tile: Tile, samples: int, images: dict[str, np.ndarray], scratch: Scratch, effort: Effort
) -> np.ndarray:
    """Cast one tile and store its passes in ``images``; return the seconds of STEPS.

    With samples above 1 the only pass is combined, the mean of that number of rays per pixel. Raises Cancelled between
    samples and between shapes if the cast is to stop.
    """
    raster = plan.camera.raster
    place = raster.columns()[:, tile.columns], raster.rows()[tile.rows], (tile.columns.start, tile.rows.start)
    parts = {name: image[tile.rows, tile.columns] for name, image in images.items()}
    seconds = np.zeros(len(STEPS))
    total = np.zeros_like(parts["combined"], np.float64) if samples > 1 else None
    for sample in range(samples):
        began = perf_counter()
        if total is None:
            rays = chief_rays(plan.camera, *place, scratch)
        else:
            rays = sampled_rays(plan.camera, *place[:2], sample, place[2], scratch)
        generated = perf_counter()
        hits = nearest_hits(plan, rays, effort.listen)
        found = perf_counter()
        if total is None:
            store(hits, parts, tile.where)
        else:
            add_combined(hits, total, plan.camera.sample_light(*place[:2], sample))
        seconds += generated - began, found - generated, perf_counter() - found
        effort.step()
    if total is not None:
        total /= samples
        put(total, parts["combined"], tile.where)
    return seconds


def in_threads(
    run: Callable[[Tile, Scratch], np.ndarray],
    tiles: Sequence[Tile],
    workers: int,
    effort: Effort,
    progress: Callable[[float], bool] | None,
    finished: Callable[[Tile], None],
    alone: bool = False,
) -> np.ndarray:
    """Run tiles on threads (numpy releases the interpreter), each with working arrays of its own, and return the sum of
    the seconds of all tiles. ``progress`` and Cancelled: as in ``cast``. ``finished(tile)`` is called in this thread.
    ``alone``: whether a single tile takes less than the start of a thread would pay for: it is run in this thread.
    """
    own = local()
    if alone and len(tiles) == 1:
        with lending() as lend:
            total = run(tiles[0], lend())
        finished(tiles[0])
        if progress is not None and not progress(effort.fraction):
            raise Cancelled
        return total
    total = np.zeros(len(STEPS))
    with lending() as lend, ThreadPoolExecutor(workers, initializer=lambda: setattr(own, "scratch", lend())) as pool:
        waiting: dict[Future, Tile] = {}
        try:
            for tile in tiles:  # raises if no thread can be started
                waiting[pool.submit(lambda tile: run(tile, own.scratch), tile)] = tile
            while waiting:
                for future in wait(waiting, LISTEN, FIRST_COMPLETED).done or [None]:
                    if future is not None:
                        total += future.result()
                        finished(waiting.pop(future))
                    if progress is not None and not progress(effort.fraction):
                        raise Cancelled
        finally:
            effort.stop()
            for future in waiting:
                future.cancel()
    return total
