"""Which cases the default tier of tests has: what shows each thing once. All others are marked ``full``.

A test with many cases keeps ``CASES`` of them, spread evenly from a place that its name gives, so that all tests
together try every model, file and pass. A test marked ``one_for_each("key")`` keeps one case for each value of that
parameter, and of the k-th value the k-th of its cases. A test that is slow and says little that is new is marked
``full`` by hand, and one whose cases are slow ``cases(1)``.
"""

import importlib.util
import sys
from zlib import crc32

import pytest

CASES = 3
"""Cases of one test in the default tier."""
LIMIT = 3200
"""Cases of all tests in the default tier, so that it stays within its budget."""
BUDGET = 180
"""Seconds of the default tier on two cores."""
OUTSIDE = ("full", "hostile")
"""The marks of what the default tier leaves out."""
FULL = (
    "tests/gui/", "tests/hostile/", "tests/core/exports/test_other_readers.py", "tests/scripts/test_openjd.py",
    "tests/scripts/test_side_by_side.py", "tests/scripts/test_work_precision.py",
)  # fmt: skip
"""Rooms and files that need a window, other programs or hostile inputs: full as a whole."""
SHARE = 4
"""The default tier tries one of so many generated examples."""
is_full = True
"""Whether this run has the full tier, too."""
KEPT = pytest.StashKey[int]()
"""The number of cases that are kept of those that are collected."""


def examples(count):
    """How many examples of ``count`` a test generates in this run."""
    return count if is_full else count // SHARE


def mark_the_rest(items):
    """Mark as ``full`` what the default tier leaves out of collected tests; return the number that it keeps."""
    cases = {}
    for item in items:
        if item.nodeid.startswith(FULL):
            item.add_marker(pytest.mark.full)
        elif not any(item.get_closest_marker(mark) for mark in OUTSIDE):
            cases.setdefault(item.nodeid.split("[", 1)[0], []).append(item)
    kept = 0
    for name, group in cases.items():
        mark = group[0].get_closest_marker("cases")
        chosen = spread(group, name, mark.args[0]) if mark else one_for_each(group) or spread(group, name, CASES)
        for item in set(group) - chosen:
            item.add_marker(pytest.mark.full)
        kept += len(chosen)
    return kept


def one_for_each(cases):
    """The set of cases with each value of the marked parameter once, the others in turns; empty if there is none."""
    mark = cases[0].get_closest_marker("one_for_each")
    parameters = getattr(cases[0], "callspec", None)
    values = {}
    if mark and parameters and mark.args[0] in parameters.params:
        for case in cases:
            values.setdefault(str(case.callspec.params[mark.args[0]]), []).append(case)
    return {those[k % len(those)] for k, those in enumerate(values.values())}


def spread(cases, name, count):
    """The set of at most ``count`` cases, evenly apart."""
    if len(cases) <= count:
        return set(cases)
    first = crc32(name.encode()) % len(cases)
    return {cases[(first + k * len(cases) // count) % len(cases)] for k in range(count)}


def added_models(path):
    """Add the camera models of a file to the list of models, and return them; none without a file."""
    if path is None:
        return ()
    from camera_ray_caster import Model, register_model

    spec = importlib.util.spec_from_file_location("model_of_ones_own", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    classes = [one for one in vars(module).values() if isinstance(one, type) and one.__module__ == spec.name]
    models = tuple(one for one in classes if issubclass(one, Model))
    for model in models:
        register_model(model)
    return models


def of_models(items, models):
    """The tests that have one of these models, or its key, as a parameter."""
    wanted = [*models, *(model.key for model in models)]
    return [item for item in items if any(one is value or one == value for value in _words(item) for one in wanted)]


def _words(item):
    """The parameters of a test that are words or classes."""
    parameters = item.callspec.params.values() if hasattr(item, "callspec") else ()
    return [value for value in parameters if isinstance(value, str | type)]
