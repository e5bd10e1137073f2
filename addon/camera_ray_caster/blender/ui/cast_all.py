"""The Cast All operator: pictures of all cameras and frames of the scene, by the ``cast`` command in a process."""

from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ...core.records import InputError
from ..faces.engine_picture import EEVEE, WORKBENCH
from ..output import reports
from ..properties.declared import ENGINE
from ..properties.setting_labels import in_labels
from ..read.camera_fields import ALL, find_cameras
from ..read.size import SIZE
from ..terminal import frame_files
from . import chosen_frames, in_process
from .drawing import draw_message
from .needs import Action
from .notes import Popover, widen


class CastAll(Action, bpy.types.Operator):
    """Cast all cameras of the scene, at one frame or all frames, and write pictures, passes and reports to a folder"""

    bl_label = "Cast All"
    bl_options = {"REGISTER"}

    directory: StringProperty(name="Folder", description="Folder of the files", subtype="DIR_PATH")
    frames: EnumProperty(
        name="Frames", items=[chosen_frames.RANGE, chosen_frames.CURRENT, chosen_frames.POSES], options={"SKIP_SAVE"}
    )
    format: EnumProperty(
        name="Passes",
        items=[
            (frame_files.EXR, "EXR", "A multilayer EXR file for each camera and frame"),
            (frame_files.NPZ, "NPZ", "NumPy arrays for each camera and frame"),
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
    def why_gray(cls, context) -> str:
        return in_process.BUSY if in_process.running() else ""

    def invoke(self, context, event):
        """Ask for the folder."""
        if not self.properties.is_property_set("frames"):
            self.frames = chosen_frames.usual(context.scene)
        if not self.directory:
            self.directory = str(_own_folder())
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, context):
        self.layout.use_property_split = True
        for name in ("frames", "format", "engine", "skip_existing"):
            self.layout.prop(self, name)
        report = reports.latest(context.scene) if self.engine == ENGINE else None
        try:
            text = chosen_frames.in_words(context.scene, self.frames, sum(report.seconds.values()) if report else 0.0)
        except InputError as error:
            text = in_labels(str(error))
        draw_message(self.layout, context, text, "INFO")

    def execute(self, context):
        if self.skip_existing and bpy.data.is_dirty:
            raise InputError("the file has unsaved changes: save it, or disable Skip Existing")
        scene = context.scene
        cameras, folder = find_cameras(scene, [ALL]), Path(bpy.path.abspath(self.directory))
        if scene.render.resolution_percentage != 100 and any(SIZE in item for item in cameras):
            raise InputError("Resolution % does not change pictures of cameras that have their own size: set it to 100")
        if folder == _own_folder().parent:  # never into a project's folder
            folder = _own_folder()
        words = ["--cameras", ALL, "--format", self.format, "--engine", self.engine]
        words += ["--skip-existing"] * self.skip_existing
        in_process.begin("cast", [*words, *chosen_frames.as_options(scene, self.frames, cameras)], folder)


def _own_folder() -> Path:
    """Return the folder beside the .blend that is for its pictures alone."""
    beside = Path(bpy.data.filepath or Path.home() / "untitled.blend")
    return beside.with_name(f"{beside.stem}_pictures")


def draw_all(layout) -> None:
    """Draw the button Cast All, or the progress and the button that stops."""
    now = in_process.running()
    if now is None:
        layout.operator(CastAll.bl_idname, icon="RENDER_ANIMATION")
        return
    row = layout.row(align=True)
    row.progress(factor=now.fraction, text=now.progress)
    row.operator(in_process.StopAll.bl_idname, text="", icon="X")


class LatestRun(Popover, bpy.types.Panel):
    """How the latest run ended"""

    bl_idname = "CAMERA_RAY_CASTER_PT_latest_run"
    bl_label = "Latest Run"

    def draw(self, context):
        widen(self.layout, context)
        for line in in_process.latest().splitlines():
            draw_message(self.layout, context, line)


CLASSES = (CastAll, LatestRun)
