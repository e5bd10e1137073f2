"""A camera as a program for browsers: its knobs, its choices, and its rays as functions of these.

A formula branches on its settings. Each way through the branches is a variant of the program; variants are found at
the given settings and at settings spread over the ranges of the knobs.
"""

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..cameras.model import Model
from ..cameras.parts.parameters import parameters_of, with_parameters, with_values
from ..cameras.parts.settings import Choice, Flag, Number, Numbers, Setting, Whole
from ..maths.recording import NUMPY, NotRecordable, Record, needed, record_known
from ..records import BlenderCamera, InputError
from .formula_values import values_of
from .split import RAY, Parts, split

Names = tuple[tuple[str, int], ...]

WIDEST = 100.0
"""Largest range of a setting that a slider has, too."""

TRIED_SETTINGS = 60
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
    names: Names
    """Names of the values beside the ray, each with the number of its components."""


@dataclass(frozen=True)
class Program:
    """A camera's program."""

    lens: Model
    """The model at the camera's own settings."""
    record: BlenderCamera
    knobs: tuple[Knob, ...]
    choices: Mapping[str, Any]
    """Values of the settings that are words or check boxes."""
    options: Mapping[str, list[dict[str, Any]]]
    """For each choice its words, as value and label."""
    fixed: tuple[Setting, ...]
    """Settings that are neither: objects of the scene, files and texts."""
    variants: tuple[Variant, ...]


def program_of(camera: Camera, held: Collection[str] = ()) -> Program:
    """Return the program of a camera whose knobs have the camera's own settings as values. ``held`` are settings that
    keep their values.

    Settings with which ``from_blender`` cannot be recorded, such as those that make tables, are fixed. Raises
    NotRecordable for a model whose ``rays`` cannot be recorded.
    """
    model, raw = type(camera.model), camera.record
    knobs = tuple(knob for setting in model.SETTINGS for knob in knobs_of(setting, raw))
    free = [setting for setting in model.SETTINGS if setting.name not in held]
    options = {setting: words for setting in free if (words := _options(setting))}
    current = {setting.name: setting.given(raw) for setting in options}
    choices = [dict(zip(current, words, strict=True)) for words in product(*options.values())]
    try:
        variants = [variant for chosen in choices for variant in _variants(camera, chosen, knobs)]
    except NotRecordable:
        knobs = tuple(knob for knob in knobs if _turns(camera, choices, knob))
        variants = [variant for chosen in choices for variant in _variants(camera, chosen, knobs)]
    turned = {knob.name.partition("[")[0] for knob in knobs} | set(current)
    fixed = tuple(setting for setting in model.SETTINGS if setting.name not in turned)
    words_of = {
        setting.name: [{"value": value, "label": label} for value, label in words.items()]
        for setting, words in options.items()
    }
    return Program(camera.model, raw, knobs, current, words_of, fixed, tuple(variants))


def _turns(camera: Camera, choices: list[dict[str, Any]], knob: Knob) -> bool:
    """Return whether the rays can be recorded with a knob, whatever is chosen, and depend on it for some choice."""
    try:
        records = [record_settings(camera, chosen, {knob.name: knob.value})[0] for chosen in choices]
    except NotRecordable:
        return False
    rays = [needed(record.steps, record.outputs[:RAY]) for record in records]
    return any(step.operation == "parameter" for record in rays for step in record.steps)


def with_settings(raw: BlenderCamera, model: type[Model], values: Mapping[str, Any]) -> BlenderCamera:
    """Return the record with other values of knobs and choices, by their names."""
    numbers = {name: values.get(name, number) for name, number in parameters_of(model.SETTINGS, raw).items()}
    made = with_parameters(model.SETTINGS, raw, numbers.values())
    not_numbers = {setting.name for setting in model.SETTINGS} & set(values) - set(numbers)
    return with_values(made, {name: values[name] for name in not_numbers})


def knobs_of(setting: Setting, raw: BlenderCamera) -> Iterator[Knob]:
    """Yield the knobs of a setting: one for a number, one for each of several; none for a coefficient that is 0."""
    if isinstance(setting, Whole):
        value = float(setting.given(raw))
        yield Knob(setting.name, setting.label, setting.text, setting.unit, *_range(setting, value), value, True)
        return
    for index, (name, value) in enumerate(parameters_of([setting], raw).items()):
        if isinstance(setting, Number):
            yield Knob(name, setting.label, setting.text, setting.unit, *_range(setting, value), value)
        elif isinstance(setting, Numbers):
            label = f"{setting.label}: {setting.components[index]}"
            yield Knob(name, label, setting.text, "", min(value, -2.0), max(value, 2.0), value)
        elif value:
            low, high = sorted((value / 2, 2 * value))
            yield Knob(name, f"{setting.label}, {index}", setting.text, "", low, high, value)


def _range(setting: Number, value: float) -> tuple[float, float]:
    """Return the ends of a slider: those of the setting if they are at most WIDEST apart, else those that suit the
    value: up to three times as much, or -1 and 1 for 0.
    """
    widest = 2 * math.tau if setting.unit == "angle" else WIDEST
    low, high, reach = setting.low, setting.high, 3 * abs(value) or 1.0
    if high - low > widest:
        low, high = max(low, reach / 60 if low >= 0 else -reach), min(high, reach)
    return min(low, value), max(high, value)


def _options(setting: Setting) -> dict[Any, str]:
    """Return the words of a choice with their labels; none for another setting."""
    if isinstance(setting, Flag):
        return {False: "Off", True: "On"}
    return {item.key: item.label for item in setting.items} if isinstance(setting, Choice) else {}


def _variants(camera: Camera, chosen: Mapping[str, Any], knobs: tuple[Knob, ...]) -> list[Variant]:
    """Return the variants for some choices."""
    generator = np.random.default_rng(len(knobs))
    variants, model = list[Variant](), type(camera.model)
    for sample in range(1 + TRIED_SETTINGS):
        shares = generator.uniform(size=len(knobs))
        values = {
            knob.name: knob.value if sample == 0 else float(knob.low + share * (knob.high - knob.low))
            for knob, share in zip(knobs, shares, strict=True)
        }
        if any(holds(variant.parts, values) for variant in variants) or len(variants) == MOST_VARIANTS:
            continue
        try:
            model.from_blender(with_settings(camera.record, model, {**chosen, **values}), camera.raster)
        except InputError:  # no camera has these settings
            continue
        record, names = record_settings(camera, chosen, values)
        parts = split(record, RAY + sum(count for _, count in names))
        variants.append(Variant(chosen, parts, names))
    return variants


def holds(parts: Parts, values: Mapping[str, float]) -> bool:
    """Return whether a variant is the formula at these settings."""
    if not parts.conditions:
        return True
    conditions = needed(parts.first.steps, parts.first.outputs[: parts.conditions])
    with np.errstate(all="ignore"):  # NaN fails a condition
        return all(conditions.evaluate({**NUMPY, "parameter": lambda value, name: values[name]}, ()))


def record_settings(camera: Camera, chosen: Mapping[str, Any], values: Mapping[str, float]) -> tuple[Record, Names]:
    """Return the record of a camera's ray and of the values of its formula, its settings parameters (``record_known``);
    and the names of the values, each with the number of its components.
    """
    names: list[tuple[str, int]] = []
    model, raster = type(camera.model), camera.raster

    def ray(settings, x, y):
        raw = with_settings(camera.record, model, {**chosen, **settings})
        made = model.from_blender(raw, raster).posed(camera.pose)
        numbers = [component for vector in made.rays(x, y) for component in vector]
        for name, parts in values_of(made, raw, raster, x, y).items():
            names.append((name, len(parts)))
            numbers += parts
        return numbers

    return record_known(ray, values, 2), tuple(names)
