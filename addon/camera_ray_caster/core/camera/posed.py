"""A camera moved to another pose: lens, raster and pixel times are kept, what depends on the pose is made anew."""

from __future__ import annotations

from dataclasses import replace

from ..cameras import find_model
from ..cameras.parts.pose import pose_from, pose_matrix
from ..records import InputError
from .spherical_stereo import with_eye


def posed(camera, matrix):
    """Return a ``Camera`` with another pose. Raises InputError for an invalid matrix, and for a camera that
    moves while it is exposed.
    """
    check_still(camera, "pose")
    raw = replace(camera.record, matrix_world=pose_matrix(matrix))
    pose = pose_from(raw)
    model = with_eye(find_model(raw).from_blender(raw, camera.raster), raw, pose)
    others = {"motion": None, "next": None, "previous": None}
    return replace(camera, model=model, pose=pose, record=raw, aperture=model.aperture(raw, pose), **others)


def check_still(camera, remedy: str) -> None:
    """Raise InputError for a camera that moves while it is exposed."""
    if camera.motion is not None:
        raise InputError(f"camera {camera.name!r} moves from pixel to pixel: give camera.at(frame) another {remedy}")
