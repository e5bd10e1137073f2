"""Operators: verify the camera, copy it, load a calibration, select what was left out, write the report."""

from functools import partial

import bpy
from bpy.props import BoolProperty, StringProperty

from ...core.camera.calibration_file import model_of
from ...core.camera.facts import camera_facts
from ...core.cameras.parts.calibration import SIZE
from ...core.exports.camera_json import recorded
from ...core.programs import READ
from ...core.records import InputError
from ...core.report.report import Report, as_json
from ..output import reports
from ..properties.calibration_choice import cameras_in, lenses_in, set_calibration, set_lens
from ..read import movie_clips
from ..read.frames import frame_of
from ..read.scene_reader import read_camera
from ..verification.check import verified
from .frame import SET_FRAME, framed
from .needs import Action, OfCamera, OfFile, OfScene, camera_object_of, select_alone

NO_REPORT = "Render with the Camera Ray Caster first (F12), or cast from the sidebar"

WITH_CYCLES = (
    "Also render a small picture of a box in Cycles with the camera's shader, and compare the rays of Cycles with the "
    "rays of the add-on"
)


class Verify(OfScene, bpy.types.Operator):
    """Compare the rays of the active camera with Blender's own view frame, camera matrix and projection"""

    bl_label = "Verify"
    bl_options = {"REGISTER"}

    with_cycles: BoolProperty(name="With Cycles", description=WITH_CYCLES, options={"SKIP_SAVE"})

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip, which differs for the button with Cycles."""
        return WITH_CYCLES if properties.with_cycles else cls.__doc__

    def execute(self, context):
        report = verified(context.scene, self.with_cycles)
        reports.keep_verified(report, context.scene)
        if report.passed:
            self.report({"INFO"}, report.verdict)
        else:
            self.report({"WARNING"}, f"{report.verdict}. See the sidebar")


class CopyFacts(OfScene, bpy.types.Operator):
    """Copy the active camera to the clipboard as JSON, with all digits. In Python camera_from_json reads it"""

    bl_label = "Copy Camera"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        camera, frame = read_camera(context.scene), frame_of(context.scene)
        report = Report(camera=camera_facts(camera), frame=frame, record=recorded(camera))
        context.window_manager.clipboard = as_json(report)


class LoadCalibration(OfFile, OfCamera, bpy.types.Operator):
    """Choose a calibration file, which sets the camera model"""

    bl_label = "Load Calibration"
    bl_description = f"Choose a calibration file of {READ}. The file determines the camera model"

    filepath: StringProperty(name="File", description="Path of the calibration file", subtype="FILE_PATH")
    filter_glob: StringProperty(
        default="*.yml;*.yaml;*.json;*.jsonl;*.xml;*.gz;*.txt;*.bin;*.cameramodel;*.sfm;*.pincam;*.npz;*.npy;*.exr;*.csv;*.obj;"
                "*.pto;*.pts;*.cahv*;*.fspy;*.xmp;*.nvm;*.out;*.toml",
        options={"HIDDEN", "SKIP_SAVE"},
    )
    camera: StringProperty(
        name="Camera in File",
        description="Name of the camera in a calibration file that has several cameras",
        options={"SKIP_SAVE"},
    )
    set_frame: BoolProperty(name=SET_FRAME.label, description=SET_FRAME.text, default=True, options={"SKIP_SAVE"})

    def draw(self, context):
        layout = self.layout
        layout.label(text="Camera in File")
        layout.prop(self, "camera", text="")
        layout.prop(self, "set_frame")
        self.draw_found(context, partial(sizes_in_words, context, camera_object_of(context)))

    def execute(self, context):
        item, path = camera_object_of(context), bpy.path.abspath(self.filepath)
        if not (self.camera or bpy.app.background) and len(names := cameras_in(item.data, path)) > 1:
            entries = partial(draw_cameras, path, names, self.set_frame)
            context.window_manager.popup_menu(entries, title="Camera in File")
            return {"CANCELLED"}  # an entry loads it
        with framed(context, item, self.set_frame) as remarks:
            remarks.append(set_calibration(item.data, path, self.camera))
        for line in remarks:
            self.report({"INFO"}, line)
        return None


class LensOfClip(OfCamera, bpy.types.Operator):
    """Set the camera model and the resolution to those of the movie clip that the camera is tracked from"""

    bl_label = "Lens of Movie Clip"

    clip: StringProperty(name="Movie Clip", description="Name of the clip; default the camera's first one")

    @classmethod
    def why_gray(cls, context) -> str:
        if reason := super().why_gray(context):
            return reason
        has_clip = movie_clips.clips_of(context.scene, camera_object_of(context))
        return "" if has_clip else "The scene and the camera have no movie clip"

    def execute(self, context):
        item = camera_object_of(context)
        clips = movie_clips.clips_of(context.scene, item)
        clip = next((named for named in clips if named.name == self.clip), None if self.clip else clips[0])
        if clip is None:
            raise InputError(f"the scene and the camera have no movie clip {self.clip!r}")
        lens, render = movie_clips.lens_of(clip), context.scene.render
        set_lens(item.data, lens)
        render.resolution_x, render.resolution_y = lens.size
        self.report({"INFO"}, f"{clip.name}: {model_of(lens).label}; the frame is {lens.size[0]} × {lens.size[1]}")


def sizes_in_words(context, item, path: str) -> list[str]:
    """Return the sizes of the pictures of a calibration file's cameras and of the frame, as lines."""
    lenses = lenses_in(item.data, path)
    sizes = {f"{lens.name}: ".lstrip(": "): [int(lens.settings.get(side.name, 0)) for side in SIZE] for lens in lenses}
    render = context.scene.render
    return [
        *(f"{name}{wide} × {high} pixels" for name, (wide, high) in sizes.items() if wide),
        f"The frame: {render.resolution_x} × {render.resolution_y}",
    ]


def draw_cameras(path: str, names: list[str], set_frame: bool, menu, context) -> None:
    """Draw an entry for each camera in a calibration file, which loads it."""
    menu.layout.operator_context = "EXEC_DEFAULT"
    for name in names:
        entry = menu.layout.operator(LoadCalibration.bl_idname, text=name)
        entry.filepath, entry.camera, entry.set_frame = path, name, set_frame


class OfReport(Action):
    """Base of the operators on the latest report."""

    @classmethod
    def why_gray(cls, context) -> str:
        return "" if reports.latest(context.scene) else NO_REPORT


class SelectLeftOut(OfReport, bpy.types.Operator):
    """Select the objects that the latest cast left out or simplified for this reason, and make the first one active"""

    bl_idname = "camera_ray_caster.select"
    bl_label = "Select"

    reason: StringProperty(
        name="Reason", description="Reason for which the report lists the objects as left out", options={"SKIP_SAVE"}
    )

    def execute(self, context):
        names = reports.by_reason(reports.latest(context.scene)).get(self.reason, ())
        users = reports.users_of(context.view_layer, self.reason, names)
        if not users:
            raise InputError("none of these objects is in this view layer: they were renamed, removed or excluded")
        select_alone(context, *users)


class WriteReport(OfReport, bpy.types.Operator):
    """Write the report of the latest render into a text datablock"""

    bl_label = "Report to Text"

    def execute(self, context):
        text = reports.write_text(reports.latest(context.scene))
        self.report({"INFO"}, f"The report is in the text {text.name!r}: open it in the Text Editor")


CLASSES = (Verify, CopyFacts, LoadCalibration, LensOfClip, SelectLeftOut, WriteReport)
