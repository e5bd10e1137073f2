"""The device that Cycles renders on, and whether it can run shaders of cameras.

Shaders of cameras run on the CPU and, through OptiX, on NVIDIA's graphics cards.
Reference: Blender manual, Cycles, Open Shading Language.
"""

import bpy

CPU = "CPU"
WITH_OSL = CPU, "OPTIX"


def device_of(scene) -> str:
    """Return the kind of device that Cycles renders a scene on: CPU, or a kind from the Preferences, such as OPTIX."""
    chosen = bpy.context.preferences.addons["cycles"].preferences.compute_device_type
    return CPU if scene.cycles.device == CPU or chosen == "NONE" else chosen


def said_of_device(scene) -> list[str]:
    """Return a line on what the scene's device does with a custom camera; none if the camera works there."""
    device = device_of(scene)
    if device in WITH_OSL:
        return []
    return [
        f"Cycles renders on {device}, which does not support camera shaders, so the picture will be black: set Device "
        "to CPU (Render properties), or choose OptiX (Preferences, System)"
    ]
