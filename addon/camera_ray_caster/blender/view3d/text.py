"""Text on a dark background in a 3D View, as a table of two columns."""

import re
from collections.abc import Callable, Sequence

import blf
import gpu
from gpu_extras.batch import batch_for_shader

FONT = 0
"""Blender's identifier of the interface's font."""
SIZE = 12
"""Font size in pixels at interface scale 1."""
BREAK = re.compile(r"(?<!=)(?:(?<!\d,)\s+|\s+(?![-\d\s]))")
"""Where a line may end: not after "=", nor between two numbers."""


def write(
    context,
    lines: Sequence[tuple[str, str]],
    corner_for: Callable[[float, float], tuple[float, float]],
    size: float | None = None,
    corner: tuple[float, float] | None = None,
) -> None:
    """Write (name, text) lines; ``corner_for(width, height)`` returns the left and top of the text in the region.

    size: of the font in pixels; None for that of notices. corner: left and top of an opaque background; None for a
    transparent one around the text.
    """
    size = _set_size(context, size)
    longest = max(_width(name) for name, _ in lines)
    names = longest + size if longest else 0.0
    width, step = names + max(_width(text) for _, text in lines), 1.5 * size
    x, y = corner_for(width, step * len(lines))
    left, top = corner or (x - size, y + size / 2)
    _ground(left, x + width + size, y - step * len(lines) - size, top, 1.0 if corner else 0.78)
    for name, text in lines:
        y -= step
        for offset, color, word in ((0, 0.65, name), (names, 0.95, text)):
            blf.color(FONT, color, color, color, 1.0)
            blf.position(FONT, x + offset, y, 0)
            blf.draw(FONT, word)


def wrapped(context, sentence: str, width: float, size: float | None = None) -> list[str]:
    """Return a sentence as lines that are at most ``width`` pixels wide; a word that is wider has its own line. A line
    does not end between "=" and a value, nor between the numbers of a vector.
    """
    _set_size(context, size)
    lines: list[str] = []
    for word in BREAK.split(sentence.strip()):
        if lines and _width(f"{lines[-1]} {word}") <= width:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return lines


def uncovered(context) -> tuple[int, int]:
    """Return the left and right of the region's visible part in pixels: the toolbar and the sidebar may cover it."""
    region = context.region
    left, right = 0, region.width
    for other in context.area.regions:
        if other.type in ("TOOLS", "UI") and other.width > 1:
            start = other.x - region.x
            left, right = (left, min(right, start)) if start > 0 else (max(left, start + other.width), right)
    return left, right


def below_headers(context) -> int:
    """Return the top of the region's part that no header at its top covers, in pixels."""
    region = context.region
    top = region.height
    for other in context.area.regions:
        if other.type in ("HEADER", "TOOL_HEADER") and other.height > 1 and other.y > region.y + region.height / 2:
            top = min(top, other.y - region.y)
    return top


def _set_size(context, size: float | None) -> float:
    """Set the font's size in pixels, None for that of notices in this interface; return it."""
    size = size or SIZE * context.preferences.system.ui_scale
    blf.size(FONT, size)
    return size


def _width(text: str) -> float:
    return blf.dimensions(FONT, text)[0]


def _ground(left, right, bottom, top, alpha: float) -> None:
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    corners = ((left, bottom), (right, bottom), (left, top), (right, top))
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("color", (0.06, 0.06, 0.06, alpha))
    batch_for_shader(shader, "TRI_STRIP", {"pos": corners}).draw(shader)
    gpu.state.blend_set("NONE")
