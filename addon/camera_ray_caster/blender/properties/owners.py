"""The Blender struct that owns a declared camera setting."""

from ...core.cameras.parts.settings import CAMERA, CYCLES, FOCUS, FROM_A_FILE, OWN, RENDER, STEREO, Setting
from .declared import GROUP


def owner_of(setting: Setting, camera, scene):
    """Return the struct with a setting's property; None for a setting of Cycles while Cycles is disabled, and for one
    that only files have.

    ``camera`` is the camera's data. The add-on's own settings must be registered.
    """
    return OWNERS[setting.owner](camera, scene)


OWNERS = {
    OWN: lambda camera, scene: getattr(camera, GROUP),
    CAMERA: lambda camera, scene: camera,
    FOCUS: lambda camera, scene: camera.dof,
    STEREO: lambda camera, scene: camera.stereo,
    RENDER: lambda camera, scene: scene.render,
    CYCLES: lambda camera, scene: scene.cycles if "cycles" in scene.bl_rna.properties else None,
    FROM_A_FILE: lambda camera, scene: None,
}
