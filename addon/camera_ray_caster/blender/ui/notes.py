"""Notes in panels: problems with the camera's picture, each with a control that solves it; results of operators.

In the sidebar they take a constant number of rows, so that no button moves under the mouse. A row opens a popover with
the full text.
"""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from .drawing import BESIDE, ICON, capital, draw_message, lines_of, width_of

UNIT = 20.0
"""Pixels of an interface unit at interface scale 1."""


class Note(NamedTuple):
    """A sentence, and a function that draws a control that solves the problem into a row."""

    text: str
    mend: Callable[[Any], object] | None = None
    icon: str = "ERROR"


def draw_notes(layout, context, notes: Iterable[Note]) -> None:
    """Draw each note, wrapped to the panel's width, and its control below it."""
    for note in notes:
        draw_message(layout, context, note.text, note.icon)
        if note.mend is not None:
            note.mend(layout.row(align=True))


def draw_first(layout, context, notes: list[Note], panel: str) -> None:
    """Draw two rows in any case: the first note, which opens ``panel``, and its control, or the note's next words; a
    row may be empty.
    """
    if not notes:
        layout.label(text="No notes", icon="CHECKMARK")
        layout.label(text="")
        return
    first, text = notes[0], capital(notes[0].text)
    text = text if len(notes) == 1 else f"{len(notes)} notes: {text}"
    if first.mend is not None:
        draw_line(layout, context, text, panel, first.icon)
        first.mend(layout.row(align=True))
        return
    line, *continued = lines_of(text, _room(context), max_lines=2)
    layout.popover(panel, text=line, icon=first.icon)
    layout.label(text="".join(continued), icon="BLANK1")


def draw_line(layout, context, text: str, panel: str, icon: str = "INFO", otherwise: str = "") -> None:
    """Draw one row in any case: a text, which opens ``panel``, as many words as fit; or the text ``otherwise`` if it is
    empty.
    """
    if text:
        layout.popover(panel, text=lines_of(text, _room(context), max_lines=1)[0], icon=icon)
    else:
        layout.label(text=otherwise, icon="BLANK1")


def _room(context) -> float:
    """Return the width of a popover's text, between its icon and its arrow."""
    return width_of(context) - BESIDE - 2 * ICON


class Popover:
    """Base of the panels that rows of the sidebar open."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_options = {"INSTANCED"}


def widen(layout, context) -> None:
    """Let a popover be as wide as the region from which it is opened, to whose width sentences are wrapped."""
    layout.ui_units_x = width_of(context) / UNIT
