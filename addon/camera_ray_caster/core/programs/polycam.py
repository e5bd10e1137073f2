"""The cameras that Polycam stores for each picture, as JSON: fx, fy, cx, cy and the rows of a matrix, t_00 to t_23.

The matrix leads from the camera, y up and z back, to a world whose y is up. The center of the first pixel is (0, 0).
Reference: polyform, Polycam's data format.
"""

from ..units import METERS
from .parts.document import Document
from .parts.placed import FROM_BLENDER, Placed, pose_of
from .parts.plain import plain_lenses
from .parts.program import PictureFolders, ProgramFiles

ENTRIES = [[f"t_{row}{column}" for column in range(4)] for row in range(3)]
"""Names of the entries of the matrix."""


def looks(document: Document) -> bool:
    return document.entries.has("t_00", "fx")


def poses(document: Document) -> list[Placed]:
    rows = [document.entries.number(name) for row in ENTRIES for name in row]
    return [Placed("", "", None, pose_of(document, rows, "the matrix t_00 to t_23") @ FROM_BLENDER)]


PROGRAM = ProgramFiles(
    "Polycam", "keyframes' cameras as .json", looks, marks="fx fy t_00 t_01 t_23 blur_score", reads="pinhole",
    read=plain_lenses, poses=poses, unit=METERS,
    pictures=PictureFolders("[0-9]*.json", (
        "", "keyframes/corrected_cameras", "keyframes/cameras", "corrected_cameras", "cameras",
    )),
)  # fmt: skip
