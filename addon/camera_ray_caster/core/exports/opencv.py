"""OpenCV's YAML: the lens as OpenCV's calibration samples write it, and the poses of all frames.

A pinhole has as few of OpenCV's 14 coefficients as it needs. fisheye_model is 1 for cv2.fisheye and 0 for a pinhole; a
file with xi is for cv2.omnidir. extrinsic_parameters has one row per frame: the rotation vector and the translation
from the world to the camera. The center of the first pixel is (0, 0).
References: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model; Omnidirectional Camera
Calibration.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..maths.rotations import half_turn_vector
from ..programs.opencv import TERMS
from ..programs.parts.lens import matrix_of
from . import lenses
from .format import Shot

PINHOLE = TERMS["OPENCV_PINHOLE"]
TABLE = {f"pinhole {count}": ("OPENCV_PINHOLE", PINHOLE[:count]) for count in (5, 8, 12, 14)} | {
    "fisheye": ("OPENCV_FISHEYE", TERMS["OPENCV_FISHEYE"]),
    "omnidir": ("UCM", (*TERMS["UCM"], "unified_xi", "skew")),
}
PLAIN = "fisheye_model: 0\n"
EXTRA = {"fisheye": "fisheye_model: 1\n", "omnidir": "xi: {unified_xi!r}\n"}


class Opencv(lenses.LensFormat):
    """One file per camera, or one file per frame if the camera's lens changes."""

    key = "opencv"
    label = "OpenCV"
    description = "<camera>.yml for FileStorage: pinhole, fisheye and omnidir, and poses"
    table = TABLE

    def files(self, shots):
        """See Format."""
        for stem, lens, some in lenses.by_lens(shots, _lens):
            yield f"{stem}.yml", f"%YAML:1.0\n---\n{lens}{_poses(some)}"


def _lens(shot: Shot) -> str:
    kind, lens = lenses.lens_of(TABLE, shot.camera)
    fx, fy, cx, cy = matrix_of(lens.settings)
    K = [[fx, lens.settings["skew"], cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]
    width, height = shot.camera.raster.picture_size
    terms = [name for name in TABLE[kind][1] if name not in ("unified_xi", "skew")]
    return (
        f"image_width: {width}\nimage_height: {height}\n{_matrix('camera_matrix', K)}"
        f"{_matrix('distortion_coefficients', [lenses.values(lens, terms)])}"
        f"{EXTRA.get(kind, PLAIN).format(**lens.settings)}"
    )


def _poses(shots: Sequence[Shot]) -> str:
    poses = [shot.camera.world_to_opencv for shot in shots]
    rows = [[*half_turn_vector(pose[:3, :3]).tolist(), *pose[:3, 3].tolist()] for pose in poses]
    frames = ", ".join(f"{shot.frame:.10g}" for shot in shots)
    return f"frames: [ {frames} ]\n{_matrix('extrinsic_parameters', rows)}"


def _matrix(name: str, rows) -> str:
    array = np.array(rows, np.float64)
    data = ", ".join(map(repr, array.ravel().tolist()))
    return f"{name}: !!opencv-matrix\n   rows: {len(array)}\n   cols: {array.shape[1]}\n   dt: d\n   data: [ {data} ]\n"
