"""The reports of the latest render and of the latest verification, and the text datablock that shows one."""

import bpy
from bpy.app.handlers import persistent

from ...core.report.report import Report, as_lines

TEXT = "Camera Ray Caster Report"

_latest: list[Report] = []
_verified: list[Report] = []


def keep(report: Report) -> None:
    """Remember the report of the latest render; a render's thread may call it."""
    _latest[:] = [report]
    keep_verified(report)


def keep_verified(report: Report) -> None:
    """Remember what the latest verification found."""
    _verified[:] = [report]


def latest() -> Report | None:
    """Return the report of the latest render of this file, None before the first."""
    return _latest[0] if _latest else None


def verified() -> Report | None:
    """Return the report with the latest findings on this file's camera, None before the first."""
    return _verified[0] if _verified else None


def relative_error(report: Report, which: str) -> str:
    """Return in words the "median" or the "worst" bound of the distances' errors, in parts of the distance."""
    bound = getattr(report.accuracy, which)("relative_distance")
    return "nothing hit" if bound is None else f"≤ {bound:.0e}"


def write_text(report: Report):
    """Write a report into the text datablock TEXT and return it. Only the main thread may add datablocks."""
    text = bpy.data.texts.get(TEXT) or bpy.data.texts.new(TEXT)
    text.from_string("\n".join(as_lines(report)) + "\n")
    return text


@persistent
def forget(*_):
    """Another file is loaded: what was rendered before says nothing of it."""
    _latest.clear()
    _verified.clear()


def register(undo) -> None:
    """See ``registration``."""
    undo.callback(forget)
    bpy.app.handlers.load_pre.append(forget)
    undo.callback(bpy.app.handlers.load_pre.remove, forget)
