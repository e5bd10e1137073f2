"""The settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam, in YAML: entries Camera.fx, Camera1.fx, ...

The center of the first pixel is (0, 0).
Reference: ORB-SLAM3, Calibration tutorial; stella_vslam documentation, Parameters.
"""

from __future__ import annotations

import re

from .parts.document import Document
from .parts.plain import has_plain, plain_lenses
from .parts.program import ProgramFiles

NAME = re.compile(r"Camera\d?\.")


def looks(document: Document) -> bool:
    """See ProgramFiles."""
    entries = document.entries
    return (any(map(NAME.match, entries)) or entries.part("Camera").has("fx")) and has_plain(document)


PROGRAM = ProgramFiles(
    "ORB-SLAM", "settings of ORB-SLAM2, ORB-SLAM3 and stella_vslam as .yaml", looks,
    marks="Camera.fx Camera.fy Camera.cx Camera.type Camera.fps",
    reads="PinHole, Rectified, KannalaBrandt8, perspective, fisheye", lost="stella_vslam's other models are refused",
    read=plain_lenses,
)  # fmt: skip
