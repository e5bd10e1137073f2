"""The lenses of a file of any program.

A file that no program recognizes may have calibrations inside: a mapping of cameras by name, or a list of them.
"""

from collections.abc import Iterator
from typing import Any

from ...conventions import LAST_FRAME
from ...records import InputError
from .. import program_of
from ..parts.document import Document
from ..parts.lens import Lens, mapping
from ..parts.spelled import unread_beside
from .unknown_file import unknown

NAMES = "name", "camera_name", "id", "camera_id", "label", "serial"
"""Entries by which cameras in a list are named."""
DEEPEST = 4
"""Levels of mappings in which calibrations are looked for."""

KEPT = 12
"""Number of files whose lenses are kept: the animated cameras of a rig read their files for every frame."""

_latest: dict[tuple, list[Lens]] = {}


def lenses_of(path: str, key: str = "", picture_size: tuple[int, int] | None = None) -> list[Lens]:
    """Return the lenses in a calibration file, in the file's order.

    ``key`` is the key of the chosen model, for files that do not name one; "" for none. ``picture_size``: width and
    height of the camera's picture, for files that do not tell it; calibration_width and calibration_height of such a
    lens are 0. Without the size, such a lens may have another focal length and center.
    Raises InputError, in one line, for a file that cannot be read, and for missing or invalid entries.
    """
    document = Document(path, picture_size, key)
    asked = (path, key, picture_size, document.digest)
    if asked not in _latest:
        lenses = _known(document)
        if lenses is None:
            inside = list(_inside(document, DEEPEST, "")) if document.has_entries else []
            document.check()
            if not inside:
                raise unknown(document)
            lenses = _named(inside)
        if len(_latest) >= KEPT:
            _latest.clear()
        _latest[asked] = lenses
    return list(_latest[asked])


def _known(document: Document) -> list[Lens] | None:
    """Return the lenses of the program that recognizes a document; None if none does, or they are further inside."""
    program = program_of(document)
    if program is None:
        return None
    if program.read is None:
        contents = "poses and no lens" if program.rays is None else "a list of rays: give it to scan(rays=), in Python"
        raise document.refusal(f"it is a file of {program.name}, which has {contents}")
    return program.read(document)


def _inside(document: Document, depth: int, path: str) -> Iterator[tuple[str, Lens]]:
    """Yield the lenses of the mappings in a document with the names of their entries, the nearest ones only."""
    names = _names_in(document.entries.values)
    for name, value in document.entries.values.items():
        document.check()
        items = [(names.get(name, name), value)] if isinstance(value, dict) else []
        if isinstance(value, list):
            by_number = {str(i): item for i, item in enumerate(value) if isinstance(item, dict)}
            names_in_list = _names_in(by_number)
            items = [(names_in_list.get(i, f"{name}.{i}"), item) for i, item in by_number.items()]
        for name_of_item, entries in items:
            inner = document.part(entries)
            try:
                lenses = _known(inner) if entries else None
            except InputError as refusal:
                lenses = [Lens("", "", {}, refusal)]
            if lenses is not None:
                beside = unread_beside(document.entries, name)
                if beside is not None and len(lenses) == 1 and not lenses[0].name:
                    reason = f"{beside} beside {name} may be its distortion: move it there"
                    lenses = [Lens("", "", {}, document.refusal(reason))]
                yield from ((f"{path}{name_of_item}", lens) for lens in lenses)
            elif depth > 1:
                yield from _inside(inner, depth - 1, f"{path}{name_of_item}.")


def _names_in(entries: dict[str, Any]) -> dict[str, str]:
    """Return the names that the entries of a list have inside, by number; {} unless each has its own."""
    is_list = [*entries] == [*map(str, range(len(entries)))]
    named = {number: mapping(entry) for number, entry in entries.items() if is_list}
    names = {number: entry.get(next(filter(entry.get, NAMES), "")) for number, entry in named.items()}
    texts = {number: name for number, name in names.items() if isinstance(name, str) and not name.isdecimal()}
    return texts if len({*texts.values()}) == len(entries) else {}


def _is_frame(name: str) -> bool:
    """Whether the last part of an entry's name is a number of a frame: serial numbers are longer, or begin with 0."""
    last = name.rpartition(".")[2]
    return last.isdecimal() and str(int(last)) == last and int(last) <= LAST_FRAME


def _named(inside: list[tuple[str, Lens]]) -> list[Lens]:
    """Return each lens once. Those of one name that differ are named by their entries, too, and so are equal ones that
    have only the names of their entries, which are no numbers as those of frames.
    """
    if len(inside) > 1 and not any(lens.name or _is_frame(entry) for entry, lens in inside):
        return [lens._replace(name=entry) for entry, lens in inside]
    different: dict[str, dict[str, tuple[str, Lens]]] = {}
    for entry, lens in inside:
        different.setdefault(lens.name, {}).setdefault(repr(lens[1:]), (entry, lens))
    lenses = []
    for name, by_entry in different.items():
        for entry, lens in by_entry.values():
            lenses.append(lens if len(by_entry) == 1 and (name or len(different) == 1) else
                          lens._replace(name=f"{entry} {name}".strip()))  # fmt: skip
    return lenses
