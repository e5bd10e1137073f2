"""The operator that adds cameras, with lenses and poses, from files of other programs (File > Import)."""

from functools import partial
from pathlib import Path

import bpy
from bpy.props import BoolProperty, CollectionProperty, StringProperty

from ...core.records import InputError
from ..rig import add_rig, contents, frames_of
from .needs import OfFile, select_alone


class AddCameras(OfFile, bpy.types.Operator):
    """Add the cameras of a file, with lenses, poses and keyframes, as children of an empty. A trajectory animates the
    empty"""

    bl_label = "Add Cameras from File"

    filepath: StringProperty(name="File", description="Path of the file", subtype="FILE_PATH")
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})
    files: CollectionProperty(type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"})
    filter_glob: StringProperty(
        default="*.yml;*.yaml;*.json;*.jsonl;*.txt;*.csv;*.bin;*.xml;*.sfm;*.pincam;*.traj;"
                "*.cameramodel;*.cahv*;*.fspy;*.xmp;*.nvm;*.out;*.log;*.npy;*.toml",
        options={"HIDDEN", "SKIP_SAVE"},
    )
    below_active: BoolProperty(
        name="Below Active Object",
        description="Parent the cameras to the active object. If it is a camera, the file's coordinates are those of "
        "its view: x right, y down, z forward",
    )

    def draw(self, context):
        self.layout.prop(self, "below_active")
        self.draw_found(context, partial(contents, context.scene))

    def execute(self, context):
        folder = Path(bpy.path.abspath(self.directory))
        paths = [str(folder / file.name) for file in self.files if file.name] or [bpy.path.abspath(self.filepath)]
        parent = context.active_object if self.below_active else None
        if self.below_active and parent is None:
            raise InputError("no object is active: select one, or switch off Below Active Object")
        cameras = add_rig(context.scene, paths, parent, say=lambda note: self.report({"WARNING"}, note))
        select_alone(context, *cameras)
        keyed = len(frames_of(cameras))
        self.report({"INFO"}, f"{len(cameras)} cameras" + (f" with keyframes at {keyed} frames" if keyed else ""))


def _draw_in_file_menu(menu, context) -> None:
    menu.layout.operator(AddCameras.bl_idname, text="Cameras (Camera Ray Caster)")


def register(undo) -> None:
    undo.append(bpy.types.TOPBAR_MT_file_import, _draw_in_file_menu)


CLASSES = (AddCameras,)
