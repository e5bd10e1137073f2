"""What makes the loops fast changes nothing that is seen from outside."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from time import sleep
from weakref import ref

import numpy as np
import pytest

from camera_ray_caster.core.maths.speed import Scratch, Shared, in_shares, lazy, memoized, sharing, whole_rows
from camera_ray_caster.core.maths.vector import inverse, linear, matvec

RNG = np.random.default_rng(5)


@pytest.mark.parametrize("width", [1, 16, 128, 400, 401, 1920])
def test_the_buffers_of_numpy_are_given_back(width):
    before = np.getbufsize()
    with pytest.raises(KeyError), whole_rows(width):
        raise KeyError
    assert np.getbufsize() == before


def test_rows_are_taken_whole_where_they_are_wide_and_of_a_multiple_of_sixteen():
    seen = {}
    for width in (64, 400, 401, 1920):
        with whole_rows(width):
            seen[width] = np.getbufsize()
    usual = np.getbufsize()
    assert seen == {64: usual, 400: 400, 401: usual, 1920: 1920}


@pytest.mark.parametrize(("work", "least"), [(0.0, 1), (0.5, 1), (1.0, 1), (2.9, 2), (20.0, 4), (1000.0, 31)])
def test_so_many_threads_share_work_that_none_waits(work, least):
    """Each share takes its part of the work, and 1 more that no two of them do at a time."""
    time = {n: max(work / n + 1, n) for n in range(1, 65)}
    assert time[sharing(64, work)] <= min(time.values()) + 1
    assert sharing(64, work) >= least
    assert sharing(2, work) == min(2, sharing(64, work))


def test_scratch_lends_the_same_memory_by_name_and_type():
    scratch = Scratch()
    first = scratch("a", (4, 5))
    assert scratch("a", (5, 2)).base is first.base
    assert not np.shares_memory(first, scratch("b", (4, 5)))
    assert not np.shares_memory(first, scratch("a", (4, 5), np.int32))
    assert scratch("a", (40, 50)).shape == (40, 50)
    assert not np.shares_memory(scratch.part("b")("a", (4, 5)), scratch("a", (4, 5)))
    assert scratch.part("b") is scratch.part("b")


@pytest.mark.parametrize("shapes", [((1, 7), (5, 1), ()), ((5, 7),) * 3, ((5, 7), (5, 1), (5, 7)), ((), (), ())])
def test_a_row_of_a_product_is_the_same_however_it_is_laid_out(shapes):
    matrix = RNG.normal(size=(3, 3))
    vector = tuple(RNG.normal(size=shape) for shape in shapes)
    out, spare = np.empty((2, 5, 7))
    for row, whole in zip(matrix, matvec(matrix, vector), strict=True):
        assert (linear(row, vector, out, spare) == whole).all()


def test_the_inverse_is_right_to_its_condition():
    for skew in (0.0, 1.0, 100.0):
        matrix = RNG.normal(size=(3, 3)) + skew * RNG.normal(size=(3, 1))
        bound = 16 * np.finfo(float).eps * np.linalg.cond(matrix)
        assert np.abs(inverse(matrix) @ matrix - np.eye(3)).max() <= bound


def test_threads_share_parts_and_do_only_those_that_are_needed():
    """Each needs three of the four; the two that both need are done once, by both threads at a time."""
    both, done = Barrier(2, timeout=300), []
    parts = [lambda: done.append(0), lambda: (both.wait(), done.append(1)), lambda: (both.wait(), done.append(2))]
    shared = Shared([*parts, lambda: done.append(3)])

    def needs(numbers):
        for _ in shared.work(numbers):
            pass
        return {*numbers} <= {*done}

    with ThreadPoolExecutor(2) as pool:
        assert all(pool.map(needs, ([1, 2], [1, 2])))
    assert sorted(done) == [1, 2]
    assert needs([0, 1])
    assert sorted(done) == [0, 1, 2]
    assert len(shared.results()) == 4
    assert sorted(done) == [0, 1, 2, 3]


def test_an_error_in_a_shared_part_is_raised_wherever_parts_are_needed():
    both = Barrier(2, timeout=300)

    def fail():
        both.wait()
        raise KeyError("part")

    shared = Shared([fail, both.wait])
    with ThreadPoolExecutor(2) as pool:
        for future in [pool.submit(shared.results) for _ in range(2)]:
            with pytest.raises(KeyError, match="part"):
                future.result()


def test_threads_work_out_a_property_of_different_objects_at_once():
    both = Barrier(2, timeout=300)

    class Room:
        @lazy
        def warmth(self):
            """How warm it is."""
            return both.wait() * 0 + 21.0  # the one waits for the other, who could not come through a lock

    rooms = Room(), Room()
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(lambda room: room.warmth, rooms)) == [21.0, 21.0]
    assert rooms[0].warmth == 21.0  # at the barrier it would wait in vain
    assert Room.warmth.__doc__ == "How warm it is."


def test_a_result_is_made_by_one_thread_and_goes_with_its_record():
    made, started = [], Barrier(4)

    @memoized
    def size(record):
        made.append(len(record.__dict__))
        sleep(0.01)
        return made[-1]

    def ask(record):
        started.wait()
        return size(record)

    class Record:
        pass

    records = [Record(), Record()]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(ask, 2 * records)) == [0] * 4
    assert len(made) == 2
    gone = ref(records.pop())
    assert gone() is None


def test_a_result_that_could_not_be_made_is_made_again():
    record, errors = lambda: None, [ZeroDivisionError]

    @memoized
    def made(record):
        if errors:
            raise errors.pop()
        return 1

    with pytest.raises(ZeroDivisionError):
        made(record)
    assert made(record) == 1


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_slices_of_shares_hold_each_item_once_in_order(threads):
    slices = in_shares(lambda items: items, 100, threads, longest=10)
    assert [k for items in slices for k in range(100)[items]] == [*range(100)]
    assert threads == 1 or max(items.stop - items.start for items in slices) <= 10


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_after_an_error_no_other_share_begins(error):
    """If all were run, they would take 50 s."""
    begun = []

    def run(items):
        begun.append(items)
        if items.start == 0:
            raise error
        sleep(0.05)

    with pytest.raises(error):
        in_shares(run, 2000, 2, longest=1)
    assert len(begun) < 2000
