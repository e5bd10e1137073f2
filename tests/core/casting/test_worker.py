"""Work on a thread of its own: it goes on beside the caller, says how far it is, and stops when it is asked to."""

from threading import Event, current_thread

import pytest

from camera_ray_caster.core.casting.worker import Worker
from camera_ray_caster.core.records import Cancelled


def endless(progress):
    """Work that ends only when it is stopped."""
    while progress(0.25):
        pass
    raise Cancelled


def test_it_works_beside_the_caller():
    go_on = Event()

    def work(progress):
        go_on.wait(10)
        progress(0.5)
        return current_thread()

    worker = Worker(work)
    assert not worker.done
    assert worker.fraction == 0
    go_on.set()
    assert worker.result() != current_thread()
    assert worker.done
    assert worker.fraction == 0.5


def test_what_the_work_raises_comes_out_of_its_result():
    with pytest.raises(ZeroDivisionError):
        Worker(lambda progress: 1 / 0).result()


def test_stopping_waits_for_the_end():
    worker = Worker(endless)
    worker.stop()
    assert worker.done
    with pytest.raises(Cancelled):
        worker.result()


def test_abandoned_work_ends():
    worker = Worker(endless)
    worker.abandon()
    with pytest.raises(Cancelled):
        worker.result()
