"""The reports of the latest render and verification, and the text datablock that shows a report."""

from textwrap import shorten

import bpy
from bpy.app.handlers import persistent

from ...core.report.report import Report, as_lines

TEXT = "Camera Ray Caster Report"
NAMES_WIDTH = 60
"""Maximum number of characters for the names of left-out objects in a line."""

_latest: list[Report] = []
_verified: list[Report] = []


def keep(report: Report) -> None:
    """Remember the report of the latest render. It may be called on a render's thread."""
    _latest[:] = [report]
    keep_verified(report)


def keep_verified(report: Report) -> None:
    """Remember the report of the latest verification."""
    _verified[:] = [report]


def latest() -> Report | None:
    """Return the report of the latest render of this file, or None before the first."""
    return _latest[0] if _latest else None


def verified() -> Report | None:
    """Return the report with the latest findings on this file's camera, or None before the first."""
    return _verified[0] if _verified else None


def relative_error(report: Report, which: str) -> str:
    """Return the "median" or "worst" error bound of the distances as text, relative to the distance."""
    bound = getattr(report.accuracy, which)("relative_distance")
    return "nothing hit" if bound is None else f"≤ {bound:.0e}"


def by_reason(report: Report) -> dict[str, list[str]]:
    """Return the names of the left-out objects, by reason."""
    names: dict[str, list[str]] = {}
    for name, reason in report.left_out:
        names.setdefault(reason, []).append(name)
    return names


def left_out_count(left_out) -> str:
    """Return the number of left-out objects in words, or "" if there are none."""
    count = len({name for name, _ in left_out})
    return f"{count} {'object' if count == 1 else 'objects'} left out" if count else ""


def left_out_line(left_out) -> str:
    """Return the number of left-out objects in words, with their names, shortened to fit a line."""
    names = shorten(", ".join(dict.fromkeys(name for name, _ in left_out)), NAMES_WIDTH, placeholder=" ...")
    return f"{left_out_count(left_out)}: {names}" if names else ""


def write_text(report: Report):
    """Write a report into the text datablock TEXT and return it. Only the main thread may add datablocks."""
    text = bpy.data.texts.get(TEXT) or bpy.data.texts.new(TEXT)
    text.from_string("\n".join(as_lines(report)) + "\n")
    return text


@persistent
def forget(*_):
    """Forget the reports: another file is loaded, and they do not apply to it."""
    _latest.clear()
    _verified.clear()


def register(undo) -> None:
    """Register this module; see ``registration``."""
    undo.callback(forget)
    bpy.app.handlers.load_pre.append(forget)
    undo.callback(bpy.app.handlers.load_pre.remove, forget)
