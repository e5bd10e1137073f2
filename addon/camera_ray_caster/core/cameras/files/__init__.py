"""Calibration files: one module per format, which recognizes its files and returns their lenses as models' settings.

The contract is ``read(document, key)``, which returns the lenses of a document, or None if it is not of that format.
``key`` is the key of the chosen model, for formats that do not name theirs. The readers convert pixel conventions: see
parts/calibration.py.
"""

from . import aria, colmap, ftheta, kalibr, mrcal, nerfstudio, ocam, opencv
from .document import Document, Lens

FORMATS = (
    colmap.read, mrcal.read, ocam.read, aria.read, nerfstudio.read, ftheta.read, kalibr.read, opencv.read,
)  # fmt: skip
"""Readers in the order in which they are tried. The last one accepts every document that no other does."""


def lenses_of(path: str, key: str) -> list[Lens]:
    """Return the lenses in a calibration file, in the file's order; ``key`` is the key of the chosen model.

    Raises InputError, in one line, for a file that cannot be read, and for missing or invalid entries.
    """
    document = Document(path)
    return next(found for read in FORMATS if (found := read(document, key)) is not None)
