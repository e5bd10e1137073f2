"""The gallery panel: camera models to choose by their pictures."""

from collections.abc import Iterator
from itertools import groupby

import bpy
from bpy.props import EnumProperty

from ...core.cameras import MODELS
from ...core.cameras.model import GROUPS
from .. import gallery
from ..properties.declared import BLENDERS_OWN, GROUP, MODEL
from .drawing import draw_message
from .model_settings import blender_type
from .needs import OfCamera, camera_object_of, objection

COLUMNS = 7
WIDTH, HEIGHT = 7.8, 3.2
"""Width of a button, at least, and height of a picture, in interface units."""


class ChooseType(OfCamera, bpy.types.Operator):
    """Use this camera type of Blender, with Blender's own model"""

    bl_idname = "camera_ray_caster.choose_type"
    bl_label = "Choose Camera Type"
    bl_options = {"UNDO", "INTERNAL"}

    key: EnumProperty(
        name="Type",
        items=[(it.key, it.label, it.description) for it in MODELS if it.group == GROUPS[0]],
        options={"SKIP_SAVE"},
    )

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip, which is the model's."""
        return cls.bl_rna.properties["key"].enum_items[properties.key].description

    def execute(self, context):
        """Set the model, the type, and the type of panorama."""
        camera = camera_object_of(context).data
        getattr(camera, GROUP).model = BLENDERS_OWN
        if self.key in camera.bl_rna.properties["type"].enum_items:
            camera.type = self.key
        else:
            camera.type, camera.panorama_type = "PANO", self.key
        return {"FINISHED"}


class ModelGallery(bpy.types.Panel):
    """Choose the camera model by an example picture"""

    bl_idname = "CAMERA_RAY_CASTER_PT_gallery"
    bl_label = "Camera Models"
    bl_space_type = "PROPERTIES"
    bl_region_type = "HEADER"  # opened from a button only
    bl_ui_units_x = int(COLUMNS * WIDTH) + 1

    def draw(self, context):
        """Draw each group: a heading, and a picture with a button for each model. Small groups share a row."""
        item = camera_object_of(context)
        if reason := objection(context, item, is_changed=True):
            draw_message(self.layout, context, reason, "ERROR")
            return
        camera = item.data
        self.layout.context_pointer_set("camera", camera)
        for groups in rows():
            row, count = self.layout.row(), sum(map(len, groups.values()))
            for group, models in groups.items():
                column = row.column()
                column.ui_units_x = COLUMNS * WIDTH * len(models) / count
                column.label(text=group)
                draw_pictures(column, camera, models)


def rows() -> Iterator[dict[str, list]]:
    """Yield the rows of the gallery: the models of one or more groups, by group."""
    row: dict[str, list] = {}
    for group, models in groupby(sorted(MODELS, key=lambda it: GROUPS.index(it.group)), lambda it: it.group):
        members = list(models)
        if row and sum(map(len, row.values())) + len(members) > COLUMNS:
            yield row
            row = {}
        row[group] = members
    yield row


def draw_pictures(layout, camera, models) -> None:
    """Draw the models of a group, each with its picture, in lines of about the same length."""
    own, lines = getattr(camera, GROUP), -(-len(models) // COLUMNS)
    grid = layout.grid_flow(row_major=True, columns=-(-len(models) // lines), even_columns=True)
    for it in models:
        cell = grid.column(align=True)
        cell.template_icon(gallery.icon(gallery.scene_name(it.key)), scale=HEIGHT)
        if it.number is None:
            is_chosen = own.model == BLENDERS_OWN and blender_type(camera) == it.key
            cell.operator(ChooseType.bl_idname, text=it.label, depress=is_chosen).key = it.key
        else:
            cell.prop_enum(own, MODEL.name, it.key)


def draw_model(layout, camera, **options):
    """Draw the menu of a camera's models with the gallery button next to it, and return their row. ``options`` are
    passed to Blender's ``prop`` for the menu.
    """
    row = layout.row(align=True)
    row.context_pointer_set("camera", camera)
    row.prop(getattr(camera, GROUP), MODEL.name, **options)
    row.popover(ModelGallery.bl_idname, text="", icon="IMGDISPLAY")
    return row


CLASSES = (ChooseType, ModelGallery)
