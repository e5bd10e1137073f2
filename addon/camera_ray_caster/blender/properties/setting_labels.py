"""Labels of models and settings, for messages in the window in place of the names that files and the terminal use."""

import re
from itertools import chain

from ...core.camera.pixel_time import SETTINGS
from ...core.cameras import MODELS


def label_of(key: str) -> str:
    """Return the label of a model; the key itself for one that is not known."""
    return next((model.label for model in MODELS if model.key == key), key)


def in_labels(text: str) -> str:
    """Return a message with a capital, with the names of settings replaced by their labels in the panels, and without
    the names of options in parentheses: of the terminal, and of Python beside it. Names that are words of the language,
    too, stay.
    """
    settings = chain.from_iterable((*SETTINGS.values(), *(model.SETTINGS for model in MODELS)))
    labels = {setting.name: setting.label for setting in settings if "_" in setting.name}
    text = re.sub(r" \(--[a-z-]+(, in Python \w+=)?\)", "", text)
    text = re.sub(r"\w+", lambda word: labels.get(word[0], word[0]), text)
    return text[:1].upper() + text[1:]
