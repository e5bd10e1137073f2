"""The property groups of objects, cameras and scenes that store the add-on's settings in a .blend."""

import bpy

from . import declared
from .declared import CAMERA, GROUP, OBJECT, SCENE
from .from_settings import property_of


class ObjectProperties(bpy.types.PropertyGroup):
    """The type of ``object.camera_ray_caster``."""

    __annotations__ = {setting.name: property_of(setting) for setting in OBJECT}


class CameraProperties(bpy.types.PropertyGroup):
    """The type of ``camera.camera_ray_caster``."""

    __annotations__ = {setting.name: property_of(setting) for setting in CAMERA}


class SceneProperties(bpy.types.PropertyGroup):
    """The type of ``scene.camera_ray_caster``."""

    __annotations__ = {setting.name: property_of(setting) for setting in SCENE}


CLASSES = (ObjectProperties, CameraProperties, SceneProperties)

OWNERS = {
    bpy.types.Object: ObjectProperties,
    bpy.types.Camera: CameraProperties,
    bpy.types.Scene: SceneProperties,
}


def renew() -> None:
    """Take up the settings of the models that were added since; the groups must not be registered."""
    declared.renew()
    CameraProperties.__annotations__ = {setting.name: property_of(setting) for setting in declared.CAMERA}


def register(undo) -> None:
    """Add the property groups to objects, cameras and scenes. Values stored in a file survive unregistering."""
    for owner, group in OWNERS.items():
        setattr(owner, GROUP, bpy.props.PointerProperty(type=group, override={"LIBRARY_OVERRIDABLE"}))
        undo.callback(delattr, owner, GROUP)
