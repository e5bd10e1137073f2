"""Reads the data set in whose folder this file lies: python reader.py, or ``views()``. Needs numpy; EXR: OpenImageIO.

Row 0 of the arrays of ``views()`` is the bottom row; ``top_down(passes)`` has the top row first, as most programs.
camera_ray_caster's ``camera_from_json`` makes the rays from a report.
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


def top_down(passes):
    """Return passes as OpenCV and most programs have them: row 0 at the top, y of flow down, C-contiguous."""
    turned = {name: np.ascontiguousarray(passes[name][::-1]) for name in passes}
    for name, image in turned.items():
        if "flow_forward" in name or "flow_backward" in name:  # an array of an NPZ; of an EXR a channel, .X or .Y
            image *= (1, -1) if image.ndim == 3 else -1 if name.endswith(".Y") else 1
    return turned


def views(folder=Path(__file__).parent):
    """Yield the name, the report and the passes by name of each picture; ``report["camera"]`` has K and the pose."""
    dataset = folder / "dataset.json"
    common = json.loads(dataset.read_text(encoding="utf-8")).get("common", {}) if dataset.is_file() else {}
    for path in sorted((*folder.rglob("*.npz"), *folder.rglob("*.exr"))):
        stems = path.stem, path.stem.rpartition("_")[0]  # without the suffix of a stereo view
        names = [name for stem in stems for name in (stem, f"report_{stem.rpartition('_')[2]}")]
        reports = (path.parent / f"{name}.json" for name in names)
        for report in [report for report in reports if report.is_file()][:1]:
            content, passes = {**common, **json.loads(report.read_text(encoding="utf-8"))}, passes_in(path)
            is_turned = content.get("made", {}).get("rows") == "top"
            yield path.stem, content, top_down(passes) if is_turned else passes


if __name__ == "__main__":
    for name, report, passes in views():
        print(name, report["camera"]["model"], report["frame"], {key: passes[key].shape for key in passes})
