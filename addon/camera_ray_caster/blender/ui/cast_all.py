"""The Cast All operator: pictures of all cameras and frames of the scene, by the code of the ``cast`` command.

A timer makes one picture at a time. Blender renders it on a thread, as with F12, so that the window stays responsive.
Esc or the Stop button ends the run after the current tile; only complete pictures are kept.
"""

from __future__ import annotations

from collections.abc import Generator
from contextlib import ExitStack
from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ...core.file_set import clear_up
from ...core.records import InputError
from ..cycles.renderer import changed
from ..faces.picture import EEVEE, WORKBENCH
from ..output import reports
from ..properties.declared import ENGINE
from ..properties.labels import in_labels
from ..read.camera import ALL, find_cameras
from ..read.size import SIZE
from ..terminal import files
from ..terminal.cast import options_of
from ..terminal.pictures import Pictures
from . import chosen_frames, in_steps
from .drawing import draw_message
from .needs import can_use, reporting
from .notes import Popover, widen


class Casting(in_steps.Running):
    """The pictures that are being made."""

    def __init__(self, options, scene, window):
        super().__init__(scene, window, self._steps(options))
        self.folder = options.output
        self.made, self.count, self.name = 0, 1, ""

    def _steps(self, options) -> Generator[None, None, None]:
        """Make the pictures; wait for a render of the scene at each step."""
        is_saved = not bpy.data.is_dirty
        with ExitStack() as stack:
            changed(stack, bpy.context.preferences.view, render_display_type="NONE")
            pictures = Pictures(options, self.scene)
            self.scene.render.use_lock_interface = True  # Blender must not draw data that a render thread evaluates
            if options.skip_existing:
                clear_up(options.output)
            jobs, stamp = pictures.jobs(), pictures.stamp()
            stamp["sha256"] = stamp["sha256"] if is_saved else None  # unsaved changes: not the file's pictures
            self.count = len(jobs)
            for job in jobs:
                self.name = job.name
                self.show()
                yield from pictures.making(job, stamp, "")
                self.made += 1

    def step(self) -> None:
        """Go on after a render, and begin the next."""
        next(self.steps)
        if bpy.ops.render.render("INVOKE_DEFAULT", scene=self.scene.name) == {"CANCELLED"}:
            raise InputError("Blender is rendering something else: wait until it has ended, or stop it")

    def lines(self, result) -> list[str]:
        """Return how many pictures were made."""
        return [f"Wrote {self.made} {'picture' if self.made == 1 else 'pictures'} into {self.folder}"]

    @property
    def stopped(self) -> str:
        """How many pictures were made until it was stopped."""
        return f"Stopped: {self.made} of {self.count} pictures are in {self.folder}"

    @property
    def fraction(self) -> float:
        """The part of the pictures that is made."""
        return self.made / self.count

    @property
    def progress(self) -> str:
        """The picture that is being made."""
        return f"Picture {self.made + 1} of {self.count}: {self.name}"


class CastAll(bpy.types.Operator):
    """Cast all cameras of the scene, at one frame or all frames, and write pictures, passes and reports to a folder"""

    bl_idname = "camera_ray_caster.cast_all"
    bl_label = "Cast All"
    bl_options = {"REGISTER"}

    directory: StringProperty(name="Folder", description="Folder of the files", subtype="DIR_PATH")
    frames: EnumProperty(
        name="Frames", items=[chosen_frames.RANGE, chosen_frames.CURRENT, chosen_frames.POSES], options={"SKIP_SAVE"}
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
            (ENGINE, "Camera Ray Caster", "The colors that the rays hit"),
            *((name, label, f"A picture of {label}, through the camera's model; the other passes are cast")
              for name, label in (("CYCLES", "Cycles"), (EEVEE, "EEVEE"), (WORKBENCH, "Workbench"))),
        ],
    )  # fmt: skip
    skip_existing: BoolProperty(
        name="Skip Existing",
        description="Skip pictures that are already finished, from the same file and settings",
    )

    @classmethod
    def poll(cls, context):
        """Gray out the operator while pictures are made or rendered."""
        return can_use(cls, in_steps.BUSY if in_steps.is_busy() else "")

    def invoke(self, context, event):
        """Ask for the folder."""
        if not self.properties.is_property_set("frames"):
            self.frames = chosen_frames.usual(context.scene)
        if not self.directory:
            self.directory = str(_own_folder())
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, context):
        """Draw the options in the file dialog."""
        self.layout.use_property_split = True
        for name in ("frames", "format", "engine", "skip_existing"):
            self.layout.prop(self, name)
        report = reports.latest(context.scene) if self.engine == ENGINE else None
        try:
            said = chosen_frames.in_words(context.scene, self.frames, sum(report.seconds.values()) if report else 0.0)
        except InputError as error:
            said = in_labels(str(error))
        draw_message(self.layout, context, said, "INFO")

    @reporting
    def execute(self, context):
        """Begin; a timer does the rest."""
        if self.skip_existing and bpy.data.is_dirty:
            raise InputError("the file has unsaved changes: save it, or disable Skip Existing")
        scene = context.scene
        cameras, folder = find_cameras(scene, [ALL]), Path(bpy.path.abspath(self.directory))
        if scene.render.resolution_percentage != 100 and any(SIZE in item for item in cameras):
            raise InputError("Resolution % does not change pictures of cameras that have their own size: set it to 100")
        if folder == _own_folder().parent:  # never into a project's folder
            folder = _own_folder()
        words = ["--cameras", ALL, "--output", str(folder), "--format", self.format]
        words += ["--engine", self.engine, "--enable-autoexec", *["--skip-existing"] * self.skip_existing]
        options = options_of(words, self.bl_label)
        options.frames, _ = chosen_frames.chosen(scene, self.frames, cameras)
        options.own_frames = self.frames == chosen_frames.POSES[0]
        in_steps.begin(Casting(options, scene, context.window))
        return {"FINISHED"}


def _own_folder() -> Path:
    """Return the folder beside the .blend that is for its pictures alone."""
    beside = Path(bpy.data.filepath or Path.home() / "untitled.blend")
    return beside.with_name(f"{beside.stem}_pictures")


def draw_all(layout) -> None:
    """Draw the button Cast All, or the progress and the button that stops."""
    now = in_steps.running()
    if now is None:
        layout.operator(CastAll.bl_idname, icon="RENDER_ANIMATION")
        return
    row = layout.row(align=True)
    if now.fraction is None:
        row.label(text=now.progress)
    else:
        row.progress(factor=now.fraction, text=now.progress)
    row.operator(in_steps.StopAll.bl_idname, text="", icon="X")


class LatestRun(Popover, bpy.types.Panel):
    """How the latest run ended"""

    bl_idname = "CAMERA_RAY_CASTER_PT_latest_run"
    bl_label = "Latest Run"

    def draw(self, context):
        """Draw the result in full."""
        widen(self.layout, context)
        draw_message(self.layout, context, in_steps.latest())


CLASSES = (CastAll, LatestRun)
