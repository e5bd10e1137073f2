"""Pictures to look at while a cast runs: every 8th pixel first, then finer, then the mean of the samples so far.

Pixels with times of their own are cast time by time: every 64th time first, whose pixels fill the picture, then finer.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from time import process_time, thread_time

import numpy as np

from ..camera.times import LinearTime, PixelTime
from ..records import Cancelled
from .pixels import hits_at
from .plan import Plan
from .store import store
from .tiles import LISTEN, Effort, Tile

Show = Callable[[np.ndarray, slice, int], object]
"""Called with the combined pass, the rows of it that are new, and its samples per pixel; 0 while it is coarse."""

PREVIEW_STEPS = 8, 4, 2
"""Distances of the pixels of coarse pictures; each of these pixels fills a square."""

TIMES = 64
"""Distance of the times whose pixels are cast first, a power of 2."""

DELAY = 0.4
"""Processor seconds after which coarse pictures begin: a faster cast needs none."""

PREVIEW_SHARE, FIRST_PREVIEW_SHARE = 0.02, 0.04
"""Part of the cast's expected processor time that coarse pictures may take, and the first one if no tile has a sample
yet. The first one takes 0.03 s of 0.8 (perspective), 0.08 of 1.5 (fisheye) and 0.15 of 8.5 (cross-slit) for one sample
of a room at 1920 x 1080. With 16 samples it takes 0.3 % of the time, and means 0 to 2 %.
"""

MOST_SAMPLES, MOST_PIXELS = 16, 1 << 24
"""Maximum number of samples between two pictures, and of pixels whose sums, 32 bytes each, are kept for them."""


class Previews:
    """Decides what is shown, and casts coarse pictures in the calling thread while other threads cast the picture."""

    def __init__(self, plan: Plan, time: PixelTime | None, samples: int, show: Show | None):
        self._plan, self._show = plan, show
        self._steps = list(PREVIEW_STEPS) if show and time is None else []
        self._began, self._spent, self._last = process_time(), 0.0, 0.0
        height, width = plan.camera.raster.shape
        passes = show is not None and time is None and samples > 1 and height * width <= MOST_PIXELS
        self.spans = list(_spans(samples) if passes else [range(samples)])
        """The samples in the blocks after each of which a picture is shown."""
        self.sums = np.zeros((height, width, 4)) if len(self.spans) > 1 else None
        """Sums of the samples so far; None for one block."""
        if isinstance(time, LinearTime):  # rows or columns as a whole
            height, width = (1, width) if time.per_column else (height, 1)
        self._is_cast = np.zeros((height, width) if show and time else (0, 0), bool)
        """Of pixels with times of their own."""
        self._axis = int(width > 1)

    def rounds(self, tiles: Sequence[Tile]) -> Iterator[tuple[range, list[Tile]]]:
        """Yield samples and tiles that are cast before a picture is shown."""
        ranks = {k: min((k & -k) or TIMES, TIMES) if self._is_cast.size else 1 for k in range(len(tiles))}
        for span in self.spans:
            for _, of_rank in groupby(sorted(ranks, key=lambda k: -ranks[k]), ranks.__getitem__):
                yield span, [tiles[k] for k in of_rank]

    def show(self, images: Mapping[str, np.ndarray], span: range, tiles: Sequence[Tile]) -> None:
        """Show the picture of the first samples, if more follow, or of the times that have been cast."""
        if self._show is None:
            return
        if span is not self.spans[-1]:
            self._steps = []  # coarse pictures end with it
            self._show(images["combined"], slice(0, len(images["combined"])), span.stop)
            return
        for tile in tiles:
            self._is_cast[tile.rows, tile.columns] |= True if tile.where is None else tile.where
        used = process_time() - self._began - self._spent
        if self._is_cast.all() or used < max(DELAY, self._last / PREVIEW_SHARE):
            return  # the times double: all pictures together cost no more than PREVIEW_SHARE
        began, combined = thread_time(), self._of_times(images["combined"])
        self._show(combined, slice(0, len(combined)), 0)
        self._last = thread_time() - began
        self._spent += self._last

    def _of_times(self, combined: np.ndarray) -> np.ndarray:
        """Return the picture of the times so far: each pixel that is not cast is the last one before it in its column,
        if rows have times, or else in its row; black if there is none.
        """
        places = np.expand_dims(np.arange(combined.shape[self._axis]), 1 - self._axis)
        source = np.maximum.accumulate(np.where(self._is_cast, places, 0), self._axis)
        if 1 in source.shape:
            return combined.take(source.ravel(), self._axis)
        picture = np.take_along_axis(combined, source[..., None], self._axis)
        picture[~np.take_along_axis(self._is_cast, source, self._axis)] = 0.0
        return picture

    def look(self, effort: Effort, workers: int, rows: Iterable[slice], progress: Callable | None) -> None:
        """Show the next coarse picture in the rows that are not finished, if it is due and costs little. Raises
        Cancelled as a cast does.
        """
        used = process_time() - self._began - self._spent
        if self._show is None or not self._steps or used < DELAY:
            return
        share = FIRST_PREVIEW_SHARE if effort.fraction == 0 else PREVIEW_SHARE
        allowed = share * used / effort.expected(workers / 2) - self._spent
        if allowed < 4 * self._last:  # each picture has four times the pixels of the one before
            return
        began = reported = thread_time()

        def listen() -> None:
            nonlocal reported
            now = thread_time()
            if now - reported > LISTEN and progress is not None:
                reported = now
                if not progress(effort.fraction):
                    raise Cancelled
            if now - began > allowed:
                raise TimeoutError

        try:
            picture = _coarse(self._plan, self._steps[0], listen)
        except TimeoutError:
            pass
        else:
            del self._steps[0]
            for band in rows:
                self._show(picture, band, 0)
        self._last = thread_time() - began
        self._spent += self._last


def _spans(samples: int) -> Iterator[range]:
    """Yield the samples in blocks: as many as before, but at most MOST_SAMPLES."""
    done = 0
    while done < samples:
        first, done = done, min(samples, done + min(max(done, 1), MOST_SAMPLES))
        yield range(first, done)


def _coarse(plan: Plan, step: int, listen: Callable[[], None]) -> np.ndarray:
    """Return the combined pass, (rows, columns, 4) float32, of chief rays: every pixel is that in the middle of its
    square of ``step`` pixels.
    """
    raster = plan.camera.raster
    places, squares = [], []
    for side in raster.shape:
        middles = np.arange(min(step // 2, (side - 1) // 2), side, step)
        places.append(middles)
        squares.append(np.minimum(np.arange(side) // step, len(middles) - 1))
    hits = hits_at(plan, places[1] + raster.x0, places[0] + raster.y0, listen=listen)
    picture = np.empty((*hits.rays.shape, 4), np.float32)
    with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
        store(hits, {"combined": picture})
    return picture[squares[0][:, None], squares[1]]
