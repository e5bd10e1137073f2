"""mrcal's .cameramodel: a Python dictionary with the lens model, its intrinsics and the imager's size.

The center of the first pixel is (0, 0). mrcal's stereographic lens is the unified camera with xi = 1 and twice the
focal length.
Reference: mrcal documentation, Lens models; The .cameramodel file format.
"""

from __future__ import annotations

import ast
from warnings import catch_warnings

from .document import Document, Lens, matrix

TERMS = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4")
STEREOGRAPHIC = "LENSMODEL_STEREOGRAPHIC"
MODELS = {
    "LENSMODEL_PINHOLE": ("OPENCV_PINHOLE", ()),
    **{f"LENSMODEL_OPENCV{count}": ("OPENCV_PINHOLE", TERMS[:count]) for count in (4, 5, 8, 12)},
    STEREOGRAPHIC: ("UCM", ()),
}


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    if "LENSMODEL_" not in document.text:
        return None
    try:
        with catch_warnings(action="ignore", category=SyntaxWarning):  # of a text that is not such a file
            entries = ast.literal_eval(document.text)
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError) as error:
        raise document.refusal("it names a lens model of mrcal, but is not a cameramodel file of mrcal") from error
    entries = entries if isinstance(entries, dict) else {}
    model, terms = MODELS[document.one_of(entries.get("lensmodel"), "lensmodel", MODELS)]
    fx, fy, cx, cy, *rest = document.numbers(entries.get("intrinsics"), "intrinsics", len(terms) + 4)
    settings = dict(zip(terms, rest, strict=True))
    if model == "UCM":
        fx, fy, settings = 2 * fx, 2 * fy, {"unified_xi": 1.0}
    width, height = document.numbers(entries.get("imagersize"), "imagersize", 2)
    return [Lens("", model, document.size(width, height) | matrix(fx, fy, cx, cy) | settings)]
