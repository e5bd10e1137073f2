"""A scene as a depsgraph has evaluated it: its camera, its shapes, and their motion."""

import pickle
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.camera.pixel_time import GRAY
from ...core.cameras import find_model
from ...core.records import BlenderCamera, InputError
from ...core.scene import Scene
from ..properties.declared import files
from ..properties.setting_labels import in_labels
from .camera_fields import camera_record
from .depsgraph_shapes import shapes_record

SHOWN_AT_ONCE = 4
"""Number of cameras that a window may show: the active one, its two eyes, and that of a pinned Properties editor."""

Eye = Callable[[BlenderCamera], BlenderCamera]
"""Function from the record of a camera object to the record of the eye that is read."""


def camera_at(camera_object, depsgraph, eye: Eye | None = None) -> tuple[BlenderCamera, Camera]:
    """Return the record of a camera object or of one of its eyes, and the camera, both at the depsgraph's frame.

    Raises InputError if there is no camera, and for a camera that cannot be cast.
    """
    raw = _record(camera_object, depsgraph, eye)
    return raw, camera_from(raw)


def _record(camera_object, depsgraph, eye: Eye | None) -> BlenderCamera:
    raw = camera_record(camera_object, depsgraph)
    return raw if eye is None else eye(raw)


def camera_or_reason(
    camera_object, depsgraph, eye: Eye | None = None
) -> tuple[BlenderCamera, Camera, str] | tuple[None, None, str]:
    """Return what ``camera_at`` does and "", or None twice and why the camera cannot be cast, in one line.

    This is for the window, whose redraws ask for the same camera several times: it is kept until its record, or a file
    that the record names, changes. One with an image of times is not: comparing images takes longer.
    """
    try:
        raw = _record(camera_object, depsgraph, eye)
        if raw.settings.get(GRAY.name) is not None:
            return raw, camera_from(raw), ""
        stamps = tuple(_stamp(raw.settings.get(file.name)) for file in files())
        return raw, _kept_camera(find_model(raw), pickle.dumps(raw), stamps), ""
    except InputError as error:
        return None, None, in_labels(str(error))


@lru_cache(maxsize=SHOWN_AT_ONCE)
def _kept_camera(model, pickled: bytes, stamps) -> Camera:
    """Return the camera of a pickled record: a real lens takes 65 ms, a table of 320 x 180 rays 40 ms."""
    return camera_from(pickle.loads(pickled))


forget_cameras = _kept_camera.cache_clear


def _stamp(path: str | None) -> tuple[int, ...] | None:
    """Return what tells a file from another one at its path, which may have its size and time of modification; None if
    there is none, or no path.
    """
    try:
        stat = Path(path).stat() if path else None
    except (OSError, ValueError):  # ``camera_from`` refuses it
        return None
    return stat and (stat.st_ino, stat.st_ctime_ns, stat.st_mtime_ns, stat.st_size)


Read = Callable[..., Scene]
"""Function from a camera object and a depsgraph to the scene at the depsgraph's frame: ``scene_at`` with its options.
"""


def scene_at(camera_object, depsgraph, eye: Eye | None = None, has_colors: bool = True) -> Scene:
    """Return camera and shapes at the depsgraph's frame, without motion; see ``shapes_record`` for ``has_colors``.
    Raises the errors of ``camera_at``.
    """
    _, camera = camera_at(camera_object, depsgraph, eye)
    return Scene(camera, shapes_record(depsgraph, has_colors))
