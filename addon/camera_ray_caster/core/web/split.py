"""A record of rays in two parts: what depends on settings alone, computed once, and what each pixel needs."""

from dataclasses import dataclass, replace

from ..maths.recording import Operation, Record, needed
from ..shaders.glsl import GlslWriter
from ..shaders.javascript import JavaScriptWriter
from ..shaders.writer import Term, Writer

INPUTS = 2
"""The pixel coordinates x and y."""
RAY = 6
"""Numbers of a ray: its origin and its direction."""


@dataclass(frozen=True)
class Parts:
    """Two records. ``first`` returns conditions and then the kept numbers; ``second`` takes x, y and these, and returns
    the RAY numbers of a ray, then others.
    """

    first: Record
    second: Record
    conditions: int
    """Number of conditions under which the record is that of the formula."""
    truths: tuple[bool, ...]
    """Of each kept number, whether it is a truth value."""


def split(record: Record, count: int) -> Parts:
    """Return the parts of a record of ``count`` numbers and conditions, as ``record_known`` makes it."""
    varying: set[int] = set()
    for index, step in enumerate(record.steps):
        if step.operation == "input" or not varying.isdisjoint(step.operands):
            varying.add(index)
    values, conditions = record.outputs[:count], record.outputs[count:]
    steps: list[Operation] = [Operation("input", fixed=(index,)) for index in range(INPUTS)]
    places: dict[int, int] = {}
    kept: dict[int, None] = {}

    def place_of(old: int) -> int:
        """Return the place in the second part of a step of the whole."""
        if old not in places:
            step = record.steps[old]
            if step.operation == "input":
                places[old] = step.fixed[0]
                return places[old]
            if old not in varying and step.operation != "constant":
                kept[old] = None
                step = Operation("input", fixed=(INPUTS + len(kept) - 1,), truth=step.truth)
            else:
                step = replace(step, operands=tuple(map(place_of, step.operands)))
            places[old] = len(steps)
            steps.append(step)
        return places[old]

    outputs = tuple(map(place_of, values))
    first = needed(record.steps, (*conditions, *kept))
    truths = tuple(record.steps[old].truth for old in kept)
    return Parts(first, needed(steps, outputs), len(conditions), truths)


@dataclass(frozen=True)
class Constants:
    """Numbers are written in the text; parameters are members of the object ``s``."""

    writer: type[Writer]

    def number(self, value: float) -> str:
        """Return the text of a constant."""
        return self.writer.literal(value)

    def named(self, name: str, value: float) -> str:
        """Return the text of a parameter."""
        return f's["{name}"]'


def functions(parts: Parts) -> dict[str, str]:
    """Return three functions: ``prepare(s)`` gives the kept numbers of settings, null where a condition does not hold;
    from these ``rays(k, x, y)`` gives the six numbers of a pixel's ray, NaN in the direction without a ray, and
    ``values(k, x, y)`` the other numbers.
    """
    first = JavaScriptWriter(Constants(JavaScriptWriter), _indent=" ")
    known = [term.text for term in first.write(parts.first, [])]
    conditions, kept = known[: parts.conditions], known[parts.conditions :]
    holds = " && ".join(conditions) or "true"
    made = {"prepare": ["(s) => {", *first.tables, *first.lines, f" return {holds} ? [{', '.join(kept)}] : null;", "}"]}
    for name, outputs in (("rays", parts.second.outputs[:RAY]), ("values", parts.second.outputs[RAY:])):
        writer = JavaScriptWriter(Constants(JavaScriptWriter), _indent=" ")
        inputs = [Term("x"), Term("y"), *(Term(f"k[{k}]") for k in range(len(kept)))]
        values = ", ".join(term.text for term in writer.write(needed(parts.second.steps, outputs), inputs))
        made[name] = ["(k, x, y) => {", *writer.tables, *writer.lines, f" return [{values}];", "}"]
    return {name: "\n".join(lines) for name, lines in made.items()}


def glsl(parts: Parts) -> tuple[str, set[str]]:
    """Return the function ``bool ray(float x, float y, out vec3 o, out vec3 d)`` in GLSL ES 3.0, and the helpers that
    it calls. It returns whether there is a ray; the kept numbers are its uniforms ``k``, 1 for true.
    """
    writer = GlslWriter(Constants(GlslWriter), _indent=" ")
    kept = [Term(f"(k[{k}] != 0.0)" if truth else f"k[{k}]") for k, truth in enumerate(parts.truths)]
    ray = writer.write(needed(parts.second.steps, parts.second.outputs[:RAY]), [Term("x"), Term("y"), *kept])
    none = writer.either(*(term.none for term in ray)) or writer.NO
    texts = [term.text for term in ray]
    return "\n".join((
        "bool ray(float x, float y, out vec3 o, out vec3 d) {", *writer.tables, *writer.lines,
        f" o = vec3({', '.join(texts[:3])});", f" d = vec3({', '.join(texts[3:])});", f" return !({none});", "}",
    )), writer.helpers  # fmt: skip
