"""The entries of a calibration under the names that people give them: in any case, with or without separators.

Each quantity has a list of names, the usual one first. A name may begin with that of the camera, as in Camera.fx or
left_fx, or a calibration may stand in a mapping of its own, as in intrinsics: {fx: ...}.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from reprlib import repr as shortened
from typing import Any

from ...cameras.parts.calibration import LARGEST
from ...records import InputError
from ...text_forms.content import flat
from .fields import Fields
from .lens import numbers_of

MATRIX = (
    "cameramatrix", "k", "m", "intrinsicmatrix", "mtx", "intrinsic", "intrinsics", "camk", "cameraintrinsics",
    "intrinsicsmatrix", "cammatrix", "kmatrix", "cameramat",
)  # fmt: skip
DISTORTION = (
    "distortioncoefficients", "distcoeffs", "distortion", "d", "distcoeff", "dist", "distortioncoeffs",
    "distortioncoeff", "coeffs", "distcoefs", "distcoef", "distortionparameters", "distcoefficients",
    "distortionparams", "kc",
)  # fmt: skip
PHOTON_VISION = "cameraextrinsics"
"""What PhotonVision called the list of coefficients up to 2023."""
LISTED = "params", "parameters", "values", "coefficients", "coeffs", "data"
"""Names of the list of coefficients inside of a mapping of a distortion."""
FX, FY = ("fx", "flx", "focalx", "focallengthx", "fu"), ("fy", "fly", "focaly", "focallengthy", "fv")
CX = "cx", "ppx", "principalpointx", "centerx", "cu"
CY = "cy", "ppy", "principalpointy", "centery", "cv"
FOCAL, CENTER = ("focallength", "f", "focal", "fc"), ("principalpoint", "center", "imagecenter", "cc")
WIDTH = "imagewidth", "width", "w", "cols", "imgwidth", "imwidth", "widthpx", "resolutionx"
HEIGHT = "imageheight", "height", "h", "rows", "imgheight", "imheight", "heightpx", "resolutiony"
SIZE = (
    "imagesize", "resolution", "imagedimension", "size", "imsize", "imgsize", "framesize", "cameraresolution", "dim",
    "imageresolution", "imagedimensions", "imagedims", "calibsize", "calibrationsize", "imagesizewh", "sizewh", "wh",
)  # fmt: skip
SHAPE = "imageshape", "imgshape", "shape", "imagesizehw", "sizehw", "hw"
"""Names of a size that begins with the rows, as arrays of numpy have it."""
CONTAINERS = {
    *MATRIX, *DISTORTION, "radial", "tangential", "camera", "cameraparameters", "calibration", "projectionparameters",
    "cameramodelparameters",
}  # fmt: skip
"""Names of mappings whose entries count as if they stood beside them."""

SIDES = ("1", "2"), ("left", "right"), ("l", "r")
"""What names of a pair's two cameras end in; words also begin so."""

PREFIX = re.compile(r"(.+?)[._\s-](?:fx|flx)", re.IGNORECASE)


BEND = re.compile(r"dist(?!anc|rib)|coef|radial|tangent|kappa|aberration|barrel|^warp|polynom|lenscorr")
"""What names of distortions have."""
BEND_BESIDE = re.compile(
    BEND.pattern + r"|^k?[dk]c\d?$|^k[ds]$|^rd$|^poly$|^((lens|type|extra|fisheye|rad)?param(eter)?|value)s$|^d\d?$"
    r"|^(left|right)(d|kc)$|^(d|kc)(left|right|[lr])$"
)
"""What they have beside a camera matrix."""
TERM = re.compile(r"[kpsd]\d|tau[xy]|radial|tangential")
"""Names of what a mapping of a distortion has."""
INSIDE = "distortion."
"""What stands before other names in it, as no plain name begins."""
COEFFICIENT = re.compile(
    r"(.*(dist(ortion)?|lens|radial|tangential|coef\w*?|cam))?"
    r"(k|p|s|d|kappa|dist(ortion)?|radial|tangential|coeff?)[0-9]|.*distortion(value|amount|w|omega|lambda)?|"
    r"(lens)?(barrel|warp|aberration|correction)|omega|lambda|division"
)
"""Names of a distortion's coefficients."""
SHAPES = {"alpha", "beta"}, {"alpha", "xi"}
"""Names that are coefficients if both are there: of an extended unified model, and of a double sphere."""


def plain_name(name: str) -> str:
    """Return a name or a word in lower case, without separators."""
    return re.sub(r"[^a-z0-9]", "", name.lower())


def _in_distortion(name: str) -> str:
    """Return the name of an entry of a mapping of a distortion among those beside it."""
    if name in LISTED:
        return DISTORTION[0]
    if name in ("model", "type"):
        return f"distortion{name}"
    return name if TERM.fullmatch(name) or name in DISTORTION else f"{INSIDE}{name}"


def _may_bend(name: str, value: Any, bend: re.Pattern = BEND_BESIDE) -> bool:
    """Whether an entry may be a distortion that is not 0, by its name, or by the names of its entries."""
    if isinstance(value, dict) and "data" not in value:
        if bend.search(name):
            return any(_may_bend(INSIDE, coefficient) for coefficient in value.values())
        return not _is_camera(value) and any(
            _may_bend(plain_name(inner), coefficient, BEND) for inner, coefficient in value.items()
        )
    numbers = numbers_of(flat(value, name, ""))
    is_one = len(numbers) == 1 and not isinstance(value, list)
    return any(numbers) and (
        name.startswith(INSIDE) or (COEFFICIENT.fullmatch(name) if is_one else bend.search(name)) is not None
    )


def _on_side(stems: Collection[str], side: str) -> dict[str, str]:
    """Return the stem of each name of one camera of a pair."""
    before = {f"{side}{stem}": stem for stem in stems} if len(side) > 1 else {}
    return before | {f"{stem}{side}": stem for stem in stems}


class Spelled:
    """Entries by plain name, with the name and the value in the file. Raises InputError for two of the same name."""

    def __init__(self, entries: Fields):
        self.document = entries.document
        self.by_name = self._merged(entries.values)
        name, value = self.by_name.get(PHOTON_VISION, ("", None))
        if isinstance(value, dict) and 1 in [*numbers_of(value.get("rows")), *numbers_of(value.get("cols"))]:
            self.by_name[DISTORTION[0]] = name, self.by_name.pop(PHOTON_VISION)[1]

    def _merged(
        self, entries: Mapping[str, Any], depth: int = 3, containers: Collection[str] = CONTAINERS
    ) -> dict[str, tuple[str, Any]]:
        merged: dict[str, tuple[str, Any]] = {}
        for name, value in entries.items():
            plain = plain_name(name)
            if value is None:  # it is missing
                continue
            holds = depth and isinstance(value, dict) and "data" not in value and plain in containers
            inside = CONTAINERS.union(LISTED) if plain in DISTORTION else CONTAINERS
            inner_entries = self._merged(value, depth - 1, inside) if holds else {plain: (name, value)}
            if plain in DISTORTION:
                inner_entries = {_in_distortion(inner): inner_value for inner, inner_value in inner_entries.items()}
            for inner, (theirs, inner_value) in inner_entries.items():
                before = merged.setdefault(inner, (theirs, inner_value))
                if before[0] != theirs:
                    raise self.document.refusal(f"it has {before[0]} and {theirs}: leave one out")
                if before[1] is not inner_value:
                    raise self.document.refusal(f"it has {theirs} twice, once in {name}: leave one out")
        return merged

    def has(self, *quantities: Sequence[str]) -> bool:
        """Whether there is an entry under one of the names of these quantities."""
        return any(name in self.by_name for names in quantities for name in names)

    def has_list(self, *quantities: Sequence[str]) -> bool:
        """Whether there is an entry under one of these names; under a letter, which may be anything, only a list."""
        names = (name for names in quantities for name in names if name in self.by_name)
        return any(len(name) > 1 or self.is_list(name) for name in names)

    def sides(self) -> list[str]:
        """Return the ends of the names of a pair's cameras; [] for one camera."""
        for pair in SIDES:
            there = [side for side in pair if any(map(self.is_list, _on_side(MATRIX, side)))]
            if there:
                return there
        return []

    def side(self, end: str) -> Spelled:
        """Return the entries of one camera of a pair, under the names of a single one."""
        side_entries, stems = Spelled(Fields(self.document, {})), {*MATRIX, *DISTORTION}
        others = {name for pair in SIDES if end in pair for side in pair for name in _on_side(stems, side)}
        side_entries.by_name = {
            name: entry for name, entry in self.by_name.items() if name not in others or not self.is_list(name)
        }
        for name, stem in _on_side(stems, end).items():
            if self.is_list(name):
                side_entries.by_name[stem] = self.by_name[name]
        return side_entries

    def is_list(self, name: str) -> bool:
        """Whether there is a list or a matrix under a name."""
        value = self.by_name[name][1] if name in self.by_name else None
        return isinstance(value, list) or (isinstance(value, dict) and "data" in value)

    def numbers(
        self, names: Sequence[str], empty: Sequence[float] = (), default: Sequence[float] | None = None
    ) -> list[float]:
        """Return the numbers of the entry with one of these names; ``empty`` if it is an empty list, and ``default`` if
        there is none. Raises InputError if it is missing, not of numbers, or there twice with different values.
        """
        path, entries = self.document.path, [self.by_name[name] for name in names if name in self.by_name]
        for name, value in entries:
            if repr(flat(value, name, path)) != repr(flat(entries[0][1], entries[0][0], path)):
                raise InputError(f"calibration file {path!r}: {entries[0][0]} and {name} differ: leave one out")
        if not entries and default is not None:
            return list(default)
        if not entries:
            raise InputError(f"{path!r} has no {names[0]} (known names, in any case: {', '.join(names)})")
        name, value = entries[0]
        value = flat(value, name, path)
        numbers = list(empty) if empty and value == [] else numbers_of(value)
        if not numbers or not all(abs(number) <= LARGEST for number in numbers):
            limits = f"finite numbers, up to {LARGEST:g}"
            raise InputError(f"{name} in {path!r} is {shortened(entries[0][1])}: it must be of {limits}")
        return numbers

    def number(self, names: Sequence[str], default: float | None = None) -> float:
        """Return the one number of an entry; see ``numbers``."""
        values = self.numbers(names, default=None if default is None else [default])
        if len(values) != 1:
            raise self.document.refusal(f"{self.by_name[next(filter(self.by_name.get, names))][0]} is not one number")
        return values[0]

    def unread(self, known: Collection[str]) -> list[str]:
        """Return the names of entries that may be a distortion, are not known, and are not 0."""
        shapes = {name for names in SHAPES if self.by_name.keys() >= names for name in names}
        return [spelling for name, (spelling, value) in self.by_name.items() if name not in known and (
            _may_bend(INSIDE, value) if name in shapes else _may_bend(name, value))]  # fmt: skip

    def size(self) -> tuple[float, float] | tuple[None, None]:
        """Return width and height of the picture; None and None if no entry tells them."""
        if self.has(WIDTH, HEIGHT):
            return self.number(WIDTH), self.number(HEIGHT)
        if self.has(SHAPE) and not self.has(SIZE):
            height, width, *_ = (*self.numbers(SHAPE), 0.0)
            return width, height
        if not self.has(SIZE):
            return None, None
        sides = next(self.by_name[name][1] for name in SIZE if name in self.by_name)
        if isinstance(sides, dict) and "data" not in sides:
            return Spelled(Fields(self.document, sides)).size()
        between = re.fullmatch(r"(\d+)[ x,*]+(\d+)", sides) if isinstance(sides, str) else None
        sides_given = list(map(float, between.groups())) if between else self.numbers(SIZE)
        if len(sides_given) != 2:
            raise self.document.refusal(f"its image size has {len(sides_given)} numbers: it must be width and height")
        return sides_given[0], sides_given[1]


def unread_beside(entries: Fields, inner: str) -> str | None:
    """Return the name of an entry that may be a distortion, beside the mapping that has a calibration; None if none is.
    Another mapping with a calibration is another camera.
    """
    others = {name: value for name, value in entries.values.items() if name != inner and not isinstance(value, str)}
    bent = (name for name, value in others.items() if _may_bend(plain_name(name), value) and not _is_camera(value))
    return next(bent, None)


def _is_camera(value) -> bool:
    return isinstance(value, dict) and not {*map(plain_name, value)}.isdisjoint((*MATRIX, *FX, *FOCAL))


def cameras_of(entries: Fields) -> Iterator[tuple[str, Fields]]:
    """Yield each prefix that focal lengths have, without its separator, and the entries of its camera under their names
    without it; the prefix "" and all entries if there is none. Entries that have no prefix, or one without its number,
    belong to every camera: those of Camera.type to Camera1.fx.
    """
    prefixes = list(dict.fromkeys(match[1] for name in entries if (match := PREFIX.fullmatch(name))))
    if not prefixes or any(plain_name(name) in FX for name in entries):
        yield "", entries
        return
    for prefix in prefixes:
        stem = prefix.rstrip("0123456789")
        own_entries: dict[str, Any] = {}
        for name, value in entries.values.items():
            before = next((start for start in (prefix, stem) if re.match(re.escape(start) + r"[._\s-]", name)), None)
            if before is not None:
                own_entries[name[len(before) + 1 :]] = value
            elif not any(name.startswith(other) for other in prefixes):
                own_entries.setdefault(name, value)
        yield prefix, Fields(entries.document, own_entries)
