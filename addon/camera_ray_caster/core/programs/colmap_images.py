"""COLMAP's images.txt and images.bin: the pose of each image, from the world to its camera, and the camera's id.

References: COLMAP documentation, Output Format; its source, reconstruction_io.
"""

from __future__ import annotations

import struct

from .parts.document import Document
from .parts.placed import Placed, inverted, of_quaternion

COUNT, IMAGE, POINTS = struct.Struct("<Q"), struct.Struct("<I7dI"), struct.Struct("<Q")
POINT = 24
"""Bytes of a point in an image: x, y and the point's id."""


def poses(document: Document) -> list[Placed] | None:
    """Return the images of a document in the order of their ids; None of any other file. Raises InputError."""
    rows = _of_binary(document.data) if b"\0" in document.data[:64] else _of_text(document)
    if rows is None:
        return None
    placed = []
    for number, numbers, camera, name in sorted(rows):
        document.check()
        pose = of_quaternion(document, numbers[:4], numbers[4:], f"image {number}")
        placed.append(Placed(str(camera), name, None, inverted(pose)))
    return placed


def _of_text(document: Document) -> list[tuple] | None:
    lines = [line for line in document.text.splitlines() if not line.startswith("#")]
    while lines and not lines[-1].strip():
        lines.pop()
    heads = [line.split(maxsplit=9) for line in lines[::2]]
    if not heads or any(len(words) != 10 or not (words[0] + words[8]).isdecimal() for words in heads):
        return None
    return [
        (int(words[0]), document.numbers(words[1:8], f"pose of image {words[0]}", 7), int(words[8]), words[9].strip())
        for words in heads
    ]


def _of_binary(data: bytes) -> list[tuple] | None:
    try:
        (count,), at, found = COUNT.unpack_from(data), COUNT.size, []
        if count * IMAGE.size > len(data):
            return None
        for _ in range(count):
            number, *numbers, camera = IMAGE.unpack_from(data, at)
            at += IMAGE.size
            end = data.index(b"\0", at)
            name, at = data[at:end].decode(), end + 1
            (points,) = POINTS.unpack_from(data, at)
            at += POINTS.size + POINT * points
            found.append((number, numbers, camera, name))
        return found if at == len(data) else None
    except (struct.error, ValueError, OverflowError):
        return None
