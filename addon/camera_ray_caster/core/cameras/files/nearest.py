"""The refusal of a file that no reader knows: what is read, and the format that is nearest to the file."""

from __future__ import annotations

import re

from ...records import InputError
from ..parts.calibration import FILE_WRITERS
from .document import Document

MARKS = {
    "OpenCV": "camera_matrix distortion_coefficients image_width image_height opencv_storage",
    "ROS": "camera_matrix distortion_model rectification_matrix projection_matrix",
    "COLMAP": "CAMERA_ID MODEL WIDTH HEIGHT PARAMS PINHOLE SIMPLE_RADIAL",
    "nerfstudio": "frames transform_matrix camera_angle_x fl_x file_path camera_model",
    "Kalibr": "camera_model distortion_model distortion_coeffs intrinsics resolution",
    "EuRoC": "sensor_type T_BS rate_hz camera_model intrinsics distortion_coefficients",
    "OKVIS": "cameras T_SC image_dimension focal_length principal_point distortion_type",
    "VINS (camodocal)": "model_type projection_parameters distortion_parameters mirror_parameters",
    "ORB-SLAM": "Camera.fx Camera.fy Camera.cx Camera.type Camera.fps",
    "Basalt": "value0 intrinsics camera_type resolution T_imu_cam",
    "BOP": "cam_K depth_scale cam_R_w2c cam_t_w2c",
    "mrcal": "lensmodel intrinsics extrinsics imagersize",
    "Project Aria": "CameraCalibrations Label Projection Params",
    "NVIDIA (f-theta)": "rig sensors properties ftheta polynomial reference_poly",
    "OCamCalib": "#polynomial coefficients #affine parameters direct mapping",
    "the Camera Ray Caster": "format cameras all_frames frames record settings",
}
"""Words of each format's files."""

WORDS = re.compile(r"#?[A-Za-z_][\w.]*")
READ_UP_TO = 1 << 16
"""Number of characters in which words are looked for: files name their entries at the begin."""


def unknown(document: Document) -> InputError:
    """Return the refusal of a file that no reader knows."""
    there = {word.lower() for word in WORDS.findall(document.text[:READ_UP_TO])}
    marks = {name: words.lower().split() for name, words in MARKS.items()}
    found = {name: [word for word in words if word in there] for name, words in marks.items()}
    nearest = max(found, key=lambda name: (len(found[name]) / len(marks[name]), len(found[name])))
    near = ""
    if found[nearest]:
        lost = [word for word in marks[nearest] if word not in there]
        near = f"; the nearest is {nearest}, " + (f"but it has no {', '.join(lost[:2])}" if lost else "by its words")
    return document.refusal(f"it is of no format that is read: these are {FILE_WRITERS}{near}")
