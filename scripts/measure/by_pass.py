"""The processor time of each pass beside that of allocating and filling its array."""

from __future__ import annotations

import mmap
from collections.abc import Callable
from functools import partial
from math import prod
from time import process_time

import numpy as np

from camera_ray_caster.core.casting.passes import PASSES

from . import against

SCENES = {"10 spheres": partial(against.spheres, 10), "63k triangles": partial(against.mesh, against.SIDES["63k"])}
ARRAYS = 8
"""Number of arrays that are filled at once while the limit is measured."""


def run(size: tuple[int, int], rounds: int) -> list[dict]:
    """Print and return the milliseconds that each pass adds to a cast of ``valid``, and those of writing it alone."""
    names = [name for name in PASSES if not PASSES[name].frames and name != "valid"]
    print(f"\nprocessor time, ms; {size[0]} x {size[1]}; least of {rounds} rounds")
    print(f"  {'':16}{'writing alone':>15}" + "".join(f"{scene:>24}" for scene in SCENES))
    alone = {scene: _least(make(("valid",), size), rounds) for scene, make in SCENES.items()}
    rows = []
    for name in names:
        limit = _least(lambda name=name: _filled(name, size), rounds) / ARRAYS
        row = {"name": name, "limit_ms": limit}
        for scene, make in SCENES.items():
            row[scene] = _least(make(("valid", name), size), rounds) - alone[scene]
        rows.append(row)
        print(
            f"  {name:16}{limit:15.1f}"
            + "".join(f"{row[scene_name]:14.1f}{row[scene_name] / limit:9.1f}x" for scene_name in SCENES)
        )
    return rows


def _filled(name: str, size: tuple[int, int]) -> list[np.ndarray]:
    arrays = [new(name, size) for _ in range(ARRAYS)]
    for array in arrays:
        array.fill(0)
    return arrays


def new(name: str, size: tuple[int, int]) -> np.ndarray:
    """Return an array for a pass in new memory, in large pages as numpy asks for them: freed memory may be kept."""
    shape, dtype = PASSES[name].shape(size[::-1]), np.dtype(PASSES[name].dtype or np.float32)
    memory = mmap.mmap(-1, prod(shape) * dtype.itemsize, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    if hasattr(mmap, "MADV_HUGEPAGE"):
        memory.madvise(mmap.MADV_HUGEPAGE)
    return np.frombuffer(memory, dtype).reshape(shape)


def _least(timed: Callable, rounds: int) -> float:
    """Return the least milliseconds of a function's runs."""
    least = np.inf
    for _ in range(rounds):
        began = process_time()
        timed()
        least = min(least, process_time() - began)
    return 1e3 * least
