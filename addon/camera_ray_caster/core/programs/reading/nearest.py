"""The refusal of a file that no reader knows: what is read, and the format that is nearest to the file or its name."""

from __future__ import annotations

import re
from pathlib import Path

from ...records import InputError
from .. import PROGRAMS, READ, arkit, ray_arrays, ray_exr, ray_mesh
from ..parts.document import Document

WORDS = re.compile(r"[A-Za-z_][\w.]*")
READ_UP_TO = 1 << 16
"""Number of characters in which words are looked for: files name their entries at the begin."""


def unknown(document: Document) -> InputError:
    """Return the refusal of a file that no reader knows."""
    if document.is_binary:
        return document.refusal("it is not a text file, and of no binary format that is read")
    there = {word.lower() for word in WORDS.findall(document.text[:READ_UP_TO])}
    marks = {one.name: one.marks.lower().split() for one in PROGRAMS if one.marks}
    found = {name: [word for word in words if word in there] for name, words in marks.items()}
    nearest = max(found, key=lambda name: (len(found[name]) / len(marks[name]), len(found[name])))
    near = ""
    if found[nearest]:
        lost = [word for word in marks[nearest] if word not in there]
        near = f"; the nearest is {nearest}, " + (f"but it has no {', '.join(lost[:2])}" if lost else "by its words")
    return document.refusal(f"it is of no format that is read: these are {READ}{near}")


ARRAYS = {
    ".npy": ("an array of numpy", ray_arrays.NPY), ".npz": ("a file of numpy's arrays", ray_arrays.ZIP),
    ".exr": ("an EXR image", ray_exr.MAGIC),
}  # fmt: skip
"""What files are by the ends of their names, and the bytes that such a file begins with."""


def by_name(document: Document) -> InputError | None:
    """Return the refusal of a file without entries that is not what its name says; None of any other file."""
    if not document.data.strip() or _has_entries(document):
        return None
    ending, begin = Path(document.path).suffix.lower(), document.data[:READ_UP_TO].lower()
    if ending == ".obj":
        lost = [line.strip().decode() for line in ray_mesh.LINES if line not in b"\n" + document.data]
        return document.refusal(f"it is no mesh of rays: it has no lines {', '.join(lost)}") if lost else None
    if ending == ".pincam" and arkit.of_pincam(document) is None:
        return document.refusal("it must be one line of six numbers: width, height, fx, fy, cx and cy")
    if ending == ".traj":
        return document.refusal("its lines must have seven numbers: a time, axis times angle, and x, y, z")
    if Path(document.path).stem == "images" and ending in (".txt", ".bin"):
        return document.refusal("it should have COLMAP's poses: the lenses are in the file cameras beside it")
    if ending == ".csv" and b"dx" not in begin and b"azimuth" not in begin:
        return document.refusal(
            f"its first line must name x, y, {', '.join(ray_mesh.DIRECTION)}, of a mesh of rays, or channel, "
            "elevation, azimuth, of Hesai's angle corrections"
        )
    kind, magic = ARRAYS.get(ending, ("", b""))
    if document.data.startswith(magic):
        return None
    return document.refusal(f"by its name it is {kind}, but it does not begin as one: it is damaged, or another file")


def _has_entries(document: Document) -> bool:
    try:
        return bool(document.raw)
    except InputError:
        return False
