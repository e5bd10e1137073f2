"""The benchmark of large sets: processor seconds and memory as the pictures become many; small ones, by one process."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[2]
WORDS = "blend_scenes/spheres_and_planes.blend", "--resolution", "32x24", "--passes", "combined,depth,shape_index"
COUNTS = 100, 400, 1600


def run(counts: tuple[int, ...]) -> list[dict]:
    """Print and return the figures of sets of so many pictures, with and without annotations."""
    rows = []
    print("\npictures  annotations  processor s  s a picture  peak MB  bytes a picture: JSON  all")
    for options in ["--annotations"], []:
        for count in counts:
            with tempfile.TemporaryDirectory() as folder:
                row = {"pictures": count, "annotations": bool(options)} | _measured(
                    count, Path(folder) / "set", options
                )
            rows.append(row)
            print(f"{count:8}  {'yes' if options else 'no':>11}  {row['cpu']:11.1f}  {row['cpu'] / count:11.4f}"
                  f"  {row['peak']:7.0f}  {row['json']:21.0f}  {row['bytes']:3.0f}", flush=True)  # fmt: skip
        few, many = rows[-len(counts)], rows[-1]
        if few is not many:
            each = (many["cpu"] - few["cpu"]) / (many["pictures"] - few["pictures"])
            print(f"{'':8}  each further picture: {each:.4f} s, "
                  f"{(many['peak'] - few['peak']) / (many['pictures'] - few['pictures']):.4f} MB")  # fmt: skip
    return rows


def _measured(count: int, out: Path, options: list[str]) -> dict[str, float]:
    """Make a set; return the seconds of processors, the peak in MB, and the bytes of a picture."""
    words = [sys.executable, ROOT / "scripts/dataset.py", *WORDS, "--frames", f"1:{count}", "--output", out, *options]
    process = subprocess.Popen(words, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"dataset.py ended with status {process.returncode}")
    pictures = [path for path in out.iterdir() if path.name.startswith("Camera_")]
    kinds = [path for path in pictures if path.suffix == ".json"]
    sizes = [sum(path.stat().st_size for path in paths) / count for paths in (kinds, pictures)]
    return {"cpu": used.ru_utime + used.ru_stime, "peak": used.ru_maxrss / 1024, "json": sizes[0], "bytes": sizes[1]}
