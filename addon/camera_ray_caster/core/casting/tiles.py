"""Division of a picture into tiles, and the cast of one: rays, search, hits, passes."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from threading import Lock
from time import perf_counter

import numpy as np

from .. import tuning
from ..camera.camera import Camera
from ..camera.pixel_time import PixelTime, groups
from ..maths.speed import STRIP, Scratch, sharing
from ..records import Cancelled
from .plan import Plan
from .rays import rays_of
from .search import HitSearch
from .store import add_combined, store

TIMED_STEPS = "rays", "cast", "passes"
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
        return self.expected(0.0)

    def expected(self, running: float) -> float:
        """The finished fraction if ``running`` further steps were finished, 0 to 1."""
        return min(1.0, (self._done + running) / self._steps) if self._steps else 1.0

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
    least, largest = tuning.TILE_PIXELS
    if samples > 1 or height * width > 8 * largest:
        largest //= 2  # a sum doubles the memory; smaller tiles suffice if there are many, and stop sooner
    done = np.cumsum(plan.work)
    threads = sharing(threads, done[-1] / tuning.SERIAL_WORK)
    most_tiles = max(-(-height * width // least), min(threads, -(-height * width * samples // least)))
    count = min(threads * -(-int(done[-1] * samples) // (threads * tuning.TILE_WORK)), most_tiles)
    cuts = np.searchsorted(done, done[-1] * np.arange(1, count) / count)
    cuts = np.unique(np.clip(np.rint(cuts / STRIP), 1, height // STRIP - 1).astype(int)) * STRIP
    for first, last in pairwise((0, *cuts[(cuts > 0) & (cuts < height)].tolist(), height)):
        yield from bands(slice(first, last), slice(0, width), largest)


def moments(camera: Camera, pixel_time: PixelTime) -> Iterator[Tile]:
    """Yield the tiles of each frame of the pixel times."""
    for frame, rows, columns, where in groups(pixel_time, camera.raster.columns(), camera.raster.rows()):
        rows, columns = (slice(*s.indices(n)) for s, n in zip((rows, columns), camera.raster.shape, strict=True))
        for tile in bands(rows, columns, tuning.TILE_PIXELS[0]):
            meant = where[tile.rows.start - rows.start : tile.rows.stop - rows.start]
            yield replace(tile, frame=frame, where=None if meant.all() else meant)


def listening(tiles: Iterable[Tile], progress: Callable[[float], bool] | None) -> Iterator[Tile]:
    """Yield tiles, and call ``progress(0)`` meanwhile as a cast does: those of 65,536 columns with times of their own
    take many seconds to find. Raises Cancelled if it returns False.
    """
    reported = perf_counter()
    for tile in tiles:
        if progress is not None and perf_counter() - reported > LISTEN:
            if not progress(0.0):
                raise Cancelled
            reported = perf_counter()
        yield tile


def bands(rows: slice, columns: slice, pixels: int) -> Iterator[Tile]:
    """Yield a part of the picture in bands of whole rows, of about equal size and at most ``pixels`` pixels."""
    step = max(1, pixels // (columns.stop - columns.start))
    count = -(-(rows.stop - rows.start) // step)
    for first, last in pairwise(np.linspace(rows.start, rows.stop, count + 1).astype(int).tolist()):
        yield Tile(slice(first, last), columns)


def cast_tile(
    plan: Plan, search: HitSearch, tile: Tile, samples: range | None, images: dict[str, np.ndarray], scratch: Scratch,
    effort: Effort, sums: np.ndarray | None = None,
) -> np.ndarray:  # fmt: skip
    """Cast one tile and store its passes in ``images``; return the seconds of TIMED_STEPS.

    With samples the only pass is combined, the mean of these rays of each pixel and of those before, whose sum is in
    ``sums``, (rows, columns, 4) float64 of the whole picture; it may be None if there are none before or after. Raises
    Cancelled between samples and between shapes if the cast is to stop.
    """
    raster = plan.camera.raster
    centers = raster.columns()[:, tile.columns], raster.rows()[tile.rows], (tile.columns.start, tile.rows.start)
    parts = {name: image[tile.rows, tile.columns] for name, image in images.items()}
    seconds = np.zeros(len(TIMED_STEPS))
    total = None
    if samples is not None:
        total = np.zeros_like(parts["combined"], np.float64) if sums is None else sums[tile.rows, tile.columns]
    for sample in samples or [None]:
        began = perf_counter()
        rays = rays_of(plan.camera, *centers, scratch, sample)
        generated = perf_counter()
        hits = search(plan, rays, effort.listen)
        searched = perf_counter()
        if total is None:
            store(hits, parts, tile.where)
        else:
            add_combined(hits, total)
        seconds += generated - began, searched - generated, perf_counter() - searched
        effort.step()
    if samples is not None and total is not None:
        where = True if tile.where is None else tile.where[..., None]
        np.divide(total, samples.stop, out=parts["combined"], where=where, casting="same_kind")
    return seconds
