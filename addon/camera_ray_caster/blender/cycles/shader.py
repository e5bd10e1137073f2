"""The shader of a custom camera: its text in the file, its compiled form, and the values of its inputs.

Blender keeps the inputs of a custom camera as ID properties of ``camera.cycles_custom``, which can be animated.
"""

import os
import sys
from pathlib import Path

import bpy
import numpy as np

from ...core.openexr.writing import exr
from ...core.records import InputError
from ...core.shaders.camera_shader import CameraShader
from ..read.camera_fields import shader_mark
from .animation import remove_keyframes

CUSTOM = "CUSTOM"


def is_enabled() -> bool:
    """Whether Cycles is enabled: only then do cameras have inputs."""
    return hasattr(bpy.types.Camera, "cycles_custom")


def check_enabled() -> None:
    """Raise InputError if Cycles is disabled."""
    if not is_enabled():
        raise InputError("Cycles is disabled: enable Cycles Render Engine in the Preferences, Add-ons")


def check_cycles(remedy: str = "use an official build") -> None:
    """Raise InputError if this Blender cannot compile shaders of cameras; the message says what to do instead."""
    check_enabled()
    import _cycles

    if not _cycles.with_osl:
        raise InputError(f"this Blender was built without the Open Shading Language: {remedy}")


def set_shader(camera, shader: CameraShader) -> None:
    """Make a camera a custom camera with this shader, and set its inputs to their values, without animation.

    Raises InputError if Cycles cannot compile the shader; type and shader of the camera are then unchanged. The text of
    a camera that already has a shader of ours is replaced without this check.
    """
    _write_textures(shader)
    _let_cycles_query()  # if Cycles is the engine, Blender also compiles as soon as the text changes
    if shader_mark(camera) is not None:
        remove_keyframes(camera)
        rewrite(camera, shader)
        return
    text, before = bpy.data.texts.new(f"{camera.name}.osl"), (camera.type, camera.custom_mode, camera.custom_shader)
    text.from_string(shader.source)
    camera.type, camera.custom_mode, camera.custom_shader = CUSTOM, "INTERNAL", text
    if not _compile(camera):
        camera.type, camera.custom_mode, camera.custom_shader = before
        bpy.data.texts.remove(text)
        raise InputError(
            f"Cycles cannot compile the shader of camera {camera.name!r}: see the messages in the terminal"
        )
    text.use_fake_user = False
    remove_keyframes(camera)
    set_inputs(camera, shader)


def clear_shader(camera) -> None:
    """Remove a camera's shader: its inputs with their animation, and its text if nothing else uses it."""
    text, camera.custom_shader = camera.custom_shader, None
    camera.custom_bytecode = camera.custom_bytecode_hash = ""
    remove_keyframes(camera)
    for name in list(camera.cycles_custom.keys()):
        del camera.cycles_custom[name]
    if not text.users:
        bpy.data.texts.remove(text)


def rewrite(camera, shader: CameraShader) -> None:
    """Replace the shader in a camera's text, and set its inputs. A text that other cameras share is copied first."""
    _write_textures(shader)
    _let_cycles_query()
    if any(other != camera and other.custom_shader == camera.custom_shader for other in bpy.data.cameras):
        camera.custom_shader = camera.custom_shader.copy()
    camera.custom_shader.from_string(shader.source)
    _compile(camera)
    set_inputs(camera, shader)


def set_inputs(camera, shader: CameraShader) -> None:
    """Set the inputs of a camera's shader to its values, if they differ."""
    if not has_inputs(camera, shader):
        for name, value in stored(shader).items():
            camera.cycles_custom[name] = value
        camera.update_tag()


def has_inputs(camera, shader: CameraShader) -> bool:
    """Whether the inputs of a camera, original or evaluated, have the values of a shader. Integers do not count."""
    inputs = camera.cycles_custom
    return all(isinstance(inputs.get(name), float) and inputs[name] == value for name, value in stored(shader).items())


def stored(shader: CameraShader) -> dict[str, float]:
    """Return the values of a shader's inputs as Blender stores them."""
    return {name: float(np.float32(value)) for name, value in shader.values.items()}


def texture_folder() -> str:
    """Return the folder of the textures that shaders read: that of the .blend, or this Blender's temporary one."""
    return Path(bpy.data.filepath or bpy.app.tempdir + "/_").parent.as_posix()


def _write_textures(shader: CameraShader) -> None:
    """Write the textures that a shader reads; the name of a file tells its content. Raises InputError."""
    for name, image in shader.textures.items():
        path = Path(name)
        if path.exists():
            continue
        try:
            unfinished = path.with_suffix(f".{os.getpid()}")
            unfinished.write_bytes(exr(image))
            unfinished.replace(path)
        except OSError as error:
            raise InputError(
                f"the rays for Cycles cannot be written to {name!r}: {error.strerror}; save the file in another folder"
            ) from error


def _compile(camera) -> bool:
    """Compile a camera's text with Cycles, whatever the render engine is; return whether it succeeded."""
    from cycles import osl

    return bool(osl.update_custom_camera_shader(camera, lambda kind, text: None))


def openimageio():
    """Return Blender's OpenImageIO. A Python that imports bpy does not search its folder, and may have another one.

    Raises InputError if this Blender has none, as builds by others than its makers, or if another was imported before.
    """
    before = list(sys.path)
    folders = list(Path(bpy.utils.system_resource("PYTHON")).glob("lib/python*/site-packages"))
    sys.path[:0] = map(str, folders)
    try:
        import OpenImageIO
    except ModuleNotFoundError as error:
        raise InputError("this build of Blender has no OpenImageIO: use a build from blender.org") from error
    finally:
        sys.path[:] = before
    taken = Path(OpenImageIO.__file__)
    if any((folder / "OpenImageIO").is_dir() and not taken.is_relative_to(folder) for folder in folders):
        raise InputError(
            f"Blender's own OpenImageIO is needed, but {taken} is already imported: import it after this call"
        )
    return OpenImageIO


def _let_cycles_query() -> None:
    """Import oslquery, with which Cycles reads a shader's inputs, and its OpenImageIO: see ``openimageio``."""
    before = list(sys.path)
    sys.path[:0] = [str(Path(openimageio().__file__).parents[1])]
    try:
        import oslquery  # noqa: F401
    finally:
        sys.path[:] = before
