"""Cast the rays of a camera at shapes: make the plan, then find the nearest hits and write the passes, tile by tile."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from time import perf_counter

import numpy as np

from . import arguments, memory, tuning
from .any_rays.choice import cast_sweep, search_for, sweep_tiles
from .camera.camera import Camera
from .camera.times import SweepTime
from .casting.images import Images, check_reusable
from .casting.pass_needs import check_passes, image_bytes, pictures
from .casting.passes import PASSES
from .casting.plan import Plan, make_plan
from .casting.previews import Previews, Show
from .casting.request import MATERIAL, SHADINGS, Request
from .casting.search import nearest_hits
from .casting.tiles import TIMED_STEPS, Effort, Tile, cast_tile, in_threads, listening, moments, shares
from .casting.top_down import top_down
from .conventions import BOTTOM, TOP
from .maths.speed import Scratch, processors
from .records import InputError, Shapes
from .scene import Scene

MOST_SAMPLES = 1 << 24
"""Maximum number of rays per pixel, as in Cycles. More rays do not make a mean that is stored as float32 more exact."""


@arguments.keywords
def cast(
    camera: Camera | Scene,
    shapes: Shapes | None = None,
    *,
    passes: str | Iterable[str] = ("depth", "normal"),
    dtype=np.float32,
    shading: str = MATERIAL,
    samples: int = 1,
    threads: int | None = None,
    cull: bool = True,
    precision: str | None = None,
    progress: Callable[[float], bool] | None = None,
    finished: Callable[[Images, slice], None] | None = None,
    preview: Show | None = None,
    into: Images | None = None,
    rows: str = BOTTOM,
) -> Images:
    """Return the passes of a picture as a mapping of name to array, (rows, columns[, channels]), row 0 at the bottom.

    The arrays have the pixels of the camera's render window. Positions and directions are in the world, lengths in
    Blender units. ``core.casting.passes`` says what each pass holds, also where nothing is hit; the passes
    ``distance_bound``, ``position_bound`` and ``normal_bound`` bound the rounding errors. All arithmetic is float64.

    camera: a camera, and ``shapes`` what it sees; or a scene, which has both: ``cast(scene, passes=...)``.
    passes: names of passes.
    dtype: type of the passes of real numbers; index passes are int32, ``valid`` and ``flow_hidden`` bool.
    shading: "MATERIAL" or "GRID", of the combined pass.
    samples: number of rays per pixel for the combined pass, which is their mean; they are spread over the pixel and
        the camera's aperture. All other passes show the chief rays.
    threads: maximum number of threads, by default one per processor; fewer are used if they would wait for each other.
    cull: False tests every shape at every pixel: the same picture, but slower.
    precision: without effect; accepted with a DeprecationWarning until version 0.4.
    progress: ``progress(fraction)`` is called in the calling thread after each tile, and twenty times a second; if it
        returns False, the cast stops before the next shape and raises Cancelled.
    finished: ``finished(images, rows)`` is called in the calling thread as soon as some rows, a slice, are complete in
        all passes, once for each row; the other rows are undefined.
    preview: ``preview(combined, rows, samples)`` is called in the calling thread with pictures to look at while a cast
        takes long, without a change of its result: first every 8th pixel, then every 4th and 2nd if that costs less
        than 2 % of the time, then the mean of the first 1, 2, 4, ... samples. ``combined`` is (rows, columns, 4)
        float32 or of ``dtype``, of which ``rows``, a slice, are new; ``samples`` is 0 while it is coarse. If pixels
        have times of their own, those of every 64th time come first, then of every 32nd, ..., and fill the picture.
        Pictures of scanners have no previews. More than 2**24 pixels have no means.
    into: the images of an earlier cast, which are written and returned, so that a series of pictures needs no new
        memory. Each requested pass must be there with the shape and type of this cast, writable, C-contiguous and
        without memory of another; other passes are removed, and its camera, shapes, plan and seconds are replaced. Its
        contents are undefined after Cancelled, and after an error while it is written.
    rows: "top" returns ``top_down(images)``, as OpenCV has them; ``finished`` and ``preview`` are as before.

    Raises InputError for an unknown pass or shading, for a dtype that is not a floating-point type, for a
    number of samples or threads that is not whole or below 1, for more than MOST_SAMPLES samples, for flow to frames
    that were not read, for passes that need more memory than is available, and, before anything is written, for
    ``into`` that does not fit.
    """
    scene = Scene.given(camera, shapes, "cast")
    started = perf_counter()
    threads = processors() if threads is None else arguments.count(threads, "threads")
    samples = arguments.count(samples, "samples", MOST_SAMPLES)
    dtype, shading = arguments.real_type(dtype, "dtype"), arguments.word(shading, "shading", SHADINGS)
    progress, finished = arguments.function(progress, "progress"), arguments.function(finished, "finished")
    preview = arguments.function(preview, "preview")
    passes = arguments.words(passes, "passes", PASSES)
    rows = arguments.word(rows, "rows", (BOTTOM, TOP))
    if rows == TOP and into is not None:
        raise InputError("into has row 0 at the bottom: cast without rows, and call top_down(images)")
    if precision is not None:
        warnings.warn("precision has no effect; version 0.4 will refuse it", DeprecationWarning, stacklevel=2)
    request = Request(passes, tuple(PASSES), shading, arguments.flag(cull, "cull"))
    shape = scene.camera.raster.shape
    if into is None:
        memory.require(image_bytes(shape, passes, dtype), memory.of_pixels("the passes", shape))
    else:
        check_reusable(into, passes, shape, dtype)
    check_passes(scene.camera, passes)
    work = _Work(scene, replace(request, others=pictures(scene, passes)), samples, threads, progress)
    images = Images({name: PASSES[name].empty(shape, dtype) for name in passes}) if into is None else into
    images.keep(passes)
    images.camera, images.shapes, images.plan = scene.camera, scene.shapes, work.plan
    images.rays = shape[0] * shape[1] * work.rays
    images.seconds = {"plan": perf_counter() - started}
    effort = Effort(len(work.tiles) * work.rays)
    show = preview if "combined" in passes and not work.by_beam else None
    previews = Previews(work.plan, work.time, work.samples, show)
    whole_rows = work.time is None or work.by_beam  # else a row may have pixels of many times
    last, open_tiles, write = previews.spans[-1], list(work.tiles), 0.0

    def run(job: tuple[range, Tile], scratch: Scratch) -> np.ndarray:
        span, tile = job
        return work.cast(tile, span, span is last, images, scratch, effort, previews.sums)

    def tell(rows: slice) -> None:
        nonlocal write
        if finished is not None:
            since = perf_counter()
            finished(images, rows)
            write += perf_counter() - since

    def end(job: tuple[range, Tile]) -> None:
        span, tile = job
        if whole_rows and span is last:
            open_tiles.remove(tile)
            tell(tile.rows)

    def meanwhile() -> None:
        previews.look(effort, work.threads, [tile.rows for tile in open_tiles], progress)

    def rounds() -> Iterator[list[tuple[range, Tile]]]:
        nonlocal write
        for span, tiles in previews.rounds(work.tiles):
            yield [(span, tile) for tile in tiles]
            since = perf_counter()
            previews.show(images, span, tiles)
            write += perf_counter() - since

    began = perf_counter()
    busy = in_threads(run, rounds(), work.threads, effort, progress, end, work.is_small, meanwhile)
    if not whole_rows:
        tell(slice(0, shape[0]))
    share = (perf_counter() - began - write) / max(busy.sum(), np.finfo(float).tiny)
    images.seconds |= dict(zip(TIMED_STEPS, busy * share, strict=True))
    if finished is not None:
        images.seconds["write"] = write
    return images if rows == BOTTOM else top_down(images)


class _Work:
    """The tiles of a picture, and what is cast of each: rays, search, hits, passes."""

    def __init__(self, scene: Scene, request: Request, samples: int, threads: int, progress):
        self._scene = scene = scene.at_rest()
        time = self.time = scene.camera.pixel_time
        self.by_beam = isinstance(time, SweepTime)
        """Whether each pixel has a ray with a time of its own."""
        middle = scene.at(None if time is None else (time.first + time.last) / 2)
        self.plan = make_plan(middle.camera, middle.shapes, request)
        """The plan of the chief rays, at the middle of the pixels' times."""
        sampled = ("combined",) if samples > 1 and "combined" in request.passes and not self.by_beam else ()
        self.samples = samples if sampled else 1
        chief = replace(request, passes=tuple(name for name in request.passes if name not in sampled))
        self._requests = [(chief, 1)] if chief.passes or not sampled else []
        self._requests += [(replace(request, passes=sampled, sampled=True), samples)] if sampled else []
        self.rays = sum(count for wanted, count in self._requests if wanted.passes)
        """Number of rays per pixel."""
        self._plans: dict[Request, Plan] = {}
        self._search = search_for(self.plan) if time is None else nearest_hits
        if time is None:
            for wanted, count in self._requests:
                self._plans[wanted] = self.plan if count == 1 else make_plan(scene.camera, scene.shapes, wanted)
            self.tiles = list(shares(self._plans[self._requests[-1][0]], threads, self._requests[-1][1]))
        elif self.by_beam:
            self.tiles = list(sweep_tiles(scene, request.passes))
        else:
            self.tiles = list(listening(moments(scene.camera, time), progress))
        amount = self.plan.work.sum()
        self.is_small = len(self.tiles) == 1 and bool(amount * samples < tuning.SERIAL_WORK)
        """Whether it takes less than the start of a thread would pay for."""
        others = round(amount / len(self.tiles) / tuning.SERIAL_WORK)  # may hold the interpreter in turn
        self.threads = min(threads, 1 + others)

    def cast(self, tile: Tile, samples: range, is_last: bool, images, scratch: Scratch, effort: Effort, sums):
        """Cast some samples of a tile, and with the last ones the passes of its chief rays, into images; return the
        seconds of TIMED_STEPS.
        """
        if self.by_beam:
            return cast_sweep(self._scene, tile, images, effort)
        seconds, then = np.zeros(len(TIMED_STEPS)), self._scene.at(tile.frame)
        with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
            for request, _ in self._requests:
                if request.passes and (request.sampled or is_last):
                    plan = self._plans.get(request) or make_plan(then.camera, then.shapes, request)
                    outs = {name: images[name] for name in request.passes}
                    numbers = samples if request.sampled else None
                    seconds += cast_tile(plan, self._search, tile, numbers, outs, scratch, effort, sums)
        return seconds
