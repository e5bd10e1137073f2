"""The cameras of HOT3D and its clips, as JSON: by stream, each a calibration with projection_params.

One focal length is that of both axes. The coefficients are those of Project Aria; the center of the first pixel is
(0, 0).
Reference: HOT3D documentation, and the hand tracking toolkit that reads its clips.
"""

from __future__ import annotations

from .aria import MODELS as ARIA
from .document import Document, Lens, matrix, numbers_of

KINDS = {"FISHEYE624": ARIA["FisheyeRadTanThinPrism"][:2], "PINHOLE": ("OPENCV_PINHOLE", ())}
"""Our model for the last part of a projection_model_type, and the settings that follow the center."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document, a single calibration; see the package, which looks for those inside."""
    entries = document.entries
    if not {"projection_model_type", "projection_params"} <= entries.keys():
        return None
    kind = str(entries["projection_model_type"]).rpartition(".")[2]
    model, terms = KINDS[document.one_of(kind, "projection_model_type", KINDS)]
    given = entries["projection_params"]
    focal = 1 if len(numbers_of(given)) == len(terms) + 3 else 2
    numbers = document.numbers(given, "projection_params", focal + 2 + len(terms))
    size = [document.number(entries, side) if side in entries else None for side in ("image_width", "image_height")]
    settings = matrix(numbers[0], numbers[focal - 1], *numbers[focal : focal + 2])
    rest = dict(zip(terms, numbers[focal + 2 :], strict=True))
    return [Lens(str(entries.get("label", "")), model, document.size(*size) | settings | rest)]
