"""STMaps: images of where each pixel of a picture is found in another one, for compositors and st_warp.

undistort makes the picture of the target of the camera's, distort the camera's of the target's. Red and green are the
places in the other picture, 0 to 1 from edge to edge, to the right and up; blue is 1 where there is one, else 0 and
red and green are -1. The target is another camera, or the perspective of the same lens. Their eyes are taken to be in
one place: where they are not, a map is right for what is far away.
References: Nuke documentation, STMap; OpenImageIO documentation, st_warp.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..camera.build import camera_from
from ..camera.camera import Camera
from ..cameras.model import WindowModel
from ..cameras.perspective import Perspective
from ..maths.vector import inverse
from .format import OWN_TIMES, Format


class Stmap(Format):
    """Two maps a camera and frame."""

    key = "stmap"
    label = "STMaps"
    description = "<camera>_<frame>_undistort.exr and _distort.exr: maps between two lenses of one eye"
    takes_target = True

    def refusal(self, shot):
        """See Format."""
        for camera in (shot.camera, shot.target or shot.camera):
            of = "" if camera is shot.camera else f"whose target {camera.name!r} is one "
            if camera.pixel_time is not None:
                return of + OWN_TIMES
            if not camera.model.central:
                return f"{of}whose rays have no eye in common"
        return None

    def unsaid(self, shot):
        """See Format; and what the places of the two eyes mean."""
        one, other = shot.camera, shot.target or shot.camera
        apart = float(np.linalg.norm(one.pose.eye - other.pose.eye))
        line = f"{one.name!r} and {other.name!r} stand {apart:.3g} apart: the maps are right for what is far away"
        return [*super().unsaid(shot), *([line] if apart else [])]

    def files(self, shots):
        """See Format. Raises InputError where the perspective of the same lens has no meaning."""
        for shot in shots:
            target = shot.target or perspective_of(shot.camera)
            yield f"{shot.stem}_undistort.exr", places(target, shot.camera)
            yield f"{shot.stem}_distort.exr", places(shot.camera, target)


def perspective_of(camera: Camera) -> Camera:
    """Return the perspective camera of the same lens: with K of a calibrated one, without its distortion; of any other
    that of Blender's focal length, sensor and shift. Raises InputError where these have no meaning.
    """
    if camera.K is not None and isinstance(camera.model, WindowModel):
        return replace(camera, model=Perspective(camera.model.frame, camera.model.window))
    return replace(camera_from(replace(camera.record, type="PERSP", model="")), pixel_time=None)


def places(camera: Camera, other: Camera) -> np.ndarray:
    """Return for each pixel of a camera's full frame where another one sees the same, as the module's page has it:
    (rows, columns, 3) float32, row 0 at the bottom. A place is right to float32's rounding of it; one that float32
    cannot hold is none.
    """
    width, height = camera.raster.size
    rays = camera.rays_at(np.arange(width)[None, :] + 0.5, np.arange(height)[:, None] + 0.5)
    with np.errstate(all="ignore"):  # NaN is an answer
        there = other.model.project(rays.directions @ inverse(other.pose.basis).T) / other.raster.size
        found = (np.abs(there) <= np.finfo(np.float32).max).all(axis=-1)
    result = np.zeros((height, width, 3), np.float32)
    result[..., :2] = np.where(found[..., None], there, -1.0)
    result[..., 2] = found
    return result
