"""Rendered shading in the 3D View: a coarse picture at once, then finer pictures by a thread until a change, and at
last the means of the first 1, 2, 4, ... of the scene's samples, as in a render.

A redraw waits for the coarse picture, but not long. A picture that takes longer is shown when it is finished, also if
the view has changed meanwhile; the next one is coarser.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from threading import Event
from time import perf_counter
from typing import Any

import bpy
import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.camera.view_records import frame_record, view_record
from ...core.cast import Images, cast
from ...core.casting.images import reusable
from ...core.casting.worker import Worker
from ...core.motion.evaluations import Motion
from ...core.motion.unfinished import seen_by
from ...core.records import BlenderCamera, InputError
from ...core.report.report import uncolored
from ...core.scene import Scene
from ..output.reports import left_out_count
from ..properties.declared import SHADING
from ..read import other_times
from ..read.scene_cache import CachedScene, cached_scene
from ..read.view import camera_frame, views_3d

PIXEL_SIDES = (32, 8, 2, 1)
"""Side of a picture's pixel in pixels of the window, from coarse to fine."""

FIRST = 1
"""Index in PIXEL_SIDES of the first picture of a view whose pictures are quick."""

QUICK = 0.06
"""Longest time in seconds that a redraw waits for its first picture. If it takes less, the last picture follows
directly. The pictures of 8, 2 and 1 pixels take 48, 178 and 327 ms of processor time for 60 monkeys of 3,936 triangles
each, at 1600 x 950 pixels.
"""

INTERVAL = 0.03
"""Interval in seconds of the checks whether a finer picture is finished."""

_workers: list[Worker] = []
_news = Event()
"""Whether a worker has the mean of more samples to show."""


@dataclass(frozen=True)
class Target:
    """A rectangle of the region, and the camera whose picture fills it."""

    left: float
    bottom: float
    width: float
    height: float
    raw: BlenderCamera
    seen: tuple[float, float, float, float]
    """Part of the camera's frame that the region shows, in fractions: left, bottom, right, top."""
    motion: Motion | None = None
    """The scene over the times of the camera's pixels; None if all are shown at one time."""

    def camera(self, step: int) -> Camera:
        """Return the camera with pixels whose side is ``step`` pixels of the window."""
        width, height = (max(1, round(side / step)) for side in (self.width, self.height))

        def made(raw: BlenderCamera) -> Camera:
            return camera_from(frame_record(raw, width, height, self.seen))

        if self.motion is None:
            return replace(made(self.raw), pixel_time=None)
        motion = seen_by(self.motion, lambda camera: made(camera.record))
        return replace(made(self.raw), motion=motion)

    def rectangle(self, raster) -> tuple[float, float, float, float]:
        """Return left, bottom, width and height of a raster's render window in the region."""
        x, y = self.width / raster.width, self.height / raster.height
        rows, columns = raster.shape
        return self.left + raster.x0 * x, self.bottom + raster.y0 * y, columns * x, rows * y


class Viewport:
    """The part of the engine that draws in a 3D View."""

    _key: Any = None
    """Scene, view and settings of the picture that is being cast, or was cast last."""
    _first = FIRST
    """Index in PIXEL_SIDES of the first picture of a view."""
    _step = 0
    """Index in PIXEL_SIDES of the picture that is cast, or was cast last; beyond the last one, it has all samples."""
    _samples = 1
    """Number of rays per pixel of the last picture."""
    _means: list[tuple] = []
    """The picture of the samples so far with its rectangle, if it was not yet shown; else empty."""
    _worker: Worker | None = None
    _is_first = True
    """Whether the worker casts the first picture of a view."""
    _spare: Mapping[int, Images] = {}
    """Pictures that were shown, by their index in PIXEL_SIDES, whose memory the next ones take."""
    _picture: tuple | None = None
    """Latest texture and its rectangle in the region."""

    def view_update(self, context, depsgraph):
        """Do nothing: ``cached_scene`` detects changes."""

    def view_draw(self, context, depsgraph):
        """Draw the latest picture of this view, and start the cast of a finer picture."""
        scene = cached_scene(context)
        region_data = context.region_data
        settings = context.scene.camera_ray_caster
        shown = {"shading": settings.shading or SHADING.default}  # no word for the item of a newer version
        matrices = [tuple(row) for row in (*region_data.view_matrix, *region_data.window_matrix)]
        motion = None
        if region_data.view_perspective == "CAMERA":
            motion = other_times.known(context.scene, context.view_layer).motion
        key = scene, id(motion), matrices, context.region.width, context.region.height, shown, settings.samples
        self.update_stats("", left_out_count((*scene.shapes.left_out, *uncolored(scene.shapes, ("combined",)))))
        if self._worker is not None and self._worker.done:
            self._take()
            if self._key == key:
                self._refine()
        elif self._means:
            self._show(self._means.pop())
        if self._key != key and (self._worker is None or not self._is_first):
            self._key, self._samples = key, settings.samples
            self._abandon()
            self._begin(context, scene, motion, shown)
        if self._picture is not None:
            self._draw(depsgraph.scene)

    def _begin(self, context, scene: CachedScene, motion: Motion | None, shown) -> None:
        """Start the cast of a coarse picture. If it is finished in time, show it, and start that of the last one."""
        try:
            self._target = _target(context, scene.raw)
            if self._target is not None:
                self._target.camera(1)
                self._target = replace(self._target, motion=motion)
        except InputError:  # the sidebar shows the reason
            self._target = None
        if self._target is None:
            self._picture = None
            return
        self._cast, self._shown = partial(_cast, self._target, scene.shapes), shown
        started = perf_counter()
        self._start(self._first, is_first=True)
        if not self._worker.wait(QUICK):
            self._first = 0
            return
        took = perf_counter() - started
        self._take()
        if self._first == FIRST:
            self._step = len(PIXEL_SIDES) - 2
        elif took < QUICK / 4:
            self._first = FIRST
        self._refine()

    def _refine(self) -> None:
        """Start the cast of the next finer picture, if there is one."""
        if self._step + 1 < len(PIXEL_SIDES) + (self._samples > 1):
            self._start(self._step + 1)

    def _start(self, step: int, is_first: bool = False) -> None:
        """Start the cast of a picture, given by its index in PIXEL_SIDES."""
        self._step, self._is_first = step, is_first
        spare = self._spare.get(step)
        self._spare = {other: images for other, images in self._spare.items() if other != step}
        self._means, options = [], self._shown
        if step == len(PIXEL_SIDES):
            step -= 1
            options = {**options, "samples": self._samples, "preview": partial(_keep, self._means, self._target)}
        self._worker = Worker(partial(self._cast, options, PIXEL_SIDES[step], spare))
        _workers.append(self._worker)
        if not bpy.app.timers.is_registered(redraw_if_finished):
            bpy.app.timers.register(redraw_if_finished, first_interval=INTERVAL)

    def _take(self) -> None:
        worker, self._worker = self._worker, None
        picture = worker.result()
        self._show(picture)
        self._spare = {**self._spare, self._step: picture[0]}

    def _abandon(self) -> None:
        if self._worker is not None:
            self._worker.abandon()
            self._worker = None

    def _show(self, picture) -> None:
        images, rectangle = picture
        pixels = images["combined"]
        height, width = pixels.shape[:2]
        buffer = gpu.types.Buffer("FLOAT", pixels.size, pixels.ravel())
        self._picture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=buffer), rectangle

    def _draw(self, scene) -> None:
        texture, (left, bottom, width, height) = self._picture
        gpu.state.blend_set("ALPHA_PREMULT")
        self.bind_display_space_shader(scene)
        draw_texture_2d(texture, (left, bottom), width, height)
        self.unbind_display_space_shader()
        gpu.state.blend_set("NONE")


def _target(context, raw: BlenderCamera | None) -> Target | None:
    """Return the camera and rectangle for the region; None if it looks through a camera that cannot be cast."""
    region, region_data = context.region, context.region_data
    if region_data.view_perspective != "CAMERA":
        record = view_record(region_data.view_matrix, region_data.window_matrix, region.width, region.height)
        return Target(0, 0, region.width, region.height, record, (0, 0, 1, 1))
    frame = camera_frame(context)
    if frame is None or raw is None:
        return None
    left, bottom, right, top = frame
    width, height = right - left, top - bottom
    seen = -left / width, -bottom / height, (region.width - left) / width, (region.height - bottom) / height
    return Target(left, bottom, width, height, raw, seen)


def _cast(target: Target, shapes, shown: dict[str, Any], step: int, spare: Images | None, progress=None):
    """Return the images at a step, with the combined pass, in the memory of ``spare`` if it fits, and their rectangle.
    ``shown``: further arguments of ``cast``. This may run in a thread.
    """
    camera, passes = target.camera(step), ("combined",)
    into = reusable(spare, passes, camera.raster.shape, np.float32)
    scene = Scene(camera, replace(shapes, motion=camera.motion))
    images = cast(scene, passes=passes, dtype=np.float32, **shown, progress=progress, into=into)
    return images, target.rectangle(camera.raster)


def _keep(means: list[tuple], target: Target, combined: np.ndarray, rows: slice, samples: int) -> None:
    """Keep a copy of the mean of some samples, in place of one of fewer that was not shown. This runs in a thread."""
    if samples:  # a coarse picture is worse than the one that is shown
        means[:] = [({"combined": combined.copy()}, target.rectangle(target.camera(1).raster))]
        _news.set()


def redraw_if_finished() -> float | None:
    """Redraw the 3D Views when a finer picture is finished; Blender calls this while any picture is being cast."""
    finished = [worker for worker in _workers if worker.done]
    if finished or _news.is_set():
        _news.clear()
        _workers[:] = [worker for worker in _workers if worker not in finished]
        for _, area in views_3d():
            area.tag_redraw()
    return INTERVAL if _workers else None


def stop() -> None:
    """Stop all casts that are running."""
    while _workers:
        _workers.pop().stop()
    if bpy.app.timers.is_registered(redraw_if_finished):
        bpy.app.timers.unregister(redraw_if_finished)


def register(undo) -> None:
    undo.callback(stop)
