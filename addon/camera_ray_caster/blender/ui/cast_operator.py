"""Cast from a button: the passes of the view layer into Image datablocks, while the window stays alive."""

from __future__ import annotations

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
from ..engine.passes import ticked
from ..output import images, reports
from ..read.camera import view_names
from ..read.scene import evaluated_camera
from .needs import NO_CAMERA, reporting

INTERVAL = 0.1
"""Seconds between two updates of the progress."""

STORING = 0.05
"""Seconds of these in which images are written, at least one: the window is drawn in the others."""

_running: list[Running] = []
_shown: list[str | None] = []
"""What the status bar was last told."""


@dataclass(frozen=True)
class Running:
    """The cast that is running, and the timer that asks for its progress."""

    worker: Worker
    timer: Any
    stored: list[str] = field(default_factory=list)
    """The names of the images that are written."""

    def store(self) -> bool:
        """Write some images of a cast that has ended; return whether they are all. Raises what the cast has raised."""
        end = perf_counter() + STORING
        for name in self._storing:
            self.stored.append(name)
            if perf_counter() > end:
                return False
        return True

    @cached_property
    def _storing(self) -> Iterator[str]:
        passes, _ = self.worker.result()
        return images.store(passes)


def fraction() -> float | None:
    """Return how far the cast is that is running, 0 to 1; None where none is."""
    return _running[0].worker.fraction if _running else None


class Cast(bpy.types.Operator):
    """Cast the chosen passes of the active camera into images, in a stereo scene of each eye"""

    bl_idname = "camera_ray_caster.cast"
    bl_label = "Cast"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Grayed out without a camera, and while a cast is running."""
        cls.poll_message_set("A cast is running: Esc stops it" if _running else NO_CAMERA)
        return context.scene.camera is not None and not _running

    @reporting
    def execute(self, context):
        """Cast at once and wait for it."""
        passes, report = cast_views(self.read(context))
        return self.finish(context, list(images.store(passes)), report)

    def invoke(self, context, event):
        """Read the scene, then cast on a thread; Blender calls ``modal`` until that has ended."""
        try:
            jobs = self.read(context)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        timer = context.window_manager.event_timer_add(INTERVAL, window=context.window)
        _running.append(Running(Worker(partial(cast_views, jobs)), timer))
        context.window_manager.modal_handler_add(self)
        show_progress()
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Show how far it is, take Esc while it casts, then store images; let every other event pass to Blender."""
        running = _running[0]
        if event.type == "ESC" and event.value == "PRESS" and not running.worker.done:
            stop()
            self.report({"INFO"}, "Stopped: the images are as they were")
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
                return self.finish(context, running.stored, report)
            except InputError as error:
                self.report({"ERROR"}, str(error))
            except MemoryError:
                self.report({"ERROR"}, "There is not enough memory for these passes: choose fewer, or fewer pixels")
        return {"CANCELLED"}

    def cancel(self, context):
        """Stop; Blender calls this when it ends the operator itself, to load another file say."""
        stop()

    def read(self, context) -> dict[str, Job]:
        """Read the scene as the window shows it, for each view."""
        keys, jobs = [entry.key for entry in ticked(context.scene, context.view_layer)], {}
        for view in view_names(context.scene):
            with evaluated_camera(context.scene, view=view) as (camera, depsgraph):
                jobs[view] = Job.read(depsgraph, camera, keys, view=view)
        return jobs

    def finish(self, context, made: list[str], report: Report):
        """Show the images of these names, and keep the report."""
        images.show(context.window_manager, made)
        reports.keep(report)
        if report.shapes == 0:
            self.report({"WARNING"}, "There is no surface to cast at: the images show the background")
        else:
            others = f" and {len(made) - 1} more" if len(made) > 1 else ""
            self.report({"INFO"}, f"{report.pixels} rays cast: image {made[0]!r}{others}, by Show Result")
        return {"FINISHED"}


def cast_views(jobs: Mapping[str, Job], progress=None) -> tuple[dict[tuple[str, str], Any], Report]:
    """Cast one view after the other; return the passes by their keys and views, and the report of all.

    ``progress`` is as in ``cast``, and so is Cancelled.
    """
    passes, made = {}, []
    for i, (view, job) in enumerate(jobs.items()):
        part = None if progress is None else lambda fraction, before=i: progress((before + fraction) / len(jobs))
        found, report = job.cast(part)
        passes |= {(key, view): pixels for key, pixels in found.items()}
        made.append(report)
    return passes, reduce(add, made)


def show_progress() -> None:
    """Show in the status bar and in the sidebars how far the cast is, where that has changed: to draw takes time."""
    done = fraction()
    text = None if done is None else "Storing Images" if done == 1 else f"Casting Rays  {done:.0%}      Esc: Stop"
    if _shown == [text]:
        return
    _shown[:] = [text]
    for window in bpy.context.window_manager.windows:
        window.workspace.status_text_set(text)
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


def stop() -> None:
    """End the cast that is running, if one is."""
    while _running:
        running = _running.pop()
        running.worker.stop()
        bpy.context.window_manager.event_timer_remove(running.timer)
        show_progress()


CLASSES = (Cast,)


def register(undo) -> None:
    """See ``registration``."""
    undo.callback(stop)
