"""Cast the rays of a camera at shapes: make the plan, then find the nearest hits and write the passes, tile by tile."""

import warnings
from collections.abc import Callable, Iterable
from time import perf_counter

import numpy as np

from . import arguments
from .any_rays.picture_work import work_of
from .camera.camera import Camera
from .casting.images import Images, images_for
from .casting.pass_needs import check_passes, pictures
from .casting.passes import PASSES
from .casting.picture_run import PictureRun
from .casting.previews import Show
from .casting.request import MATERIAL, SHADINGS, Request
from .casting.top_down import top_down
from .conventions import BOTTOM, TOP
from .maths.speed import processors
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
    images = images_for(passes, scene.camera.raster.shape, dtype, into)
    check_passes(scene.camera, passes)
    request = Request(passes, shading, arguments.flag(cull, "cull"), others=pictures(scene, passes))
    work = work_of(scene, request, samples, threads, progress)
    images.keep(passes)
    images.camera, images.shapes, images.plan = scene.camera, scene.shapes, work.plan
    images.rays = images.camera.raster.shape[0] * images.camera.raster.shape[1] * work.rays
    images.seconds = {"plan": perf_counter() - started}
    PictureRun(work, images, progress, finished, preview).all()
    return images if rows == BOTTOM else top_down(images)
