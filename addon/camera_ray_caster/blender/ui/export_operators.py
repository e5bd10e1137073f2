"""Operators that export cameras to files and copy matrices to the clipboard, and the export menu."""

from math import degrees, pi
from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ...core.exports import EXPORT_FORMATS, find_format
from ...core.exports.fitted import FIT, FIT_WITHIN
from ...core.records import InputError
from ..output import exports
from ..read.camera_fields import ALL, find_camera, find_cameras
from ..read.scene_reader import read_camera
from ..read.unique import unique_name
from . import chosen_frames, in_process
from .needs import OfScene

CHOSEN = {
    "ACTIVE": lambda context: [context.scene.camera],
    "SELECTED": lambda context: [item for item in context.selected_objects if item.type == "CAMERA"],
    "ALL": lambda context: find_cameras(context.scene, [ALL]),
}
"""Functions that return the camera objects, by item of ``Export.cameras``."""


class Export(OfScene, ExportHelper, bpy.types.Operator):
    """Write cameras, at one or more frames, to a folder, as files for another program"""

    bl_label = "Export Cameras"
    bl_options = {"REGISTER"}

    filepath: StringProperty(
        name="Folder", description="Folder of the files, made if it is missing", subtype="FILE_PATH",
        options={"HIDDEN", "SKIP_SAVE"},
    )  # fmt: skip
    """Not remembered: the dialog proposes a name with the format of now."""
    format: EnumProperty(
        name="Format",
        items=[(entry.key, entry.label, entry.description) for entry in EXPORT_FORMATS],
        options={"SKIP_SAVE"},
    )
    cameras: EnumProperty(
        name="Cameras",
        items=[
            ("ACTIVE", "Active", "The scene's active camera"),
            ("SELECTED", "Selected", "The selected cameras"),
            ("ALL", "All", "All cameras of the scene"),
        ],
    )
    frames: EnumProperty(
        name="Frames", items=[chosen_frames.CURRENT, chosen_frames.RANGE, chosen_frames.POSES]
    )
    target: StringProperty(
        name="Target Camera",
        description="Name of the target camera of the maps. If empty, a perspective camera with the same lens",
    )

    fit: BoolProperty(
        name=FIT,
        description="If the format does not have a camera's lens, write the nearest one that it has, and report the "
                    "error in pixels",
    )  # fmt: skip
    fit_within: FloatProperty(
        name=FIT_WITHIN,
        description="Fit only pixels within this angle of the viewing direction. A pinhole can match only the middle "
                    "of a fisheye",
        subtype="ANGLE", min=pi / 180, max=pi, default=pi,
    )  # fmt: skip
    in_process: BoolProperty(
        name="In a Process", description="Write several frames in a process of its own, which can be stopped",
        options={"HIDDEN", "SKIP_SAVE"},
    )  # fmt: skip

    check_extension = None
    """None: the name in the file dialog is a folder name, without an extension."""

    @property
    def filename_ext(self) -> str:
        """Suffix that the dialog adds to the .blend's name to propose a folder."""
        return f"_{self.format}"

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip: the description of the format."""
        return find_format(properties.format).description

    @classmethod
    def why_gray(cls, context) -> str:
        return super().why_gray(context) or (in_process.BUSY if in_process.running() else "")

    def invoke(self, context, event):
        """Ask for the folder."""
        self.in_process = True
        return super().invoke(context, event)

    def check(self, context):
        """Exchange the format at the end of the folder's name for one that is chosen in the file dialog."""
        path = Path(self.filepath)
        before = next((entry.key for entry in EXPORT_FORMATS if path.name.endswith(f"_{entry.key}")), self.format)
        if before != self.format:
            self.filepath = str(path.with_name(path.name.removesuffix(before) + self.format))
        return before != self.format

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "format")
        layout.prop(self, "cameras")
        layout.prop(self, "frames")
        if find_format(self.format).takes_target:
            layout.prop_search(self, "target", context.scene, "objects", icon="CAMERA_DATA")
        if getattr(find_format(self.format), "table", None):
            layout.prop(self, "fit")
            row = layout.row()
            row.active = self.fit
            row.prop(self, "fit_within")

    def execute(self, context):
        scene = context.scene
        cameras = CHOSEN[self.cameras](context)
        if not cameras:
            raise InputError("no camera is selected: select some, or export the active one")
        target = find_camera(scene, self.target) if self.target else None
        frames, shown = chosen_frames.chosen(scene, self.frames, cameras)
        folder = Path(bpy.path.abspath(self.filepath))
        names = [unique_name(item, bpy.data.objects) for item in cameras]
        are_words = not any(name == ALL or name.startswith("-") for name in names)  # which a terminal takes as names
        if self.in_process and self.frames != chosen_frames.CURRENT[0] and are_words:
            words = ["--cameras", *names, "--format", self.format]
            words += [f"--to={unique_name(target, bpy.data.objects)}"] if target else []
            words += [f"--fit={degrees(self.fit_within)!r}"] if self.fit else []
            in_process.begin("export", [*words, *chosen_frames.as_options(scene, self.frames, cameras)], folder)
            return
        fit = self.fit_within if self.fit else None
        remarks, paths = exports.write(scene, self.format, cameras, frames, folder, target, fit=fit, shown=shown)
        wrote = f"Wrote {len(paths)} {'file' if len(paths) == 1 else 'files'} into {folder}"
        for line in (wrote, *remarks) if self.fit else (*remarks, wrote):  # the status bar keeps the last one
            self.report({"INFO"}, line)


class ExportMenu(bpy.types.Menu):
    """The export formats"""

    bl_idname = "CAMERA_RAY_CASTER_MT_export"
    bl_label = "Cameras (Ray Caster)"

    def draw(self, context):
        self.layout.operator_context = "INVOKE_DEFAULT"
        for entry in EXPORT_FORMATS:
            self.layout.operator(Export.bl_idname, text=entry.label).format = entry.key


class CopyK(OfScene, bpy.types.Operator):
    """Copy the active camera's matrix K to the clipboard, in OpenCV's convention: y down, the origin at the center of
    the top left pixel"""

    bl_label = "Copy K"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        camera = read_camera(context.scene)
        if camera.K is None:
            raise InputError(f"{camera.model.label} has no K matrix: use Copy Camera to copy all its numbers")
        context.window_manager.clipboard = _as_text(camera.K)


class CopyWorldToCamera(OfScene, bpy.types.Operator):
    """Copy the world-to-camera matrix of the active camera, in OpenCV's convention: x right, y down, z forward"""

    bl_label = "Copy World to Camera"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        context.window_manager.clipboard = _as_text(read_camera(context.scene).opencv_from_world)


def _as_text(matrix) -> str:
    """Return a matrix as a nested list in the syntax of Python and JSON, with all digits."""
    rows = ",\n ".join(map(str, matrix.tolist()))
    return f"[{rows}]"


def _draw_in_file_menu(menu, context) -> None:
    menu.layout.menu(ExportMenu.bl_idname)


def register(undo) -> None:
    undo.append(bpy.types.TOPBAR_MT_file_export, _draw_in_file_menu)


CLASSES = (Export, ExportMenu, CopyK, CopyWorldToCamera)
