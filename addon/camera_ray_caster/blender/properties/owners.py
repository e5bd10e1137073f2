"""Which of Blender's structs has a declared setting of a camera."""

from ...core.cameras.parts.settings import CAMERA, CYCLES, OWN, RENDER, STEREO, Setting
from .declared import GROUP


def owner_of(setting: Setting, camera, scene):
    """Return the struct that has a setting as a property of its name; None for one of Cycles while that is disabled.

    ``camera``: its data. The add-on's own settings need to be registered.
    """
    return OWNERS[setting.owner](camera, scene)


OWNERS = {
    OWN: lambda camera, scene: getattr(camera, GROUP),
    CAMERA: lambda camera, scene: camera,
    STEREO: lambda camera, scene: camera.stereo,
    RENDER: lambda camera, scene: scene.render,
    CYCLES: lambda camera, scene: scene.cycles if "cycles" in scene.bl_rna.properties else None,
}
