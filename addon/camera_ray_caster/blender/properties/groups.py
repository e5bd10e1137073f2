"""The property groups of objects, cameras and scenes, in which a .blend stores the add-on's settings."""

import bpy

from .declared import CAMERA, GROUP, OBJECT, SCENE
from .from_settings import property_of


class ObjectProperties(bpy.types.PropertyGroup):
    """``object.camera_ray_caster``"""

    __annotations__ = {setting.name: property_of(setting) for setting in OBJECT}


class CameraProperties(bpy.types.PropertyGroup):
    """``camera.camera_ray_caster``"""

    __annotations__ = {setting.name: property_of(setting) for setting in CAMERA}


class SceneProperties(bpy.types.PropertyGroup):
    """``scene.camera_ray_caster``"""

    __annotations__ = {setting.name: property_of(setting) for setting in SCENE}


CLASSES = (ObjectProperties, CameraProperties, SceneProperties)

OWNERS = {
    bpy.types.Object: ObjectProperties,
    bpy.types.Camera: CameraProperties,
    bpy.types.Scene: SceneProperties,
}


def register(undo) -> None:
    """Give every object, camera and scene its properties; what is stored in a file outlives them."""
    for owner, group in OWNERS.items():
        setattr(owner, GROUP, bpy.props.PointerProperty(type=group))
        undo.callback(delattr, owner, GROUP)
