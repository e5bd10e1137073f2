"""Lens files of Zemax OpticStudio (.zmx): blocks SURF, the first the object, the last the image.

CURV is 1 / radius, DISZ the distance behind, DIAM a SEMI-diameter (0: unknown), GLAS the name of a glass, a flag, and
n_d and V_d. With flag 1 (a model glass) n_d and V_d are the glass's. After the name of a catalog glass 1.5 and 40 are
placeholders: such a glass must be known here by name. EVENASPH has PARM 1, 2 ... for r^2, r^4 ... The text is UTF-16.
Surfaces that are no centered refracting ones (coordinate breaks, mirrors, gratings ...) are refused by their number.
"""

from math import inf

from ...records import InputError
from ..prescription import Prescription, Row

UNITS = {"MM": 1.0, "CM": 10.0, "IN": 25.4, "METER": 1000.0, "M": 1000.0}
"""Millimeters of the file's unit."""

PLACEHOLDER = 1.5, 40.0
"""n_d and V_d that a file has where a catalog has the glass."""

GLASSES = {
    "N-BK7": (1.5168, 64.17), "BK7": (1.5168, 64.17), "N-SF11": (1.78472, 25.68), "SF11": (1.78472, 25.76),
    "N-SK16": (1.62041, 60.32), "SK16": (1.62041, 60.32), "F2": (1.62004, 36.37), "N-F2": (1.62005, 36.43),
    "N-LAK8": (1.713, 53.83), "N-SF6": (1.80518, 25.36), "SF6": (1.80518, 25.43), "N-BAF10": (1.67003, 47.11),
    "N-SF5": (1.67271, 32.25), "SF5": (1.6727, 32.21), "N-LASF9": (1.85025, 32.17), "N-SSK5": (1.65844, 50.88),
    "N-K5": (1.52249, 59.48), "N-SK2": (1.60738, 56.65), "N-LAF2": (1.74397, 44.85), "N-FK51A": (1.48656, 84.47),
    "N-SSK2": (1.62229, 53.27), "N-SSK8": (1.61773, 49.83), "N-LAK7": (1.6516, 58.52), "N-LAK9": (1.691, 54.71),
    "N-LAK10": (1.72003, 50.62), "N-LAK12": (1.6779, 55.2), "N-LAK14": (1.6968, 55.41), "N-LAK21": (1.64049, 60.1),
    "N-LAK22": (1.65113, 55.89), "N-SK4": (1.61272, 58.63), "N-SK5": (1.58913, 61.27), "N-SK10": (1.62278, 56.98),
    "N-SK11": (1.56384, 60.8), "N-SK14": (1.60311, 60.6), "N-SK15": (1.62296, 58.02), "SF1": (1.71736, 29.51),
    "N-SF1": (1.71736, 29.62), "SF2": (1.64769, 33.85), "SF4": (1.7552, 27.58), "N-SF4": (1.75513, 27.38),
    "N-SF8": (1.68894, 31.31), "N-SF10": (1.72828, 28.53), "SF15": (1.69895, 30.07), "N-SF15": (1.69892, 30.2),
    "N-SF57": (1.84666, 23.78), "SF57": (1.84666, 23.83), "F5": (1.60342, 38.03), "N-PSK3": (1.55232, 63.46),
    "N-BASF2": (1.66446, 36), "N-BAK1": (1.5725, 57.55), "N-BAK2": (1.53996, 59.71), "N-BAK4": (1.56883, 55.98),
    "N-BALF4": (1.57956, 53.87), "N-BAF4": (1.60568, 43.72), "N-KF9": (1.52346, 51.54), "N-LAF7": (1.7495, 34.82),
    "N-LAF21": (1.788, 47.49), "N-LASF31A": (1.883, 40.76), "N-LASF44": (1.8042, 46.5), "N-PK51": (1.52855, 76.98),
    "N-KZFS4": (1.61336, 44.49), "LLF1": (1.54814, 45.75), "LF5": (1.58144, 40.85),
    "SILICA": (1.45846, 67.82), "F_SILICA": (1.45846, 67.82), "CAF2": (1.43385, 95.23), "PMMA": (1.49176, 57.44),
}  # fmt: skip
"""n_d and V_d of glasses that files name without numbers; Schott, optical glass data sheets."""


def recognizes(text: str, path: str) -> bool:
    """Return whether a text has blocks of surfaces."""
    lines = {line.split()[0] for line in text.splitlines()[:4000] if line.split()}
    return {"SURF", "CURV", "DISZ"} <= lines


def read(text: str, name: str) -> Prescription:
    """Return the lens. Raises InputError, which names the surface, for one that is no centered refracting surface."""
    blocks: list[dict[str, list[str]]] = []
    head: dict[str, list[str]] = {}
    for line in text.splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "SURF":
            blocks.append({"SURF": words[1:]})
        elif blocks and line[0].isspace():
            key = f"PARM {words[1]}" if words[0] == "PARM" and len(words) > 2 else words[0]
            blocks[-1].setdefault(key, words[2:] if key != words[0] else words[1:])
        elif not blocks:
            head.setdefault(words[0], words[1:])
    unit = UNITS.get(head.get("UNIT", ["MM"])[0].upper(), 0.0)
    if not unit:
        raise InputError(f"its unit is {head['UNIT'][0]!r}: it must be one of {', '.join(UNITS)}")
    rows: list[Row] = []
    stop = None
    for number, block in enumerate(blocks[1:-1], 1):
        if "STOP" in block:
            stop = len(rows)
        rows.append(_row(block, number, unit))
    if stop is None:
        raise InputError("no surface is the stop (STOP)")
    title = " ".join(head.get("NAME", [])) or name
    return Prescription(tuple(rows), stop, title, " ".join(head.get("NOTE", [])[1:]))


def _row(block: dict[str, list[str]], number: int, unit: float) -> Row:
    kind = block.get("TYPE", ["STANDARD"])[0].upper()
    glass = block.get("GLAS", [])
    if kind not in ("STANDARD", "EVENASPH") or (glass and glass[0].upper() == "MIRROR"):
        kind = "MIRROR" if kind in ("STANDARD", "EVENASPH") else kind
        raise InputError(f"surface {number} is a {kind}: only centered surfaces that refract are read")
    entries = "CURV", "DISZ", "DIAM", "CONI"
    curvature, gap, rim, conic = (_number(block.get(key, ["0"])[0], number, key) for key in entries)
    powers = []
    for order in range(1, 9 if kind == "EVENASPH" else 1):
        value = _number((block.get(f"PARM {order}") or ["0"])[0], number, f"PARM {order}")
        if value:
            powers.append((2 * order, value * unit ** (1 - 2 * order)))
    index, abbe = _glass(glass, number) if glass else (1.0, inf)
    if gap == inf:
        raise InputError(f"surface {number} has an infinite distance behind it: it must be finite")
    return Row(curvature / unit, gap * unit, index, rim * unit or inf, conic, tuple(powers), abbe, label=str(number))


def glass_of(name: str, problem: str, entries: str) -> tuple[float, float]:
    """Return n_d and V_d of a glass by its name. Raises InputError, with what its surface has and the entries that tell
    them, for one that is not known.
    """
    if name.upper() not in GLASSES:
        raise InputError(f"{problem} without its index: give {entries}")
    return GLASSES[name.upper()]


def _glass(words: list[str], number: int) -> tuple[float, float]:
    numbers = [_number(word, number, "GLAS") for word in words[1:5]]
    flag = numbers[0] if numbers else 0.0
    constants = (numbers[2], numbers[3]) if len(numbers) == 4 else PLACEHOLDER
    if flag == 1 or (constants != PLACEHOLDER and constants[0] > 1):
        return constants[0], constants[1] if constants[1] > 0 else inf
    return glass_of(words[0], f"surface {number} has the glass {words[0]!r}", "n_d and V_d in its place")


def _number(word: str, number: int, quantity: str) -> float:
    if word.upper() == "INFINITY":
        return inf
    try:
        return float(word)
    except ValueError as error:
        raise InputError(f"surface {number} has the {quantity} {word[:20]!r}: it must be a number") from error
