"""The directions of a central model's rays as a function in GLSL, with the model's numbers beside the text.

The text depends on the model and on which terms its formula has, not on the values of its settings: a program that is
compiled from it serves while a setting is dragged.
"""

from dataclasses import dataclass, field

import numpy as np

from ..cameras.model import Model
from ..maths.recording import NotRecordable, Parameter, Record, record
from .camera_shader import named
from .glsl import GlslWriter
from .osl import LITERALS
from .writer import METHODS, Term, in_range

LONGEST_TABLE = 1024
"""Entries of the longest table that is written into a text."""


@dataclass(frozen=True)
class DirectionText:
    """A function ``bool direction(float x, float y, out vec3 d)``, which returns whether there is a ray, and values."""

    text: str
    values: np.ndarray
    """(n, 4) float32: the numbers that the text reads as ``kept.k[i]``, n vectors of four, at least one."""


@dataclass
class _Kept:
    """Numbers of a record that are read from ``kept``, in the order of their first use."""

    places: dict[str, int] = field(default_factory=dict)
    values: list[float] = field(default_factory=list)
    _count: int = 0

    def named(self, name: str, value: float) -> str:
        """Return the text that reads a parameter."""
        if name not in self.places:
            self.places[name] = len(self.values)
            self.values.append(in_range(value))
        index = self.places[name]
        return f"kept.k[{index // 4}].{'xyzw'[index % 4]}"

    def number(self, value: float) -> str:
        """Return the text of a constant, or the one that reads it."""
        self._count += 1
        return GlslWriter.literal(value) if abs(value) in LITERALS else self.named(f"c{self._count}", value)


class _MapWriter(GlslWriter):
    """Writer that refuses what would be too long or too slow for a fragment shader."""

    def table(self, entries) -> str:
        if len(entries) > LONGEST_TABLE:
            raise NotRecordable(f"a table of {len(entries)} entries is too long for a shader")
        return super().table(entries)


def ray_map(model: Model) -> DirectionText:
    """Return the directions of a model's rays as a text in GLSL and its numbers.

    Raises NotRecordable for a model whose formula has operations that GLSL cannot have, or long tables.
    """
    kept = _Kept()
    writer = _MapWriter(kept)
    made = _record(model)
    for step in made.steps:
        if step.operation in METHODS and not hasattr(writer, METHODS[step.operation]):
            raise NotRecordable(f"{step.operation} cannot be written in GLSL")
    outputs = writer.write(made, [Term("x"), Term("y")])
    none = writer.either(*(term.none for term in outputs)) or writer.NO
    text = "\n".join((
        *writer.helper_texts(), "bool direction(float x, float y, out vec3 d)", "{", *writer.tables, *writer.lines,
        f"    d = vec3({', '.join(term.text for term in outputs)});", f"    return !({none});", "}", "",
    ))  # fmt: skip
    count = max(1, -(-len(kept.values) // 4))
    values = np.zeros(4 * count, np.float32)
    values[: len(kept.values)] = kept.values
    return DirectionText(text, values.reshape(-1, 4))


def _record(model: Model) -> Record:
    """Return the record of the direction at x and y, the numbers of the model its parameters."""
    width, height = model.size
    named_model = named(model, size=(Parameter(width, "frame_width"), Parameter(height, "frame_height")))
    return record(lambda x, y: list(named_model.rays(x, y)[1]), 2)
