"""CalLab's calibrations of DLR, as text: camera.0.A=[fx s cx; 0 fy cy; 0 0 1], camera.0.k1 and others.

Radial coefficients are OpenCV's; the order of tangential ones is not documented: they are refused. The center of the
first pixel is (0, 0).
Reference: DLR CalDe and DLR CalLab, output file.
"""

import re

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.plain import of_matrix
from .parts.program import ProgramFiles, of_cameras

LINE = re.compile(r"(camera\.\d+)\.(\w+)\s*=\s*\[?([^\]]*)\]?")
RADIAL = "k1", "k2", "k3"


def looks(document: Document) -> bool:
    return "camera." in document.text and bool(_cameras(document))


def _cameras(document: Document) -> list[Fields]:
    by_camera: dict[str, dict[str, list[str]]] = {}
    for match in filter(None, map(LINE.fullmatch, document.lines())):
        by_camera.setdefault(match[1], {})[match[2]] = match[3].replace(";", " ").split()
    return [Fields(document, entries, name) for name, entries in by_camera.items() if "A" in entries]


def _lens(camera: Fields) -> Lens:
    document = camera.document
    if any(camera.numbers(name, 1, [0.0])[0] for name in ("p1", "p2", "t1", "t2")):
        raise document.refusal(f"{camera.label} has tangential distortion, which is not read")
    k1, k2, k3 = (camera.numbers(name, 1, [0.0])[0] for name in RADIAL)
    entries = camera.merged(Fields(document, {"radial": [k1, k2, 0.0, 0.0, k3]}))
    return of_matrix(entries, "A", "radial", camera.sides("width", "height"))


PROGRAM = ProgramFiles(
    "CalLab", "output of DLR CalDe and CalLab as text", looks, marks="camera.0.A camera.0.k1 camera.0.k2 CalLab CalDe",
    reads="pinhole with radial distortion", lost="poses of the pattern; tangential distortion is refused",
    **of_cameras(_cameras, _lens),
)  # fmt: skip
