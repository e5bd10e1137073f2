"""Settings of a camera made in Python that only make sense with others: what is left out, and what has no effect.

The rules stand beside the settings that they are about: ``partner``, ``left_out`` and ``used_with`` of ``Setting``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..cameras.parts.calibration import FILE, SIZE
from ..cameras.parts.left_out import DECLARED, MIDDLE, NEEDED, OF_FRAME, SAME
from ..cameras.parts.settings import Coefficients, Setting
from ..records import InputError

Settings = Mapping[str, Setting]
Values = Mapping[str, Any]


def completed(model: str, declared: Settings, given: Values, frame: tuple[int, int]) -> dict[str, Any]:
    """Return the settings that follow from those given, by name, for a picture of ``frame`` = (width, height) pixels.

    declared: the settings of the model, whose key is ``model``; given: values as records hold them. A calibrated
    picture of which no number is given is the declared one, scaled to the frame's longer side, with square pixels.
    Raises InputError for half of a pair that makes no sense alone, and for a setting that would have no effect.
    """
    if given.get(FILE.name):
        return {}
    values: dict[str, Any] = {}
    for name in given:
        if name in declared:
            check_effect(model, declared, given, declared[name])
    for one in declared.values():
        if one.name in given or one.partner not in given or not _has_effect(declared, given, one):
            continue
        if one.left_out != SAME:
            raise InputError(f"{model} has {one.partner} without {one.name}: give both")
        values[one.name] = given[one.partner]
    if SIZE[0].name not in declared or not _has_effect(declared, given, SIZE[0]):
        return values
    picture = {
        name: one
        for name, one in declared.items()
        if (one.left_out != DECLARED or getattr(one, "unit", "") == "pixels") and _has_effect(declared, given, one)
    }
    stated = [name for name in picture if name in given]
    if not stated:
        return _default_lens(picture, frame)
    size = [given.get(side.name) or own for side, own in zip(SIZE, frame, strict=True)]
    middles = iter(size)
    for name, one in picture.items():
        if one.left_out in (SAME, NEEDED) and name not in given and name not in values:
            raise InputError(f"{model} has {stated[0]} without {name}: give {name}, too")
        if one.left_out == OF_FRAME:
            values[name] = size[SIZE.index(one)]
        elif one.left_out == MIDDLE:
            values[name] = (next(middles) - 1) / 2
    return {name: value for name, value in values.items() if name not in given}


def check_effect(model: str, declared: Settings, given: Values, setting: Setting) -> None:
    """Raise InputError for a setting that has no effect, unless its value is the default."""
    for name, value in setting.used_with:
        is_other = name in declared and given.get(name, declared[name].default) != value
        if is_other and given[setting.name] != setting.default:
            raise InputError(f"{setting.name} of {model} has no effect unless {name} is {value!r}: change one of them")


def _has_effect(declared: Settings, given: Values, setting: Setting) -> bool:
    return all(
        given.get(name, declared[name].default) == value for name, value in setting.used_with if name in declared
    )


def _default_lens(picture: Settings, frame: tuple[int, int]) -> dict[str, Any]:
    """Return the declared calibrated picture in a frame of another shape: its longer side is the frame's."""
    declared = [side.default for side in SIZE]
    if frame[0] * declared[1] == frame[1] * declared[0]:
        return {}
    scale = max(frame) / max(declared)
    values: dict[str, Any] = {}
    middles = iter(frame)
    for name, one in picture.items():
        if one.left_out == OF_FRAME:
            values[name] = frame[SIZE.index(one)]
        elif one.left_out == MIDDLE:
            values[name] = (next(middles) - 1) / 2
        elif isinstance(one, Coefficients):
            first, each = one.grows
            terms = enumerate(map(float, one.default.split()))
            values[name] = " ".join(repr(term * scale ** (first + each * power)) for power, term in terms)
        else:
            values[name] = one.default * scale
    return values
