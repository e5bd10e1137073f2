"""Runs in turns: each round runs every contender once, so that other load on the machine affects them all alike."""

from __future__ import annotations

import gc
from time import perf_counter, sleep

import numpy as np

from . import contenders as c

EMBREE_MOST = 10_000
"""Maximum number of spheres, of 320 triangles each, that fit into the memory of a small machine."""


def spheres(count: int, width: int, height: int, rounds: int, threads: int) -> list[dict]:
    """Time one scene of spheres with every contender; return the rows of the table."""
    entries = {
        "ours, 4 passes": c.ours(c.PASSES, threads),
        "ours, depth + index": c.ours(("depth", "shape_index"), threads),
    }
    if c.has("mitsuba"):
        entries |= c.mitsubas()
    if c.has("embreex") and c.has("trimesh") and count <= EMBREE_MOST:
        entries["Embree, distance"] = c.embree
    camera, shapes = c.scene(count, width, height)
    title = f"{count:,} spheres and a wall, {width} x {height}, {threads} threads"
    return [{"spheres": count} | row for row in compare(title, camera, shapes, entries, rounds)]


def compare(title: str, camera, shapes, entries: dict, rounds: int) -> list[dict]:
    """Time one scene with every contender, print its table and return the rows."""
    print(f"\n{title}, {rounds} rounds, ms")
    rows, runs = [], {}
    for name, prepare in entries.items():
        began = perf_counter()
        runs[name] = prepare(camera, shapes)
        rows.append({"name": name, "prepare_ms": 1e3 * (perf_counter() - began)})
    times = take_turns(runs, rounds)
    reference = {"4": np.median(times["ours, 4 passes"]), "d": np.median(times["ours, depth + index"])}
    print(f"  {'':28}{'least':>9}{'median':>9}{'spread':>15}{'prepare':>10}{'over ours':>11}")
    for row in rows:
        milliseconds = times[row["name"]]
        low, median, high = np.percentile(milliseconds, (25, 50, 75))
        row |= {"least_ms": min(milliseconds), "median_ms": median, "low_ms": low, "high_ms": high}
        row["over_ours"] = median / reference["4" if "4 passes" in row["name"] else "d"]
        print(f"  {row['name']:28}{min(milliseconds):9.1f}{median:9.1f}{low:8.1f}-{high:.1f}".ljust(64)
              + f"{row['prepare_ms']:9.0f}{row['over_ours']:10.2f}x")  # fmt: skip
    return rows


def take_turns(runs: dict, rounds: int) -> dict[str, list[float]]:
    """Return the times of each run in milliseconds, round by round, after one untimed run."""
    times: dict[str, list[float]] = {name: [] for name in runs}
    for run in runs.values():
        run()
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for name, run in runs.items():
                sleep(c.PAUSE)
                began = perf_counter()
                kept = run()
                times[name].append(1e3 * (perf_counter() - began))
                del kept
    finally:
        gc.enable()
    return times
