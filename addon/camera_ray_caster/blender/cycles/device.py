"""The device that Cycles renders on, and what it makes of a camera that is a shader.

Shaders of cameras run on the CPU and, through OptiX, on NVIDIA's graphics cards.
Reference: Blender manual, Cycles, Open Shading Language.
"""

import bpy

CPU = "CPU"
WITH_OSL = CPU, "OPTIX"


def device_of(scene) -> str:
    """Return the kind of device that Cycles renders a scene on: CPU, or one of the Preferences such as OPTIX, CUDA."""
    chosen = bpy.context.preferences.addons["cycles"].preferences.compute_device_type
    return CPU if scene.cycles.device == CPU or chosen == "NONE" else chosen


def said_of_device(scene) -> list[str]:
    """Return what will become of a custom camera on the scene's device, in a line; nothing where it works."""
    device = device_of(scene)
    if device in WITH_OSL:
        return []
    return [
        f"Cycles renders on {device}, where shaders of cameras do not run, so the picture will be black: set Device to "
        "CPU (Render properties), or choose OptiX (Preferences, System)"
    ]
