"""Reads the data set in whose folder this file lies: python reader.py, or ``views()``. Needs numpy; EXR: OpenImageIO.

Row 0 of the arrays is the bottom row. camera_ray_caster's ``camera_from_json`` makes the rays from a report.
"""

import json
from pathlib import Path

import numpy as np


def passes_in(path):
    """Return the arrays of a file by name: passes of an NPZ, channels of an EXR."""
    if path.suffix == ".npz":
        return np.load(path)
    import OpenImageIO  # pip install OpenImageIO; Blender's Python has it

    image = OpenImageIO.ImageBuf(str(path))
    pixels = np.asarray(image.get_pixels("float"))[::-1]
    return {name: pixels[..., k] for k, name in enumerate(image.spec().channelnames)}


def views(folder=Path(__file__).parent):
    """Yield the name, the report and the passes by name of each picture; ``report["camera"]`` has K and the pose."""
    dataset = folder / "dataset.json"
    common = json.loads(dataset.read_text(encoding="utf-8")).get("common", {}) if dataset.is_file() else {}
    for path in sorted((*folder.rglob("*.npz"), *folder.rglob("*.exr"))):
        stems = path.stem, path.stem.rpartition("_")[0]  # without the suffix of a stereo view
        reports = [path.parent / f"{one}.json" for stem in stems for one in (stem, f"report_{stem.rpartition('_')[2]}")]
        for report in [one for one in reports if one.is_file()][:1]:
            yield path.stem, {**common, **json.loads(report.read_text(encoding="utf-8"))}, passes_in(path)


if __name__ == "__main__":
    for name, report, passes in views():
        print(name, report["camera"]["model"], report["frame"], {key: passes[key].shape for key in passes})
