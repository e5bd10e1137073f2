"""Operators that add what a camera model needs: a slit or a path that fills the picture, an image of pixel times."""

import bpy
import numpy as np
from bpy.props import EnumProperty
from mathutils import Euler, Matrix, Vector

from ...core.camera.pixel_time import GRAY
from ...core.cameras.parts.lines import SECOND_SLIT, SLIT
from ...core.cameras.strip import PATH
from ...core.records import InputError
from ..properties.declared import GROUP
from .needs import OfCamera, camera_object_of, select_alone

QUARTER = 1.5707963267948966
GRADIENT = 256, 16
"""Width and height of an added gradient in pixels; a picture has 256 times (see ``core.camera.pixel_time``)."""
PATH_HALF = 5.0
"""Half the length of an added path, in Blender units."""

PLACES = {
    SLIT.name: Matrix(),
    SECOND_SLIT.name: Matrix.LocRotScale(Vector((0, 0, -0.5)), Euler((0, 0, QUARTER)), None),
    PATH.name: Matrix(),
}
"""Matrix of each added line in the camera's frame; the line lies along its X axis. The slit and the path pass
horizontally through the eye. The second slit is upright, halfway to the window of a cross-slit camera, which then sees
about twice as wide.
"""
SETTINGS = {setting.name: setting for setting in (SLIT, SECOND_SLIT, PATH)}


class OfLine(OfCamera):
    """Base of the operators on a slit or the path of the panel's camera."""

    setting: EnumProperty(name="Line", items=[(line.name, line.label, line.text) for line in SETTINGS.values()])


class AddLine(OfLine, bpy.types.Operator):
    """Add this line to the scene, parented to the camera, and assign it to the camera"""

    bl_label = "Add Slit or Path"

    def execute(self, context):
        camera = camera_object_of(context)
        name = f"{camera.name} {SETTINGS[self.setting].label}"
        line = bpy.data.objects.new(name, _path(name) if self.setting == PATH.name else None)
        line.empty_display_type = "ARROWS"
        line.show_name = True
        editable = [collection for collection in camera.users_collection if collection.is_editable]
        for collection in editable or (context.scene.collection,):
            collection.objects.link(line)
        line.parent, line.matrix_local = camera, PLACES[self.setting]
        setattr(getattr(camera.data, GROUP), self.setting, line)
        if context.area is not None and context.area.type == "VIEW_3D":  # the Properties editor stays with the camera
            select_alone(context, line)


class SelectLine(OfLine, bpy.types.Operator):
    """Select only this line, to move it"""

    bl_label = "Select Slit or Path"

    def execute(self, context):
        line = getattr(getattr(camera_object_of(context).data, GROUP), self.setting)
        if line is None or line.name not in context.view_layer.objects:
            raise InputError("the object is not in this view layer: enable its collection, or choose another one")
        select_alone(context, line)


class AddGradient(OfCamera, bpy.types.Operator):
    """Add an image with an even gradient, from black at the left to white at the right, that sets the time of each
    pixel. Paint or replace it to change the times"""

    bl_label = "Add Gradient"

    def execute(self, context):
        image = bpy.data.images.new("Time Gradient", *GRADIENT, float_buffer=True, is_data=True)
        columns, rows = GRADIENT
        gray = np.repeat(np.linspace(0, 1, columns, dtype=np.float32), 4).reshape(-1, 4)
        gray[:, 3] = 1
        image.pixels.foreach_set(np.tile(gray, (rows, 1)).ravel())
        image.pack()
        setattr(getattr(camera_object_of(context).data, GROUP), GRAY.name, image)


def _path(name: str):
    """Return a straight curve along X."""
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("POLY")
    spline.points.add(1)
    for point, x in zip(spline.points, (-PATH_HALF, PATH_HALF), strict=True):
        point.co = (x, 0.0, 0.0, 1.0)
    return curve


CLASSES = (AddLine, SelectLine, AddGradient)
