"""Blender presets of the camera model: those of the extension and the user's own."""

from pathlib import Path

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
from bpy.props import BoolProperty, StringProperty

from ...core.cameras.parts.settings import CAMERA, OWN
from ...core.records import InputError
from ..process.opening import reported
from ..properties.declared import BLENDERS_OWN, GROUP, MODEL
from .frame import SET_FRAME, framed
from .model_drawing import PRESETS
from .model_settings import port_settings, settings_of
from .needs import OfCamera, camera_object_of

TICK = f"{GROUP}_set_frame"
"""Name of the property of the window manager that the menu of presets shows as a tick box."""
FOLDER = Path(__file__).resolve().parents[1]
"""Parent folder of ``presets``."""
OWNERS = {OWN: "settings", CAMERA: "camera"}
"""Variable names in a preset, by owner of the settings that it stores."""
KINDS_IN_PRESETS = {"FLOAT", "INT", "BOOLEAN", "ENUM", "VECTOR", "TEXT", "FILE"}
"""Kinds of settings that a preset stores; objects and images belong to a .blend file."""


class ExecutePreset(OfCamera, bpy.types.Operator):
    """Use this preset of a camera model, and set the frame that it asks for"""

    bl_idname = "camera_ray_caster.preset_execute"
    bl_label = "Use Camera Model Preset"

    filepath: StringProperty(name="File", description="Path of the preset", subtype="FILE_PATH", options={"SKIP_SAVE"})
    menu_idname: StringProperty(name="Menu", description="Identifier of the menu of presets", options={"SKIP_SAVE"})
    set_frame: BoolProperty(name=SET_FRAME.label, description=SET_FRAME.text, default=True, options={"SKIP_SAVE"})

    def execute(self, context):
        item, window = camera_object_of(context), context.window_manager
        is_set = self.set_frame if self.properties.is_property_set("set_frame") else getattr(window, TICK)
        with framed(context, item, is_set) as remarks, context.temp_override(camera=item.data):
            try:
                done = bpy.ops.script.execute_preset(filepath=self.filepath, menu_idname=ModelPresets.bl_idname)
            except RuntimeError as error:
                raise InputError(f"preset {self.filepath!r} cannot be used: {reported(error)}") from error
        for line in remarks:
            self.report({"INFO"}, line)
        return done


class ModelPresets(PresetPanel, bpy.types.Panel):
    """The list of presets."""

    bl_idname = PRESETS
    bl_label = "Camera Model Presets"
    preset_subdir = GROUP
    preset_operator = ExecutePreset.bl_idname
    preset_add_operator = "camera_ray_caster.preset_add"

    def draw(self, context):
        self.layout.prop(context.window_manager, TICK)
        super().draw(context)


class AddModelPreset(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of the camera model and its settings"""

    bl_idname = "camera_ray_caster.preset_add"
    bl_label = "Add Camera Model Preset"
    preset_menu = ModelPresets.bl_idname
    preset_subdir = GROUP
    preset_defines = ("camera = bpy.context.camera", f"settings = camera.{GROUP}")

    @classmethod
    def poll(cls, context):
        cls.poll_message_set("Open the camera's tab in the Properties editor first")
        return getattr(context, "camera", None) is not None

    @property
    def preset_values(self) -> list[str]:
        """The values to store: the model, Blender's camera type for its own models, and the settings of the model."""
        camera = bpy.context.camera
        types = ["camera.type", "camera.panorama_type"] if getattr(camera, GROUP).model == BLENDERS_OWN else []
        settings = [setting for setting in (*settings_of(camera), *port_settings(camera)) if setting.owner in OWNERS]
        kept = (setting for setting in settings if setting.kind in KINDS_IN_PRESETS)
        stored = (f"{OWNERS[setting.owner]}.{setting.name}" for setting in kept)
        return [f"settings.{MODEL.name}", *types, *stored]


CLASSES = (ExecutePreset, ModelPresets, AddModelPreset)


def register(undo) -> None:
    tick = BoolProperty(name=SET_FRAME.label, description=SET_FRAME.text, default=True, options={"SKIP_SAVE"})
    setattr(bpy.types.WindowManager, TICK, tick)
    undo.callback(delattr, bpy.types.WindowManager, TICK)
    bpy.utils.register_preset_path(str(FOLDER))
    undo.callback(bpy.utils.unregister_preset_path, str(FOLDER))
