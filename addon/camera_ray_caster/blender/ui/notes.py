"""Notes in panels: what is wrong with the camera's picture, each with what mends it.

In the sidebar they have a place of constant height, so that none of them moves a button under the mouse.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from .drawing import draw_message, width_of

UNIT = 20.0
"""Pixels of an interface unit at interface scale 1."""


class Note(NamedTuple):
    """A sentence, and a function that draws into a row what mends it."""

    text: str
    mend: Callable[[Any], object] | None = None
    icon: str = "ERROR"


def draw_notes(layout, context, notes: Iterable[Note]) -> None:
    """Draw each note, wrapped to the panel's width, and below it what mends it."""
    for note in notes:
        draw_message(layout, context, note.text, note.icon)
        if note.mend is not None:
            note.mend(layout.row(align=True))


def draw_first(layout, notes: list[Note], panel: str) -> None:
    """Draw two rows, whatever there is: the first note, which opens ``panel``, and what mends it."""
    if not notes:
        layout.label(text="No notes", icon="CHECKMARK")
        layout.label(text="")
        return
    first, text = notes[0], notes[0].text[:1].upper() + notes[0].text[1:]
    layout.popover(panel, text=text if len(notes) == 1 else f"{len(notes)} notes: {text}", icon=first.icon)
    if first.mend is None:
        layout.label(text="")
    else:
        first.mend(layout.row(align=True))


def widen(layout, context) -> None:
    """Let a popover be as wide as the region from which it is opened, to whose width sentences are wrapped."""
    layout.ui_units_x = width_of(context) / UNIT
