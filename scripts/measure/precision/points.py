"""Measurements of a method on a scene, and the timing."""

from dataclasses import dataclass
from statistics import median
from time import perf_counter

REPEATS = 7


@dataclass(frozen=True)
class Point:
    """One method on one scene: an error with its unit, and the time per million rays (or pixels)."""

    family: str
    scene: str
    method: str
    median_error: float
    worst_error: float
    unit: str
    seconds: float
    """Seconds per million, of the fastest of several runs: the other runs were delayed by the machine."""
    spread: float
    """Ratio of the median run's time to the fastest run's time."""
    wrong: int = 0
    """Number of pixels whose hit or miss is wrong."""
    compared: int = 0


def timed(runs, counts):
    """Run functions alternately; return the result, seconds per million and spread of each, by its count of items."""
    results, seconds = [run() for run in runs], [[] for _ in runs]
    for _ in range(REPEATS):
        for run, spent in zip(runs, seconds, strict=True):
            started = perf_counter()
            run()
            spent.append(perf_counter() - started)
    return [
        (result, min(spent) / count * 1e6, median(spent) / min(spent))
        for result, spent, count in zip(results, seconds, counts, strict=True)
    ]
