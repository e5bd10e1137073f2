"""Calibration files: one module per format, which recognizes its files and returns their lenses as models' settings.

The contract is ``read(document, key)``, which returns the lenses of a document, or None if it is not of that format.
``key`` is the key of the chosen model, for formats that do not name theirs, or "". The readers convert pixel
conventions: see parts/calibration.py. A file that no reader knows may have calibrations inside: a mapping of cameras by
name, or a list of them.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...records import InputError
from .. import (
    aria,
    arkit,
    basalt,
    camodocal,
    ftheta,
    generic,
    gyroflow,
    hesai,
    hot3d,
    isaac,
    kitti,
    meshroom,
    metashape,
    nerfstudio,
    ocam,
    opencv,
    ouster,
    program_of,
    ray_arrays,
    ray_exr,
    ray_mesh,
    recorded,
    velodyne,
    woodscape,
)
from ..parts.document import Document
from ..parts.lens import Lens
from .nearest import by_name, unknown

FORMATS = (
    ray_arrays.read, ray_exr.read, ray_mesh.read, metashape.read, arkit.read,
    hesai.read, kitti.read, ocam.read, velodyne.read, ouster.read, recorded.read, generic.read, aria.read,
    nerfstudio.read, ftheta.read, isaac.read, woodscape.read, meshroom.read, gyroflow.read, hot3d.read,
    basalt.read, camodocal.read, opencv.read,
)  # fmt: skip
"""Readers in the order in which they are tried."""

ARRAYS = ray_arrays.ZIP, ray_arrays.NPY, ray_exr.MAGIC

DEEPEST = 3
"""Levels of mappings in which calibrations are looked for."""

KEPT = 8
"""Number of files whose lenses are kept: an animated camera reads its file for every frame."""

_latest: dict[tuple, list[Lens]] = {}


def lenses_of(path: str, key: str = "", frame: tuple[int, int] | None = None) -> list[Lens]:
    """Return the lenses in a calibration file, in the file's order.

    ``key`` is the key of the chosen model, for files that do not name one; "" for none. ``frame``: width and height of
    the camera's frame, which is the size of the pictures if the file does not tell it; calibration_width and
    calibration_height of such a lens are 0. Without a frame, such a lens may have another focal length and center.
    Raises InputError, in one line, for a file that cannot be read, and for missing or invalid entries.
    """
    document = Document(path, frame, key)
    asked = (path, key, frame, document.digest)
    if asked not in _latest:
        try:
            lenses = _known(document, key)
        except InputError as refusal:
            raise by_name(document) or refusal from refusal
        if lenses is None:
            inside = list(_inside(document, key, DEEPEST, ""))
            if not inside:
                raise unknown(document)
            lenses = _named(inside)
        if len(_latest) >= KEPT:
            _latest.clear()
        _latest[asked] = lenses
    return list(_latest[asked])


def _known(document: Document, key: str) -> list[Lens] | None:
    program = program_of(document)
    if program is not None and program.read is not None:
        return program.read(document)
    if document.is_binary and not document.data.startswith(ARRAYS):
        raise unknown(document)
    return next((found for read in FORMATS if (found := read(document, key)) is not None), None)


def _inside(document: Document, key: str, depth: int, path: str) -> Iterator[tuple[str, Lens]]:
    """Yield the lenses of the mappings in a document with the names of their entries, the nearest ones only."""
    for name, value in document.raw.items():
        document.check()
        items = [(name, value)] if isinstance(value, dict) else []
        if isinstance(value, list):
            items = [(f"{name}.{i}", one) for i, one in enumerate(value) if isinstance(one, dict)]
        for own, entries in items:
            part = document.part(entries)
            try:
                found = _known(part, key) if entries else None
            except InputError as refusal:
                found = [Lens("", "", {}, refusal)]
            if found is not None:
                yield from ((f"{path}{own}", lens) for lens in found)
            elif depth > 1:
                yield from _inside(part, key, depth - 1, f"{path}{own}.")


def _named(inside: list[tuple[str, Lens]]) -> list[Lens]:
    """Return each lens once. Those of one name that differ are named by their entries, too."""
    different: dict[str, dict[str, tuple[str, Lens]]] = {}
    for entry, lens in inside:
        different.setdefault(lens.name, {}).setdefault(repr(lens[1:]), (entry, lens))
    lenses = []
    for name, own in different.items():
        for entry, lens in own.values():
            lenses.append(lens if len(own) == 1 and (name or len(different) == 1) else
                          lens._replace(name=f"{entry} {name}".strip()))  # fmt: skip
    return lenses
