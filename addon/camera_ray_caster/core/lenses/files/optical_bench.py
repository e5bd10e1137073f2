"""Lens files of the Optical Bench (.txt): sections in brackets, columns between tabs.

Rows of [lens data] are name, radius, distance behind, n_d, clear DIAMETER (whatever the heading says), Abbe number and
glass. AS is the stop, FS a flare stop, CG a cover glass; a plane has an infinite radius or 0. A distance may be a name
of [variable distances], which has one column for each state of a zoom or of the focus. [aspherical data] has name,
radius, k and A4, A6 ...; with AsphericalA2 in [constants] they begin with A2, with AsphericalOddCount they are A3, A4,
A5 ...
"""

from math import inf, isfinite

from ...records import InputError
from ..prescription import Prescription, Row

STOP = "AS"
CLAIMS = {"Focal Length": "focal_length", "F-Number": "f_number", "Bf": "back_focus"}
"""Rows of [variable distances] that state what the lens is."""


def recognizes(text: str, path: str) -> bool:
    """Return whether a text has the section [lens data]."""
    return "[lens data]" in text.lower()


def read(text: str, name: str) -> Prescription:
    """Return the lens. Raises InputError, which names the row, for what is no number, and for a lens without a stop."""
    sections: dict[str, list[list[str]]] = {}
    rows: list[list[str]] = []
    for line in text.splitlines():
        if line.startswith("["):
            rows = sections.setdefault(line.strip("[] \t").lower(), [])
        elif line.strip() and not line.startswith("#"):
            rows.append([word.strip() for word in line.split("\t")])
    variable = {row[0]: row[1:] for row in sections.get("variable distances", []) if len(row) > 1}
    constants = {row[0] for row in sections.get("constants", [])}
    aspheres = {row[0]: row for row in sections.get("aspherical data", [])}
    states = max((len(values) for values in variable.values()), default=1)
    surfaces, gaps, stops = [], [], []
    for number, row in enumerate(sections.get("lens data", [])):
        label, radius, gap, index, diameter, abbe = [*row, *[""] * 6][:6]
        if label == STOP:
            stops.append(number)
        gaps.append([_gap(gap, variable, state, label) for state in range(states)])
        curvature = _curvature(radius, label)
        conic, powers = _asphere(aspheres.get(label), constants)
        rim = _number(diameter, label, "diameter") / 2 if diameter else inf
        dispersion = _number(abbe, label, "Abbe number") if abbe and index else inf
        medium = _number(index, label, "index") if index else 1.0
        surfaces.append(Row(curvature, gaps[-1][0], medium, rim or inf, conic, powers, dispersion or inf, label=label))
    if len(stops) != 1:
        raise InputError(f"it has {len(stops)} rows {STOP}: one must be the stop")
    changing = [number for number, of_row in enumerate(gaps) if len(set(of_row)) > 1]
    configurations = tuple(
        (str(state), tuple((number, gaps[number][state]) for number in changing)) for state in range(states)
    )
    descriptive = {row[0].lower(): row[1] for row in sections.get("descriptive data", []) if len(row) > 1}
    stated = {known: variable[key][0] for key, known in CLAIMS.items() if key in variable}
    claims = {known: float(word) for known, word in stated.items() if _is_finite(word)}
    source = descriptive.get("patent", "") or descriptive.get("author", "")
    title = descriptive.get("title", name)
    return Prescription(tuple(surfaces), stops[0], title, source, 1.0, claims, configurations if changing else ())


def _is_finite(word: str) -> bool:
    try:
        return isfinite(float(word))
    except ValueError:
        return False


def _number(word: str, label: str, quantity: str) -> float:
    try:
        return float(word)
    except ValueError as error:
        raise InputError(f"row {label!r} has the {quantity} {word[:20]!r}: it must be a number") from error


def _curvature(word: str, label: str) -> float:
    if word.lower().strip("-+") in ("", "infinity", "inf", "undefined"):
        return 0.0
    radius = _number(word, label, "radius")
    return 1 / radius if radius else 0.0


def _gap(word: str, variable: dict[str, list[str]], state: int, label: str) -> float:
    if word in variable:
        values = variable[word]
        return _number(values[min(state, len(values) - 1)], label, "distance")
    return _number(word, label, "distance") if word else 0.0


def _asphere(row: list[str] | None, constants: set[str]) -> tuple[float, tuple[tuple[int, float], ...]]:
    """Return the conic constant and the powers of the radius with their coefficients."""
    if row is None:
        return 0.0, ()
    numbers = [_number(word, row[0], "coefficient") if word else 0.0 for word in row[2:]]
    first, step = (2, 2) if "AsphericalA2" in constants else (3, 1) if "AsphericalOddCount" in constants else (4, 2)
    powers = [(first + step * k, value) for k, value in enumerate(numbers[1:])]
    return (numbers[0] if numbers else 0.0), tuple((power, value) for power, value in powers if value)
