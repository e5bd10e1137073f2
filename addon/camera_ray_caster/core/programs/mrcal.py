"""mrcal's .cameramodel: a Python dictionary with the lens model, its intrinsics and the imager's size.

The center of the first pixel is (0, 0). mrcal's stereographic lens is the unified camera with xi = 1 and twice the
focal length; its LONLAT is the equirectangular panorama. An entry that stands twice is refused. Older files have the
model as distortion_model, DISTORTION_OPENCV8, and words as byte strings.
Reference: mrcal documentation, Lens models; The .cameramodel file format.
"""

from __future__ import annotations

import ast
import re
from math import pi
from typing import Any
from warnings import catch_warnings

from ..cameras.parts.settings import LIMIT_ROUNDING
from ..records import InputError
from .parts.document import Document, Lens, matrix

TERMS = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4")
STEREOGRAPHIC, LONLAT = "LENSMODEL_STEREOGRAPHIC", "LENSMODEL_LONLAT"
MODELS = {
    "LENSMODEL_PINHOLE": ("OPENCV_PINHOLE", ()),
    **{f"LENSMODEL_OPENCV{count}": ("OPENCV_PINHOLE", TERMS[:count]) for count in (4, 5, 8, 12)},
    STEREOGRAPHIC: ("UCM", ()),
}

MARK = re.compile("LENSMODEL_|DISTORTION_[A-Z]")
"""What every file has; DISTORTION_ before mrcal 1.0."""

LONGEST = 1 << 20
"""Characters of a file: Python's reader takes a second for them."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    if not MARK.search(document.text):
        return None
    if len(document.text) > LONGEST:
        raise document.refusal(f"it names a lens model of mrcal, but is longer than {LONGEST:,} characters")
    try:
        with catch_warnings(action="ignore", category=SyntaxWarning):  # of a text that is not such a file
            entries = _once(ast.parse(document.text.strip(), mode="eval").body, document)
    except InputError:
        raise
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError) as error:
        raise document.refusal("it names a lens model of mrcal, but is not a cameramodel file of mrcal") from error
    entries = entries if isinstance(entries, dict) else {}
    kind = document.one_of(_kind(entries), "lensmodel", (*MODELS, LONLAT))
    if kind == LONLAT:
        return [_panorama(document, entries)]
    model, terms = MODELS[kind]
    fx, fy, cx, cy, *rest = document.numbers(entries.get("intrinsics"), "intrinsics", len(terms) + 4)
    settings = dict(zip(terms, rest, strict=True))
    if model == "UCM":
        fx, fy, settings = 2 * fx, 2 * fy, {"unified_xi": 1.0}
    width, height = document.numbers(entries.get("imagersize"), "imagersize", 2)
    return [Lens("", model, document.size(width, height) | matrix(fx, fy, cx, cy) | settings)]


def _kind(entries: dict) -> Any:
    """Return the lens model, also of files before mrcal 1.0: by another name, or as a byte string."""
    kind = next((entries[name] for name in ("lensmodel", "lens_model", "distortion_model") if name in entries), None)
    kind = kind.decode("ascii", "replace") if isinstance(kind, bytes) else kind
    if not isinstance(kind, str):
        return kind
    kind = kind.replace("DISTORTION_", "LENSMODEL_")
    return "LENSMODEL_PINHOLE" if kind == "LENSMODEL_NONE" else kind


def _once(tree: ast.expr, document: Document) -> Any:
    """Return the value of a literal. Raises InputError for a dictionary with a name twice."""
    if isinstance(tree, ast.Dict):
        names = [ast.literal_eval(name) for name in tree.keys if name is not None]
        twice = [name for name in names if names.count(name) > 1]
        if twice:
            raise document.refusal(f"it has {twice[0]!r} twice: leave one out")
    return ast.literal_eval(tree)


def _panorama(document: Document, entries: dict) -> Lens:
    """Return the equirectangular panorama of fx and fy, pixels per radian, and cx and cy, in the viewing direction."""
    fx, fy, cx, cy = document.numbers(entries.get("intrinsics"), "intrinsics", 4)
    width, height = document.numbers(entries.get("imagersize"), "imagersize", 2)
    size = document.size(width, height)
    if min(fx, fy) <= 0:
        raise document.refusal("its pixels per radian must be above 0")
    low, high = (cy - height + 0.5) / fy, (cy + 0.5) / fy
    if max(-low, high) > pi / 2 + LIMIT_ROUNDING:
        raise document.refusal("its picture reaches beyond a pole, which no panorama of Blender does")
    return Lens("", "EQUIRECTANGULAR", size | {
        "longitude_min": (-0.5 - cx) / fx, "longitude_max": (width - 0.5 - cx) / fx,
        "latitude_min": max(low, -pi / 2), "latitude_max": min(high, pi / 2),
    })  # fmt: skip
