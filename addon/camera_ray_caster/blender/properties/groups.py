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
    """Add the settings of the models that were registered since; the groups must not be registered."""
    declared.renew()
    CameraProperties.__annotations__ = {setting.name: property_of(setting) for setting in declared.CAMERA}


def others_property(package: str) -> str:
    """Return "Scene.camera_ray_caster" or the like if another add-on than the package has such a property; else ""."""
    ours = [cls.bl_rna for cls in bpy.types.PropertyGroup.__subclasses__() if f"{cls.__module__}.".startswith(package)]
    for owner in OWNERS:
        existing = owner.bl_rna.properties.get(GROUP)
        if existing is not None and getattr(existing, "fixed_type", None) not in ours:
            return f"{owner.__name__}.{GROUP}"
    return ""


def register(undo) -> None:
    """Add the property groups to objects, cameras and scenes. Values stored in a file survive unregistering."""
    for owner, group in OWNERS.items():
        setattr(owner, GROUP, bpy.props.PointerProperty(type=group, override={"LIBRARY_OVERRIDABLE"}))
        undo.callback(_remove, owner, group)


def _remove(owner, group) -> None:
    """Remove a property, unless another add-on has put its own in its place."""
    existing = owner.bl_rna.properties.get(GROUP)
    if existing is not None and (not group.is_registered or getattr(existing, "fixed_type", None) == group.bl_rna):
        delattr(owner, GROUP)
