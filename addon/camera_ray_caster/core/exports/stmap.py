"""STMaps: images that hold the place of each pixel in another picture, for compositors and st_warp.

undistort turns the camera's picture into the target's, distort the target's into the camera's. Red and green are the
place in the other picture, from 0 to 1 between its edges, to the right and up; blue is 1. Pixels without a place have
red and green -1 and blue 0. The target is another camera, or the perspective of the same lens. Both eyes are assumed to
be at the same place: if they are not, a map is correct for distant objects only.
References: Nuke documentation, STMap; OpenImageIO documentation, st_warp.
"""

from dataclasses import replace

import numpy as np

from ..camera.build import camera_from
from ..camera.camera import Camera
from ..cameras.model import WindowModel
from ..cameras.perspective import Perspective
from ..maths.vector import inverse
from .format import OWN_TIMES, Format

TURNED = 7
"""Decimals of a turn beside the target: what float32 matrices move is less than a map's own rounding."""


class Stmap(Format):
    """Two maps per camera and frame; for a camera whose maps do not change two maps."""

    key = "stmap"
    label = "STMaps"
    description = "<camera>_<frame>_undistort.exr and _distort.exr: maps between two lenses; once if all are equal"
    takes_target = True

    def refusal(self, shot):
        for camera in (shot.camera, shot.target or shot.camera):
            of = "" if camera is shot.camera else f"whose target {camera.name!r} is one "
            if camera.pixel_time is not None:
                return of + OWN_TIMES
            if not camera.model.central:
                return f"{of}whose rays have no eye in common"
        return None

    formula = False

    def omissions(self, shot):
        """See Format. A line on the distance between the two eyes is added if they are apart."""
        camera, target = shot.camera, shot.target or shot.camera
        apart = float(np.linalg.norm(camera.pose.eye - target.pose.eye))
        line = f"{camera.name!r} and {target.name!r} are {apart:.3g} apart: the maps are exact for distant objects only"
        return [*super().omissions(shot), *([line] if apart else [])]

    def files(self, shots):
        """See Format. Raises InputError if the perspective of the same lens is undefined."""
        for name in dict.fromkeys(shot.name for shot in shots):
            of_camera = [shot for shot in shots if shot.name == name]
            pairs = [(shot, shot.target or perspective_of(shot.camera)) for shot in of_camera]
            still = len(of_camera) > 1 and len({_maps(shot.camera, target) for shot, target in pairs}) == 1
            for shot, target in pairs[:1] if still else pairs:
                stem = shot.name if still else shot.stem
                yield f"{stem}_undistort.exr", places(target, shot.camera)
                yield f"{stem}_distort.exr", places(shot.camera, target)


def _maps(camera: Camera, target: Camera) -> str:
    """Return what the maps between two cameras depend on."""
    turn = inverse(target.pose.basis) @ camera.pose.basis
    return repr((camera.model, camera.raster, target.model, target.raster, turn.round(TURNED).tolist()))


def perspective_of(camera: Camera) -> Camera:
    """Return the perspective camera of the same lens.

    For a calibrated camera it has the same K without distortion, for any other Blender's focal length, sensor and
    shift. Raises InputError if these are invalid.
    """
    if camera.K is not None and isinstance(camera.model, WindowModel):
        return replace(camera, model=Perspective(camera.model.size, camera.model.window))
    return replace(camera_from(replace(camera.record, type="PERSP", model="")), pixel_time=None)


def places(camera: Camera, other: Camera) -> np.ndarray:
    """Return the map from the pixels of a camera's picture to their places in another camera's picture.

    The map is (rows, columns, 3) float32, row 0 at the bottom; the module's docstring describes the channels. A place
    is exact to its rounding to float32. A place that float32 cannot hold counts as missing.
    """
    x0, x1, y0, y1 = camera.raster.picture
    left, _, bottom, _ = other.raster.picture
    rays = camera.rays_at(np.arange(x0, x1)[None, :] + 0.5, np.arange(y0, y1)[:, None] + 0.5)
    with np.errstate(all="ignore"):  # NaN means: no place
        there = other.model.project(rays.directions @ inverse(other.pose.basis).T)
        there = (there - (left, bottom)) / other.raster.picture_size
        is_seen = (np.abs(there) <= np.finfo(np.float32).max).all(axis=-1)
    result = np.zeros((y1 - y0, x1 - x0, 3), np.float32)
    result[..., :2] = np.where(is_seen[..., None], there, -1.0)
    result[..., 2] = is_seen
    return result
