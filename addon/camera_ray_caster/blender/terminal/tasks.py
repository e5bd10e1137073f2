"""The tasks of a run: which jobs workers have, and what is done if workers, or the scheduler, end.

Nothing of Dask is imported: a client is what has Dask's ``submit``, ``nthreads``, ``scheduler_info`` and ``close``.
"""

import time
from collections import Counter
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import CancelledError
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from ...core.records import InputError
from ..process import signals
from .jobs import Outcome

CHUNK = 4
"""Number of pictures per task of a worker."""
TASKS_AT_ONCE, TASKS_PER_THREAD = 16, 4
"""Number of tasks that are with the scheduler at a time, and in addition for each thread of a worker."""
RESTARTS, AGAIN = 3, 60.0
"""How often a scheduler may end, and the seconds to wait for the next one."""
CHECK = 15
"""Seconds between two checks that a worker runs. Two checks must fail, since a killed worker may be restarting."""
FEWER = "give fewer --workers, or raise the limits of open files, processes and memory (ulimit)"
POLL = 0.05
"""Seconds between two checks for finished tasks."""

KILLED = "KilledWorker"
"""Name of Dask's error for a task whose workers have ended several times."""


@dataclass
class Tasks:
    """Jobs, and those of them that workers have."""

    client: Any
    work: Callable[[list], list]
    """Done by a worker: returns the outcomes of some jobs."""
    jobs: Iterator
    taken: Callable[[Any], Outcome | None]
    """Returns the outcome of a job that is finished already."""
    goes_on: bool = False
    """Whether a job that kills its workers is a failure, and not an error."""
    retries: int = 0
    connect: Callable[[], Any] | None = None
    """Returns a client of another scheduler, once there is one; None if that cannot be."""
    again: list[list] = field(default_factory=list)
    """Chunks that have to be done once more."""
    waiting: list[tuple[Any, list]] = field(default_factory=list)
    """Tasks that workers have, and the chunk of each."""
    crashes: Counter = field(default_factory=Counter)
    """How often the workers of a job have ended."""

    def outcomes(self) -> Iterator[Outcome]:
        """Yield the outcomes of jobs, chunk by chunk. A few chunks for each worker are with the scheduler at a time. If
        it ends and another one begins at its address, that one takes over what is not finished.

        Raises InputError if all workers have ended, if a job kills its workers, and if the scheduler is lost.
        """
        for _ in range(1 + RESTARTS):
            try:
                yield from self._until_lost()
                return
            except (OSError, CancelledError) as error:
                if not self._reconnected():
                    raise InputError("the Dask scheduler has ended: start again; finished pictures are kept") from error
        raise InputError("the Dask scheduler has ended several times: see its log; finished pictures are kept")

    def _until_lost(self) -> Iterator[Outcome]:
        seen, gone = time.monotonic(), 0
        while True:
            signals.raise_if_stopping()
            if self.connect is None and time.monotonic() - seen > CHECK:
                seen, gone = time.monotonic(), 0 if self.client.nthreads() else gone + 1
                if gone > 1:
                    raise InputError(f"all workers have ended; finished pictures are kept; {FEWER}")
            workers = self.client.scheduler_info()["workers"].values()  # as the client was last told
            threads = sum(worker["nthreads"] for worker in workers)
            for _ in range(TASKS_AT_ONCE + TASKS_PER_THREAD * threads - len(self.waiting)):
                chunk = yield from self._chunk()
                if not chunk:
                    break
                self.again.append(chunk)
                task = self.client.submit(self.work, chunk, pure=False)
                self.waiting.append((task, self.again.pop()))
            if not self.waiting:
                return
            for task in [task for task in self.waiting if task[0].done()]:
                yield from self._result(*task)
                self.waiting.remove(task)
            time.sleep(POLL)

    def _chunk(self) -> Generator[Outcome, None, list]:
        """Return the next jobs for a worker, none at the end; yield the outcomes of jobs that are finished already."""
        if self.again:
            return self.again.pop()
        chunk: list = []
        for job in self.jobs:
            outcome = self.taken(job)
            if outcome is None:
                chunk.append(job)
            else:
                yield outcome
            if len(chunk) == CHUNK:
                break
        return chunk

    def _result(self, task: Any, chunk: list) -> Iterator[Outcome]:
        """Yield the outcomes of a task that is done. If it has killed its workers, its jobs are tried one by one."""
        try:
            made = task.result()
        except Exception as error:
            if type(error).__name__ != KILLED:
                raise
            self.crashes.update(job.name for job in chunk)
            job = chunk[0]
            if len(chunk) > 1 or self.crashes[job.name] < 2 + self.retries:
                self.again += [[job] for job in chunk]
            elif self.goes_on:
                yield Outcome(False, failure=f"{job.name}: it crashed several workers in turn")
            else:
                raise InputError(f"this picture crashed several workers in turn: {job.name}") from error
            return
        yield from made

    def _reconnected(self) -> bool:
        """Wait for another scheduler at the address of one that has ended; return whether there is one. Jobs that
        workers had are done again, unless their pictures are there.
        """
        self.again += (chunk for _, chunk in self.waiting)
        self.waiting.clear()
        with suppress(Exception):  # it may not be able to say goodbye
            self.client.close(timeout=1)
        end = time.monotonic() + AGAIN
        while self.connect is not None and time.monotonic() < end:
            signals.raise_if_stopping()
            with suppress(OSError, ValueError):
                self.client = self.connect()
                return True
        return False
