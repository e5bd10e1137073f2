"""What is measured of a method on a scene, and how its time is taken."""

from dataclasses import dataclass
from statistics import median
from time import perf_counter

REPEATS = 7


@dataclass(frozen=True)
class Point:
    """One method on one scene: an error with its unit, and what a million of its rays (or pixels) cost."""

    family: str
    scene: str
    method: str
    median_error: float
    worst_error: float
    unit: str
    seconds: float
    """Per million, of the fastest of several runs: the others waited for something."""
    spread: float
    """The median run over the fastest."""
    wrong: int = 0
    """Hits and misses that are not the exact ones."""
    compared: int = 0


def timed(runs, counts):
    """Run functions alternately; return each one's result, seconds per million and spread, by the counts they make."""
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
