"""Cast a camera's rays at shapes: plan, nearest hits, passes, tile by tile."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from time import perf_counter

import numpy as np

from . import arguments, memory, tuning
from .camera.camera import Camera
from .casting.flow import pictures
from .casting.passes import PASSES, image_bytes
from .casting.plan import Plan, make_plan
from .casting.request import AUTOMATIC, MATERIAL, Request
from .casting.tiles import STEPS, Effort, Tile, cast_tile, in_threads, moments, shares
from .maths.speed import Scratch, processors
from .records import Shapes

MOST_SAMPLES = 1 << 24
"""Rays a pixel, as many as Cycles allows: more are no closer to the mean than a stored float32."""


class Images(dict[str, np.ndarray]):
    """The passes by name, (rows, columns[, channels]) arrays, row 0 at the bottom; beside them how they were made."""

    camera: Camera
    shapes: Shapes
    plan: Plan
    seconds: dict[str, float]


def cast(
    camera: Camera,
    shapes: Shapes,
    passes: str | Iterable[str] = ("depth", "normal"),
    dtype=np.float32,
    *,
    shading: str = MATERIAL,
    samples: int = 1,
    threads: int | None = None,
    cull: bool = True,
    precision: str = AUTOMATIC,
    progress: Callable[[float], bool] | None = None,
) -> Images:
    """Return the passes of the camera's render window as a mapping of name to array.

    dtype is what passes of real numbers are stored as; the arithmetic is float64, but ``precision="FAST"`` searches for
    hits with float32. object_index, material_index and shape_index are int32, valid is bool. With ``samples`` above 1
    the combined pass is the mean of as many rays a pixel, all over the pixel and the camera's aperture; all other
    passes are of the chief rays. ``threads``: so many at most, one a processor if None; fewer where they
    would wait for each other. ``progress(fraction)`` is called in the calling thread after each tile, and twenty
    times a second; where it returns False the cast stops within the shapes under way and raises Cancelled.
    ``cull=False`` tests every shape at every pixel: the same picture, slower.
    Raises InputError for an unknown pass, shading or precision, for a dtype that is no floating-point number, for a
    number of samples or threads that is not whole, below 1, or above MOST_SAMPLES, for flow to frames that were not
    read, and for passes that take more memory than there is.
    """
    if not (isinstance(camera, Camera) and isinstance(shapes, Shapes)):
        raise TypeError(f"cast takes a camera and shapes as they are read, not {type(camera)} and {type(shapes)}")
    started = perf_counter()
    threads = processors() if threads is None else arguments.count(threads, "threads")
    samples = arguments.count(samples, "samples", MOST_SAMPLES)
    dtype = arguments.real_type(dtype, "dtype")
    progress = arguments.function(progress, "progress")
    passes = arguments.words(passes, "passes", PASSES)
    request = Request(passes, tuple(PASSES), shading, arguments.flag(cull, "cull"), precision=precision)
    memory.require(image_bytes(camera.raster.shape, passes, dtype), memory.of_pixels("the passes", camera.raster.shape))
    request = replace(request, others=pictures(camera, shapes, passes))
    time = camera.pixel_time
    whole = make_plan(*_moment(camera, shapes, (time.first + time.last) / 2 if time else None), request)
    images = Images({name: PASSES[name].empty(camera.raster.shape, dtype) for name in passes})
    images.camera, images.shapes, images.plan = camera, shapes, whole
    sampled = ("combined",) if samples > 1 and "combined" in passes else ()
    parts = [(replace(request, passes=tuple(name for name in passes if name not in sampled)), 1)]
    parts += [(replace(request, passes=sampled, sampled=True), samples)] if sampled else []
    plans: dict[Request, Plan] = {}
    if time is None:
        plans = {part: whole if count == 1 else make_plan(camera, shapes, part) for part, count in parts}
        tiles = list(shares(plans[parts[-1][0]], threads, parts[-1][1]))
    else:
        tiles = list(moments(camera, time))
    images.seconds = {"plan": perf_counter() - started}
    effort = Effort(len(tiles) * sum(count for part, count in parts if part.passes))

    def run(tile: Tile, scratch: Scratch) -> np.ndarray:
        seconds = np.zeros(len(STEPS))
        then = _moment(camera, shapes, tile.frame)
        with np.errstate(all="ignore"):  # NaN and inf are answers here: no ray, no hit
            for part, count in parts:
                if part.passes:
                    plan = plans.get(part) or make_plan(*then, part)
                    into = {name: images[name] for name in part.passes}
                    seconds += cast_tile(plan, tile, count, into, scratch, effort)
        return seconds

    began = perf_counter()
    others = round(whole.work.sum() / len(tiles) / tuning.SERIAL_WORK)  # may hold the interpreter meanwhile
    busy = in_threads(run, tiles, min(threads, 1 + others), request.real, effort, progress)
    share = (perf_counter() - began) / max(busy.sum(), np.finfo(float).tiny)
    images.seconds |= dict(zip(STEPS, busy * share, strict=True))
    return images


def _moment(camera: Camera, shapes: Shapes, frame: float | None) -> tuple[Camera, Shapes]:
    """Return both as they are at a frame; None for a picture that has one time."""
    if frame is None:
        return camera, shapes
    return camera.at(frame), shapes if shapes.motion is None else shapes.motion.shapes_at(frame)
