"""The device that Cycles renders on, and whether it can run shaders of cameras.

Shaders of cameras run on the CPU and, through OptiX, on NVIDIA's graphics cards.
Reference: Blender manual, Cycles, Open Shading Language.
"""

import bpy

from ...core.records import InputError

CPU = "CPU"
WITH_OSL = CPU, "OPTIX"


def device_of(scene) -> str:
    """Return the kind of device that Cycles renders a scene on: CPU, or a kind from the Preferences, such as OPTIX."""
    chosen = bpy.context.preferences.addons["cycles"].preferences.compute_device_type
    return CPU if scene.cycles.device == CPU or chosen == "NONE" else chosen


def devices() -> dict[str, list]:
    """Return Cycles' devices on this machine by kind, the processor first; kinds without devices are left out."""
    preferences = bpy.context.preferences.addons["cycles"].preferences
    by_kind: dict[str, list] = {CPU: []}
    for kind, *_ in preferences.get_device_types(bpy.context):
        of_kind = [device for device in preferences.get_devices_for_type(kind) or () if device.type == kind]
        if kind != "NONE" and of_kind:
            by_kind[kind] = of_kind
    return by_kind


def use_device(scene, kind: str) -> None:
    """Let Cycles render a scene on all devices of a kind in this process. Raises InputError if there is none."""
    there = devices()
    if kind not in there:
        raise InputError(f"Cycles has no device {kind} on this machine: choose one of {', '.join(there)}")
    scene.cycles.device = CPU if kind == CPU else "GPU"
    if kind != CPU:
        bpy.context.preferences.addons["cycles"].preferences.compute_device_type = kind
        for device in there[kind]:
            device.use = True


def device_notes(scene, otherwise: str = "use Fit Blender's Lens") -> list[str]:
    """Return a line on what the scene's device does with a custom camera, and what to do or ``otherwise``; none if the
    camera works there.
    """
    device = device_of(scene)
    if device in WITH_OSL:
        return []
    return [
        f"Cycles renders on {device}, which does not support camera shaders, so the picture will be black: set Device "
        f"to CPU (Render properties), choose OptiX (Preferences, System), or {otherwise}"
    ]
