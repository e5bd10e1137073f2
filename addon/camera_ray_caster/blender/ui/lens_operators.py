"""Operators of a real lens: choose one that comes with the add-on, and give it the size that its file states."""

import bpy
from bpy.props import EnumProperty

from ...core.cameras.parts.lens_settings import LENS_FILE
from ...core.lenses.focus import own_focal_length
from ...core.lenses.read import library, read_lens
from ..properties.declared import GROUP
from ..read.camera_fields import own_value
from .needs import OfCamera, camera_object_of


class ChooseLens(OfCamera, bpy.types.Operator):
    """Use a lens that comes with the add-on, with its own focal length"""

    bl_label = "Lens"

    name: EnumProperty(
        name="Lens",
        description="A lens that comes with the add-on",
        items=[(name, name.replace("_", " "), read_lens(name).source, index) for index, name in enumerate(library())],
    )

    def execute(self, context):
        data = camera_object_of(context).data
        setattr(getattr(data, GROUP), LENS_FILE.name, self.name)
        data.lens = own_focal_length(read_lens(self.name))


class OwnFocalLength(OfCamera, bpy.types.Operator):
    """Set Focal Length to that of the lens file, so that the lens has its own size"""

    bl_label = "Lens's Own Focal Length"

    def execute(self, context):
        data = camera_object_of(context).data
        file = bpy.path.abspath(own_value(data, LENS_FILE), library=data.library)
        data.lens = own_focal_length(read_lens(file))


def draw_lens_file(layout, camera) -> None:
    """Draw the buttons of a real lens."""
    row = layout.row(align=True)
    row.operator_menu_enum(ChooseLens.bl_idname, "name", text="Choose Lens")
    row.operator(OwnFocalLength.bl_idname, text="Own Focal Length")


CLASSES = (ChooseLens, OwnFocalLength)
