"""Cameras, by frame, as other programs' files; see ``core.exports``. They appear whole or not at all."""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

import bpy
import numpy as np

from ...core.exports import export, find_format
from ...core.exports.format import Content, Shot
from ...core.names import file_name, file_names
from ...core.records import InputError
from ..read.scene import evaluated, go_to, read_camera
from ..terminal import signals
from ..terminal.opening import reported
from .file_set import appearing


def write(scene, key: str, cameras: Sequence, frames: Iterable[float], folder: Path, target=None):
    """Export camera objects of a scene at frames, in the format of this key, into ``folder``; return what is to be said
    of it, in lines, and the files' paths.

    Of a scene with Stereo 3D each camera has the eyes that are rendered, with the suffixes of their views. ``target``:
    the camera object to which maps lead. The scene is as it was afterwards. Raises InputError for what cannot be read
    or represented, and for a folder that cannot be written, Cancelled where it is stopped: nothing is left behind then.
    """
    if target is not None and not find_format(key).takes_target:
        raise InputError(f"a camera to lead to is for maps: format {key} has none")
    files, said = export(key, shots(scene, cameras, frames, target))
    with appearing(folder) as temporary:
        for name, content in files:
            signals.raise_if_stopping()
            _write(temporary / name, content)
        names = sorted(os.listdir(temporary))
    return said, [folder / name for name in names]


def shots(scene, cameras: Sequence, frames: Iterable[float], target=None) -> list[Shot]:
    """Return the cameras, or their eyes, at frames, frame by frame; see ``write``."""
    eyes = [(camera, suffix, view) for camera in cameras for suffix, view in _eyes(scene)]
    file_names(f"{camera.name}{suffix}" for camera, suffix, _ in eyes)  # no two are alike
    found = []
    with evaluated(scene):
        for frame in frames:
            signals.raise_if_stopping()
            go_to(scene, frame)
            to = read_camera(scene, target) if target is not None else None
            for camera, suffix, view in eyes:
                read, meters = read_camera(scene, camera, view=view), scene.unit_settings.scale_length
                suffix = file_name(suffix) if suffix else ""
                found.append(Shot(file_name(camera.name), frame, read, meters, to, suffix))
    return found


def _eyes(scene) -> list[tuple[str, str]]:
    """Return suffix and name of each view that is rendered of a camera."""
    render = scene.render
    if not render.use_multiview or render.views_format != "STEREO_3D":
        return [("", "")]
    return [(view.file_suffix, view.name) for view in render.stereo_views if view.use] or [("", "")]


def _write(path: Path, content: Content) -> None:
    if isinstance(content, np.ndarray):
        _write_image(path, content)
    elif isinstance(content, bytes):
        path.write_bytes(content)
    else:
        path.write_text(content, encoding="utf-8", newline="\n")


def _write_image(path: Path, pixels: np.ndarray) -> None:
    """Let Blender write pixels (rows, columns, 3) float32 to an EXR as they are."""
    height, width, _ = pixels.shape
    image = bpy.data.images.new(path.stem, width, height, alpha=False, float_buffer=True)
    try:
        image.colorspace_settings.name = "Non-Color"
        image.pixels.foreach_set(np.dstack((pixels, np.ones((height, width), np.float32))).ravel())
        image.file_format = "OPEN_EXR"
        image.save(filepath=str(path))
    except RuntimeError as error:
        raise OSError(0, reported(error)) from error
    finally:
        bpy.data.images.remove(image)
