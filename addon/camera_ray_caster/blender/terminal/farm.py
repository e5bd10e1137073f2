"""Pictures made by many processes, of this machine or of a cluster: by Dask, which is imported when it is asked for.

A worker opens the file once and makes a few pictures at a time. One that is killed leaves nothing, or whole files, and
what it had yet to make is given to another. Nothing here imports bpy before a worker works: Blender has to be used by
the thread that imports it.
"""

from __future__ import annotations

import atexit
import logging
import os
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import partial
from importlib import import_module
from threading import Lock, current_thread, main_thread
from typing import Any

from ...core.records import InputError
from . import signals
from .standard_output import keep_output

CHUNK = 4
"""Pictures that a worker is given at a time."""
ANSWER = "10s"
"""How long a scheduler is waited for."""
POLL = 0.05
"""Seconds between looks at what is done."""

ENVIRONMENT = {"MALLOC_TRIM_THRESHOLD_": 128 << 20, "MALLOC_MMAP_THRESHOLD_": 32 << 20}
"""Of workers: glibc keeps the memory of arrays that go for those that come, where Dask would have it handed back."""

_blender = Lock()
_opened: dict[str, Any] = {}
"""What this worker has open: ``pictures``, and what they are ``of``, options and stamp."""


@contextmanager
def cluster(options) -> Iterator[Any]:
    """Yield a client of the Dask cluster that the options ask for, made for this run or there before; None for none.

    Raises InputError where there is no Dask, or no scheduler.
    """
    if not (options.workers or options.scheduler):
        yield None
        return
    try:
        import distributed
    except ModuleNotFoundError as error:
        raise InputError("--workers and --scheduler need Dask: pip install '.[farm]' adds it") from error
    with ExitStack() as stack:
        address = options.scheduler or stack.enter_context(_local(options.workers))
        try:
            client = stack.enter_context(distributed.Client(address, timeout=ANSWER, set_as_default=False))
        except (OSError, ValueError) as error:
            raise InputError(f"no scheduler of Dask answers at {address!r}: start one, or look at its log") from error
        if options.workers:
            client.register_plugin(_preparing(options.workers))
        for worker, missing in client.run(_missing()).items():
            if missing:
                raise InputError(f"worker {worker} has no {missing[0]}: install it there, in the worker's Python")
        yield client


@contextmanager
def _local(workers: int) -> Iterator[str]:
    """Yield the address of a cluster of this machine, with a process for each worker."""
    import bpy
    import dask
    import distributed

    if bpy.app.binary_path:
        raise InputError("--workers starts processes of Python, which Blender is none of: run this with pip's bpy")
    own = {"distributed.nanny.pre-spawn-environ": ENVIRONMENT}
    limits = {
        "threads_per_worker": 1,
        "memory_limit": 0,
        "dashboard_address": "127.0.0.1:0",
        "silence_logs": logging.CRITICAL,
    }
    with dask.config.set(own), distributed.LocalCluster(n_workers=workers, **limits) as made:
        yield made.scheduler_address


def _preparing(workers: int):
    """Return a plugin that holds each worker of this machine to its share of the processors that this process has, and
    takes from its path what Blender has put on this one's: there is a package bpy that only works within a Blender.
    """
    import bpy
    import distributed

    processors = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
    path = [folder for folder in sys.path if not folder.startswith(bpy.utils.system_resource("SCRIPTS"))]

    class Preparing(distributed.WorkerPlugin):
        def setup(self, worker):
            sys.path[:] = path
            if processors:
                first = worker.name % len(processors)
                os.sched_setaffinity(0, processors[first::workers])

    return Preparing()


def _missing():
    """Return a function that returns what a Python lacks. Another machine's need not have this module."""

    def missing() -> list[str]:
        from importlib.util import find_spec

        return [name for name in ("camera_ray_caster", "bpy") if find_spec(name) is None]

    return missing


def outcomes(client, options, stamp: Mapping[str, Any], maps: Mapping[str, Any], jobs: Sequence) -> Iterator:
    """Yield what comes of jobs, in chunks, as workers have made them.

    Raises InputError for what a worker refuses, or cannot do, and where the scheduler has gone.
    """
    import distributed

    chunks = [jobs[at : at + CHUNK] for at in range(0, len(jobs), CHUNK)]
    waiting = client.map(partial(work, options, stamp, maps), chunks, pure=False)
    try:
        while waiting:
            signals.raise_if_stopping()
            over = [future for future in waiting if future.done()]
            waiting = [future for future in waiting if future not in over]
            for future in over:
                yield from future.result()
            time.sleep(POLL)
    except distributed.KilledWorker as error:
        raise InputError(f"pictures that end the worker that makes them, also another one: {error.task}") from error
    except (OSError, CancelledError) as error:
        raise InputError("the scheduler of Dask has gone: start again, what is finished is taken") from error


def work(options, stamp: Mapping[str, Any], maps: Mapping[str, Any], jobs: Sequence) -> list:
    """Make pictures in a worker; return what came of them."""
    with _blender:  # which does one thing at a time
        if (options, stamp) != _opened.get("of"):
            if current_thread() is not main_thread():
                atexit.register(_leave)  # before bpy is imported: what comes later is done before it
            keep_output()
            from ..output.stamps import differing
            from .pictures import Pictures

            import_module(__name__.partition(".blender.")[0]).register()  # what registers commands imports this module
            _opened.clear()
            _opened["pictures"] = pictures = Pictures(options)
            others = differing(stamp, pictures.stamp())
            if others:
                raise InputError(f"a worker has other {', '.join(others)} than this machine: make it the same")
            _opened["of"] = options, stamp
        made = (_opened["pictures"].make(job, stamp, "dataset.py", maps[job.camera]) for job in jobs)
        return [replace(outcome, report=None, paths=()) for outcome in made]


def _leave() -> None:
    """End this process without Blender's own end, which crashes in another thread than the one that has imported it."""
    logging.shutdown()
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    os._exit(0)
