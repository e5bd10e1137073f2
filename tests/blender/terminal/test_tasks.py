"""The tasks of a farm on a simulated cluster: nothing is lost or doubled, whatever ends, and how far it scales."""

import re
from pathlib import Path
from types import SimpleNamespace

import pytest

from camera_ray_caster.blender.terminal import tasks
from camera_ray_caster.blender.terminal.jobs import Outcome
from camera_ray_caster.core.records import InputError

from .simulated import Cluster

PAGE = Path(__file__).parents[3] / "docs" / "scale.md"


class Job(SimpleNamespace):
    __hash__ = object.__hash__


def farmed(monkeypatch, jobs, *clusters, finished=(), **options):
    """Run jobs on clusters, one after the other at one address; return how often each was made, the outcomes, and the
    seconds. A picture that is there is not made again, as by ``Pictures.make``.
    """
    made, waiting = {}, list(clusters)
    clock = clusters[0].clock

    def work(jobs):
        outcomes = []
        for job in jobs:
            outcomes.append(Outcome(True, job.name not in made))
            made[job.name] = made.get(job.name, 0) + (job.name not in made)
        return outcomes

    def connect():
        if not waiting:
            raise OSError("nobody answers")
        cluster = waiting.pop(0)
        cluster.clock = clock
        cluster.sent = clock[0]
        monkeypatch.setattr(tasks.time, "sleep", cluster.sleep)
        return cluster

    monkeypatch.setattr(tasks, "time", SimpleNamespace(sleep=None, monotonic=lambda: clock[0]))
    monkeypatch.setattr(tasks, "AGAIN", 0.0 if len(clusters) == 1 else 60.0)
    first = connect()
    taken = {job: Outcome(True) for job in jobs if job.name in finished}
    running = tasks.Tasks(first, work, iter(jobs), taken.get, connect=connect, **options)
    outcomes = list(running.outcomes())
    return made, outcomes, clock[0]


def jobs_of(count):
    return [Job(name=f"picture {k}", camera="Camera") for k in range(count)]


def test_kills_a_slow_worker_and_another_scheduler_lose_and_double_nothing(monkeypatch):
    jobs = jobs_of(8000)  # 2,000 tasks
    kills = [3.0 * k + 0.1 for k in range(10)]
    first = Cluster(10, 0.05, slow=5.0, kills=kills, end=20.0)
    second = Cluster(10, 0.05, slow=5.0, kills=[21.0, 25.0, 30.0])
    made, outcomes, seconds = farmed(monkeypatch, jobs, first, second, finished={"picture 7", "picture 4000"})
    assert len(made) == 7998
    assert set(made.values()) == {1}
    assert len(outcomes) == 8000
    assert all(outcome.passed for outcome in outcomes)
    assert seconds < 1.2 * 8000 * 0.05 / 9.2  # nine workers and a fifth


def test_a_picture_that_kills_its_workers_is_a_failure_and_costs_no_other(monkeypatch):
    jobs = jobs_of(40)
    cluster = Cluster(4, 0.05, killers=frozenset({jobs[5]}))
    made, outcomes, _ = farmed(monkeypatch, jobs, cluster, goes_on=True, retries=1)
    assert sorted(made) == sorted(job.name for job in jobs if job is not jobs[5])
    (failure,) = [outcome.failure for outcome in outcomes if outcome.failure]
    assert failure == "picture 5: it crashed several workers in turn"
    with pytest.raises(InputError, match="crashed several workers in turn: picture 5"):
        farmed(monkeypatch, jobs, Cluster(4, 0.05, killers=frozenset({jobs[5]})))


def test_a_scheduler_that_does_not_come_back_is_a_refusal(monkeypatch):
    with pytest.raises(InputError, match="the Dask scheduler has ended"):
        farmed(monkeypatch, jobs_of(400), Cluster(4, 0.05, end=2.0))


def test_few_tasks_are_with_the_scheduler_at_a_time(monkeypatch):
    most = 0
    submit = Cluster.submit

    def counted(self, *words, **options):
        nonlocal most
        task = submit(self, *words, **options)
        most = max(most, len(self.queue) + len(self.running))
        return task

    monkeypatch.setattr(Cluster, "submit", counted)
    farmed(monkeypatch, jobs_of(4000), Cluster(4, 0.05))
    assert most <= tasks.TASKS_AT_ONCE + 4 * tasks.TASKS_PER_THREAD


def pictures_a_second(monkeypatch, workers, seconds):
    count = max(400, 40 * workers)
    _, outcomes, took = farmed(monkeypatch, jobs_of(count), Cluster(workers, seconds))
    assert len(outcomes) == count
    return count / took


def test_workers_scale_until_the_scheduler_is_busy(monkeypatch):
    """The table of docs/scale.md: pictures of 0.06 s, four a task, of which the scheduler hands out 1,000 a second."""
    rates = {workers: pictures_a_second(monkeypatch, workers, 0.06) for workers in (1, 10, 100, 400)}
    assert rates[10] > 9 * rates[1]
    assert rates[100] > 80 * rates[1]
    assert rates[400] < 300 * rates[1]
    assert rates[400] > 0.7 * 4000
    stated = re.findall(r"^\| (\d+) \| (\d+) \| \d+ % \|$", PAGE.read_text(), re.MULTILINE)
    assert [(int(workers), int(rate)) for workers, rate in stated] == [
        (count, round(rate)) for count, rate in rates.items()
    ]
