"""The Cast operator: it casts the passes of the view layer into images without blocking the window."""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import cached_property, partial, reduce
from operator import add
from time import perf_counter
from typing import Any

import bpy

from ...core.casting.worker import Worker
from ...core.records import InputError
from ...core.report.report import Report
from ..engine.job import Job
from ..output import image_datablocks, reports
from ..properties.pass_properties import ticked
from ..read.camera_fields import view_names
from ..read.scene_reader import evaluated_camera
from .needs import OfScene
from .other_engine import show_in_sidebars

INTERVAL = 0.1
"""Seconds between two timer events, which update the progress and store images."""

STORING = 0.05
"""Seconds of each interval spent on storing images, at least one image; the rest is for drawing the window."""

@dataclass(frozen=True)
class RunningCast:
    """The running cast, and the timer that polls it."""

    worker: Worker
    timer: Any
    source: reports.Source
    stored: list[str] = field(default_factory=list)
    """Names of the images stored so far."""

    def store(self) -> bool:
        """Store some images of a finished cast; return whether all are stored. Raises any error of the cast."""
        end = perf_counter() + STORING
        for name in self._storing:
            self.stored.append(name)
            if perf_counter() > end:
                return False
        return True

    @cached_property
    def _storing(self) -> Iterator[str]:
        passes, _ = self.worker.result()
        return image_datablocks.store(passes)


_running: list[RunningCast] = []
_shown: list[str | None] = []
"""The latest text in the status bar; empty before the first."""


def fraction() -> float | None:
    """Return the progress of the running cast, 0 to 1, or None if no cast is running."""
    return _running[0].worker.fraction if _running else None


class Cast(OfScene, bpy.types.Operator):
    """Cast the chosen passes of the active camera into images; in a stereo scene, for each eye"""

    bl_label = "Cast"
    bl_options = {"REGISTER"}  # no undo: images stay

    @classmethod
    def why_gray(cls, context) -> str:
        return "A cast is running: press Esc to stop it" if _running else super().why_gray(context)

    def execute(self, context):
        source, jobs = self.read(context)
        passes, report = cast_views(jobs)
        self.finish(context, list(image_datablocks.store(passes)), report, source)

    def invoke(self, context, event):
        """Read the scene, then cast on a thread; Blender calls ``modal`` until the cast has ended."""
        source, jobs = self.read(context)
        timer = context.window_manager.event_timer_add(INTERVAL, window=context.window)
        _running.append(RunningCast(Worker(partial(cast_views, jobs)), timer, source))
        context.window_manager.modal_handler_add(self)
        show_progress()
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Show the progress, stop on Esc during the cast, then store the images; pass other events to Blender."""
        running = _running[0]
        if event.type == "ESC" and event.value == "PRESS" and not running.worker.done:
            stop()
            self.report({"INFO"}, "Stopped: the images were not changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        show_progress()
        with ExitStack() as ending:
            ending.callback(stop)
            try:
                if not running.worker.done or not running.store():
                    ending.pop_all()
                    return {"PASS_THROUGH"}
                _, report = running.worker.result()
            except MemoryError as error:
                raise InputError(
                    "there is not enough memory for these passes: choose fewer passes, or fewer pixels"
                ) from error
            self.finish(context, running.stored, report, running.source)

    def cancel(self, context):
        """Stop the cast. Blender calls this when it ends the operator itself, for example to load another file."""
        stop()

    def read(self, context) -> tuple[reports.Source, dict[str, Job]]:
        """Return what is cast, and a job for each view, read from the scene as the window shows it."""
        source = reports.Source.read(context.scene, context.evaluated_depsgraph_get())
        keys, jobs = [entry.key for entry in ticked(context.scene, context.view_layer)], {}
        for view in view_names(context.scene):
            with evaluated_camera(context.scene, view=view) as (camera, depsgraph):
                jobs[view] = Job.read(depsgraph, camera, keys, view=view)
        return source, jobs

    def finish(self, context, made: list[str], report: Report, source: reports.Source):
        """Show the named images and keep the report."""
        image_datablocks.show(made)
        reports.keep(report, source)
        if report.shapes == 0:
            self.report({"WARNING"}, "The scene has nothing to cast: the images show the background")
        else:
            others = f" and {len(made) - 1} more" if len(made) > 1 else ""
            self.report({"INFO"}, f"{report.rays:,} rays cast: open image {made[0]!r}{others} with Show Result")


def cast_views(jobs: Mapping[str, Job], progress=None) -> tuple[dict[tuple[str, str], Any], Report]:
    """Cast the views one by one; return the passes by (key, view) and the sum of the reports.

    ``progress`` and the exception Cancelled are the same as in ``cast``.
    """
    passes, made = {}, []
    for i, (view, job) in enumerate(jobs.items()):
        of_all = None if progress is None else lambda fraction, before=i: progress((before + fraction) / len(jobs))
        images, report = job.cast(of_all)
        passes |= {(key, view): pixels for key, pixels in images.items()}
        made.append(report)
    return passes, reduce(add, made)


def show_progress() -> None:
    """Show the progress in the status bar and the sidebars. Redraw only if the text has changed: drawing takes time."""
    done = fraction()
    text = None if done is None else "Storing Images" if done == 1 else f"Casting Rays  {done:.0%}      Esc: Stop"
    if _shown != [text]:
        _shown[:] = [text]
        show_in_sidebars(text)


def stop() -> None:
    """Stop the running cast, if there is one."""
    while _running:
        running = _running.pop()
        running.worker.stop()
        bpy.context.window_manager.event_timer_remove(running.timer)
        show_progress()


CLASSES = (Cast,)


def register(undo) -> None:
    undo.callback(stop)
