"""Annotations of pictures in COCO files: one for each picture, and one for a whole run."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from pathlib import Path

import bpy

from ...core.annotations.coco import Sheet, document, merged
from ...core.annotations.keypoints import seen_key_points
from ...core.cast import Images
from ...core.file_set import atomic_folder
from ..read.frames import frame_of
from ..read.keypoints import key_points
from ..read.unique import find_unique

ENDING = "_coco.json"
"""Ending of the name of a picture's annotation file."""

WHOLE = "annotations.json"
"""Name of the annotation file of a run."""

CATEGORY = "category"
"""Name of the custom property that holds an object's category."""


def annotated(scene, images: Images, file_name: str, suffix: str = "", keypoints: Sequence[str] = ()) -> str:
    """Return the annotations of a picture that was just rendered from the scene, as JSON in COCO's format.

    ``file_name`` is the PNG or, if combined is not cast, the file of passes; ``suffix`` is that of the view in a stereo
    scene; for ``keypoints``, see ``read.keypoints``.
    """
    camera = images.camera
    image = {"file_name": file_name, "camera": camera.name + suffix, "frame": frame_of(scene)}
    points = key_points(scene, bpy.context.evaluated_depsgraph_get(), keypoints) if keypoints else []
    seen = seen_key_points(camera, images.shapes, points)
    sheet = Sheet.of(camera.raster)
    return json.dumps(document(image, sheet, camera, images.shapes, category_of, seen, images))


def category_of(name: str) -> str:
    """Return the category of the object with a unique name: its custom property CATEGORY, or else the name of its
    data, which copies share.
    """
    item = find_unique(name, bpy.data.objects)
    if item is None:
        return name
    given = item.get(CATEGORY)
    return (item.data.name if item.data else name) if given in (None, "") else str(given)


def collect(folder: Path, names: Iterable[str]) -> Path:
    """Merge the annotation files of the named pictures into one file in the folder, and return its path."""
    own = (json.loads((folder / f"{name}{ENDING}").read_text(encoding="utf-8")) for name in names)
    whole = merged(own)
    with atomic_folder(folder) as temporary:
        (temporary / WHOLE).write_text(json.dumps(whole), encoding="utf-8")
    return folder / WHOLE
