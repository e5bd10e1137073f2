"""Intel RealSense's intrinsics, as JSON, with ppx and ppy; and an intrinsic_matrix, which is stored by columns.

The center of the first pixel is (0, 0).
Reference: librealsense documentation, Projection.
"""

from .parts.document import Document
from .parts.plain import has_plain, plain_lenses
from .parts.program import ProgramFiles


def looks(document: Document) -> bool:
    entries = document.entries
    return (entries.has("ppx", "ppy") or entries.has("intrinsic_matrix")) and has_plain(document)


PROGRAM = ProgramFiles(
    "RealSense", "intrinsics as .json; Open3D's and NICE-SLAM's: fx, fy, cx, cy by names", looks,
    marks="width height ppx ppy coeffs intrinsic_matrix", reads="pinhole, Brown-Conrady",
    lost="the inverse Brown-Conrady with coefficients is refused", read=plain_lenses,
)  # fmt: skip
