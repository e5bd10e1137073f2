"""Hostile inputs, each from its kind and its number alone, which are the seed."""

import random

from . import (
    blend_bytes,
    calibrations,
    command_lines,
    images,
    libraries,
    lines,
    meshes,
    names,
    numbers,
    scripts,
    settings,
)  # fmt: skip

MODULES = (
    settings, numbers, names, libraries, meshes, lines, images, calibrations, blend_bytes, scripts, command_lines,
)  # fmt: skip
KINDS = {module.__name__.rpartition(".")[2]: module for module in MODULES}
"""Modules by name. ``COUNT`` is how many inputs a module has; ``make(chance, number, folder)`` makes one of them of
the small scene that is open, with files in the folder, and returns a ``Hostile``.
"""


def make(kind, number, folder):
    """Make an input."""
    return KINDS[kind].make(random.Random(f"{kind} {number}"), number, folder)
