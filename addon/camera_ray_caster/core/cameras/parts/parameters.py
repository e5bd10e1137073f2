"""The values of settings, and the real numbers among them, by which pictures change smoothly: a camera's parameters."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from ...maths.recording import Varied, is_recorded
from ...records import BlenderCamera
from .settings import RECORD_FIELDS, Coefficients, Number, Numbers, Setting, Whole


def values_of(settings: Iterable[Setting], raw: BlenderCamera) -> dict[str, Any]:
    """Return the values of some settings in a record, by name; see ``Setting.reported``."""
    return {setting.name: setting.reported(raw) for setting in settings}


def parameters_of(settings: Iterable[Setting], raw: BlenderCamera) -> dict[str, float]:
    """Return the real numbers of some settings in a record, by name and in order.

    The numbers of a vector or a polynomial have their places beside the name: "ray_1[0]". Whole numbers are left out.
    """
    return {name: value for setting in settings for name, value in _named(setting, raw).items()}


def varied(settings: Iterable[Setting], raw: BlenderCamera, names: Sequence[str]) -> BlenderCamera:
    """Return the record in which the parameters of these names are varied numbers, by themselves in this order."""
    numbers = (
        Varied(number, tuple(1.0 if name == k else None for k in names)) if name in names else number
        for name, number in parameters_of(settings, raw).items()
    )
    return with_parameters(settings, raw, numbers)


def with_parameters(settings: Iterable[Setting], raw: BlenderCamera, numbers: Iterable[float]) -> BlenderCamera:
    """Return the record with these numbers in place of those of ``parameters_of``."""
    remaining = iter(numbers)
    values = {setting: tuple(next(remaining) for _ in _named(setting, raw)) for setting in settings}
    return with_values(raw, {setting.name: _value(setting, several) for setting, several in values.items() if several})


def with_values(raw: BlenderCamera, values: Mapping[str, Any]) -> BlenderCamera:
    """Return the record with other values of settings, by name."""
    fields: dict[str, Any] = {name: value for name, value in values.items() if name in RECORD_FIELDS}
    others = {name: value for name, value in values.items() if name not in fields}
    return replace(raw, **fields, settings={**raw.settings, **others})


def defaults_of(settings: Iterable[Setting]) -> dict[str, Any]:
    """Return the defaults, by name, of settings that are not fields of a record, which have their own."""
    return {setting.name: setting.default for setting in settings if setting.name not in RECORD_FIELDS}


def _named(setting: Setting, raw: BlenderCamera) -> dict[str, float]:
    if isinstance(setting, Number):
        return {} if isinstance(setting, Whole) else {setting.name: float(setting.given(raw))}
    several = setting.numbers(raw) if isinstance(setting, Coefficients) else ()
    several = setting.given(raw) if isinstance(setting, Numbers) else several
    return {f"{setting.name}[{index}]": float(number) for index, number in enumerate(several)}


def _value(setting: Setting, numbers: tuple[float, ...]) -> Any:
    """Return the value in a record: text for a polynomial, unless its numbers vary or are recorded."""
    if isinstance(setting, Number):
        return numbers[0]
    varies = is_recorded(*numbers) or any(isinstance(number, Varied) for number in numbers)
    plain = isinstance(setting, Coefficients) and not varies
    return " ".join(repr(float(number)) for number in numbers) if plain else numbers
