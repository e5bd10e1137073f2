"""Settings of a camera made in Python that only make sense with others: what is left out, and what has no effect.

The rules stand beside the settings that they are about: ``partner``, ``left_out`` and ``used_with`` of ``Setting``.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from ..cameras.parts.calibration import FILE, SIZE
from ..cameras.parts.left_out import DECLARED, MIDDLE, NEEDED, OF_FRAME, SAME
from ..cameras.parts.settings import Coefficients, Setting
from ..records import InputError

Settings = Mapping[str, Setting]
Values = Mapping[str, Any]


def completed(model: str, declared: Settings, explicit: Values, picture_size: tuple[int, int]) -> dict[str, Any]:
    """Return the settings that follow from those given, by name, for a picture of this width and height.

    declared: the settings of the model, whose key is ``model``; explicit: values as records hold them. A calibrated
    picture of which no number is given is the declared one, scaled to the frame's longer side, with square pixels.
    Raises InputError for half of a pair that makes no sense alone, and for a setting that would have no effect.
    """
    if explicit.get(FILE.name):
        return {}
    values: dict[str, Any] = {}
    for name in explicit:
        if name in declared:
            check_effect(model, declared, explicit, declared[name])
    for setting in declared.values():
        if setting.name in explicit or setting.partner not in explicit or not _has_effect(declared, explicit, setting):
            continue
        if setting.left_out != SAME:
            raise InputError(f"{model} has {setting.partner} without {setting.name}: give both")
        values[setting.name] = explicit[setting.partner]
    if SIZE[0].name not in declared or not _has_effect(declared, explicit, SIZE[0]):
        return values
    picture = {
        name: setting
        for name, setting in declared.items()
        if (setting.left_out != DECLARED or getattr(setting, "unit", "") == "pixels")
        and _has_effect(declared, explicit, setting)
    }
    stated = [name for name in picture if name in explicit]
    if not stated:
        return _default_lens(picture, picture_size)
    for name, setting in picture.items():
        if setting.left_out in (SAME, NEEDED) and name not in explicit and name not in values:
            raise InputError(f"{model} has {stated[0]} without {name}: give {name}, too")
    size = [explicit.get(side.name) or side_of_frame for side, side_of_frame in zip(SIZE, picture_size, strict=True)]
    values |= _frame(picture, size)
    return {name: value for name, value in values.items() if name not in explicit}


def _frame(picture: Settings, size: Sequence[float]) -> dict[str, Any]:
    """Return the sides and the middle of a picture of this size, by the settings that are these."""
    sides = {name: size[SIZE.index(setting)] for name, setting in picture.items() if setting.left_out == OF_FRAME}
    middles = (name for name, setting in picture.items() if setting.left_out == MIDDLE)
    return sides | {name: (side - 1) / 2 for name, side in zip(middles, size, strict=False)}


def check_effect(model: str, declared: Settings, values: Values, setting: Setting) -> None:
    """Raise InputError for a setting that has no effect, unless its value is the default."""
    for name, value in setting.used_with:
        is_other = name in declared and values.get(name, declared[name].default) != value
        if is_other and values[setting.name] != setting.default:
            raise InputError(f"{setting.name} of {model} has no effect unless {name} is {value!r}: change one of them")


def _has_effect(declared: Settings, values: Values, setting: Setting) -> bool:
    known = (entry for entry in setting.used_with if entry[0] in declared)
    return all(values.get(name, declared[name].default) == value for name, value in known)


def _default_lens(picture: Settings, picture_size: tuple[int, int]) -> dict[str, Any]:
    """Return the declared calibrated picture in a frame of another shape: its longer side is the frame's."""
    declared = [side.default for side in SIZE]
    if picture_size[0] * declared[1] == picture_size[1] * declared[0]:
        return {}
    scale = max(picture_size) / max(declared)
    values = _frame(picture, picture_size)
    for name, setting in picture.items():
        if isinstance(setting, Coefficients):
            first, step = setting.grows
            terms = enumerate(map(float, setting.default.split()))
            values[name] = " ".join(repr(term * scale ** (first + step * power)) for power, term in terms)
        elif name not in values:
            values[name] = setting.default * scale
    return values
