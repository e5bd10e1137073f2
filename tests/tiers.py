"""Which cases the default tier of tests has: what shows each thing once. All others are marked ``full``.

Of a test with many cases it has the first of each kind: where a parameter is a camera model, the first case of each
group of models; of any other test the first ``CASES``. A test marked ``one_for_each("key")`` has the first case of each
value of that parameter, a test marked ``cases(1)`` its first. A test that is slow and says little that is new is marked
``full`` by hand. So no case depends on a name, and a case that is added at the end moves no other.
"""

import importlib.util
import os
import sys
from functools import cache

import pytest

CASES = 3
"""Cases of one test in the default tier, where its cases are of one kind."""
BUDGET = 140
"""Seconds of the default tier on two cores: of the processors, twice as many."""
OUTSIDE = ("full", "hostile")
"""The marks of what the default tier leaves out."""
FULL = (
    "tests/gui/", "tests/hostile/", "tests/recipes/", "tests/core/exports/test_other_readers.py",
    "tests/scripts/test_openjd.py", "tests/scripts/test_side_by_side.py", "tests/scripts/test_work_precision.py",
)  # fmt: skip
"""Rooms and files that need a window, a copy of the repository, other programs or hostile inputs: full as a whole."""
LONGEST = (
    "tests/recipes/test_recipes.py", "tests/blender/faces/test_beside_cycles.py", "tests/scripts/test_benchmark.py",
    "tests/core/web/test_page.py", "tests/scripts/test_site.py", "tests/blender/faces/test_engine_picture.py",
    "tests/core/library/test_own_model.py", "tests/core/sets/test_memory.py", "tests/core/any_rays/test_brute_force.py",
    "tests/hostile/test_share_kills.py", "tests/hostile/test_farm_kills.py", "tests/core/camera/test_camera.py",
)  # fmt: skip
"""The files that take longest, the longest first: workers begin with them, so that none is left with one at the end."""
SHARE = 4
"""The default tier tries one of so many generated examples."""
is_full = True
"""Whether this run has the full tier, too."""


def examples(count):
    """How many examples of ``count`` a test generates in this run."""
    return count if is_full else count // SHARE


def mark_the_rest(items):
    """Mark as ``full`` what the default tier leaves out of collected tests."""
    cases = {}
    for item in items:
        if item.nodeid.startswith(FULL):
            item.add_marker(pytest.mark.full)
        elif not any(item.get_closest_marker(mark) for mark in OUTSIDE):
            cases.setdefault(item.nodeid.split("[", 1)[0], []).append(item)
    for group in cases.values():
        kept = chosen(group)
        for item in group:
            if item not in kept:
                item.add_marker(pytest.mark.full)


def longest_first(items):
    """Sort collected tests, so that those of the longest files come first."""
    turns = {path: turn for turn, path in enumerate(LONGEST)}
    items.sort(key=lambda item: turns.get(item.nodeid.split("::", 1)[0], len(turns)))


def chosen(cases):
    """The cases of one test that the default tier has."""
    count = cases[0].get_closest_marker("cases")
    if count:
        return cases[: count.args[0]]
    declared = cases[0].get_closest_marker("one_for_each")
    if declared and declared.args[0] in _parameters(cases[0]):
        return first_of_each(cases, lambda case: str(_parameters(case)[declared.args[0]]))
    return first_of_each(cases, group_of_models) if group_of_models(cases[0]) else cases[:CASES]


def first_of_each(cases, kind):
    """The first case of each kind, which is a function of a case."""
    first = {}
    for case in cases:
        first.setdefault(kind(case), case)
    return list(first.values())


def group_of_models(case):
    """The group of the camera model that a parameter of this case is, or whose key it is; None if there is none."""
    groups = groups_of_models()
    return next((groups[word] for word in _words(case) if word in groups), None)


@cache
def groups_of_models():
    """The group of each camera model, by the model and by its key."""
    from camera_ray_caster.core.cameras import MODELS

    return {word: model.group for model in MODELS for word in (model, model.key)}


def processor_seconds(of_children=True):
    """The time that this process, and those that it has waited for, took of the processors."""
    return sum(os.times()[: 4 if of_children else 2])


def added_models(path):
    """Add the camera models of a file to the list of models, and return them; none without a file."""
    if path is None:
        return ()
    from camera_ray_caster import Model, register_model

    spec = importlib.util.spec_from_file_location("model_of_ones_own", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    classes = [value for value in vars(module).values() if isinstance(value, type) and value.__module__ == spec.name]
    models = tuple(kind for kind in classes if issubclass(kind, Model))
    for model in models:
        register_model(model)
    return models


def of_models(items, models):
    """The tests that have one of these models, or its key, as a parameter."""
    wanted = [*models, *(model.key for model in models)]
    return [
        item for item in items if any(marked is value or marked == value for value in _words(item) for marked in wanted)
    ]


def _parameters(item):
    """The parameters of a test, by name."""
    return item.callspec.params if hasattr(item, "callspec") else {}


def _words(item):
    """The parameters of a test that are words or classes."""
    return [value for value in _parameters(item).values() if isinstance(value, str | type)]
