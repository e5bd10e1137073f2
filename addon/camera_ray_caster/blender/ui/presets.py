"""Blender presets of the camera model: those of the extension and the user's own."""

from pathlib import Path

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from ...core.cameras.parts.settings import CAMERA, OWN
from ..properties.declared import BLENDERS_OWN, GROUP, MODEL
from .model_drawing import PRESETS
from .model_settings import settings_of

FOLDER = Path(__file__).resolve().parents[1]
"""Parent folder of ``presets``."""
OWNERS = {OWN: "own", CAMERA: "camera"}
"""Variable names in a preset, by owner of the settings that it stores."""
KEPT = {"FLOAT", "INT", "BOOLEAN", "ENUM", "VECTOR", "TEXT", "FILE"}
"""Kinds of settings that a preset stores; objects and images belong to a .blend file."""


class ModelPresets(PresetPanel, bpy.types.Panel):
    """The list of presets."""

    bl_idname = PRESETS
    bl_label = "Camera Model Presets"
    preset_subdir = GROUP
    preset_operator = "script.execute_preset"
    preset_add_operator = "camera_ray_caster.preset_add"


class AddModelPreset(AddPresetBase, bpy.types.Operator):
    """Add or remove a preset of the camera model and its settings"""

    bl_idname = "camera_ray_caster.preset_add"
    bl_label = "Add Camera Model Preset"
    preset_menu = ModelPresets.bl_idname
    preset_subdir = GROUP
    preset_defines = ("camera = bpy.context.camera", f"own = camera.{GROUP}")

    @classmethod
    def poll(cls, context):
        """Gray out the operator outside a camera's tab."""
        cls.poll_message_set("Open the camera's tab in the Properties editor first")
        return getattr(context, "camera", None) is not None

    @property
    def preset_values(self) -> list[str]:
        """The values to store: the model, Blender's camera type for its own models, and the settings of the model."""
        camera = bpy.context.camera
        types = ["camera.type", "camera.panorama_type"] if getattr(camera, GROUP).model == BLENDERS_OWN else []
        kept = [it for it in settings_of(camera) if it.owner in OWNERS and it.kind in KEPT]
        return [f"own.{MODEL.name}", *types, *(f"{OWNERS[it.owner]}.{it.name}" for it in kept)]


CLASSES = (ModelPresets, AddModelPreset)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    bpy.utils.register_preset_path(str(FOLDER))
    undo.callback(bpy.utils.unregister_preset_path, str(FOLDER))
