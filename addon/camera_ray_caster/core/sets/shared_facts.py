"""What is the same for all pictures of a data set: dataset.json has it once, and reports and annotations leave it out.

``common`` in dataset.json has entries of reports, and ``objects`` the poses of objects, as annotations have them. A
report lacks the entries that are equal there. The annotations of a picture have ``moved``, the poses that differ, in
place of ``objects``, if they are of the same objects.
"""

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

DATASET, ANNOTATIONS, COCO = "dataset.json", "annotations.json", "_coco.json"

Entries = dict[str, Any]


def without_objects(document: Entries, objects: list[Entries]) -> Entries:
    """Return annotations of one picture with ``moved`` in place of ``objects``."""
    entries = document["objects"]
    if [entry["shape_index"] for entry in entries] != [entry["shape_index"] for entry in objects]:
        return document
    moved = [entry for entry, other_entry in zip(entries, objects, strict=True) if entry != other_entry]
    return {key: value for key, value in document.items() if key != "objects"} | {"moved": moved}


def with_objects(document: Entries, objects: list[Entries]) -> Entries:
    """Undo ``without_objects``; other annotations are returned as they are."""
    if "moved" not in document:
        return document
    moved = {entry["shape_index"]: entry for entry in document["moved"]}
    whole = [moved.get(entry["shape_index"], entry) for entry in objects]
    return {key: value for key, value in document.items() if key != "moved"} | {"objects": whole}


def dataset_of(folder: Path) -> Entries:
    """Return the content of dataset.json of a folder of pictures, or of the folder around it; {} if there is none."""
    for candidate in (folder, folder.parent):
        path = candidate / DATASET
        try:
            state = path.stat()
            return _read(path, state.st_mtime_ns, state.st_size)
        except (OSError, ValueError):
            continue
    return {}


@lru_cache(maxsize=2)
def _read(path: Path, changed: int, size: int) -> Entries:
    content = json.loads(path.read_text(encoding="utf-8"))
    return content if isinstance(content, dict) else {}
