"""The sidebar's list of the scene's cameras: each with its model, and buttons to make it active and see through it."""

import re

import bpy
from bpy.props import BoolProperty, StringProperty

from ...core.records import InputError
from ..properties.setting_labels import label_of
from ..read.camera_fields import ALL, find_camera, find_cameras
from . import in_process
from .cast_all import LatestRun, draw_all
from .chosen_frames import usual
from .drawing import Sidebar
from .export_operators import Export
from .model_settings import key_of
from .needs import Action
from .notes import draw_line
from .see_through import is_seen_through

FOLDERS = re.compile(r"(?<=\s)(?:[A-Za-z]:)?[/\\](?=\S).*[/\\]")
"""What a row of the sidebar has no room for in a line with a path; the popover has the whole line."""


class UseCamera(Action, bpy.types.Operator):
    """Make this camera the scene's active camera"""

    bl_label = "Use Camera"

    name: StringProperty(name="Camera", description="Name of the camera object", options={"SKIP_SAVE"})
    see_through: BoolProperty(
        name="See Through", description="Also look through the camera in this 3D View", options={"SKIP_SAVE"}
    )

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip, which differs for the button that also looks through the camera."""
        return "Make this camera the active one and see through it" if properties.see_through else cls.__doc__

    def execute(self, context):
        context.scene.camera = find_camera(context.scene, self.name)
        if self.see_through and not is_seen_through(context):
            bpy.ops.camera_ray_caster.see_through()


class SidebarCameras(Sidebar, bpy.types.Panel):
    """The cameras of the scene."""

    bl_idname = "CAMERA_RAY_CASTER_PT_cameras"
    bl_label = "All Cameras"
    bl_parent_id = "CAMERA_RAY_CASTER_PT_camera"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        """Show the panel for scenes with several cameras, while work runs, which it can stop, and with its result."""
        count = sum(item.type == "CAMERA" for item in context.scene.objects)
        return count > 1 or bool(in_process.running() or in_process.latest())

    def draw(self, context):
        layout, active = self.layout, context.scene.camera
        column = layout.column(align=True)
        try:
            cameras = find_cameras(context.scene, [ALL])
        except InputError:  # the last one has been deleted since the poll
            return
        for item in cameras:
            row = column.row(align=True)
            icon = "RADIOBUT_ON" if item == active else "RADIOBUT_OFF"
            text = f"{item.name}: {label_of(key_of(item.data))}"
            row.operator(UseCamera.bl_idname, text=text, icon=icon, depress=item == active).name = item.name
            through = row.operator(UseCamera.bl_idname, text="", icon="CAMERA_DATA")
            through.name, through.see_through = item.name, True
        layout.operator_context = "INVOKE_DEFAULT"
        draw_all(layout)
        export = layout.operator(Export.bl_idname, text="Export All", icon="EXPORT")
        export.format, export.cameras, export.frames = "json", "ALL", usual(context.scene)
        draw_line(layout, context, FOLDERS.sub("", in_process.latest()), LatestRun.bl_idname)


CLASSES = (UseCamera, SidebarCameras)
