"""The operators: verify, copy, select, write."""

import bpy
from bpy.props import BoolProperty, StringProperty

from ...core.camera.facts import camera_facts
from ...core.cameras.parts.calibration import FILE_WRITERS
from ...core.exports.camera_json import recorded
from ...core.report.report import Report, as_json
from ..output import reports
from ..properties.calibration import set_calibration
from ..read.scene import read_camera
from ..verification.check import verified
from .needs import OfCamera, OfScene, camera_object_of, reporting, select_alone

NO_REPORT = "Render with the Camera Ray Caster first (F12), or cast from the sidebar"


class Verify(OfScene, bpy.types.Operator):
    """Compare the rays of the active camera with Blender's own view frame, camera matrix and projection"""

    bl_idname = "camera_ray_caster.verify"
    bl_label = "Verify"
    bl_options = {"REGISTER"}

    with_cycles: BoolProperty(
        name="With Cycles",
        description="Render a small picture of a box by Cycles with the camera's shader, and compare its rays too",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def description(cls, context, properties):
        """Say of the button with Cycles what that does."""
        return cls.bl_rna.properties["with_cycles"].description if properties.with_cycles else cls.__doc__

    @reporting
    def execute(self, context):
        """Verify, keep what was found for the panel, and say it in one line."""
        report = verified(context.scene, self.with_cycles)
        reports.keep_verified(report)
        if report.passed:
            self.report({"INFO"}, "The rays agree with every witness")
        else:
            self.report({"WARNING"}, "A witness disagrees with the rays: see the sidebar")
        return {"FINISHED"}


class CopyFacts(OfScene, bpy.types.Operator):
    """Copy what the active camera is to the clipboard, as JSON with all digits, of which camera_from_json makes its
    rays"""

    bl_idname = "camera_ray_caster.copy_facts"
    bl_label = "Copy Camera"
    bl_options = {"INTERNAL"}

    @reporting
    def execute(self, context):
        """Copy it."""
        camera, frame = read_camera(context.scene), context.scene.frame_current_final
        report = Report(camera=camera_facts(camera), frame=frame, record=recorded(camera))
        context.window_manager.clipboard = as_json(report)
        return {"FINISHED"}


class LoadCalibration(OfCamera, bpy.types.Operator):
    """The camera model follows from a calibration file"""

    bl_idname = "camera_ray_caster.load_calibration"
    bl_label = "Load Calibration"
    bl_description = f"Choose a calibration file of {FILE_WRITERS}: the camera model follows from it"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(name="File", description="The calibration file", subtype="FILE_PATH")
    camera: StringProperty(name="Camera in File", description="Of a file with several: its name there")

    def invoke(self, context, event):
        """Ask for the file."""
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    @reporting
    def execute(self, context):
        """Read it, and say what was read."""
        said = set_calibration(camera_object_of(context).data, bpy.path.abspath(self.filepath), self.camera)
        self.report({"INFO"}, said)
        return {"FINISHED"}


class SelectLeftOut(bpy.types.Operator):
    """Select the objects that the latest cast left out for this reason, and make the first one active"""

    bl_idname = "camera_ray_caster.select"
    bl_label = "Select"
    bl_options = {"REGISTER", "UNDO"}

    reason: StringProperty(name="Reason", description="As the report says it", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        """Grayed out before the first cast."""
        cls.poll_message_set(NO_REPORT)
        return reports.latest() is not None

    def execute(self, context):
        """Select them alone, where the view layer has them and they can be selected."""
        names = reports.by_reason(reports.latest()).get(self.reason, ())
        found = [context.view_layer.objects[name] for name in names if name in context.view_layer.objects]
        if not found:
            self.report({"ERROR"}, "None of them is in this view layer: they were renamed, removed or excluded")
            return {"CANCELLED"}
        select_alone(context, *found)
        return {"FINISHED"}


class WriteReport(bpy.types.Operator):
    """Write the report of the latest render into a text datablock"""

    bl_idname = "camera_ray_caster.write_report"
    bl_label = "Report to Text"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Grayed out before the first render."""
        cls.poll_message_set(NO_REPORT)
        return reports.latest() is not None

    def execute(self, context):
        """Write it, and say where it is."""
        text = reports.write_text(reports.latest())
        self.report({"INFO"}, f"The report is the text {text.name!r}, in the Text Editor")
        return {"FINISHED"}


CLASSES = (Verify, CopyFacts, LoadCalibration, SelectLeftOut, WriteReport)
