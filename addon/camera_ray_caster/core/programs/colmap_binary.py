"""COLMAP's cameras.bin: the cameras of cameras.txt in binary, least significant byte first.

References: COLMAP documentation, Output Format; its source, reconstruction_io.
"""

from __future__ import annotations

import struct

from . import colmap
from .parts.document import Document, Lens, one_of_several

KINDS = {
    0: "SIMPLE_PINHOLE", 1: "PINHOLE", 2: "SIMPLE_RADIAL", 3: "RADIAL", 4: "OPENCV", 5: "OPENCV_FISHEYE",
    6: "FULL_OPENCV", 7: "FOV", 8: "SIMPLE_RADIAL_FISHEYE", 9: "RADIAL_FISHEYE", 10: "THIN_PRISM_FISHEYE",
    11: "RAD_TAN_THIN_PRISM_FISHEYE", 12: "SIMPLE_DIVISION", 13: "DIVISION", 14: "SIMPLE_FISHEYE", 15: "FISHEYE",
    16: "EUCM", 17: "EQUIRECTANGULAR",
}  # fmt: skip
"""Models by their numbers in the file."""

COUNT, CAMERA = struct.Struct("<Q"), struct.Struct("<iiQQ")


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    data = document.data
    if b"\0" not in data[:64]:
        return None
    cameras = rows(data)
    if cameras is None:
        raise document.refusal("it is not a text file, and not a cameras.bin of COLMAP")
    return [one_of_several(words[0], colmap.lens, document, words) for words in cameras]


def rows(data: bytes) -> list[list[str]] | None:
    """Return the words of the lines that cameras.txt would have; None unless the data is that of a cameras.bin."""
    try:
        (count,), at = COUNT.unpack_from(data), COUNT.size
        if count * CAMERA.size > len(data):
            return None
        found = []
        for _ in range(count):
            name, number, width, height = CAMERA.unpack_from(data, at)
            kind = KINDS[number]
            numbers = struct.unpack_from(f"<{colmap.count(kind)}d", data, at + CAMERA.size)
            at += CAMERA.size + 8 * len(numbers)
            found.append([str(name), kind, str(width), str(height), *map(repr, numbers)])
        return found if at == len(data) else None
    except (struct.error, KeyError):
        return None
