"""A record of a formula, written as statements of the Open Shading Language (OSL).

OSL has no NaN: a division by zero gives 0 there, and so does the root of a negative number. All numbers are float32.
Reference: Open Shading Language 1.14, Language Specification, chapters 5 and 7.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from ..maths.recording import Entries, Operation
from .table_textures import FIRST_ROW, MOST_IN_TEXT, WIDE, texture_of
from .writer import C_ABSENT, C_FUNCTIONS, C_HELPERS, Term, Writer, in_range

LITERALS = frozenset((0.0, 0.5, 1.0, 2.0, 3.0, 4.0, math.pi / 2, math.pi, 2 * math.pi, math.inf))
"""Constants that are written in the text, as are their negatives: they belong to the formula and are not settings."""


@dataclass
class OslWriter(Writer):
    """Writer of the statements of a shader."""

    TRUTH: ClassVar[str] = "int"
    NO: ClassVar[str] = "0"
    YES: ClassVar[str] = "1"
    TO_NUMBER: ClassVar[str] = "{}"
    TO_INDEX: ClassVar[str] = "(int){}"
    FUNCTIONS = C_FUNCTIONS | {"absolute": "fabs({})"}
    ABSENT = {name: text.replace("abs(", "fabs(") for name, text in C_ABSENT.items()}
    HELPERS = C_HELPERS | {"cos": C_HELPERS["cos"].replace("abs(", "fabs(")}

    folder: str = ""
    """The folder of textures."""
    textures: dict[str, np.ndarray] = field(default_factory=dict)
    """Images of tables that are too long for the text, by the paths of their files: see ``table_textures``."""
    _names: dict[tuple, str] = field(default_factory=dict)
    _files: dict[str, tuple[str, int]] = field(default_factory=dict)
    _texels: dict[tuple, str] = field(default_factory=dict)
    """Names of the colors that were read, by texture and place."""

    def table_text(self, name: str, entries: Sequence[float]) -> str:
        """See Writer. Cycles cannot pass arrays to the inputs of a shader."""
        return f"    float {name}[{len(entries)}] = {{{', '.join(map(self.literal, entries))}}};"

    def _take(self, step: Operation, operands: list[Term], inputs) -> Term:
        """Write a look-up; in a large table as a texel, of which several columns of the table are the channels."""
        (index,), (entries,) = operands, step.fixed
        if not isinstance(entries, Entries) or len(entries) <= MOST_IN_TEXT:
            return super()._take(step, operands, inputs)
        name, channel = self._texture(entries), entries.column % 3
        if (name, index.text) not in self._texels:
            file, high = self._files[name]
            row = self.put("float", f"floor({index.text} / {WIDE}.0)")
            s, t = f"({index.text} - {row} * {WIDE}.0 + 0.5) / {WIDE}.0", f"({row} + 1.5) / {high}.0"
            read = f'texture("{file}", {s}, fabs({name}_turned - {t}), "interp", "closest")'
            self._texels[name, index.text] = self.put("color", read)
        text = self.put("float", f"{self._texels[name, index.text]}[{channel}]")
        return Term(text, self.either(index.none, f"{name}_none"))

    def _texture(self, entries: Entries) -> str:
        """Write the reading of the mark of a table's texture, unless it exists; return the texture's name."""
        key = id(entries.table), entries.column // 3
        if key not in self._names:
            file, image = texture_of(entries)
            path, high, name = f"{self.folder}/{file}", len(image), f"texture{len(self._names) + 1}"
            self._names[key], self._files[name], self.textures[path] = name, (path, high), image
            self.tables += [
                f'    color {name} = texture("{path}", {0.5 / WIDE}, {0.5 / high}, "interp", "closest");',
                f"    int {name}_none = fabs({name}[1] - {FIRST_ROW[1]}) > 0.01;",
                f"    float {name}_turned = {name}[0] > {FIRST_ROW[1]} ? 1.0 : 0.0;",
            ]
        return self._names[key]


@dataclass
class Inputs:
    """The shader's inputs that stand for constants of a record, in the order of their first use.

    A constant with a name is an input of that name. An unnamed constant is written in the text if it is one of
    LITERALS; otherwise it is an input named after its place among the constants. The ``places`` are inputs in any case.
    """

    places: frozenset[int] = frozenset()
    values: dict[str, float] = field(default_factory=dict)
    used: set[int] = field(default_factory=set)
    """Places of the unnamed constants that are inputs."""
    _count: int = 0

    def named(self, name: str, value: float) -> str:
        """Set the value of an input; return its name."""
        self.values[name] = in_range(value)
        return name

    def number(self, value: float) -> str:
        """Return the text of a constant: its literal, or the name of its input."""
        self._count += 1
        index = self._count
        if abs(value) in LITERALS and index not in self.places:
            return OslWriter.literal(value)
        self.used.add(index)
        return self.named(f"c{index}", value)
