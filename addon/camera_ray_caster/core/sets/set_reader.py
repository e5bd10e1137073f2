"""Reads the data set in whose folder this file lies: python reader.py, or ``views()``. Needs numpy only.

Row 0 of the arrays is the bottom row. camera_ray_caster's ``camera_from_json`` makes the rays from a report.
"""

import json
from pathlib import Path

import numpy as np


def views(folder=Path(__file__).parent):
    """Yield the name, the report and the passes by name of each picture; ``report["camera"]`` has K and the pose."""
    for path in sorted(folder.glob("*.npz")):
        report = path.with_suffix(".json")
        if report.is_file():
            yield path.stem, json.loads(report.read_text(encoding="utf-8")), np.load(path)


if __name__ == "__main__":
    for name, report, passes in views():
        print(name, report["camera"]["model"], report["frame"], {key: passes[key].shape for key in passes})
