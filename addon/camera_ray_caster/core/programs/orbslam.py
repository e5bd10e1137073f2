"""The settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam, in YAML: entries Camera.fx, Camera1.fx, ...

The center of the first pixel is (0, 0). Stereo.T_c1_c2, in older files Tlr, leads from the second camera to the first,
x right, y down, z ahead; IMU.T_b_c1, or Tbc, from the camera to the IMU.
Reference: ORB-SLAM3, Calibration tutorial; stella_vslam documentation, Parameters.
"""

import re

import numpy as np

from ..units import METERS
from . import stella
from .parts.document import Document
from .parts.lens import Lens
from .parts.placed import Placed, pose_in
from .parts.plain import has_plain, plain_lenses
from .parts.program import ProgramFiles

NAME = re.compile(r"Camera\d?\.")
UNRECTIFIED = "LEFT.", "RIGHT."
"""Begins of the names of a pair's matrices by which its pictures are rectified: Camera.fx is that of these."""
STEREO, BODY = ("Stereo.T_c1_c2", "Tlr"), ("IMU.T_b_c1", "Tbc")


def looks(document: Document) -> bool:
    entries = document.entries
    is_camera = any(map(NAME.match, entries)) or entries.part("Camera").has("fx")
    return is_camera and not stella.looks(document) and has_plain(document)


def _lenses(document: Document) -> list[Lens] | None:
    entries = document.entries.values
    return plain_lenses(document.part({name: entries[name] for name in entries if not name.startswith(UNRECTIFIED)}))


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: those of two cameras in the frame of the first one; that of one camera in the IMU's."""
    entries, lenses = document.entries, _lenses(document) or []
    entry = entries.first(*(STEREO if len(lenses) == 2 else BODY))
    if not entries.has(entry):
        return []
    poses = [np.eye(4), pose_in(entries, entry)][-len(lenses) :]
    return [Placed(lens.name, "", None, pose) for lens, pose in zip(lenses, poses, strict=True)]


PROGRAM = ProgramFiles(
    "ORB-SLAM", "settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam as .yaml", looks,
    marks="Camera.fx Camera.fy Camera.cx Camera.type Camera.fps",
    reads="PinHole, Rectified, KannalaBrandt8, perspective, fisheye", lost="stella_vslam's other models are refused",
    read=_lenses, poses=poses, unit=METERS,
)  # fmt: skip
