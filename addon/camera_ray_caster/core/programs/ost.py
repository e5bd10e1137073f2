"""ROS's ost.txt, and .ini of camera_calibration_parsers: a picture's size, a camera matrix, distortion and others.

Five coefficients are of plumb_bob, eight of rational_polynomial. The center of the first pixel is (0, 0).
Reference: ROS documentation, camera_calibration; camera_calibration_parsers, INI format.
"""

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.plain import of_matrix
from .parts.program import ProgramFiles

NAMES = "width", "height", "camera matrix", "distortion", "rectification", "projection"


def looks(document: Document) -> bool:
    return "[image]" in document.text and set(NAMES) <= set(document.lines())


def read(document: Document) -> list[Lens]:
    sections: dict[str, list[str]] = {}
    name = ""
    for line in document.lines():
        if line in NAMES and line in sections:
            raise document.refusal(f"it has {line} twice: give a file of one camera")
        if line in NAMES or line.startswith("["):
            name = line
            sections[name] = []
        else:
            sections.setdefault(name, []).extend(line.split())
    entries = Fields(document, dict(sections))
    if entries.count_of("distortion") == 4:
        raise document.refusal("its distortion has 4 numbers, of a pinhole or of a fisheye: use the .yaml beside it")
    return [of_matrix(entries, "camera matrix", "distortion", entries.sides("width", "height"))]


PROGRAM = ProgramFiles(
    "ROS ost.txt", "ost.txt and .ini of camera_calibration", looks,
    marks="image width height narrow_stereo camera matrix distortion rectification projection",
    reads="plumb_bob, rational_polynomial", lost="rectification and projection are not read", read=read,
)  # fmt: skip
