"""The benchmark of scaling: time and memory of a cast against the number of spheres, of triangles of a mesh and of
pixels, as a table and a diagram.
"""

from __future__ import annotations

import tracemalloc
from dataclasses import replace
from time import perf_counter

import numpy as np

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.maths.speed import release
from camera_ray_caster.core.mesh import Mesh
from camera_ray_caster.core.records import MESH

from . import contenders as c

COUNTS = (10, 100, 1_000, 10_000, 100_000, 1_000_000)
TRIANGLES = (1_000, 4_000, 16_000, 64_000, 256_000, 1_024_000)
SIZES = ((960, 540), (1920, 1080), (3840, 2160), (7680, 4320), (16384, 8192))
PASSES = ("depth", "shape_index")


def run(rounds: int, threads: int, quick: bool) -> list[dict]:
    """Print and return the milliseconds and the peak memory in addition to the pictures."""
    counts, triangles, sizes = (all_[: len(all_) // 2] if quick else all_ for all_ in (COUNTS, TRIANGLES, SIZES))
    cases = [("spheres", n, 1920, 1080, c.scene) for n in counts]
    cases += [("triangles", n, 1920, 1080, ring) for n in triangles]
    cases += [("pixels", 100, width, height, c.scene) for width, height in sizes]
    rows = []
    print(f"\ndepth and shape index, {threads} threads, median of {rounds}")
    print(f"  {'':>12}{'shapes':>11}{'pixels':>13}{'ms':>10}{'ns a pixel':>12}{'memory beside, MB':>19}")
    for quantity, count, width, height, scene in cases:
        camera, shapes = scene(count, width, height)
        cast(camera, shapes, passes=PASSES, threads=threads)
        times = []
        for _ in range(rounds):
            began = perf_counter()
            images = cast(camera, shapes, passes=PASSES, threads=threads)
            times.append(1e3 * (perf_counter() - began))
        del images
        release()
        tracemalloc.start()
        images = cast(camera, shapes, passes=PASSES, threads=threads)
        beside = tracemalloc.get_traced_memory()[1] - sum(image.nbytes for image in images.values())
        tracemalloc.stop()
        del images
        median = float(np.median(times))
        shape_counts = {"spheres": count} if scene is c.scene else {"triangles": count}
        row = {"against": quantity, "pixels": width * height, "median_ms": median, "beside_mb": beside / 1e6}
        rows.append(row | shape_counts)
        print(f"  {quantity:>12}{count:11,}{width * height:13,}{median:10.1f}{1e6 * median / width / height:12.1f}"
              f"{beside / 1e6:19.1f}")  # fmt: skip
    return rows


def ring(count: int, width: int, height: int):
    """Return a camera, and a wall behind one mesh of ``count`` triangles, a ring that fills the picture's height.

    ``count`` is 1,000 times a power of 4.
    """
    around, across = np.array((50, 10)) * round((count / 1000) ** 0.5)
    j, i = np.mgrid[:around, :across]
    u, v = 2 * np.pi * j / around, 2 * np.pi * i / across
    away = 2 + 0.8 * np.cos(v)
    places = np.stack((away * np.cos(u), away * np.sin(u), 0.8 * np.sin(v))).reshape(3, -1)
    at = lambda j, i: (j % around * across + i % across).ravel()  # noqa: E731
    a, b, c_, d = at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i + 1)
    triangles = np.concatenate(((a, b, c_), (a, c_, d)), axis=1)
    mesh = Mesh(places.astype(np.float32), triangles.astype(np.intp), np.arange(count, dtype=np.int32))
    camera, shapes = c.scene(1, width, height)
    tilted = np.array([[1, 0, 0], [0, 0.8, -0.6], [0, 0.6, 0.8]])
    axes, center = np.stack((tilted, shapes.axes[1])), np.stack(((0, 0, -13), shapes.center[1]))
    kind, shared = np.array([MESH, shapes.kind[1]], np.uint8), np.zeros(2, bool)
    mesh_of = np.array([0, -1], np.int32)
    return camera, replace(shapes, kind=kind, center=center, axes=axes, meshes=(mesh,), mesh=mesh_of, shared=shared)


def draw(rows: list[dict], path) -> None:
    """Draw the milliseconds against each quantity, with lines of linear growth."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), layout="constrained")
    for axis, quantity in zip(axes, ("spheres", "triangles", "pixels"), strict=True):
        of_quantity = [row for row in rows if row["against"] == quantity]
        x, y = ([row[name] for row in of_quantity] for name in (quantity, "median_ms"))
        axis.loglog(x, y, "o-", color="#2b6ca3")
        axis.loglog(x, [y[-1] * n / x[-1] for n in x], ":", color="0.5", label="linear")
        axis.set_xlabel("triangles of one mesh" if quantity == "triangles" else quantity)
        axis.set_ylabel("milliseconds")
        axis.grid(True, alpha=0.3)
        axis.legend(frameon=False)
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)
