"""Whatever a file or a command line holds: a right result, or one line and exit status 2."""

import pytest

from .inputs import KINDS

PART = 20
"""Inputs of a test."""

FEW = 3
"""Inputs of a kind that ``make test`` tries; ``make test-hostile`` tries all."""

PARTS = [(kind, first) for kind, module in KINDS.items() for first in range(0, module.COUNT, PART)]


def broken(pool, kind, numbers):
    """What came of inputs, in words, where it is none of what is allowed."""
    allowed = ["cast", "refused"]
    if kind == "blend_bytes":
        allowed.append("opening crashed")  # in Blender's own code, before there is any scene
    outcomes = {number: pool.tried(kind, number) for number in numbers}
    return "\n\n".join(
        f"{kind} {number} {it['outcome']}: {it['what']}\n{it['said']}"
        for number, it in outcomes.items()
        if it["outcome"] not in allowed
    )


def test_there_are_a_thousand():
    assert sum(module.COUNT for module in KINDS.values()) >= 1000


@pytest.mark.parametrize("kind", KINDS)
def test_a_few_inputs_of_each_kind(pool, kind):
    step = KINDS[kind].COUNT // FEW
    assert not (faults := broken(pool, kind, range(step // 2, KINDS[kind].COUNT, step))), faults


@pytest.mark.hostile
@pytest.mark.parametrize(("kind", "first"), PARTS)
def test_all_inputs(pool, kind, first):
    numbers = range(first, min(first + PART, KINDS[kind].COUNT))
    assert not (faults := broken(pool, kind, numbers)), faults
