"""Long work in steps, from a timer: the window stays responsive and shows the progress; Esc or a button stops it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Generator

import bpy
from bpy.app.handlers import persistent

from ...core.memory import exhausted
from ...core.records import Cancelled, InputError
from ..output.restored import restored
from ..process import signals
from ..properties.labels import in_labels
from .other_engine import show, show_later

INTERVAL = 0.1
"""Seconds between two looks at whether a render has ended."""
SHOWN = 10.0
"""Seconds that the status bar shows the result."""
BUSY = "Wait until the running work has ended, or stop it"


class Running(ABC):
    """Work in progress, done in ``steps``; subclasses supply the messages."""

    interval = INTERVAL
    """Seconds from the end of a step to the next."""
    fraction: float | None = None
    """Fraction that is done, 0 to 1; None if it is not known."""
    progress = ""
    """Message about the current step."""
    stopped = "Stopped"
    """Message if the work is stopped."""

    def __init__(self, scene, window, steps: Generator):
        self.scene, self.window, self.steps = scene, window, self._restoring(steps)
        self.is_cancelled = False
        self.exchange: Callable[[], None] = lambda: None
        """Exchanges what the scene has for what it had before the first step."""

    def _restoring(self, steps: Generator) -> Generator:
        """Do the steps, and restore the scene afterwards."""
        with restored(self.scene) as self.exchange:
            return (yield from steps)

    @abstractmethod
    def step(self) -> None:
        """Do the next step. Raises StopIteration at the end."""

    @abstractmethod
    def lines(self, result) -> list[str]:
        """Return the messages at the end, from the result of the steps."""

    def show(self) -> None:
        """Show the progress in the status bar and the sidebars."""
        tell(f"{self.progress}      Esc: Stop")


def tell(text: str) -> None:
    """Show a text in the status bar, and draw the sidebars again."""
    show(text)
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


_running: list[Running] = []
_said: list[tuple[str, str]] = []
"""How the latest work ended: the kinds of reports and their lines."""


def running() -> Running | None:
    """Return the work that is being done, or None."""
    return _running[0] if _running else None


def is_busy() -> bool:
    """Return whether work is being done, or Blender renders."""
    return bool(_running) or bpy.app.is_job_running("RENDER")


def latest() -> str:
    """Return how the latest work ended, in words; "" before the first."""
    return _said[-1][1] if _said else ""


def begin(work: Running) -> None:
    """Begin; a timer does the rest."""
    signals.reset()
    _running.append(work)
    bpy.app.timers.register(tick, first_interval=INTERVAL)


def tick() -> float | None:
    """Go on as soon as a render has ended; called by a timer."""
    if not _running:
        return None
    if bpy.app.is_job_running("RENDER"):
        return INTERVAL
    now = _running[0]
    try:
        with bpy.context.temp_override(window=_window(now)):
            if now.is_cancelled or signals.is_stopping():
                raise Cancelled
            now.step()
    except StopIteration as done:
        end(*now.lines(done.value))
    except Cancelled:
        end(now.stopped)
    except ReferenceError:
        end("Stopped: the scene, or a camera of it, was removed")
    except InputError as error:
        end(in_labels(str(error)), kind="ERROR")
    except (MemoryError, RuntimeError, OSError) as error:
        end(exhausted(error) or str(error), kind="ERROR")
        if not exhausted(error):
            raise
    return now.interval if _running else None


def _window(now: Running):
    """Return the window of the work, or another one if it was closed."""
    windows = list(bpy.context.window_manager.windows)
    return now.window if now.window in windows else windows[0]


def end(*said: str, kind: str = "INFO") -> None:
    """End the work: restore the scene, and say how it ended."""
    while _running:
        _running.pop().steps.close()
    signals.reset()
    _said[:] = [(kind, line) for line in said]
    tell(latest())
    show_later(None, SHOWN)


@persistent
def note_cancelled(*_) -> None:
    """Note that a render was cancelled; Blender calls this in the render's thread."""
    for now in _running:
        now.is_cancelled = True


@persistent
def stop(*_) -> None:
    """Stop at once: another file is loaded, or the add-on is disabled."""
    if _running:
        end("Stopped")


@persistent
def exchange(*_) -> None:
    """Let the file that is being saved have the scene as it was before the work, which goes on after that."""
    for now in _running:
        now.exchange()


class StopAll(bpy.types.Operator):
    """Stop after the current tile, frame or file; pictures that are finished stay"""

    bl_idname = "camera_ray_caster.stop_all"
    bl_label = "Stop"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        """Ask the running work to end."""
        if _running and not signals.is_stopping():
            signals.stop()
        return {"FINISHED"}


class HearEsc(bpy.types.Operator):
    """Stop the running work on Esc, and report how it ended"""

    bl_idname = "camera_ray_caster.hear_esc"
    bl_label = "Stop on Esc"
    bl_options = {"INTERNAL"}

    def invoke(self, context, event):
        """Listen for events until the work has ended."""
        self.timer = context.window_manager.event_timer_add(INTERVAL, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Stop on Esc; pass other events to Blender."""
        if not _running:
            self.cancel(context)
            for kind, line in _said:
                self.report({kind}, line)
            return {"FINISHED"}
        if event.type == "ESC" and event.value == "PRESS":
            bpy.ops.camera_ray_caster.stop_all()
            return {"RUNNING_MODAL"}
        return {"PASS_THROUGH"}

    def cancel(self, context):
        """Stop listening; Blender calls this when it ends the operator itself, for example to load another file."""
        context.window_manager.event_timer_remove(self.timer)


CLASSES = (StopAll, HearEsc)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    undo.callback(_said.clear)
    undo.callback(stop)
    undo.add_handlers([("render_cancel", note_cancelled), ("load_pre", stop)])
    undo.add_handlers([(name, exchange) for name in ("save_pre", "save_post", "save_post_fail")])
