"""A camera as a program for browsers: its knobs, its choices, and its rays as functions of these.

A formula branches on its settings. Each way through the branches is a variant of the program; variants are found at
the given settings and at settings spread over the ranges of the knobs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..cameras.model import Model
from ..cameras.parts.parameters import parameters_of, with_parameters
from ..cameras.parts.settings import RECORD_FIELDS, Number, Numbers, Setting, Whole
from ..maths.recording import NUMPY, Record, needed, record_known
from ..records import BlenderCamera, InputError
from .split import Parts, split

WIDEST = 100.0
"""Largest range of a setting that is a slider's, too."""

SAMPLES = 60
"""Settings that are tried for further variants, for each choice: with 200, no model gets another one."""
MOST_VARIANTS = 12
"""Variants for each choice."""


@dataclass(frozen=True)
class Knob:
    """A number that a slider changes."""

    name: str
    label: str
    text: str
    unit: str
    low: float
    high: float
    value: float
    whole: bool = False


@dataclass(frozen=True)
class Variant:
    """One way through the branches of a formula."""

    choices: Mapping[str, Any]
    parts: Parts


@dataclass(frozen=True)
class Program:
    """A camera's program."""

    model: type[Model]
    frame: tuple[int, int]
    knobs: tuple[Knob, ...]
    choices: Mapping[str, Any]
    """Values of the settings that are words or check boxes."""
    fixed: tuple[Setting, ...]
    """Settings that are neither: objects of the scene, files and texts."""
    variants: tuple[Variant, ...]


def program_of(camera: Camera) -> Program:
    """Return the program of a camera whose knobs have the camera's own settings as values.

    Raises NotRecordable for a model with operations that cannot be recorded.
    """
    model, raw = type(camera.model), camera.record
    knobs = tuple(knob for setting in model.SETTINGS for knob in knobs_of(setting, raw))
    options = {setting: _options(setting) for setting in model.SETTINGS if _options(setting)}
    given = {setting.name: setting.given(raw) for setting in options}
    variants = []
    for words in product(*options.values()):
        chosen = dict(zip((setting.name for setting in options), words, strict=True))
        variants += [Variant(chosen, parts) for parts in _variants(camera, chosen, knobs)]
    fixed = tuple(one for one in model.SETTINGS if one not in options and not any(knobs_of(one, raw)))
    return Program(model, camera.raster.size, knobs, given, fixed, tuple(variants))


def with_settings(raw: BlenderCamera, model: type[Model], values: Mapping[str, Any]) -> BlenderCamera:
    """Return the record with other values of knobs and choices, by their names."""
    numbers = {name: values.get(name, number) for name, number in parameters_of(model.SETTINGS, raw).items()}
    made = with_parameters(model.SETTINGS, raw, numbers.values())
    rest = {setting.name for setting in model.SETTINGS} & set(values) - set(numbers)
    fields = {name: values[name] for name in rest & RECORD_FIELDS}
    return replace(made, **fields, settings={**made.settings, **{name: values[name] for name in rest - RECORD_FIELDS}})


def knobs_of(setting: Setting, raw: BlenderCamera) -> Iterator[Knob]:
    """Yield the knobs of a setting: one for a number, one for each of several; none for a coefficient that is 0."""
    if isinstance(setting, Whole):
        value = float(setting.given(raw))
        yield Knob(setting.name, setting.label, setting.text, setting.unit, *_range(setting, value), value, True)
        return
    for place, (name, value) in enumerate(parameters_of([setting], raw).items()):
        if isinstance(setting, Number):
            yield Knob(name, setting.label, setting.text, setting.unit, *_range(setting, value), value)
        elif isinstance(setting, Numbers):
            label = f"{setting.label}: {setting.components[place]}"
            yield Knob(name, label, setting.text, "", min(value, -2.0), max(value, 2.0), value)
        elif value:
            low, high = sorted((value / 2, 2 * value))
            yield Knob(name, f"{setting.label}, {place}", setting.text, "", low, high, value)


def _range(setting: Number, value: float) -> tuple[float, float]:
    """Return the ends of a slider: those of the setting if they are at most WIDEST apart, else those that suit the
    value: up to three times as much, or -1 and 1 for 0.
    """
    widest = 2 * math.tau if setting.unit == "angle" else WIDEST
    low, high, reach = setting.low, setting.high, 3 * abs(value) or 1.0
    if high - low > widest:
        low, high = max(low, reach / 60 if low >= 0 else -reach), min(high, reach)
    return min(low, value), max(high, value)


def _options(setting: Setting) -> list[Any]:
    if setting.kind == "BOOLEAN":
        return [False, True]
    return [item.key for item in setting.items] if setting.kind == "ENUM" else []  # type: ignore[attr-defined]


def _variants(camera: Camera, chosen: Mapping[str, Any], knobs: tuple[Knob, ...]) -> list[Parts]:
    """Return the variants for some choices."""
    generator = np.random.default_rng(len(knobs))
    found: list[Parts] = []
    for sample in range(1 + SAMPLES):
        shares = generator.uniform(size=len(knobs))
        values = {
            knob.name: knob.value if sample == 0 else float(knob.low + share * (knob.high - knob.low))
            for knob, share in zip(knobs, shares, strict=True)
        }
        if any(holds(parts, values) for parts in found) or len(found) == MOST_VARIANTS:
            continue
        try:
            _model(camera, {**chosen, **values})
        except InputError:  # no camera has these settings
            continue
        found.append(split(record_settings(camera, chosen, values)))
    return found


def holds(parts: Parts, values: Mapping[str, float]) -> bool:
    """Return whether a variant is the formula at these settings."""
    if not parts.conditions:
        return True
    conditions = needed(parts.first.steps, parts.first.outputs[: parts.conditions])
    with np.errstate(all="ignore"):  # NaN fails a condition
        return all(conditions.evaluate({**NUMPY, "parameter": lambda value, name: values[name]}, ()))


def record_settings(camera: Camera, chosen: Mapping[str, Any], values: Mapping[str, float]) -> Record:
    """Return the record of a camera's rays, its settings parameters: see ``record_known``."""

    def ray(settings, x, y):
        return [part for vector in _model(camera, {**chosen, **settings}).rays(x, y) for part in vector]

    return record_known(ray, values, 2)


def _model(camera: Camera, values: Mapping[str, Any]) -> Model:
    model = type(camera.model)
    return model.from_blender(with_settings(camera.record, model, values), camera.raster).posed(camera.pose)
