"""Export of cameras, by frame, to files of other programs; see ``core.exports``. All files appear, or none."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...core.exports import export_files, file_writer, find_format
from ...core.exports.format import Shot
from ...core.names import file_name, file_names
from ...core.records import InputError
from ..process import signals
from ..read.camera_fields import eye_object, views_of
from ..read.frames import frame_rate, go_to
from ..read.lengths import meters_of
from ..read.scene_reader import evaluated, read_camera
from ..read.size import own_size, sized
from ..read.unique import unique_name
from .saving import blender_writes

Shown = Callable[[Any, float], bool]
"""Whether a camera is wanted in a frame."""
Say = Callable[[str], object]
"""What is called with a line about what is being done."""


def write(
    scene, key: str, cameras: Sequence, frames: Iterable[float], folder: Path, target=None, own_sizes: bool = True,
    fit: float | None = None, shown: Shown = lambda *_: True, say: Say | None = None,
) -> tuple[list[str], list[Path]]:  # fmt: skip
    """Export camera objects of a scene at some frames, in the format ``key``, into ``folder``; return lines of messages
    and the paths of the files.

    In a stereo scene each rendered view of a camera is exported, with its suffix. ``target`` is the camera object to
    which maps lead; ``fit``: see ``core.exports.export_files``; ``shown``: whether a camera is exported at a frame;
    ``say`` is called with the frames that are read and the names of the files. The scene is restored afterwards. Raises
    InputError if a camera cannot be read or represented or the folder cannot be written, and Cancelled if stopped; then
    no files are left behind.
    """
    if target is not None and not find_format(key).takes_target:
        raise InputError(f"format {key} has no target camera: only maps have a target")
    files, remarks = export_files(key, shots(scene, cameras, frames, target, own_sizes, shown, say), fit)
    return remarks, file_writer.write(_until_stopped(files, say), folder, _write_image)


def _until_stopped(files: Iterable, say: Say | None) -> Iterator:
    """Yield files, and say their names; raise Cancelled if a request to stop has arrived."""
    for file in files:
        signals.raise_if_stopping()
        if say is not None:
            say(file[0])
        yield file


def shots(
    scene, cameras: Sequence, frames: Iterable[float], target=None, own_sizes: bool = True,
    shown: Shown = lambda *_: True, say: Say | None = None,
) -> list[Shot]:  # fmt: skip
    """Return the cameras, or their eyes, at each frame, in the order of the frames; see ``write``.

    own_sizes: whether a camera with a size of its own has it, in place of the scene's; see ``read.size``.
    """
    views = [(view.file_suffix, view.name) for view in views_of(scene)] or [("", "")]
    names = [unique_name(camera, bpy.data.objects) for camera in cameras]
    file_names(f"{name}{suffix}" for name in names for suffix, _ in views)  # raises if two names are equal
    shots, rate = [], frame_rate(scene)
    sizes = [own_size(camera) if own_sizes else None for camera in cameras]
    frames, of_sizes = list(frames), dict.fromkeys(sizes)
    count, done = len(frames) * len(of_sizes), 0
    for size in of_sizes:
        cameras_of_size = zip(zip(cameras, names, strict=True), sizes, strict=True)
        ours = [named for named, camera_size in cameras_of_size if camera_size == size]
        with sized(scene, size), evaluated(scene):
            for frame in frames:
                signals.raise_if_stopping()
                done += 1
                if say is not None:
                    say(f"Frame {frame:g}, {done} of {count}")
                go_to(scene, frame)
                to = read_camera(scene, target) if target is not None else None
                for camera, name in ours:
                    for suffix, view in views if shown(camera, frame) else ():
                        read = read_camera(scene, eye_object(scene, view, camera), view=view)
                        camera_file, end = file_name(name), file_name(suffix) if suffix else ""
                        shots.append(Shot(camera_file, frame, read, meters_of(scene), to, end, rate))
    if len(of_sizes) > 1:
        order = {file_name(name): number for number, name in enumerate(names)}
        shots.sort(key=lambda shot: (frames.index(shot.frame), order[shot.camera_name]))
    return shots


def _write_image(path: Path, pixels: np.ndarray) -> None:
    """Let Blender write pixels, (rows, columns, 3) float32, to an EXR file without color conversion."""
    height, width, _ = pixels.shape
    image = bpy.data.images.new(path.stem, width, height, alpha=False, float_buffer=True)
    try:
        image.colorspace_settings.name = "Non-Color"
        image.pixels.foreach_set(np.dstack((pixels, np.ones((height, width), np.float32))).ravel())
        image.file_format = "OPEN_EXR"
        with blender_writes(path.parent):
            image.save(filepath=str(path))
    finally:
        bpy.data.images.remove(image)
