"""Calibration files: one module a format, which tells its own texts and gives their lenses as settings of models.

The contract is ``read(document, key)``: the lenses of a document, None where it is not of that format. ``key`` is the
chosen model's, for formats that do not say theirs. Pixel conventions are converted there: see parts/calibration.py.
"""

from . import aria, colmap, ftheta, kalibr, mrcal, nerfstudio, ocam, opencv
from .document import Document, Lens

FORMATS = (
    colmap.read, mrcal.read, ocam.read, aria.read, nerfstudio.read, ftheta.read, kalibr.read, opencv.read,
)  # fmt: skip
"""The last one is asked for what is none of the others'."""


def lenses_of(path: str, key: str) -> list[Lens]:
    """Return the lenses in a calibration file, in its order; ``key``: the chosen model's.

    Raises InputError, in one line, for a file that cannot be read, and for what is missing or without meaning in it.
    """
    document = Document(path)
    return next(found for read in FORMATS if (found := read(document, key)) is not None)
