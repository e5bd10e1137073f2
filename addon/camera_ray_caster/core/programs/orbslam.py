"""The settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam, in YAML: entries Camera.fx, Camera1.fx, ...

The center of the first pixel is (0, 0). Stereo.T_c1_c2, in older files Tlr, leads from the second camera to the first,
x right, y down, z ahead.
Reference: ORB-SLAM3, Calibration tutorial; stella_vslam documentation, Parameters.
"""

from __future__ import annotations

import re

import numpy as np

from ..units import METERS
from . import stella
from .parts.document import Document
from .parts.placed import Placed, pose_in
from .parts.plain import has_plain, plain_lenses
from .parts.program import ProgramFiles

NAME = re.compile(r"Camera\d?\.")
STEREO = "Stereo.T_c1_c2", "Tlr"


def looks(document: Document) -> bool:
    entries = document.entries
    is_camera = any(map(NAME.match, entries)) or entries.part("Camera").has("fx")
    return is_camera and not stella.looks(document) and has_plain(document)


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: those of two cameras in the frame of the first one; none of one camera."""
    entries, lenses = document.entries, plain_lenses(document) or []
    entry = entries.first(*STEREO)
    if len(lenses) != 2 or not entries.has(entry):
        return []
    poses = np.eye(4), pose_in(entries, entry)
    return [Placed(lens.name, "", None, pose) for lens, pose in zip(lenses, poses, strict=True)]


PROGRAM = ProgramFiles(
    "ORB-SLAM", "settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam as .yaml", looks,
    marks="Camera.fx Camera.fy Camera.cx Camera.type Camera.fps",
    reads="PinHole, Rectified, KannalaBrandt8, perspective, fisheye", lost="stella_vslam's other models are refused",
    read=plain_lenses, poses=poses, unit=METERS,
)  # fmt: skip
