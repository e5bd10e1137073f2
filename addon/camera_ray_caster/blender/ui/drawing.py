"""Helpers for drawing panels: wrapped sentences, table rows."""

from collections.abc import Collection, Iterable, Iterator
from functools import lru_cache
from textwrap import wrap
from typing import Any

import blf

FIELD_MARGIN = 20.0
"""Approximate margin on each side of a panel's fields, in pixels at interface scale 1."""
FONT_SIZE, LABELS, BESIDE = 11.0, 0.4, 56.0
"""Size of the interface's font, the part of a row that Blender gives to a label, and the width of a sidebar's tabs and
margins.
"""
TICK = 36.0
"""Width of a tick box with its margins, in pixels at interface scale 1."""
ICON = 24.0
"""Width of an icon, or of a popover's arrow, in pixels at interface scale 1."""
FEWEST = 16
"""Letters of a line in the narrowest region."""
LINES = 15
"""Number of lines in a column of a menu."""
NARROW = 280
"""Region width up to which a label next to its field would be cut off, in pixels at interface scale 1."""


class Sidebar:
    """Base of the panels in the 3D View's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ray Caster"


def width_of(context) -> float:
    """Return the width of the region in pixels at interface scale 1."""
    return context.region.width / (context.preferences.system.ui_scale or 1.0)  # the scale is 0 without a window


def put_labels(layout, context) -> None:
    """Put labels next to the fields, as Blender does, if the region is wide enough."""
    layout.use_property_split = width_of(context) > NARROW


def draw_field(layout, context, owner, name: str, label: str = ""):
    """Draw a property with a label, by default its name, and return the layout of its field. Without
    ``use_property_split``, or if its column is too narrow for the label, give the label the width that it needs, up to
    60 percent of the row.
    """
    kind = owner.bl_rna.properties[name]
    label = label or kind.name
    room = label_room(width_of(context), kind.type == "BOOLEAN")
    if layout.use_property_split and text_width(label) > room:
        layout = layout.row()
        layout.use_property_split = False
    if layout.use_property_split or kind.type in {"BOOLEAN", "FLOAT", "INT"}:  # Blender labels these
        row = layout.row(align=True)
        row.prop(owner, name, text=label)
        return row
    room = (text_width(label) + FIELD_MARGIN) / max(width_of(context) - 2 * FIELD_MARGIN, 1.0)
    row = layout.split(factor=min(room, 0.6), align=True)
    row.label(text=label)
    row = row.row(align=True)
    row.prop(owner, name, text="")
    return row


def text_width(text: str) -> float:
    """Return the width of a text in a panel, in pixels at interface scale 1."""
    blf.size(0, FONT_SIZE)
    return blf.dimensions(0, text)[0]


def label_room(width: float, is_tick: bool = False) -> float:
    """Return the width of the column of labels in a sidebar of this width, or what a tick box leaves of the column of
    fields, in pixels at interface scale 1.
    """
    return (1 - LABELS) * (width - BESIDE) - TICK if is_tick else LABELS * (width - BESIDE)


def draw_message(layout, context, text: str, icon: str = "INFO") -> None:
    """Draw a sentence, wrapped to the panel's width, with a capital first letter; leave a formula as it is."""
    text = capital(text)
    column = layout.column(align=True)
    column.scale_y = 0.85
    for i, line in enumerate(lines_of(text, width_of(context) - BESIDE - ICON)):
        column.label(text=line, icon="BLANK1" if i else icon)


@lru_cache(1000)
def lines_of(text: str, width: float, max_lines: int | None = None) -> list[str]:
    """Return a text as lines that fit a width in pixels at interface scale 1: at most so many, then the last one ends
    in "..." where words are left out.
    """
    usual = int(len(text) * width / max(text_width(text), 1.0))
    for letters in range(usual + 8, FEWEST, -1):  # lines of narrow letters have some more
        lines = wrap(text, letters, max_lines=max_lines, placeholder=" ...")
        if all(text_width(line) <= width for line in lines):
            return lines
    return wrap(text, FEWEST, max_lines=max_lines, placeholder=" ...")


def capital(text: str) -> str:
    """Return a sentence with a capital first letter; a formula as it is."""
    return text if text[1:4] == " = " else text[:1].upper() + text[1:]


def in_columns(layout, groups: Iterable[tuple[str, Collection]]) -> Iterator[tuple[Any, Collection]]:
    """Yield the column of a menu in which each group is drawn, below its title, with the group's entries."""
    row, free = layout.row(), 0
    for title, entries in groups:
        if len(entries) >= free:
            column, free = row.column(), LINES
        free -= len(entries) + 1
        column.label(text=title)
        yield column, entries


def draw_row(layout, name: str, cells, factor: float) -> None:
    """Draw a table row: its name, then its cells in columns of equal width."""
    row = layout.split(factor=factor, align=True)
    row.label(text=name)
    row = row.split(align=True)
    for cell in cells:
        column = row.column(align=True)
        column.alignment = "RIGHT"
        column.label(text=cell)
