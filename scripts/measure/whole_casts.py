"""Whole casts beside writing their arrays alone, with one thread and with two, by the clock and by processor time."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import perf_counter, process_time

import numpy as np

from . import against
from .by_pass import new
from .dataset_speed import PASSES_CAST

FOUR, SIDES = against.FOUR, against.SIDES
BALLS, MESH = partial(against.spheres, 10), partial(against.mesh, SIDES["63k"])
CASES: dict[str, tuple[tuple[str, ...], Callable]] = {
    "10 spheres": (FOUR, BALLS),
    "63k triangles": (FOUR, MESH),
    "a plane": (FOUR, against.plane),
    "1M triangles": (FOUR, partial(against.mesh, SIDES["1M"])),
    f"63k triangles, {len(PASSES_CAST)} passes": (tuple(PASSES_CAST), MESH),
    "10 spheres, fisheye": (FOUR, partial(BALLS, model="FISHEYE_EQUIDISTANT")),
    "10 spheres, equirectangular": (FOUR, partial(BALLS, model="EQUIRECTANGULAR")),
    "63k triangles, fisheye": (FOUR, partial(MESH, model="FISHEYE_EQUIDISTANT")),
    "63k triangles, equirectangular": (FOUR, partial(MESH, model="EQUIRECTANGULAR")),
}
"""By name: the passes, and a function that takes passes and the picture's size and returns the cast."""

Times = tuple[float, float]
"""Milliseconds of processors and by the clock."""


def run(size: tuple[int, int], rounds: int) -> list[dict]:
    """Print and return the times of each case, and how many times as long it takes as writing its arrays: into new
    memory, or for casts ``into`` an earlier picture into memory that exists.
    """
    print(f"\nms, of processors / by the clock; {size[0]} x {size[1]}; least of {rounds} rounds")
    heads = "writing", "one thread", "two threads", "over writing", "passes", "writing into", "into", "over writing"
    print(f"  {'':30}" + "".join(f"{head:>16}" for head in heads))
    return [_row(name, passes, make, size, rounds) for name, (passes, make) in CASES.items()]


def _row(name: str, passes: tuple[str, ...], make: Callable, size: tuple[int, int], rounds: int) -> dict:
    """Return the times of a case. Its passes take what one thread takes more than without any but ``valid``."""
    cast, search = make(passes, size), make(("valid",), size)
    images, arrays = cast(), [new(key, size) for key in passes]
    writing, one_thread, two_threads, valid, filling, into = _least(
        rounds,
        lambda: _fill([new(key, size) for key in passes]),
        lambda: cast(threads=1),
        lambda: cast(threads=2),
        lambda: search(threads=1),
        lambda: _fill(arrays),
        lambda: cast(into=images),
    )
    over, over_into = min(one_thread[0], two_threads[0]) / writing[0], into[0] / filling[0]
    shown = [f"{cpu:.1f} / {clock:.1f}" for cpu, clock in (writing, one_thread, two_threads, filling, into)]
    written = one_thread[0] - valid[0]
    columns = *shown[:3], f"{over:.1f} x", f"{written:.1f}", *shown[3:], f"{over_into:.1f} x"
    print(f"  {name:30}" + "".join(f"{text:>16}" for text in columns))
    return {
        "name": name, "writing_ms": writing, "one_thread_ms": one_thread, "two_threads_ms": two_threads,
        "over_writing": over, "passes_ms": written, "filling_ms": filling, "into_ms": into, "over_filling": over_into,
    }  # fmt: skip


def _fill(arrays: list[np.ndarray]) -> None:
    for array in arrays:
        array.fill(0)


def _least(rounds: int, *timed: Callable) -> list[Times]:
    """Return the least times of functions that run in turns, after one run that does not count."""
    least = np.full((len(timed), 2), np.inf)
    for round_ in range(rounds + 1):
        for entry, call in zip(least, timed, strict=True):
            cpu, clock = process_time(), perf_counter()
            call()
            spent = process_time() - cpu, perf_counter() - clock
            if round_:
                entry[:] = np.minimum(entry, spent)
    return [tuple(1e3 * entry) for entry in least]
