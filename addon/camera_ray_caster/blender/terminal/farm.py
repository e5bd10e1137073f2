"""Pictures made by several processes on this machine or a cluster, with Dask, which is imported only when needed.

A worker opens the file once and makes a few pictures at a time. A killed worker leaves only complete files, and its
unfinished pictures go to another worker. Importing this module does not import bpy, because Blender must be used in
the thread that imports bpy.
"""

import atexit
import logging
import os
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from functools import partial
from importlib import import_module
from math import inf
from threading import Lock, current_thread, main_thread
from typing import Any

from ...core.file_set import clear_up
from ...core.records import InputError
from ..process.standard_output import keep_output, quiet_errors
from . import tasks

ANSWER = "10s"
"""Time to wait for a scheduler to answer."""
START = "60s"
"""Time for a worker of this machine to start."""
FILES, FILES_PER_WORKER = 24, 6
"""Open files without which no cluster starts: 4 workers fail with 48 at once, with 24 after a minute, with 16 never."""

ENVIRONMENT = {"MALLOC_TRIM_THRESHOLD_": 128 << 20, "MALLOC_MMAP_THRESHOLD_": 32 << 20}
"""Environment of workers: glibc keeps freed memory for new arrays, while Dask's default returns it to the system."""

_blender = Lock()
_opened: dict[str, Any] = {}
"""File that this worker has open: ``pictures`` is the Pictures object, ``of`` its options and stamp."""


@contextmanager
def cluster(options) -> Iterator[Any]:
    """Yield a client of the Dask cluster that the options name, a new local or a running one; None without a cluster.

    What killed workers left behind is removed afterwards. Raises InputError if Dask is not installed, no scheduler
    answers, or a worker lacks a package.
    """
    if not (options.workers or options.scheduler):
        yield None
        return
    try:
        import distributed
    except ModuleNotFoundError as error:
        raise InputError("--workers and --scheduler need Dask: install it with pip install '.[farm]'") from error
    for name in ("distributed", "distributed.client", "tornado", "asyncio"):  # each logs every lost connection
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    with ExitStack() as stack:
        stack.callback(clear_up, options.output)
        address = options.scheduler or stack.enter_context(_local(options.workers))
        try:
            client = stack.enter_context(distributed.Client(address, timeout=ANSWER, set_as_default=False))
        except (OSError, ValueError) as error:
            raise InputError(
                f"no Dask scheduler answers at {address!r}: start the scheduler, or look at its log"
            ) from error
        if options.workers:
            client.register_plugin(_preparing(options.workers))
        for worker, missing in client.run(_missing()).items():
            if missing:
                raise InputError(f"worker {worker} has no {missing[0]}: install it in the worker's Python")
        yield client


@contextmanager
def _local(workers: int) -> Iterator[str]:
    """Yield the address of a new cluster on this machine, with a process for each worker."""
    import bpy
    import dask
    import distributed

    if bpy.app.binary_path:
        raise InputError("--workers starts Python processes and cannot start Blender: run the script with pip's bpy")
    needed, limit = FILES + FILES_PER_WORKER * workers, _most_files()
    if limit < needed:  # with too few, Dask's processes wait for each other without end
        raise InputError(f"{workers} workers cannot start: too many open files for a limit of {limit}; {tasks.FEWER}")
    settings = {"distributed.nanny.pre-spawn-environ": ENVIRONMENT}
    limits = {
        "threads_per_worker": 1,
        "memory_limit": 0,
        "dashboard_address": "127.0.0.1:0",
        "silence_logs": logging.CRITICAL,
        "death_timeout": START,
    }
    with dask.config.set(settings):
        try:
            with quiet_errors():  # of the workers, too: their outcomes have the errors
                made = distributed.LocalCluster(n_workers=workers, **limits)
        except (RuntimeError, OSError, MemoryError) as error:
            raise InputError(f"{workers} workers cannot start: {_reason(error)}; {tasks.FEWER}") from error
        with made:
            yield made.scheduler_address


def _most_files() -> float:
    """Return the number of files that this process may open."""
    try:
        import resource
    except ModuleNotFoundError:  # Windows
        return inf
    soft = resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    return inf if soft == resource.RLIM_INFINITY else soft


def _reason(error: BaseException) -> str:
    """Return the first line of what caused an error."""
    while error.__cause__ or error.__context__:
        error = error.__cause__ or error.__context__
    text = getattr(error, "strerror", None) or str(error) or type(error).__name__
    return text.strip().splitlines()[0]


def _preparing(workers: int):
    """Return a plugin that limits each worker to its share of this process's processors, and removes Blender's script
    folders from the worker's path: they contain a package bpy that only works inside Blender.
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
    """Return a function that lists the missing packages of a worker; it does not need this module on the worker."""

    def missing() -> list[str]:
        from importlib.util import find_spec

        return [name for name in ("camera_ray_caster", "bpy") if find_spec(name) is None]

    return missing


def outcomes(client, pictures, stamp: Mapping[str, Any], maps: Mapping[str, Any], jobs: Iterable) -> Iterator:
    """Yield the outcomes of jobs: of finished ones at once, of others as workers finish them. Raises the errors of
    ``tasks.Tasks``, and those with which workers refuse a job.
    """
    options = pictures.options

    def connect():
        import distributed

        return distributed.Client(options.scheduler, timeout=ANSWER, set_as_default=False)

    def taken(job):
        return pictures.taken(job, stamp, maps.get(job.camera))

    task = partial(work, options, stamp, maps)
    made = tasks.Tasks(client, task, iter(jobs), taken, options.dataset, options.retries,
                       connect if options.scheduler else None)  # fmt: skip
    return made.outcomes()


def work(options, stamp: Mapping[str, Any], maps: Mapping[str, Any], jobs: Sequence) -> list:
    """Make pictures in a worker; return their outcomes."""
    with _blender:  # Blender does one thing at a time
        if (options, stamp) != _opened.get("of"):
            if current_thread() is not main_thread():
                atexit.register(_leave)  # before bpy's import: exit handlers run in reverse order
            keep_output()
            from ..output.stamps import differing
            from .picture_jobs import Pictures

            import_module(__name__.partition(".blender.")[0]).register()  # not at the top: circular import
            _opened.clear()
            _opened["pictures"] = pictures = Pictures(options)
            others = differing(stamp, pictures.stamp())
            if others:
                raise InputError(f"a worker differs from this machine in {', '.join(others)}: make them equal")
            _opened["of"] = options, stamp
        make = _opened["pictures"].tried if options.dataset else _opened["pictures"].make
        made = (make(job, stamp, options.prog, maps.get(job.camera)) for job in jobs)
        return [outcome if options.json else replace(outcome, report=None, paths=()) for outcome in made]


def _leave() -> None:
    """End this process without Blender's own exit, which crashes outside the thread that imported bpy."""
    logging.shutdown()
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    os._exit(0)
