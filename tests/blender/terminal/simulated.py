"""A cluster that is simulated: workers that take seconds of a clock of its own, that end, and a scheduler that ends."""

from concurrent.futures import CancelledError
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count
from random import Random

SENT = 0.001
"""Seconds in which a scheduler hands out a task, one at a time: Dask's manual has 0.2 to 1 ms."""


class KilledWorker(Exception):
    """What Dask raises for a task whose workers have ended ALLOWED times."""


ALLOWED = 3


@dataclass(eq=False)
class Task:
    """A task of the simulated scheduler."""

    cluster: object
    work: object
    jobs: list
    ends: int = 0
    outcome: object = None

    def done(self):
        return self.outcome is not None or self.cluster.ended

    def result(self):
        if self.cluster.ended:
            raise CancelledError
        if isinstance(self.outcome, Exception):
            raise self.outcome
        return self.outcome


@dataclass
class Cluster:
    """Workers, each of which takes some seconds for a job. Its methods are those of Dask's client."""

    workers: int
    seconds: float
    clock: list = field(default_factory=lambda: [0.0])
    """The time of the simulation, one number."""
    slow: float = 1.0
    """How many times as long the first worker takes."""
    kills: list = field(default_factory=list)
    """Times at which a random worker ends and begins anew, without what it was doing."""
    killers: frozenset = frozenset()
    """Jobs that end their workers."""
    end: float = float("inf")
    """The time at which the scheduler ends."""
    random: Random = field(default_factory=lambda: Random(1))

    def __post_init__(self):
        self.ended, self.free, self.queue, self.running = False, list(range(self.workers)), [], {}
        self.events, self.order, self.sent = [], count(), self.clock[0]
        for time in self.kills:
            heappush(self.events, (time, next(self.order), None, None))

    def nthreads(self):
        return dict.fromkeys(range(self.workers), 1)

    def scheduler_info(self):
        return {"workers": {k: {"nthreads": 1} for k in range(self.workers)}}

    def submit(self, work, jobs, pure):
        if self.ended:
            raise OSError("closed")
        task = Task(self, work, jobs)
        self.queue.append(task)
        self._start()
        return task

    def close(self, timeout):
        self.ended = True

    def _start(self):
        while self.free and self.queue:
            worker, task = self.free.pop(), self.queue.pop(0)
            self.sent = max(self.sent, self.clock[0]) + SENT
            took = self.seconds * len(task.jobs) * (self.slow if worker == 0 else 1)
            self.running[worker] = task
            heappush(self.events, (self.sent + took, next(self.order), worker, task))

    def sleep(self, seconds):
        """Go on to the next event, at least by some seconds."""
        until = self.clock[0] + seconds
        if self.events and self.events[0][0] > until:
            until = self.events[0][0]
        while self.events and self.events[0][0] <= until:
            self.clock[0], _, worker, task = heappop(self.events)
            if self.clock[0] >= self.end:
                self.ended = True
                return
            if worker is None:
                if self.running:
                    self._lost(self.random.choice(sorted(self.running)))
            elif self.running.get(worker) is task:
                if self.killers & set(task.jobs):
                    self._lost(worker)
                else:
                    task.outcome = task.work(task.jobs)
                    del self.running[worker]
                    self.free.append(worker)
            self._start()
        self.clock[0] = max(self.clock[0], until)

    def _lost(self, worker):
        task = self.running.pop(worker)
        self.free.append(worker)
        task.ends += 1
        if task.ends >= ALLOWED:
            task.outcome = KilledWorker()
        else:
            self.queue.append(task)
