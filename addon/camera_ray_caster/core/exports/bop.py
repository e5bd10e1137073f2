"""BOP's scene_camera.json: K and the pose of each image, by the image's number, which is its frame.

The translation is in millimeters; depth_scale converts depths from Blender units to millimeters. The center of the
first pixel is (0, 0). Each of several cameras has its own file, as in data sets with several sensors.
Reference: BOP toolkit documentation, BOP dataset format.
"""

from __future__ import annotations

from ..programs.parts.lens import matrix_of
from ..units import MILLIMETERS, factor
from . import lenses
from .format import Shot
from .plain import as_text

TABLE = {"pinhole": ("OPENCV_PINHOLE", ())}


class Bop(lenses.LensFormat):
    """One file per camera."""

    key = "bop"
    label = "BOP"
    description = "scene_camera.json: pinholes and poses in millimeters; of several cameras scene_camera_<camera>.json"
    table = TABLE
    unit = MILLIMETERS

    def refusal(self, shot):
        """See Format."""
        if shot.frame != int(shot.frame):
            return "whose frame is not a whole number"
        return super().refusal(shot)

    def files(self, shots):
        """See Format."""
        names = list(dict.fromkeys(shot.name for shot in shots))
        for name in names:
            images = {str(int(shot.frame)): _image(shot) for shot in shots if shot.name == name}
            yield f"scene_camera{'' if len(names) == 1 else f'_{name}'}.json", as_text(images)


def _image(shot: Shot) -> dict:
    fx, fy, cx, cy = matrix_of(lenses.lens_of(TABLE, shot.camera)[1].settings)
    pose = shot.camera.world_to_opencv
    return {
        "cam_K": [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        "cam_R_w2c": pose[:3, :3].ravel().tolist(),
        "cam_t_w2c": pose[:3, 3].tolist(),
        "depth_scale": factor(MILLIMETERS, shot.meters),
    } | shot.remark
