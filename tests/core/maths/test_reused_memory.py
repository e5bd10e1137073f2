"""Memory is used again when nothing uses it any longer, and not before."""

import gc
import sys

import numpy as np
import pytest

from camera_ray_caster.core.maths import reused_memory
from camera_ray_caster.core.maths.speed import lending, release

SHAPE = 300, 200, 3


@pytest.fixture(autouse=True)
def nothing_kept(monkeypatch):
    monkeypatch.setattr(reused_memory, "_unused", {})


def address(array: np.ndarray) -> int:
    return array.__array_interface__["data"][0]


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int32])
def test_an_array_is_as_that_of_numpy_empty(dtype):
    array = reused_memory.empty(SHAPE, dtype)
    assert (array.shape, array.dtype) == (SHAPE, dtype)
    assert array.flags.c_contiguous
    assert array.flags.writeable
    assert array.flags.aligned


def test_memory_comes_back_when_the_last_view_has_gone():
    array = reused_memory.empty(SHAPE, np.float32)
    array.fill(1)
    view, first = array[5:, ::2].T, address(array)
    del array
    other = reused_memory.empty(SHAPE, np.float32)
    other.fill(2)
    assert address(other) != first
    assert (view == 1).all()
    del view
    assert address(reused_memory.empty(SHAPE, np.int32)) == first


def test_memory_is_given_once_though_other_memory_comes_back_meanwhile():
    """As the garbage collector, or another thread, may do between the look-up of a list and its ``pop``."""
    first, second = reused_memory.empty(SHAPE, np.float32), reused_memory.empty(SHAPE, np.float32)
    at = address(first), address(second)
    del first
    (blocks,) = reused_memory._unused.values()
    del second
    addresses = {address(blocks.pop()) for _ in range(2)}
    assert addresses == {*at}
    assert not any(reused_memory._unused.values())


def test_no_more_is_kept_than_the_limit(monkeypatch):
    size = np.empty(SHAPE, np.float32).nbytes
    monkeypatch.setattr(reused_memory, "MOST_BYTES", 3 * size)
    arrays = [reused_memory.empty(SHAPE, np.float32) for _ in range(2)]
    arrays += [reused_memory.empty((2, *SHAPE), np.float32)]
    del arrays
    gc.collect()
    assert sum(amount * len(blocks) for amount, blocks in reused_memory._unused.items()) <= 3 * size
    assert reused_memory.empty((4, *SHAPE), np.float32).base is None  # too large to be kept
    assert reused_memory.empty((4, 4), np.float32).base is None  # the C library's


def test_memory_that_the_system_does_not_have_is_said_once(monkeypatch):
    def none(*_):
        raise MemoryError

    warned = []
    monkeypatch.setattr(sys, "unraisablehook", warned.append)
    monkeypatch.setattr(np, "empty", none)
    with pytest.raises(MemoryError):
        reused_memory.empty(SHAPE, np.float32)
    gc.collect()
    assert warned == []


def test_what_is_kept_is_released():
    reused_memory.empty(SHAPE, np.float32)
    with lending() as lend:
        working = lend()
    assert reused_memory._unused
    release()
    assert not reused_memory._unused
    with lending() as lend:
        assert lend() is not working


def test_working_arrays_are_lent_to_one_at_a_time_and_again_afterwards():
    with lending() as lend, lending() as other:
        first, second, third = lend(), lend(), other()
        assert len({id(first), id(second), id(third)}) == 3
        first("a", (5,))
    with lending() as lend:
        assert {id(lend()) for _ in range(3)} >= {id(first)}
