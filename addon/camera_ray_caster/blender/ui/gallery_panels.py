"""The choice of a camera's model, and of the times of its pixels: a menu of names, and the gallery of pictures."""

from collections.abc import Iterator
from itertools import groupby

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ...core.camera import pixel_time
from ...core.cameras import MODELS
from ...core.cameras.model import GROUPS
from ...core.cameras.parts.settings import Item
from ...core.records import InputError
from .. import gallery
from ..properties.declared import BLENDERS_OWN, GROUP, MODEL
from ..properties.setting_labels import label_of
from .drawing import in_columns
from .model_settings import key_of
from .needs import OfCamera, camera_object_of, objection

SCALE = 4.5
"""Size of a picture in the gallery, in interface units: of eight in a row, as Blender draws them, all fit a window."""
GALLERY = "camera_ray_caster_gallery"
"""Name of the property of cameras whose items are the pictures: of Blender's layouts, only such a menu draws picture
and name as one button.
"""
TIMES = {
    pixel_time.ROWS: "slit_scan_rows", pixel_time.COLUMNS: "slit_scan_columns",
    pixel_time.IMAGE: "time_displacement", pixel_time.ROLLING_SHUTTER: "rolling_shutter",
    pixel_time.SWEEP: "street_scanner",
}  # fmt: skip
"""Scene of each mode of pixel times except One Time."""
SHORT = {
    "EQUIRECTANGULAR": "Equirect.", "EQUIANGULAR_CUBEMAP_FACE": "Cube Face", "FISHEYE_EQUIDISTANT": "Equidistant",
    "FISHEYE_EQUISOLID": "Equisolid", "FISHEYE_LENS_POLYNOMIAL": "Fisheye Poly", "CENTRAL_CYLINDRICAL": "Central Cyl.",
    "OPENCV_PINHOLE": "CV Pinhole", "OPENCV_FISHEYE": "CV Fisheye", "UCM": "Unified (UCM)", "EUCM": "EUCM",
    "DOUBLE_SPHERE": "Dbl. Sphere", "THIN_PRISM_FISHEYE": "Thin Prism", "FOV": "FOV",
    "RADIAL_POLYNOMIAL": "Radial Poly", "OCAM": "OCam", "FISHEYE_ORTHOGRAPHIC": "Fisheye Ortho",
    "FISHEYE_STEREOGRAPHIC": "Stereographic", "CYLINDRICAL": "Pano Cylinder",
    "STEREOGRAPHIC_PANORAMA": "Pano Stereog.", "OMNIDIRECTIONAL_STEREO": "Omni Stereo",
    "TWISTED_ORTHOGRAPHIC": "Twisted Ortho", "CAMERA_OBSCURA": "Obscura", pixel_time.ROWS: "Slit Rows",
    pixel_time.COLUMNS: "Slit Columns", pixel_time.IMAGE: "Time Displ.", pixel_time.ROLLING_SHUTTER: "Rolling",
    pixel_time.SWEEP: "Sweep",
}  # fmt: skip
"""Names below the gallery's pictures, where the label is wider than a picture."""
_kept: list[tuple[str, str, str, int, int]] = []
"""The items: Blender does not keep their texts."""


class ChooseModel(OfCamera, bpy.types.Operator):
    """Use this camera model, or this time of the pixels"""

    bl_idname = "camera_ray_caster.choose_type"
    bl_label = "Choose Camera Model"
    bl_options = {"UNDO", "INTERNAL"}

    key: StringProperty(name="Model", description="Key of the model, or of the time", options={"SKIP_SAVE"})

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip, which is the model's."""
        return next((entry.text for entry in every_item() if entry.key == properties.key), cls.__doc__)

    def execute(self, context):
        if self.key not in [entry.key for entry in every_item()]:
            raise InputError(f"there is no camera model {self.key!r}")
        choose(camera_object_of(context).data, self.key)


class KeyModel(OfCamera, bpy.types.Operator):
    """Insert a keyframe of the camera model at the current frame. Shift: add a driver, to be edited in a Drivers
    Editor"""

    bl_label = "Key Camera Model"
    bl_options = {"UNDO", "INTERNAL"}

    driver: BoolProperty(name="Driver", description="Add a driver instead", options={"SKIP_SAVE"})

    def invoke(self, context, event):
        """Add a driver if Shift is pressed."""
        self.driver |= event.shift
        return self.execute(context)

    def execute(self, context):
        """Insert the keyframe, or add a driver that keeps the model until it is edited."""
        settings = getattr(camera_object_of(context).data, GROUP)
        if not self.driver:
            settings.keyframe_insert(MODEL.name)
            return
        number = settings.bl_rna.properties[MODEL.name].enum_items[settings.model].value
        curve = settings.driver_add(MODEL.name)
        curve.driver.expression = curve.driver.expression or str(number)
        self.report({"INFO"}, "The model has a driver: edit it in a Drivers Editor")


def choose(camera, key: str) -> None:
    """Set a camera's model; for one of Blender's own the type, and the type of panorama. Or set its times of pixels.
    A lecture begins again, with the formula.
    """
    settings = getattr(camera, GROUP)
    bpy.context.window_manager.camera_ray_caster_place.step = 0
    if key in [entry.key for entry in pixel_time.MODE.items]:
        setattr(settings, pixel_time.MODE.name, key)
    elif key in [entry.key for entry in MODEL.items]:
        settings.model = key
    else:
        settings.model = BLENDERS_OWN
        if key in camera.bl_rna.properties["type"].enum_items:
            camera.type = key
        else:
            camera.type, camera.panorama_type = "PANO", key


class ModelMenu(bpy.types.Menu):
    """Choose the camera model by its name"""

    bl_idname = "CAMERA_RAY_CASTER_MT_models"
    bl_label = "Camera Model"
    bl_options = {"SEARCH_ON_KEY_PRESS"}

    def draw(self, context):
        item = camera_object_of(context)
        chosen = () if objection(context, item) else (key_of(item.data), getattr(item.data, GROUP).time_mode)
        for column, entries in in_columns(self.layout, by_group()):
            for entry in entries:
                icon = "CHECKMARK" if entry.key in chosen else "BLANK1"
                column.operator(ChooseModel.bl_idname, text=entry.label, icon=icon).key = entry.key


def by_group() -> Iterator[tuple[str, list[Item]]]:
    """Yield each group with its models as items; the last group are the times of the pixels."""
    models = sorted(MODELS, key=lambda model: GROUPS.index(model.group))
    for group, members in groupby(models, lambda model: model.group):
        yield group, [Item(model.key, model.label, model.description, -1, group) for model in members]
    yield "Time of Pixels", list(pixel_time.MODE.items)


def every_item() -> list[Item]:
    """Return all models and times."""
    return [entry for _, entries in by_group() for entry in entries]


def pictured() -> list[Item]:
    """Return the models and times that the gallery shows."""
    return [entry for entry in every_item() if entry.key != pixel_time.NONE]


def scene_of(key: str) -> str:
    """Return the name of the gallery's scene of a model, or of a time of the pixels."""
    return TIMES[key] if key in TIMES else gallery.scene_name(key)


def _pictures(camera, context) -> list[tuple[str, str, str, int, int]]:
    _kept[:] = [
        (key, SHORT.get(key, label), f"{label}: {text}", gallery.icon(scene_of(key)), i)
        for i, (key, label, text, *_) in enumerate(pictured())
    ]
    return _kept


def _place(camera) -> int:
    return next((i for i, entry in enumerate(pictured()) if entry.key == key_of(camera)), -1)


def draw_model(layout, camera):
    """Draw the menu of a camera's models, with the gallery and a button that keys it next to it; return their row."""
    row = layout.row(align=True)
    row.context_pointer_set("camera", camera)
    row.menu(ModelMenu.bl_idname, text=label_of(key_of(camera)), icon="CAMERA_DATA")
    if gallery.folder() is not None:
        row.template_icon_view(camera, GALLERY, show_labels=True, scale=1, scale_popup=SCALE)
    row.operator(KeyModel.bl_idname, text="", icon="DECORATE_KEYFRAME")
    return row


CLASSES = (ChooseModel, KeyModel, ModelMenu)


def register(undo) -> None:
    gallery_property = EnumProperty(
        name="Gallery", description="Choose the camera model, or the time of the pixels, by an example picture",
        items=_pictures, get=_place, set=lambda camera, i: choose(camera, pictured()[i].key),
        options={"SKIP_SAVE"}, override={"LIBRARY_OVERRIDABLE"},
    )  # fmt: skip
    setattr(bpy.types.Camera, GALLERY, gallery_property)
    undo.callback(delattr, bpy.types.Camera, GALLERY)
