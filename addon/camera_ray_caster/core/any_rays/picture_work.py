"""What is cast of a picture: tiles of pixels, or the beams of a scanner that sweeps."""

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

import numpy as np

from ..camera.times import SweepTime
from ..casting.images import Images
from ..casting.picture_run import PictureWork
from ..casting.plan import Plan, make_plan
from ..casting.request import Request
from ..casting.search import nearest_hits
from ..casting.tiles import TIMED_STEPS, Effort, Tile, bands, cast_tile, listening, moments, shares
from ..maths.speed import Scratch
from ..scene import Scene
from .body_search import RAYS
from .choice import search_for
from .door import times_of
from .moving import write_nearest


def work_of(
    scene: Scene, request: Request, samples: int, threads: int, progress: Callable[[float], bool] | None
) -> PictureWork:
    """Return what is cast of the picture of a scene. ``progress`` and Cancelled: see ``listening``."""
    scene = scene.at_rest()
    time = scene.camera.pixel_time
    middle = scene.at(None if time is None else (time.first + time.last) / 2)
    plan = make_plan(middle.camera, middle.shapes, request)
    if isinstance(time, SweepTime):
        return BeamWork(scene, plan, threads)
    return PixelWork(scene, plan, samples, threads, progress)


class PixelWork(PictureWork):
    """Tiles of pixels that have one time, with samples for the combined pass."""

    def __init__(self, scene: Scene, plan: Plan, samples: int, threads: int, progress):
        request, time = plan.request, scene.camera.pixel_time
        self._scene, self.time = scene, time
        sampled = ("combined",) if samples > 1 and "combined" in request.passes else ()
        chief = tuple(name for name in request.passes if name not in sampled)
        self.samples = samples if sampled else 1
        self.rays = bool(chief) + samples * bool(sampled)
        self._requests = [replace(request, passes=chief)] if chief or not sampled else []
        self._requests += [replace(request, passes=sampled, sampled=True)] if sampled else []
        self._plans: dict[Request, Plan] = {}
        self._search = search_for(plan) if time is None else nearest_hits
        if time is None:
            for wanted in self._requests:
                self._plans[wanted] = make_plan(scene.camera, scene.shapes, wanted) if wanted.sampled else plan
            tiles = shares(self._plans[self._requests[-1]], threads, self.samples)
        else:
            tiles = listening(moments(scene.camera, time), progress)
        super().__init__(plan, tiles, threads)

    def cast(
        self, tile: Tile, samples: range, is_last: bool, images: Images, scratch: Scratch, effort: Effort, sums
    ) -> np.ndarray:
        seconds, then = np.zeros(len(TIMED_STEPS)), self._scene.at(tile.frame)
        with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
            for request in self._requests:
                if request.passes and (request.sampled or is_last):
                    plan = self._plans.get(request) or make_plan(then.camera, then.shapes, request)
                    outs = {name: images[name] for name in request.passes}
                    numbers = samples if request.sampled else None
                    seconds += cast_tile(plan, self._search, tile, numbers, outs, scratch, effort, sums)
        return seconds


class BeamWork(PictureWork):
    """The beams of a scanner that sweeps: each is a ray with a time of its own."""

    has_previews = False

    def __init__(self, scene: Scene, plan: Plan, threads: int):
        self._scene, self.rays = scene, int(bool(plan.request.passes))
        height, width = scene.camera.raster.shape
        super().__init__(plan, bands(slice(0, height), slice(0, width), RAYS), threads)

    def cast(
        self, tile: Tile, samples: range, is_last: bool, images: Images, scratch: Scratch, effort: Effort, sums
    ) -> np.ndarray:
        if not self.rays:
            return np.zeros(len(TIMED_STEPS))
        began, camera, shapes = perf_counter(), self._scene.camera, self._scene.shapes
        raster = replace(camera.raster, y0=camera.raster.y0 + tile.rows.start, y1=camera.raster.y0 + tile.rows.stop)
        rays = replace(camera, raster=raster).rays()
        origin, direction = (
            np.array(vectors.reshape(-1, 3).T, order="C") for vectors in (rays.origins, rays.directions)
        )
        generated = perf_counter()
        outs = {name: image[tile.rows].reshape(1, -1, *image.shape[2:]) for name, image in images.items()}
        span = camera.clip_start, camera.clip_end
        write_nearest(shapes, origin, direction, times_of(shapes, rays.time, raster.shape), span, outs)
        effort.step()
        return np.array([generated - began, perf_counter() - generated, 0.0])
