"""The shader of a custom camera: its text in the file, its compiled form and the values of its inputs.

Blender keeps the inputs of a custom camera as ID properties of ``camera.cycles_custom``, which can be animated.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

from ...core.records import InputError
from ...core.shaders.camera_shader import CameraShader
from ..read.camera import shader_mark
from .animation import remove_keyframes

CUSTOM = "CUSTOM"


def is_enabled() -> bool:
    """Whether Cycles is: cameras have inputs then."""
    return hasattr(bpy.types.Camera, "cycles_custom")


def check_enabled() -> None:
    """Raise InputError where Cycles is disabled."""
    if not is_enabled():
        raise InputError("Cycles is disabled: enable Cycles Render Engine in the Preferences, Add-ons")


def check_cycles() -> None:
    """Raise InputError where this Blender cannot compile shaders of cameras."""
    check_enabled()
    import _cycles

    if not _cycles.with_osl:
        raise InputError("this Blender was built without the Open Shading Language: take an official build")


def set_shader(camera, shader: CameraShader) -> None:
    """Make a camera a custom one with this shader, and give its inputs their values, without animation.

    Raises InputError where Cycles does not compile it; the camera is as it was then.
    """
    _let_cycles_query()  # Blender compiles, too, as soon as a camera has another text, where Cycles is the engine
    remove_keyframes(camera)
    if shader_mark(camera) is not None:
        rewrite(camera, shader)
        return
    text, before = bpy.data.texts.new(f"{camera.name}.osl"), (camera.type, camera.custom_mode, camera.custom_shader)
    text.from_string(shader.source)
    camera.type, camera.custom_mode, camera.custom_shader = CUSTOM, "INTERNAL", text
    if not _compile(camera):
        camera.type, camera.custom_mode, camera.custom_shader = before
        bpy.data.texts.remove(text)
        raise InputError(f"Cycles cannot compile the shader of camera {camera.name!r}: the terminal says why")
    text.use_fake_user = False
    set_inputs(camera, shader)


def clear_shader(camera) -> None:
    """Take a camera's shader away: its inputs with their animation, and its text where nothing else uses it."""
    text, camera.custom_shader = camera.custom_shader, None
    camera.custom_bytecode = camera.custom_bytecode_hash = ""
    remove_keyframes(camera)
    for name in list(camera.cycles_custom.keys()):
        del camera.cycles_custom[name]
    if not text.users:
        bpy.data.texts.remove(text)


def rewrite(camera, shader: CameraShader) -> None:
    """Give a camera's text another shader, and its inputs their values. A text of several cameras is copied first."""
    _let_cycles_query()
    if any(other != camera and other.custom_shader == camera.custom_shader for other in bpy.data.cameras):
        camera.custom_shader = camera.custom_shader.copy()
    camera.custom_shader.from_string(shader.source)
    _compile(camera)
    set_inputs(camera, shader)


def set_inputs(camera, shader: CameraShader) -> None:
    """Give the inputs of a camera's shader their values, where they have others."""
    if not has_inputs(camera, shader):
        for name, value in stored(shader).items():
            camera.cycles_custom[name] = value
        camera.update_tag()


def has_inputs(camera, shader: CameraShader) -> bool:
    """Whether the inputs of a camera, or of an evaluated one, have the values of a shader. Integers do not count."""
    inputs = camera.cycles_custom
    return all(isinstance(inputs.get(name), float) and inputs[name] == value for name, value in stored(shader).items())


def stored(shader: CameraShader) -> dict[str, float]:
    """Return the values of a shader's inputs as Blender stores them."""
    return {name: float(np.float32(value)) for name, value in shader.values.items()}


def _compile(camera) -> bool:
    """Compile a camera's text with Cycles, under any engine; return whether it worked."""
    from cycles import osl

    return bool(osl.update_custom_camera_shader(camera, lambda kind, text: None))


def _let_cycles_query() -> None:
    """Import the module with which Cycles reads a shader's inputs, and the OpenImageIO that it was built with, from
    where Blender keeps them: a Python that imports bpy does not know that place, and may have another OpenImageIO.

    Raises InputError where that one was imported before.
    """
    before = list(sys.path)
    folders = list(Path(bpy.utils.system_resource("PYTHON")).glob("lib/python*/site-packages"))
    sys.path[:0] = map(str, folders)
    try:
        import OpenImageIO
        import oslquery  # noqa: F401
    finally:
        sys.path[:] = before
    taken = Path(OpenImageIO.__file__)
    if any((folder / "OpenImageIO").is_dir() and not taken.is_relative_to(folder) for folder in folders):
        raise InputError(f"Cycles needs Blender's OpenImageIO, and this Python has imported {taken}: import that later")
