"""The choice of a camera's model: a menu of names, the gallery, a menu of pictures, and the times of the pixels."""

from collections.abc import Iterator
from itertools import groupby

import bpy
from bpy.props import EnumProperty, StringProperty

from ...core.camera import pixel_time
from ...core.cameras import MODELS
from ...core.cameras.model import GROUPS
from .. import gallery
from ..properties.declared import BLENDERS_OWN, GROUP, MODEL
from ..properties.labels import label_of
from .drawing import draw_message
from .model_settings import key_of
from .needs import OfCamera, camera_object_of, objection

LINES = 15
"""Number of lines in a column of the menu of names."""
PICTURES = 8
"""Number of pictures in a column of the gallery."""
HEIGHT = 2.8
"""Height of a picture, in interface units."""


class ChooseModel(OfCamera, bpy.types.Operator):
    """Use this camera model"""

    bl_idname = "camera_ray_caster.choose_type"
    bl_label = "Choose Camera Model"
    bl_options = {"UNDO", "INTERNAL"}

    key: StringProperty(name="Model", description="Key of the model", options={"SKIP_SAVE"})

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip, which is the model's."""
        return next((it.description for it in MODELS if it.key == properties.key), cls.__doc__)

    def execute(self, context):
        """Set the model; for one of Blender's own the type, and the type of panorama."""
        camera = camera_object_of(context).data
        own, chosen = getattr(camera, GROUP), next((it for it in MODELS if it.key == self.key), None)
        if chosen is None:
            self.report({"ERROR"}, f"There is no camera model {self.key!r}")
            return {"CANCELLED"}
        if chosen.number is not None:
            own.model = self.key
            return {"FINISHED"}
        own.model = BLENDERS_OWN
        if self.key in camera.bl_rna.properties["type"].enum_items:
            camera.type = self.key
        else:
            camera.type, camera.panorama_type = "PANO", self.key
        return {"FINISHED"}


class ChooseTime(OfCamera, bpy.types.Operator):
    """Use this time of the pixels"""

    bl_idname = "camera_ray_caster.choose_time"
    bl_label = "Choose Time of Pixels"
    bl_options = {"UNDO", "INTERNAL"}

    key: EnumProperty(
        name="Time", items=[(it.key, it.label, it.text) for it in pixel_time.MODE.items], options={"SKIP_SAVE"}
    )

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip, which is the item's."""
        return next(it.text for it in pixel_time.MODE.items if it.key == properties.key)

    def execute(self, context):
        """Set the time of the pixels."""
        setattr(getattr(camera_object_of(context).data, GROUP), pixel_time.MODE.name, self.key)
        return {"FINISHED"}


class ModelMenu(bpy.types.Menu):
    """Choose the camera model by its name"""

    bl_idname = "CAMERA_RAY_CASTER_MT_models"
    bl_label = "Camera Model"
    bl_options = {"SEARCH_ON_KEY_PRESS"}

    def draw(self, context):
        """Draw an entry for each model, in groups; small groups share a column."""
        item = camera_object_of(context)
        chosen = "" if objection(context, item) else key_of(item.data)
        row, free = self.layout.row(), 0
        for group, models in by_group():
            if len(models) >= free:
                column, free = row.column(), LINES
            free -= len(models) + 1
            column.label(text=group)
            for it in models:
                icon = "CHECKMARK" if it.key == chosen else "BLANK1"
                column.operator(ChooseModel.bl_idname, text=it.label, icon=icon).key = it.key


class TimeMenu(bpy.types.Menu):
    """Choose the time of the pixels: slit scan, time displacement, rolling shutter"""

    bl_idname = "CAMERA_RAY_CASTER_MT_times"
    bl_label = "Time of Pixels"

    def draw(self, context):
        """Draw an entry for each."""
        for it in pixel_time.MODE.items:
            self.layout.operator(ChooseTime.bl_idname, text=it.label).key = it.key


class ModelGallery(bpy.types.Menu):
    """Choose the camera model by an example picture"""

    bl_idname = "CAMERA_RAY_CASTER_MT_gallery"
    bl_label = "Camera Models"

    def draw(self, context):
        """Draw each group: a heading, and a picture with a button for each model. Small groups share a column."""
        item = camera_object_of(context)
        if reason := objection(context, item, is_changed=True):
            draw_message(self.layout, context, reason, "ERROR")
            return
        self.layout.context_pointer_set("camera", item.data)
        chosen, row = key_of(item.data), self.layout.row()
        for groups in columns():  # in a menu, rows below rows are not aligned
            column = row.column()
            for group, models in groups.items():
                column.label(text=group)
                for it in models:
                    column.template_icon(gallery.icon(gallery.scene_name(it.key)), scale=HEIGHT)
                    icon = "CHECKMARK" if it.key == chosen else "BLANK1"
                    column.operator(ChooseModel.bl_idname, text=it.label, icon=icon).key = it.key


def by_group() -> Iterator[tuple[str, list]]:
    """Yield each group with its models."""
    for group, models in groupby(sorted(MODELS, key=lambda it: GROUPS.index(it.group)), lambda it: it.group):
        yield group, list(models)


def columns() -> Iterator[dict[str, list]]:
    """Yield the columns of the gallery: the models of small groups, or a part of those of a large one, by group."""
    column: dict[str, list] = {}
    free = PICTURES
    for group, members in by_group():
        length = -(-len(members) // -(-len(members) // PICTURES))
        for first in range(0, len(members), length):
            models = members[first : first + length]
            if len(models) > free:
                yield column
                column, free = {}, PICTURES
            column[group] = models
            free -= len(models)
    yield column


def draw_model(layout, camera):
    """Draw the menu of a camera's models with the gallery button next to it, and return their row."""
    row = layout.row(align=True)
    row.context_pointer_set("camera", camera)
    own, key = getattr(camera, GROUP), key_of(camera)
    row.prop(own, MODEL.name, text="", icon="CAMERA_DATA", icon_only=True)  # to be keyed; a menu cannot be
    row.menu(ModelMenu.bl_idname, text=label_of(key))
    row.menu(ModelGallery.bl_idname, text="", icon="IMGDISPLAY")
    return row


CLASSES = (ChooseModel, ChooseTime, ModelMenu, TimeMenu, ModelGallery)
