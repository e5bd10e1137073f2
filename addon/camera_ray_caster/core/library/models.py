"""The list of camera models, and adding to it."""

import re

from ..arguments import count, shown, unknown, word
from ..cameras import MODELS
from ..cameras.model import GROUPS, Model
from ..records import InputError

KEY = re.compile("[A-Z][A-Z0-9_]*")
"""Keys of models."""

LARGEST = 2**31 - 1
"""Largest number that Blender stores."""


class Models(dict[str, type[Model]]):
    """Models by key. As text it is a table: key, label and settings."""

    def __repr__(self) -> str:
        width = max(map(len, self), default=0)
        return "\n".join(
            f"{key:{width}}  {model.label}: {', '.join(setting.name for setting in model.SETTINGS) or 'no settings'}"
            for key, model in self.items()
        )

    def __missing__(self, key: object) -> type[Model]:
        raise KeyError(str(unknown("model", key, self)))


def models() -> Models:
    """Return all camera models by key; printed, a table of their settings.

    ``models()["PUSHBROOM"].SETTINGS`` has the names, ranges, units, defaults and descriptions of a model's settings.
    """
    return Models({model.key: model for model in MODELS})


def add_model(model: type[Model]) -> None:
    """Add a model to the list, in place of one of the same key that was added before: see ``crc.register_model``."""
    if not (isinstance(model, type) and issubclass(model, Model)):
        raise InputError(f"{shown(model)} is not a camera model: give a class that inherits Model")
    missing = [name for name in ("key", "label", "description", "group", "FORMULA") if not hasattr(model, name)]
    if missing or model.__abstractmethods__:
        lacking = ", ".join((*missing, *sorted(model.__abstractmethods__)))
        raise InputError(f"model {model.__name__} has no {lacking}: define it in the class")
    if not KEY.fullmatch(word(model.key, f"key of model {model.__name__}")):
        raise InputError(f"key of model {model.__name__} is {model.key!r}: it must be capitals, digits and _")
    for name in ("label", "description"):
        word(getattr(model, name), f"{name} of model {model.key}")
    word(model.group, f"group of model {model.key}", GROUPS)
    if model.number is not None:
        count(model.number, f"number of model {model.key}", LARGEST)
    others = [known for known in MODELS if known.key != model.key]
    if model.number is not None and model.number in [known.number for known in others]:
        raise InputError(f"number {model.number} of model {model.key} is another model's: take one from 1000 on")
    package = Model.__module__.rpartition(".")[0]
    if any(known.key == model.key and known.__module__.startswith(package) for known in MODELS):
        raise InputError(f"key {model.key} is that of a model of the package: take another one")
    MODELS[:] = [*others, model]
