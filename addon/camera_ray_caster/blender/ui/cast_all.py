"""Cast All: pictures of all cameras and frames of the scene in a folder, by the code of the command ``cast``.

A timer makes one picture at a time. Blender renders it as F12 does, on a thread, so that the window stays responsive;
Esc or the button Stop ends after the current tile, and leaves whole pictures only.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import bpy
from bpy.app.handlers import persistent
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ...core.file_set import clear_up
from ...core.memory import exhausted
from ...core.records import Cancelled, InputError
from ..cycles.renderer import changed
from ..process import signals
from ..properties.declared import ENGINE
from ..properties.labels import in_labels
from ..read.camera import ALL
from ..read.frames import frame_of
from ..terminal import files
from ..terminal.cast import options_of
from ..terminal.pictures import Pictures
from ..terminal.restored import restored
from .drawing import draw_message
from .needs import can_use, reporting
from .other_engine import show, show_later

INTERVAL = 0.1
"""Seconds between two looks at whether a render has ended."""
SHOWN = 10.0
"""Seconds that the status bar shows the result."""


class Running:
    """The pictures that are being made."""

    def __init__(self, options, scene, window):
        self.scene, self.window, self.folder = scene, window, options.output
        self.made, self.count, self.name = 0, 1, ""
        self.is_cancelled = False
        self.steps = self._steps(options)

    def _steps(self, options) -> Iterator[None]:
        """Make the pictures; wait for a render of the scene at each step."""
        is_saved = not bpy.data.is_dirty
        with restored(self.scene), ExitStack() as stack:
            changed(stack, bpy.context.preferences.view, render_display_type="NONE")
            pictures = Pictures(options, self.scene)
            self.scene.render.use_lock_interface = True  # Blender may not draw what a render's thread evaluates
            if options.skip_existing:
                clear_up(options.output)
            jobs, stamp = pictures.jobs(), pictures.stamp()
            stamp["sha256"] = stamp["sha256"] if is_saved else None  # the file is not what the pictures show
            self.count = len(jobs)
            for job in jobs:
                self.name = job.name
                self.show()
                yield from pictures.making(job, stamp, "")
                self.made += 1

    def step(self) -> None:
        """Go on after a render, and begin the next. Raises StopIteration at the end, and Cancelled if it was stopped.
        """
        if self.is_cancelled or signals.is_stopping():
            raise Cancelled
        next(self.steps)
        if bpy.ops.render.render("INVOKE_DEFAULT", scene=self.scene.name) == {"CANCELLED"}:
            raise InputError("Blender is rendering something else: let it end first")

    def show(self) -> None:
        """Show the progress in the status bar and the sidebars."""
        show(f"{self.progress}      Esc: Stop")
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()

    @property
    def progress(self) -> str:
        """The progress in words."""
        return f"Picture {self.made + 1} of {self.count}: {self.name}"


_running: list[Running] = []
_said: list[str] = []
"""How the latest run ended."""


def running() -> Running | None:
    """Return the pictures that are being made, or None."""
    return _running[0] if _running else None


def latest() -> str:
    """Return how the latest run ended, in words; "" before the first."""
    return _said[0] if _said else ""


def tick() -> float | None:
    """Go on as soon as a render has ended; called by a timer."""
    if not _running:
        return None
    if bpy.app.is_job_running("RENDER"):
        return INTERVAL
    now = _running[0]
    try:
        with bpy.context.temp_override(window=_window(now)):
            now.step()
    except StopIteration:
        end(f"Wrote {now.made} {'picture' if now.made == 1 else 'pictures'} into {now.folder}")
    except Cancelled:
        end(f"Stopped: {now.made} of {now.count} pictures are in {now.folder}")
    except ReferenceError:
        end("Stopped: the scene was removed")
    except InputError as error:
        end(in_labels(str(error)))
    except (MemoryError, RuntimeError, OSError) as error:
        end(exhausted(error) or str(error))
        if not exhausted(error):
            raise
    return INTERVAL if _running else None


def _window(now: Running):
    """Return the window of the run, or another one if it was closed."""
    windows = list(bpy.context.window_manager.windows)
    return now.window if now.window in windows else windows[0]


def end(said: str) -> None:
    """End the run: restore the scene, and say how it ended."""
    while _running:
        _running.pop().steps.close()
    signals.reset()
    _said[:] = [said]
    show(said)
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


class CastAll(bpy.types.Operator):
    """Cast all cameras of the scene, at one or all frames, into pictures, passes and reports in a folder"""

    bl_idname = "camera_ray_caster.cast_all"
    bl_label = "Cast All"
    bl_options = {"REGISTER"}

    directory: StringProperty(name="Folder", description="Folder of the files", subtype="DIR_PATH")
    frames: EnumProperty(
        name="Frames",
        items=[
            ("RANGE", "Range", "The scene's frame range, with its frame step"),
            ("CURRENT", "Current", "The current frame"),
        ],
    )
    format: EnumProperty(
        name="Passes",
        items=[
            (files.EXR, "EXR", "A multilayer EXR file for each camera and frame"),
            (files.NPZ, "NPZ", "NumPy arrays for each camera and frame"),
        ],
    )
    engine: EnumProperty(
        name="Picture",
        description="Engine that renders the combined pass",
        items=[
            (ENGINE, "Camera Ray Caster", "The picture that the rays show"),
            ("CYCLES", "Cycles", "A picture of Cycles, through the camera's model; the other passes are cast"),
        ],
    )
    skip_existing: BoolProperty(
        name="Skip Existing",
        description="Skip pictures that are already finished, from the same file and settings",
    )

    @classmethod
    def poll(cls, context):
        """Gray out the operator while pictures are made or rendered."""
        busy = bool(_running) or bpy.app.is_job_running("RENDER")
        return can_use(cls, "Let the running render end first, or stop it" if busy else "")

    def invoke(self, context, event):
        """Ask for the folder."""
        if not self.directory:
            beside = Path(bpy.data.filepath or Path.home() / "untitled.blend")
            self.directory = str(beside.with_name(f"{beside.stem}_pictures"))
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, context):
        """Draw the options in the file dialog."""
        self.layout.use_property_split = True
        for name in ("frames", "format", "engine", "skip_existing"):
            self.layout.prop(self, name)

    @reporting
    def execute(self, context):
        """Begin; a timer does the rest."""
        if self.skip_existing and bpy.data.is_dirty:
            raise InputError("pictures of the file cannot be told from those of your changes: save it, or do not skip")
        scene = context.scene
        every = f"{scene.frame_start}:{scene.frame_end}:{scene.frame_step}"
        at = ["--frames", every] if self.frames == "RANGE" else ["--frame", str(frame_of(scene))]
        words = ["--cameras", ALL, *at, "--output", bpy.path.abspath(self.directory), "--format", self.format]
        words += ["--engine", self.engine, "--enable-autoexec", *["--skip-existing"] * self.skip_existing]
        signals.reset()
        _running.append(Running(options_of(words, self.bl_label), scene, context.window))
        bpy.app.timers.register(tick, first_interval=INTERVAL)
        return {"FINISHED"}


class StopAll(bpy.types.Operator):
    """Stop after the current tile; pictures that are finished stay"""

    bl_idname = "camera_ray_caster.stop_all"
    bl_label = "Stop"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        """Ask the running render to end."""
        if _running and not signals.is_stopping():
            signals.stop()
        return {"FINISHED"}


def draw_all(layout, context) -> None:
    """Draw the button Cast All, or the progress and the button that stops; and how the latest run ended."""
    now = running()
    if now is None:
        layout.operator(CastAll.bl_idname, icon="RENDER_ANIMATION")
        if latest():
            draw_message(layout, context, latest())
        return
    row = layout.row(align=True)
    row.progress(factor=now.made / now.count, text=now.progress)
    row.operator(StopAll.bl_idname, text="", icon="X")


CLASSES = (CastAll, StopAll)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    undo.callback(_said.clear)
    undo.callback(stop)
    undo.add_handlers([("render_cancel", note_cancelled), ("load_pre", stop)])
