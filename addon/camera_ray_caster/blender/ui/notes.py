"""Notes and results in panels: what is wrong with the camera's picture, with what mends it; how an operator ended.

In the sidebar they have rows of a constant number, which open popovers with all of it: no button moves under the mouse.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from .drawing import capital, draw_message, width_of

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
    first, text = notes[0], capital(notes[0].text)
    draw_line(layout, text if len(notes) == 1 else f"{len(notes)} notes: {text}", panel, first.icon)
    if first.mend is None:
        layout.label(text="")
    else:
        first.mend(layout.row(align=True))


def draw_line(layout, text: str, panel: str, icon: str = "INFO", otherwise: str = "") -> None:
    """Draw one row, whatever there is: a text, which opens ``panel``, or without one what is said ``otherwise``."""
    if text:
        layout.popover(panel, text=text, icon=icon)
    else:
        layout.label(text=otherwise, icon="BLANK1")


class Popover:
    """Base of the panels that rows of the sidebar open."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_options = {"INSTANCED"}


def widen(layout, context) -> None:
    """Let a popover be as wide as the region from which it is opened, to whose width sentences are wrapped."""
    layout.ui_units_x = width_of(context) / UNIT
