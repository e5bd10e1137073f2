"""NeRF's transforms_train.json, _val.json and _test.json: pinholes by their angle of view, and poses.

camera_angle_x is the whole lens: square pixels, the center in the middle, no distortion. Of ten pictures in order the
eighth is of val and the tenth of test. Poses are from Blender's camera frame to the world.
Reference: B. Mildenhall et al., NeRF (2020), and its data sets.
"""

from __future__ import annotations

from math import atan, isclose

import numpy as np

from ..programs.parts.lens import matrix_of
from ..records import InputError
from . import lenses
from .format import SEPARATELY, Shot
from .plain import as_text

TABLE = {"camera_angle_x": ("OPENCV_PINHOLE", ())}
PARTS = "train", "val", "test"
NEAR = 1e-6
"""Largest relative difference of focal lengths and of the center from the middle: Blender's shift is float32."""


class Nerf(lenses.LensFormat):
    """Three files with all cameras and frames."""

    key = "nerf"
    label = "NeRF"
    description = "transforms_train.json, _val and _test: pinholes by camera_angle_x, and poses"
    table = TABLE

    def refusal(self, shot):
        """See Format."""
        reason = super().refusal(shot)
        if reason is not None:
            return reason
        fx, fy, cx, cy = matrix_of(lenses.lens_of(TABLE, shot.camera)[1].settings, 0.5)
        width, height = shot.camera.raster.picture_size
        middle = max(abs(cx - width / 2), abs(cy - height / 2)) <= NEAR * max(width, height)
        return None if middle and isclose(fx, fy, rel_tol=NEAR) else "which camera_angle_x alone does not say"

    def files(self, shots):
        """See Format. Raises InputError for lenses that differ."""
        angles = {_angle(shot): shot.stem for shot in shots}
        least, most = min(angles), max(angles)
        if most - least > NEAR:
            differ = f"{angles[least]!r} and {angles[most]!r} differ"
            raise InputError(f"NeRF has one camera_angle_x, but {differ}: {SEPARATELY}, or for nerfstudio")
        of = {7: "val", 9: "test"}
        for part in PARTS:
            frames = [_frame(shot) for number, shot in enumerate(shots) if of.get(number % 10, "train") == part]
            yield f"transforms_{part}.json", as_text({"camera_angle_x": next(iter(angles)), "frames": frames})


def _angle(shot: Shot) -> float:
    fx, *_ = matrix_of(lenses.lens_of(TABLE, shot.camera)[1].settings)
    return 2 * atan(shot.camera.raster.picture_size[0] / 2 / fx)


def _frame(shot: Shot) -> dict:
    pose = shot.camera.pose
    matrix = np.vstack((np.column_stack((pose.basis, pose.eye)), (0.0, 0.0, 0.0, 1.0)))
    return {"file_path": f"./{shot.stem}", "transform_matrix": matrix.tolist()} | shot.remark
