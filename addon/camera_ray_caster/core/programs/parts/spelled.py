"""The entries of a calibration under the names that people give them: in any case, with or without separators.

Each quantity has a list of names, the usual one first. A name may begin with that of the camera, as in Camera.fx or
left_fx, or a calibration may stand in a mapping of its own, as in intrinsics: {fx: ...}.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from reprlib import repr as shortened
from typing import Any

from ...cameras.parts.calibration import LARGEST
from ...records import InputError
from ...text_forms.content import flat
from .fields import Fields
from .lens import numbers_of

MATRIX = (
    "cameramatrix", "k", "m", "intrinsicmatrix", "mtx", "intrinsic", "intrinsics", "camk", "cameraintrinsics",
    "intrinsicsmatrix", "cammatrix", "kmatrix",
)  # fmt: skip
DISTORTION = (
    "distortioncoefficients", "distcoeffs", "distortion", "d", "distcoeff", "dist", "distortioncoeffs",
    "distortioncoeff", "coeffs", "distcoefs", "distcoef", "distortionparameters", "distcoefficients",
    "distortionparams",
)  # fmt: skip
FX, FY = ("fx", "flx", "focalx", "focallengthx", "fu"), ("fy", "fly", "focaly", "focallengthy", "fv")
CX = "cx", "ppx", "principalpointx", "centerx", "cu"
CY = "cy", "ppy", "principalpointy", "centery", "cv"
FOCAL, CENTER = ("focallength", "f", "focal"), ("principalpoint", "center", "imagecenter")
WIDTH = "imagewidth", "width", "w", "cols", "imgwidth", "imwidth"
HEIGHT = "imageheight", "height", "h", "rows", "imgheight", "imheight"
SIZE = "imagesize", "resolution", "imagedimension", "size", "imsize", "imgsize"
CONTAINERS = {
    *MATRIX, *DISTORTION, "camera", "cameraparameters", "calibration", "projectionparameters", "cameramodelparameters",
}  # fmt: skip
"""Names of mappings whose entries count as if they stood beside them."""

SIDES = ("1", "2"), ("left", "right"), ("l", "r")
"""What names of a pair's two cameras end in."""

PREFIX = re.compile(r"(.+?)[._\s-](?:fx|flx)", re.IGNORECASE)


def plain_name(name: str) -> str:
    """Return a name or a word in lower case, without separators."""
    return re.sub(r"[^a-z0-9]", "", name.lower())


class Spelled:
    """Entries by plain name, with the name and the value in the file. Raises InputError for two of the same name."""

    def __init__(self, entries: Fields):
        self.document = entries.document
        self.found = self._merged(entries.values)

    def _merged(self, entries: Mapping[str, Any]) -> dict[str, tuple[str, Any]]:
        found: dict[str, tuple[str, Any]] = {}
        for name, value in entries.items():
            plain = plain_name(name)
            inside = value if isinstance(value, dict) and "data" not in value and plain in CONTAINERS else {name: value}
            for own, one in inside.items():
                before = found.setdefault(plain_name(own), (own, one))
                if before[0] != own:
                    raise self.document.refusal(f"it has {before[0]} and {own}: leave one out")
                if before[1] is not one:
                    raise self.document.refusal(f"it has {own} twice, once in {name}: leave one out")
        return found

    def has(self, *quantities: Sequence[str]) -> bool:
        """Whether there is an entry under one of the names of these quantities."""
        return any(name in self.found for names in quantities for name in names)

    def sides(self) -> list[str]:
        """Return the ends of the names of a pair's cameras; [] for one camera."""
        for pair in SIDES:
            there = [side for side in pair if any(self._is_list(stem + side) for stem in MATRIX)]
            if there:
                return there
        return []

    def side(self, end: str) -> Spelled:
        """Return the entries of one camera of a pair, under the names of a single one."""
        own, stems = Spelled(Fields(self.document, {})), {*MATRIX, *DISTORTION}
        others = {stem + side for pair in SIDES if end in pair for side in pair for stem in stems}
        own.found = {name: one for name, one in self.found.items() if name not in others or not self._is_list(name)}
        own.found |= {stem: self.found[stem + end] for stem in stems if self._is_list(stem + end)}
        return own

    def _is_list(self, name: str) -> bool:
        return name in self.found and isinstance(self.found[name][1], list | dict)

    def numbers(
        self, names: Sequence[str], empty: Sequence[float] = (), default: Sequence[float] | None = None
    ) -> list[float]:
        """Return the numbers of the entry with one of these names; ``empty`` if it is an empty list, and ``default`` if
        there is none. Raises InputError if it is missing, not of numbers, or there twice with different values.
        """
        path, given = self.document.path, [self.found[name] for name in names if name in self.found]
        for name, value in given:
            if repr(flat(value, name, path)) != repr(flat(given[0][1], given[0][0], path)):
                raise InputError(f"calibration file {path!r}: {given[0][0]} and {name} differ: leave one out")
        if not given and default is not None:
            return list(default)
        if not given:
            raise InputError(f"{path!r} has no {names[0]} (known names, in any case: {', '.join(names)})")
        name, value = given[0]
        value = flat(value, name, path)
        numbers = list(empty) if empty and value == [] else numbers_of(value)
        if not numbers or not all(abs(one) <= LARGEST for one in numbers):
            limits = f"finite numbers, up to {LARGEST:g}"
            raise InputError(f"{name} in {path!r} is {shortened(given[0][1])}: it must be of {limits}")
        return numbers

    def number(self, names: Sequence[str], default: float | None = None) -> float:
        """Return the one number of an entry; see ``numbers``."""
        found = self.numbers(names, default=None if default is None else [default])
        if len(found) != 1:
            raise self.document.refusal(f"{self.found[next(filter(self.found.get, names))][0]} is not one number")
        return found[0]

    def size(self) -> tuple[float, float] | tuple[None, None]:
        """Return width and height of the picture; None and None if no entry tells them."""
        if self.has(WIDTH, HEIGHT):
            return self.number(WIDTH), self.number(HEIGHT)
        if not self.has(SIZE):
            return None, None
        found = self.numbers(SIZE)
        if len(found) != 2:
            raise self.document.refusal(f"its image size has {len(found)} numbers: it must be width and height")
        return found[0], found[1]


def cameras_of(entries: Fields) -> Iterator[tuple[str, Fields]]:
    """Yield each prefix that focal lengths have, without its separator, and the entries of its camera under their names
    without it; the prefix "" and all entries if there is none. Entries that have no prefix, or one without its number,
    belong to every camera: those of Camera.type to Camera1.fx.
    """
    prefixes = list(dict.fromkeys(found[1] for name in entries if (found := PREFIX.fullmatch(name))))
    if not prefixes or any(plain_name(name) in FX for name in entries):
        yield "", entries
        return
    for prefix in prefixes:
        stem = prefix.rstrip("0123456789")
        own: dict[str, Any] = {}
        for name, value in entries.values.items():
            before = next((one for one in (prefix, stem) if re.match(re.escape(one) + r"[._\s-]", name)), None)
            if before is not None:
                own[name[len(before) + 1 :]] = value
            elif not any(name.startswith(other) for other in prefixes):
                own.setdefault(name, value)
        yield prefix, Fields(entries.document, own)
