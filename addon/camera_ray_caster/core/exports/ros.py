"""ROS's CameraInfo as YAML for camera_calibration_parsers: only the lens, since CameraInfo has no field for a pose.

The rectified picture has the same K: P is K, and R is the identity. The center of the first pixel is (0, 0).
Reference: ROS documentation, sensor_msgs/CameraInfo; camera_calibration_parsers.
"""

from __future__ import annotations

import json

from ..programs.opencv import TERMS
from ..programs.parts.lens import matrix_of
from . import lenses
from .format import Shot

TABLE = {
    "plumb_bob": ("OPENCV_PINHOLE", TERMS["OPENCV_PINHOLE"][:5]),
    "rational_polynomial": ("OPENCV_PINHOLE", TERMS["OPENCV_PINHOLE"][:8]),
    "equidistant": ("OPENCV_FISHEYE", TERMS["OPENCV_FISHEYE"]),
}


class Ros(lenses.LensFormat):
    """One file per camera, or one file per frame if the camera's lens changes."""

    key = "ros"
    label = "ROS CameraInfo"
    description = "<camera>.yaml: plumb_bob, rational_polynomial and equidistant lenses, without poses"
    table = TABLE
    rigid = False

    def files(self, shots):
        """See Format."""
        for stem, lens, _ in lenses.by_lens(shots, _lens):
            yield f"{stem}.yaml", lens


def _lens(shot: Shot) -> str:
    kind, lens = lenses.lens_of(TABLE, shot.camera)
    fx, fy, cx, cy = matrix_of(lens.settings)
    width, height = shot.camera.raster.picture_size
    matrices = {
        "camera_matrix": (3, 3, [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0]),
        "distortion_coefficients": (1, len(TABLE[kind][1]), lenses.values(lens, TABLE[kind][1])),
        "rectification_matrix": (3, 3, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
        "projection_matrix": (3, 4, [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0]),
    }
    text = f"image_width: {width}\nimage_height: {height}\ncamera_name: {json.dumps(shot.name, ensure_ascii=False)}\n"
    for name, (rows, columns, values) in matrices.items():
        data = ", ".join(map(repr, values))
        text += f"distortion_model: {kind}\n" if name == "distortion_coefficients" else ""
        text += f"{name}:\n  rows: {rows}\n  cols: {columns}\n  data: [{data}]\n"
    return text
