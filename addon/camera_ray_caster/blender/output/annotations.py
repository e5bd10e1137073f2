"""Annotations of pictures in COCO files: one for each picture, and one for a whole run."""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from ...core.annotations.coco import Sheet, as_text, document, merged_text
from ...core.annotations.keypoints import seen_key_points
from ...core.cast import Images
from ...core.sets.shared_facts import ANNOTATIONS, dataset_of, with_objects, without_objects
from ...core.sets.shared_facts import COCO as ENDING
from ..read.frames import frame_of
from ..read.scene_keypoints import key_points
from ..read.unique import find_unique

CATEGORY = "category"
"""Name of the custom property that holds an object's category."""


def annotated(
    scene, images: Images, file_name: str, suffix: str = "", keypoints: Sequence[str] = (), objects: list | None = None
) -> str:
    """Return the annotations of a picture that was just rendered from the scene, as JSON in COCO's format.

    ``file_name`` is the PNG or, if combined is not cast, the file of passes; ``suffix`` is that of the view in a stereo
    scene; for ``keypoints``, see ``read.scene_keypoints``. ``objects``: see ``core.sets.shared_facts``.
    """
    camera = images.camera
    image = {"file_name": file_name, "camera": camera.name + suffix, "frame": frame_of(scene)}
    points = key_points(scene, bpy.context.evaluated_depsgraph_get(), keypoints) if keypoints else []
    seen = seen_key_points(camera, images.shapes, points)
    sheet = Sheet.of(camera.raster)
    annotations = document(image, sheet, camera, images.shapes, category_of, seen, images)
    return as_text(annotations if objects is None else without_objects(annotations, objects))


def category_of(name: str) -> str:
    """Return the category of the object with a unique name: its custom property CATEGORY, or else the name of its
    data, which copies share.
    """
    item = find_unique(name, bpy.data.objects)
    if item is None:
        return name
    category = item.get(CATEGORY)
    return (item.data.name if item.data else name) if category in (None, "") else str(category)


def merged_files(
    folder: Path, jobs: Iterable[Any], suffixes: Sequence[str] = ("",)
) -> Iterator[tuple[str, Iterator[str]]]:
    """Yield the name and the text, in parts, of the annotation file of pictures in a folder; nothing for no picture.
    The jobs, which have their names, are iterated twice.
    """
    if any(True for _ in jobs):
        yield ANNOTATIONS, merged_text(Documents(folder, jobs, suffixes), folder)


@dataclass(frozen=True)
class Documents:
    """The annotations of pictures in a folder, read at each iteration."""

    folder: Path
    jobs: Iterable[Any]
    suffixes: Sequence[str]

    def __iter__(self) -> Iterator[dict[str, Any]]:
        objects = dataset_of(self.folder).get("objects", [])
        for job, suffix in ((job, suffix) for job in self.jobs for suffix in self.suffixes):
            document = json.loads((self.folder / f"{job.name}{suffix}{ENDING}").read_text(encoding="utf-8"))
            document = with_objects(document, objects)
            image, (subfolder, *_) = document["images"][0], job.name.rpartition("/")
            image["file_name"] = f"{subfolder}/{image['file_name']}" if subfolder else image["file_name"]
            yield document
