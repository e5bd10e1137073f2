"""transforms.json of nerfstudio and instant-ngp, with the lens and the pose of each frame.

Poses are from Blender's camera frame to the world; the center of the first pixel is (0.5, 0.5). All frames are of one
camera model: either pinholes with distortion, or fisheyes. Distortion is stored per frame, because readers do not agree
on the order of p1 and p2 in the head of the file.
Reference: nerfstudio documentation, Data conventions.
"""

from __future__ import annotations

import numpy as np

from ..programs.nerfstudio import MODELS
from ..programs.parts.lens import matrix_of
from ..records import InputError
from . import lenses
from .format import SEPARATELY, Shot
from .plain import as_text

TABLE = {kind: MODELS[kind] for kind in ("OPENCV", "OPENCV_FISHEYE")}


class Nerfstudio(lenses.LensFormat):
    """One file with all cameras and frames."""

    key = "nerfstudio"
    label = "nerfstudio"
    description = "transforms.json: pinholes and fisheyes, and poses"
    table = TABLE

    def files(self, shots):
        """See Format."""
        kinds: dict[str, str] = {}
        for shot in shots:
            kinds.setdefault(lenses.lens_of(TABLE, shot.camera)[0], shot.name)
        if len(kinds) > 1:
            several = " and ".join(f"{name!r} is {kind}" for kind, name in kinds.items())
            raise InputError(f"transforms.json has one camera_model, but camera {several}: {SEPARATELY}")
        yield "transforms.json", as_text({"camera_model": next(iter(kinds)), "frames": [_frame(one) for one in shots]})


def _frame(shot: Shot) -> dict:
    camera = shot.camera
    kind, lens = lenses.lens_of(TABLE, camera)
    names = ("fl_x", "fl_y", "cx", "cy", *TABLE[kind][1])
    values = matrix_of(lens.settings, 0.5) + lenses.values(lens, TABLE[kind][1])
    pose = np.vstack((np.column_stack((camera.pose.basis, camera.pose.eye)), (0.0, 0.0, 0.0, 1.0)))
    width, height = camera.raster.picture_size
    size = {"file_path": shot.image, "w": width, "h": height}
    return size | dict(zip(names, values, strict=True)) | {"transform_matrix": pose.tolist()} | shot.remark
