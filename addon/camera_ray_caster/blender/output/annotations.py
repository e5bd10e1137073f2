"""Annotations of pictures as files: one beside each picture, and one of a whole run."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from pathlib import Path

import bpy

from ...core.annotations.coco import Sheet, document, merged
from ...core.annotations.keypoints import seen_key_points
from ...core.cast import Images
from ...core.records import InputError
from ..read.keypoints import key_points
from .file_set import appearing

ENDING = "_coco.json"
"""Of the name of a picture's own file."""

WHOLE = "annotations.json"
"""The file of a run."""

CATEGORY = "category"
"""The custom property of objects that names what they are."""


def check_annotations(scene) -> None:
    """Raise InputError where a frame has no one picture that annotations could be of."""
    if scene.render.use_multiview:
        raise InputError("--annotations are of one view: switch off Stereoscopy (Output properties)")


def annotated(scene, images: Images, file_name: str, keypoints: Sequence[str] = ()) -> str:
    """Return the annotations of the picture in a file, which a render has just made of the scene, as COCO's JSON.

    ``keypoints``: see ``read.keypoints``.
    """
    camera, render = images.camera, scene.render
    raster = camera.raster
    if render.use_border and not render.use_crop_to_border:
        size, corner = raster.size, (0, 0)
    else:
        size, corner = raster.shape[::-1], (raster.x0, raster.y0)
    image = {"file_name": file_name, "camera": camera.name, "frame": scene.frame_current_final}
    points = key_points(scene, bpy.context.evaluated_depsgraph_get(), keypoints) if keypoints else []
    seen = seen_key_points(camera, images.shapes, points)
    return json.dumps(document(image, Sheet(*size, corner), camera, images.shapes, category_of, seen))


def category_of(name: str) -> str:
    """Return what an object is: its custom property CATEGORY, else the name of its data, which copies share."""
    item = bpy.data.objects.get(name)
    if item is None:
        return name
    return str(item.get(CATEGORY) or (item.data.name if item.data else name))


def collect(folder: Path, names: Iterable[str]) -> Path:
    """Write the annotations of pictures, which are there, as one file of the folder, and return its path."""
    own = (json.loads((folder / f"{name}{ENDING}").read_text(encoding="utf-8")) for name in names)
    whole = merged(own)
    with appearing(folder) as temporary:
        (temporary / WHOLE).write_text(json.dumps(whole), encoding="utf-8")
    return folder / WHOLE
