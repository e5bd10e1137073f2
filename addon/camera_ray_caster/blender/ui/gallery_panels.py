"""The gallery panel: camera models to choose by their pictures."""

from itertools import groupby

import bpy

from ...core.cameras.model import GROUPS
from .. import gallery
from ..properties.declared import GROUP, MODEL
from .needs import camera_object_of

POINTER = "camera_ray_caster_data"
"""Name of the context pointer to the camera that a gallery button changes."""
COLUMNS = 8
WIDTH = 4.5
"""Width of a picture, in interface units."""


class ModelGallery(bpy.types.Panel):
    """Choose the camera model by an example picture"""

    bl_idname = "CAMERA_RAY_CASTER_PT_gallery"
    bl_label = "Camera Models"
    bl_space_type = "PROPERTIES"
    bl_region_type = "HEADER"  # opened from a button only
    bl_ui_units_x = int(COLUMNS * WIDTH) + 1

    def draw(self, context):
        """Draw each group: a heading, and a picture with a button for each model. Small groups share a row."""
        camera = getattr(context, POINTER, None) or camera_object_of(context).data
        free = 0
        for group, items in groupby(MODEL.items, lambda item: item.group):
            members = list(items)
            if len(members) > free:
                row, free = self.layout.row(), COLUMNS
            free -= len(members)
            column = row.column()
            column.ui_units_x = WIDTH * min(len(members), COLUMNS)
            column.label(text=group)
            draw_pictures(column, getattr(camera, GROUP), members)
            if free > 0 and group == GROUPS[-1]:
                row.column().ui_units_x = WIDTH * free


def draw_pictures(layout, own, members) -> None:
    """Draw the models of a group, each with its picture."""
    grid = layout.grid_flow(row_major=True, columns=min(len(members), COLUMNS), even_columns=True)
    for item in members:
        cell = grid.column(align=True)
        cell.template_icon(gallery.icon(gallery.scene_name(item.key)), scale=WIDTH)
        cell.prop_enum(own, MODEL.name, item.key)


def draw_model(layout, camera, **options):
    """Draw the menu of a camera's models with the gallery button next to it, and return their row. ``options`` are
    passed to Blender's ``prop`` for the menu.
    """
    row = layout.row(align=True)
    row.context_pointer_set(POINTER, camera)
    row.prop(getattr(camera, GROUP), MODEL.name, **options)
    row.popover(ModelGallery.bl_idname, text="", icon="IMGDISPLAY")
    return row


CLASSES = (ModelGallery,)
