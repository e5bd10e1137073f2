"""Labels of pictures: COCO's panoptic segments, YOLO's boxes, and masks as PNG.

References: COCO documentation, Data format, Panoptic Segmentation; Ultralytics documentation, Detect datasets.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..annotations.coco import merged, unpacked
from .png import png
from .reading import TRAIN, VALIDATION, View


def panoptic(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield panoptic.json and a PNG of segment ids, R + 256 G + 65536 B, for each view; 0 is no object. Each split has
    files of its own: panoptic_train.json, panoptic_val.json.
    """
    whole = merged(view.annotations for view in views)
    images: dict[str, list] = {f"_{view.split}" if view.split else "": [] for view in views}
    for number, view in enumerate(views, 1):
        own = [one for one in whole["annotations"] if one["image_id"] == number]
        size = view.annotations["images"][0]
        ids = np.zeros((size["height"], size["width"]), np.uint32)
        for one in own:
            ids[unpacked(one["segmentation"])] = one["shape_index"] + 1
        colors = np.stack([(ids >> shift & 255).astype(np.uint8) for shift in (0, 8, 16)], axis=-1)
        end = f"_{view.split}" if view.split else ""
        yield f"panoptic{end}/{view.name}.png", png(colors)
        segments = [
            {"id": one["shape_index"] + 1, "iscrowd": 0, **{key: one[key] for key in ("category_id", "bbox", "area")}}
            for one in own
        ]
        images[end].append({"image_id": number, "file_name": f"{view.name}.png", "segments_info": segments})
    categories = [{**one, "isthing": 1} for one in whole["categories"]]
    for end, own in images.items():
        files = [whole["images"][one["image_id"] - 1] for one in own]
        said = {"info": whole["info"], "images": files, "annotations": own, "categories": categories}
        yield f"panoptic{end}.json", json.dumps(said)


def yolo(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield data.yaml, and for each view a picture and the boxes of what is visible, in parts of the picture. Each
    split has folders of its own.
    """
    whole = merged(view.annotations for view in views)
    names = [one["name"] for one in whole["categories"]]
    lines = "".join(f"  {number}: {json.dumps(name, ensure_ascii=False)}\n" for number, name in enumerate(names))
    train, validation = (f"images/{one}" if views[0].split else "images" for one in (TRAIN, VALIDATION))
    yield "data.yaml", f"path: .\ntrain: {train}\nval: {validation}\nnames:\n{lines}"
    for number, view in enumerate(views, 1):
        size = whole["images"][number - 1]
        own = [one for one in whole["annotations"] if one["image_id"] == number]
        stem = f"{view.split}/{view.name}" if view.split else view.name
        yield f"labels/{stem}.txt", "".join(_box(one, size) for one in own)
        if view.picture is not None:
            yield f"images/{stem}.png", view.picture


def _box(one: dict[str, Any], size: dict[str, Any]) -> str:
    x, y, width, height = one["bbox"]
    sides = size["width"], size["height"]
    numbers = (x + width / 2) / sides[0], (y + height / 2) / sides[1], width / sides[0], height / sides[1]
    return f"{one['category_id'] - 1} {' '.join(f'{number:.8f}' for number in numbers)}\n"


def masks(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield for each object in each view its visible and its whole mask; the names have its shape index."""
    for view in views:
        for one in (*view.annotations["annotations"], *view.annotations["hidden"]):
            stem = f"{view.name}_{one['shape_index']:04}"
            if "segmentation" in one:
                yield f"mask_visible/{stem}.png", png(unpacked(one["segmentation"]).astype(np.uint8) * 255)
            yield f"mask_whole/{stem}.png", png(unpacked(one["segmentation_whole"]).astype(np.uint8) * 255)
