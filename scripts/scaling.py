"""The benchmark's scaling: seconds and memory of a cast against shapes and against pixels, as a table and a diagram."""

from __future__ import annotations

import tracemalloc
from time import perf_counter

import contenders as c
import numpy as np

from camera_ray_caster.core.cast import cast

COUNTS = (10, 100, 1_000, 10_000, 100_000, 1_000_000)
SIZES = ((960, 540), (1920, 1080), (3840, 2160), (7680, 4320), (16384, 8192))
PASSES = ("depth", "shape_index")


def run(rounds: int, threads: int, quick: bool) -> list[dict]:
    """Print and return milliseconds and the largest memory beyond the pictures."""
    counts, sizes = (COUNTS[: len(COUNTS) // 2], SIZES[: len(SIZES) // 2]) if quick else (COUNTS, SIZES)
    cases = [("spheres", n, 1920, 1080) for n in counts] + [("pixels", 100, w, h) for w, h in sizes]
    rows = []
    print(f"\ndepth and shape index, {threads} threads, median of {rounds}")
    print(f"  {'':>12}{'spheres':>10}{'pixels':>13}{'ms':>10}{'ns a pixel':>12}{'memory beside, MB':>19}")
    for what, count, width, height in cases:
        camera, shapes = c.scene(count, width, height)
        cast(camera, shapes, PASSES, threads=threads)
        times = []
        for _ in range(min(rounds, 3)):
            began = perf_counter()
            images = cast(camera, shapes, PASSES, threads=threads)
            times.append(1e3 * (perf_counter() - began))
        del images
        tracemalloc.start()
        images = cast(camera, shapes, PASSES, threads=threads)
        beside = tracemalloc.get_traced_memory()[1] - sum(image.nbytes for image in images.values())
        tracemalloc.stop()
        del images
        median = float(np.median(times))
        rows.append({"against": what, "spheres": count, "pixels": width * height, "median_ms": median,
                     "beside_mb": beside / 1e6})  # fmt: skip
        print(f"  {what:>12}{count:10,}{width * height:13,}{median:10.1f}{1e6 * median / width / height:12.1f}"
              f"{beside / 1e6:19.1f}")  # fmt: skip
    return rows


def draw(rows: list[dict], path) -> None:
    """Draw the milliseconds against both, beside straight lines."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for axis, what in zip(axes, ("spheres", "pixels"), strict=True):
        own = [row for row in rows if row["against"] == what]
        x, y = ([row[name] for row in own] for name in (what, "median_ms"))
        axis.loglog(x, y, "o-", color="#2b6ca3")
        axis.loglog(x, [y[-1] * n / x[-1] for n in x], ":", color="0.5", label="linear")
        axis.set_xlabel(what)
        axis.set_ylabel("milliseconds")
        axis.grid(True, which="major", alpha=0.3)
        axis.legend(frameon=False)
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)
