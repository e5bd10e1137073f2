"""Lecture mode of Step Through: a step of the latest pixel, large on the camera's picture."""

from ...core.lesson.lesson import Lesson
from . import text

SIZES = 2.4, 2.0, 1.6, 1.3, 1.0
"""Font sizes in units of the interface's text: the first at which all lines fit into the upper half of the view."""
MARGIN, BUTTONS = 3.0, 8.0
"""Distance of the text from the view's left and lower edges, and width of Blender's navigation buttons at the right
one, in lines of the interface's text.
"""


def write_step(context, lesson: Lesson, step: int) -> None:
    """Write a step, counted from 0, at the top of the region; lines that do not fit at the least size are left out."""
    every, preferences = lesson.screens, context.preferences
    step = min(step, len(every) - 1)
    title, lines = every[step]
    unit = preferences.ui_styles[0].widget.points * preferences.system.ui_scale
    left, right = text.uncovered(context)
    margin = MARGIN * unit
    top, width = text.below_headers(context) - unit, right - left - margin - BUTTONS * unit
    for size in SIZES:
        heading = f"{title} ({step + 1}/{len(every)})"
        rows = [row for line in (heading, *lines)
                for row in text.wrapped(context, line, width, size * unit)]  # fmt: skip
        if len(rows) * 1.5 * size * unit <= top - context.region.height / 2:
            break
    room = int((top - margin) / (1.5 * size * unit))
    rows = rows if len(rows) <= room else [*rows[: max(room - 1, 1)], "..."]
    corner = left, context.region.height  # in which Blender writes the names of the view and the object
    text.write(context, [("", row) for row in rows], lambda *_: (left + margin, top), size * unit, corner)
