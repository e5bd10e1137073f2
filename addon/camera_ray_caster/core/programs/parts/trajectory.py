"""Lines of numbers: a pose each, with a time or without.

Names of the columns in a comment, or in the first line, tell what they are: the time and its unit, or the frame, the
place, and the quaternion or axis times angle; other columns are not read. Without names, lines of spaces have seconds,
x, y, z and the quaternion x, y, z, w; with commas nanoseconds, x, y, z, the quaternion w, x, y, z, and more that is not
read; both x, y, z and the quaternion x, y, z, w if they have no time. Semicolons count as commas.
"""

import re
from collections.abc import Iterable
from typing import NamedTuple

from ...arguments import shown
from .document import Document
from .lens import numbers_of
from .placed import Placed, of_quaternion, of_rotation

NANOSECONDS = 1e12
"""Times above it are in nanoseconds: as seconds it would be 30,000 years."""
LONGEST_STEP = 1000.0
"""Seconds between poses above which whole numbers without a unit may be of another unit."""
UNIT_LENGTH = 2e-3
"""Departure of a quaternion's squared length from 1: files have from 3 digits on."""

COLUMN = re.compile(
    r"(?P<frame>frame(?:_?(?:id|idx|index|nr|no|number))?)|(?P<time>%?u?(?:tracking_)?(?:time|timestamp|stamp|t|sec|secs|seconds|nsec|nsecs|nanoseconds)(?:_?(?:ns|nsec|us|ms|s|sec))?)|"
    r"(?P<turn>(?:.*(?:quat|orient|rot)\w*[._]|q[a-z_]*|rot[a-z_]*|r|o|rvec_?))(?P<turned>[wxyz])|"
    r"(?P<place>(?:.*(?:pos|transl)\w*[._]|p[a-z_]*|t(?:ransl[a-z_]*)?_?|))(?P<placed>[xyz])"
)  # fmt: skip
"""Names of columns: times, parts of rotations, and parts of places."""
UNITS = {"ns": 1e-9, "nsec": 1e-9, "nsecs": 1e-9, "nanoseconds": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0, "sec": 1.0,
         "secs": 1.0, "seconds": 1.0, "utime": 1e-6}  # fmt: skip
"""Seconds of the units in names of times."""
ANGLES = "roll", "pitch", "yaw"
WORLD = "_world_device"
"""End of the names of Project Aria's poses, which have others in other frames."""
NAMED = re.compile(r"[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12},")
"""Begin of lines with a unique identifier before the numbers."""
LONGEST_NAME = 100
"""Characters of a name of a column."""
LONGEST_LINE = 1 << 14
"""Number of letters of the first lines of a trajectory, whose other columns may be covariances."""
LEAST = 4
"""Known names from which on a line is taken for names of columns."""


class Columns(NamedTuple):
    """The numbers of the columns of a trajectory."""

    time: tuple[tuple[int, float | None], ...]
    """Columns whose sum is the time, with the seconds of their units; None of one that is not told."""
    position: tuple[int, ...]
    turn: tuple[int, ...]
    """w, x, y, z of the quaternion, or the three numbers of axis times angle."""
    frame: tuple[int, ...] = ()
    """The column of the frame, which counts if there is no time."""
    head: str = ""
    """The line that names them."""


SPACED, TIMELESS, IN_NANOSECONDS = (
    Columns(((0, None),), (1, 2, 3), (7, 4, 5, 6)), Columns((), (0, 1, 2), (6, 3, 4, 5)),
    Columns(((0, 1e-9),), (1, 2, 3), (4, 5, 6, 7)),
)  # fmt: skip


def rows_of(document: Document) -> list[list[str]]:
    """Return the words of the lines of numbers; [] of any other file."""
    return [_words(line) for line in lines_of(document)]


def lines_of(document: Document) -> list[str]:
    """Return the lines of numbers, without that of names; [] of any other file."""
    lines = document.lines()
    if any(len(line) > LONGEST_LINE for line in lines[:2]):
        return []
    if lines and not _is_number(lines[0]) and len(lines) > 1 and _named(lines[0], lines[1]):
        lines = lines[1:]
    if not lines or not _is_number(lines[0]) or (len(lines) == 5 and len(lines[2].split()) == 2):  # the last: OCamCalib
        return []
    return lines


def columns_of(document: Document) -> Columns | None:
    """Return the columns of a trajectory; None of any other file."""
    lines = lines_of(document)
    if not lines:
        return None
    first = _words(lines[0])
    named = _head(document, len(first))
    if named is not None:
        return named
    count, has_commas = len(first), _has_commas(lines[0])
    if count == 7 and _is_unit(map(_words, lines), slice(3, 7)):
        return TIMELESS
    if count < 8 or not all(numbers_of(word) or word.strip("-").lower() == "nan" for word in first[:8]):
        return None
    return IN_NANOSECONDS if has_commas else SPACED if count == 8 else None


def has_commas_in(document: Document) -> bool:
    """Whether the first line of numbers has commas."""
    return _has_commas(next(iter(lines_of(document)), ""))


def placed_in_lines(document: Document) -> list[Placed]:
    """Return the poses of a trajectory. Raises InputError."""
    columns, rows = columns_of(document), rows_of(document)
    if columns is None:
        raise document.refusal("it is no trajectory")
    _check(document, columns, rows)
    placed = []
    for number, row in enumerate(rows, 1):
        document.check()
        name = f"pose {number}"
        used = [*(index for index, _ in columns.time), *columns.position, *columns.turn, *columns.frame]
        if len(row) <= max(used) or (columns is not IN_NANOSECONDS and len(row) != len(rows[0])):
            document.numbers(row, name, len(rows[0]) if columns is not IN_NANOSECONDS else 8)  # raises
        values = dict(zip(used, document.numbers([row[index] for index in used], name, len(used)), strict=True))
        position, turn = [values[i] for i in columns.position], [values[i] for i in columns.turn]
        pose = (of_quaternion if len(turn) == 4 else of_rotation)(document, turn, position, name)
        if columns.time:
            time = sum(seconds(values[i], unit) for i, unit in columns.time)
            placed.append(Placed("", "", None, pose, time))
        else:
            frame = values[columns.frame[0]] if columns.frame else float(number)
            placed.append(Placed("", "", frame, pose, moves=True))
    return placed


def _check(document: Document, columns: Columns, rows: list[list[str]]) -> None:
    """Raise InputError if lines differ, or if the columns are not what they would be taken for."""
    lines = lines_of(document)
    apart = _has_commas(lines[0])
    odd = next((number for number, line in enumerate(lines, 1) if _has_commas(line) != apart), None)
    if odd is not None:
        raise document.refusal(f"pose {odd} is {shown(lines[odd - 1])}: all lines must have commas, or none")
    if columns.head and not (len(columns.position) == 3 and len(columns.turn) in (3, 4)):
        raise document.refusal(
            f"its columns are {shown(columns.head)}: they must be a time, x, y, z, and qx, qy, qz, qw or rx, ry, rz"
        )
    if columns is SPACED and not _is_unit(rows, slice(4, 8)) and _is_unit(rows, slice(1, 5)):
        raise document.refusal("of its 8 numbers the second to the fifth are a quaternion of length 1, not the last 4: "
                               "name the columns in the first line, such as # timestamp qw qx qy qz x y z")  # fmt: skip
    times = [row[columns.time[0][0]] for row in rows if columns.time and len(row) > columns.time[0][0]]
    if columns is IN_NANOSECONDS and "." in times[0]:
        raise document.refusal(
            f"its first time is {times[0]}, and not in whole nanoseconds as in .csv files: name the columns "
            "in the first line, such as #timestamp [s],x,y,z,qx,qy,qz,qw"
        )
    whole = columns.time and columns.time[0][1] is None and all(time.isdigit() for time in times)
    if apart and whole and len(times) > 1:
        step = (seconds(float(times[-1])) - seconds(float(times[0]))) / (len(times) - 1)
        if step > LONGEST_STEP:
            raise document.refusal(
                f"its times are {times[0]}, {times[1]} ...: tell their unit in the first line, such as timestamp [ns]"
            )


def _is_unit(rows: Iterable[list[str]], four: slice) -> bool:
    """Whether four numbers are of length 1 in all lines."""
    return all(abs(sum(number * number for number in numbers_of(row[four])) - 1) < UNIT_LENGTH for row in rows)


def seconds(value: float, unit: float | None = None) -> float:
    """Return a time in seconds; of a unit that is not told in seconds, or nanoseconds if it would be too long."""
    return value * (unit or 1.0) if unit or value <= NANOSECONDS else value / 1e9


def _words(line: str) -> list[str]:
    if not _has_commas(line):
        return line.split()
    return [word.strip(" \t\"'") for word in line.replace(";", ",").strip(" ,\t").split(",")]


def _has_commas(line: str) -> bool:
    return "," in line or ";" in line


def _is_number(line: str) -> bool:
    return bool(numbers_of(_words(line)[:1])) or NAMED.match(line) is not None


def _named(head: str, line: str) -> list[tuple[str, str]] | None:
    """Return name and unit of each column, if a line names those of another one."""
    words = _words(head) if _has_commas(head) else re.sub(r"\s+(?=[\[(])", "", head).split()
    count = len(_words(line))
    if len(max(words, key=len, default="")) > LONGEST_NAME:
        return None
    if len(words) != count or any(map(numbers_of, words)):
        return None
    names = []
    for word in words:
        name, _, unit = re.sub(r"[\])\s]", "", word.lower()).replace("(", "[").partition("[")
        name = name.split("field.")[-1].removeprefix("%").removeprefix("#")
        names.append((name.removesuffix(WORLD), unit))
    known = sum(COLUMN.fullmatch(name) is not None or name in ANGLES for name, _ in names)
    return names if known >= LEAST else None


def _head(document: Document, count: int) -> Columns | None:
    """Return the columns that the last line before the numbers names, if it does."""
    before: list[str] = []
    for line in document.text.splitlines():
        if line.strip() and _is_number(line):
            break
        before.append(line.strip().lstrip("#%/ "))
    for head in reversed(before):
        names = _named(head, ",".join("0" * count))
        if names is not None:
            return _by_names(names, head)
    return None


def _by_names(names: list[tuple[str, str]], head: str) -> Columns:
    time: list[tuple[int, float | None]] = []
    frame: tuple[int, ...] = ()
    turns: dict[str, int] = {}
    places: dict[str, int] = {}
    for index, (name, unit) in enumerate(names):
        match = COLUMN.fullmatch(name)
        if match is None:
            continue
        if match["frame"] is not None:
            frame = (index,)
        elif match["turned"] is not None:
            turns.setdefault(match["turned"], index)
        elif match["placed"] is not None:
            places.setdefault(match["placed"], index)
        elif not time or {name, names[time[-1][0]][0]} <= UNITS.keys():
            time.append((index, UNITS.get(unit or re.split(r"[_ ]|(?<=time|tamp)", name)[-1])))
    turn = tuple(turns[axis] for axis in ("wxyz" if "w" in turns else "xyz") if axis in turns)
    if any(name in ANGLES for name, _ in names):
        turn = ()
    position = tuple(places[axis] for axis in "xyz" if axis in places)
    return Columns(tuple(time), position, turn, () if time else frame, head)
