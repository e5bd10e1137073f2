"""Labels of pictures: COCO's panoptic segments, YOLO's boxes, and masks as PNG.

References: COCO documentation, Data format, Panoptic Segmentation; Ultralytics documentation, Detect datasets.
"""

import json
from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np

from ..annotations.coco import Merging, unpacked
from .finished_set import TRAIN, VALIDATION, Files, View
from .png import png
from .streams import Waiting


def panoptic(views: list[View]) -> Files:
    """Yield panoptic.json and a PNG of segment ids, R + 256 G + 65536 B, for each view; 0 is no object. Each split has
    files of its own: panoptic_train.json, panoptic_val.json.
    """
    merging = Merging(view.annotations for view in views)
    images = {f"_{view.split}" if view.split else "": (Waiting(), Waiting()) for view in views}
    for view in views:
        entries = merging.entries(view.annotations)
        objects, (size,) = entries["annotations"], entries["images"]
        ids = np.zeros((size["height"], size["width"]), np.uint32)
        for entry in objects:
            ids[unpacked(entry["segmentation"])] = entry["shape_index"] + 1
        colors = np.stack([(ids >> shift & 255).astype(np.uint8) for shift in (0, 8, 16)], axis=-1)
        end = f"_{view.split}" if view.split else ""
        yield f"panoptic{end}/{view.name}.png", png(colors)
        kept = [{key: shape[key] for key in ("category_id", "bbox", "area")} for shape in objects]
        segments = [{"id": shape["shape_index"] + 1, "iscrowd": 0} | entry
                    for shape, entry in zip(objects, kept, strict=True)]  # fmt: skip
        segmented = {"image_id": size["id"], "file_name": f"{view.name}.png", "segments_info": segments}
        for waiting, entry in zip(images[end], (size, segmented), strict=True):
            waiting.add(json.dumps(entry))
    info = json.dumps(merging.info)
    categories = json.dumps([{**category, "isthing": 1} for category in merging.categories])
    for end, (files, segments_of) in images.items():
        yield f"panoptic{end}.json", chain(
            [f'{{"info": {info}, "images": ['], files, ['], "annotations": ['], segments_of,
            [f'], "categories": {categories}}}'],
        )  # fmt: skip


def yolo(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield data.yaml, and for each view a picture and the boxes of what is visible, in parts of the picture. Each
    split has folders of its own.
    """
    merging = Merging(view.annotations for view in views)
    names = [*merging.numbers]
    lines = "".join(f"  {number}: {json.dumps(name, ensure_ascii=False)}\n" for number, name in enumerate(names))
    train, validation = (f"images/{split}" if views[0].split else "images" for split in (TRAIN, VALIDATION))
    yield "data.yaml", f"path: .\ntrain: {train}\nval: {validation}\nnames:\n{lines}"
    for view in views:
        entries = merging.entries(view.annotations)
        objects, (size,) = entries["annotations"], entries["images"]
        stem = f"{view.split}/{view.name}" if view.split else view.name
        yield f"labels/{stem}.txt", "".join(_box(entry, size) for entry in objects)
        yield from view.picture_as(f"images/{stem}.png")


def _box(entry: dict[str, Any], size: dict[str, Any]) -> str:
    x, y, width, height = entry["bbox"]
    sides = size["width"], size["height"]
    numbers = (x + width / 2) / sides[0], (y + height / 2) / sides[1], width / sides[0], height / sides[1]
    return f"{entry['category_id'] - 1} {' '.join(f'{number:.8f}' for number in numbers)}\n"


def masks(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield for each object in each view its visible and its whole mask; the names have its shape index."""
    for view in views:
        for entry in (*view.annotations["annotations"], *view.annotations["hidden"]):
            stem = f"{view.name}_{entry['shape_index']:04}"
            if "segmentation" in entry:
                yield f"mask_visible/{stem}.png", png(unpacked(entry["segmentation"]).astype(np.uint8) * 255)
            yield f"mask_whole/{stem}.png", png(unpacked(entry["segmentation_whole"]).astype(np.uint8) * 255)
