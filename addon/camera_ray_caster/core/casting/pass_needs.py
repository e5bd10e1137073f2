"""What passes need: memory, and the pictures of other frames."""

from collections.abc import Collection, Iterable

import numpy as np

from ..camera.camera import Camera
from ..records import InputError
from ..scene import Scene
from .passes import PASSES
from .seen_points import Picture

COLORED = {"combined", "albedo"}
"""The passes that show colors of materials."""

WITHOUT_PIXEL = "solid_angle", "footprint", "flow_forward", "flow_backward", "flow_hidden"
"""Passes that a ray alone does not have."""


def image_bytes(shape: tuple[int, int], passes: Iterable[str], dtype) -> int:
    """Return the number of bytes of the arrays of some passes."""
    sizes = (max(PASSES[name].channels, 1) * np.dtype(PASSES[name].dtype or dtype).itemsize for name in passes)
    return shape[0] * shape[1] * sum(sizes)


def check_passes(camera: Camera, passes: Collection[str]) -> None:
    """Raise InputError for passes that need neighboring pixels, if the camera's pixels are single beams."""
    absent = [name for name in passes if name in WITHOUT_PIXEL]
    if absent and not camera.model.differentiable:
        raise InputError(
            f"{camera.model.label} of camera {camera.name!r} has no {', '.join(absent)}: its pixels are single beams, "
            "not parts of a picture"
        )


def has_colors(passes: Collection[str]) -> bool:
    """Return whether any of some passes shows colors, for which images are read."""
    return not COLORED.isdisjoint(passes)


def frames_of(passes: Collection[str]) -> set[str]:
    """Return the other frames that passes look into, out of NEXT and PREVIOUS."""
    return {frame for name in passes for frame in PASSES[name].frames}


def pictures(scene: Scene, passes: Collection[str]) -> dict[str, Picture]:
    """Return the pictures of other frames that passes need, by name. Raises InputError for one that was not read."""
    of_frames = {}
    for frame in sorted(frames_of(passes)):
        looking = [name for name in passes if frame in PASSES[name].frames]
        there: Scene | None = getattr(scene, frame)
        if there is None:
            raise InputError(
                f"passes {', '.join(looking)} look into the {frame} frame, which was not read: read camera and shapes "
                "with read_scene(scene, passes=...), or without Blender give it: "
                f"crc.Scene(camera, shapes).with_timeline({frame}=...)"
            )
        of_frames[frame] = Picture(there.camera, there.shapes)
        if any(PASSES[name].casts for name in looking):
            of_frames[frame].prepare()
    return of_frames
