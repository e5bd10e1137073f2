"""The cast of a picture's tiles in threads (numpy releases the interpreter), and what is told and shown meanwhile."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from threading import local
from time import perf_counter

import numpy as np

from .. import tuning
from ..camera.times import PixelTime
from ..maths.speed import Scratch, lending
from ..records import Cancelled
from .images import Images
from .plan import Plan
from .previews import Previews, Show
from .tiles import LISTEN, TIMED_STEPS, Effort, Tile

Job = tuple[range, Tile]
"""Samples, and the tile in which they are cast."""


class PictureWork(ABC):
    """What is cast of a picture, and how: its tiles."""

    time: PixelTime | None = None
    """The pixels' times, if a row may have pixels of many tiles."""
    samples = 1
    """Number of samples per pixel of the combined pass, and in ``rays`` that of all rays."""
    rays = 1
    has_previews = True

    def __init__(self, plan: Plan, tiles: Iterable[Tile], threads: int):
        """plan: that of the chief rays, at the middle of the pixels' times."""
        self.plan, self.tiles = plan, list(tiles)
        amount = plan.work.sum()
        self.is_small = len(self.tiles) == 1 and bool(amount * self.samples < tuning.SERIAL_WORK)
        """Whether it takes less than the start of a thread would pay for."""
        others = round(amount / len(self.tiles) / tuning.SERIAL_WORK)  # may hold the interpreter in turn
        self.threads = min(threads, 1 + others)

    @abstractmethod
    def cast(
        self, tile: Tile, samples: range, is_last: bool, images: Images, scratch: Scratch, effort: Effort, sums
    ) -> np.ndarray:
        """Cast some samples of a tile, and with the last ones the passes of its chief rays, into images; return the
        seconds of TIMED_STEPS. ``sums``: see ``cast_tile``.
        """


class PictureRun:
    """The cast of all tiles of a picture. ``progress``, ``finished``, ``preview`` and Cancelled: as in ``cast``."""

    def __init__(
        self,
        work: PictureWork,
        images: Images,
        progress: Callable[[float], bool] | None,
        finished: Callable[[Images, slice], None] | None,
        preview: Show | None,
    ):
        self._work, self._images, self._progress, self._finished = work, images, progress, finished
        self._effort = Effort(len(work.tiles) * work.rays)
        show = preview if "combined" in images and work.has_previews else None
        self._previews = Previews(work.plan, work.time, work.samples, show)
        self._open = list(work.tiles)
        self._write, self._busy = 0.0, np.zeros(len(TIMED_STEPS))

    def all(self) -> None:
        """Cast all tiles, and note the seconds of each step in the images."""
        began = perf_counter()
        if self._work.is_small:
            self._here()
        else:
            self._in_threads()
        if self._work.time is not None:
            self._tell(slice(0, self._work.plan.camera.raster.shape[0]))
        share = (perf_counter() - began - self._write) / max(self._busy.sum(), np.finfo(float).tiny)
        self._images.seconds |= dict(zip(TIMED_STEPS, self._busy * share, strict=True))
        if self._finished is not None:
            self._images.seconds["write"] = self._write

    def _here(self) -> None:
        with lending() as lend:
            scratch = lend()
            for jobs in self._rounds():
                for job in jobs:
                    self._end(job, self._cast(job, scratch))
                    self._listen()

    def _in_threads(self) -> None:
        """Cast each round when the one before has ended; each thread has working arrays of its own."""
        of_thread, waiting = local(), dict[Future, Job]()
        with lending() as lend, ThreadPoolExecutor(
            self._work.threads, initializer=lambda: setattr(of_thread, "scratch", lend())
        ) as pool:  # fmt: skip
            try:
                for jobs in self._rounds():
                    for job in jobs:  # raises if no thread can be started
                        waiting[pool.submit(lambda job: self._cast(job, of_thread.scratch), job)] = job
                    while waiting:
                        for future in wait(waiting, LISTEN, FIRST_COMPLETED).done or [None]:
                            if future is not None:
                                self._end(waiting.pop(future), future.result())
                            rows = [tile.rows for tile in self._open]
                            self._previews.look(self._effort, self._work.threads, rows, self._progress)
                            self._listen()
            finally:
                self._effort.stop()
                for future in waiting:
                    future.cancel()

    def _rounds(self) -> Iterator[Sequence[Job]]:
        for span, tiles in self._previews.rounds(self._work.tiles):
            yield [(span, tile) for tile in tiles]
            since = perf_counter()
            self._previews.show(self._images, span, tiles)
            self._write += perf_counter() - since

    def _cast(self, job: Job, scratch: Scratch) -> np.ndarray:
        span, tile = job
        of_tile = self._images, scratch, self._effort, self._previews.sums
        return self._work.cast(tile, span, self._is_last(span), *of_tile)

    def _is_last(self, span: range) -> bool:
        return span is self._previews.spans[-1]

    def _end(self, job: Job, seconds: np.ndarray) -> None:
        self._busy += seconds
        span, tile = job
        if self._work.time is None and self._is_last(span):
            self._open.remove(tile)
            self._tell(tile.rows)

    def _tell(self, rows: slice) -> None:
        if self._finished is not None:
            since = perf_counter()
            self._finished(self._images, rows)
            self._write += perf_counter() - since

    def _listen(self) -> None:
        if self._progress is not None and not self._progress(self._effort.fraction):
            raise Cancelled
