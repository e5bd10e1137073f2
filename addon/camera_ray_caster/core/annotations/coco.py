"""Annotations in COCO's format: images, categories, boxes, masks and key points, of one picture or of many.

Boxes are x, y, width and height in pixels from the top left corner of the picture, y down. Key points are x, y and
visibility: 0 outside, 1 hidden, 2 seen; a pixel's center is at + 0.5. Instances of an object have no key points. Masks
are run lengths, column by column. Besides COCO's own keys there are ``bbox_whole``, ``area_whole`` and
``segmentation_whole``, the amodal mask, of the object if it were alone in the picture, ``visible_fraction``, ``object``
and ``shape_index``; and the lists ``hidden``, of objects without visible pixels, ``keypoints``, of all key points with
their world coordinates and depth, and ``objects``, of the poses of all objects (see ``object_poses``).
Reference: https://cocodataset.org/#format-data.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from itertools import chain
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..cast import Images
from ..motion.moments import check_rows, check_still
from ..records import Raster, Shapes
from ..version import VERSION
from .keypoints import SeenKeyPoint
from .object_poses import object_poses
from .silhouettes import Box, Silhouette, silhouettes

Document = dict[str, Any]

CHUNK = 1 << 16
"""Number of characters that are copied at once."""

NO_POINT: list[float] = [0, 0, 0]
"""COCO's entry for a key point that an object does not have, or that is outside of the picture."""


@dataclass(frozen=True)
class Sheet:
    """A picture's file: its size in pixels, and the column and row of the full frame at its bottom left corner."""

    width: int
    height: int
    corner: tuple[int, int] = (0, 0)

    @classmethod
    def of(cls, raster: Raster) -> Sheet:
        """Return the sheet of a camera's pictures."""
        x0, _, y0, _ = raster.picture
        return cls(*raster.picture_size, (x0, y0))

    def box(self, x0: int, x1: int, y0: int, y1: int) -> list[int]:
        """Return pixels x0 .. x1 - 1, y0 .. y1 - 1 of the full frame, y up, as a box of COCO."""
        return [x0 - self.corner[0], self.height - (y1 - self.corner[1]), x1 - x0, y1 - y0]

    def point(self, pixel: tuple[float, float]) -> list[float]:
        """Return pixel coordinates of the full frame, y up, as pixel coordinates of COCO."""
        return [pixel[0] - self.corner[0], self.height - (pixel[1] - self.corner[1])]


def document(
    image: dict[str, Any],
    sheet: Sheet,
    camera: Camera,
    shapes: Shapes,
    category_of: Callable[[str], str],
    points: Sequence[SeenKeyPoint] = (),
    images: Images | None = None,
) -> Document:
    """Return the annotations of one picture.

    image: ``file_name``, and any further entries of the image. category_of: maps an object's name to its category.
    images: a cast of camera and shapes, if there is one.
    Raises InputError if pixels have their own times, and objects appear or disappear, or those with key points move.
    """
    check_rows(shapes)
    check_still(shapes, {seen.point.owner for seen in points})
    outlines, index = silhouettes(camera, shapes, images)
    raster = camera.raster
    names = [shapes.names[shapes.name_index[outline.row]] for outline in outlines]
    category = {name: category_of(name) for name in names}
    numbers = {name: number for number, name in enumerate(sorted(set(category.values())), 1)}
    key_names: dict[str, list[str]] = {name: [] for name in numbers}
    for seen in points:
        if seen.point.owner in category:
            key_names[category[seen.point.owner]].append(seen.point.name)
    key_names = {name: list(dict.fromkeys(names_of)) for name, names_of in key_names.items()}

    def box(ends: Box) -> list[int]:
        x0, x1, y0, y1 = ends
        return sheet.box(x0 + raster.x0, x1 + raster.x0, y0 + raster.y0, y1 + raster.y0)

    def mask(pixels: np.ndarray, column: int = 0, row: int = 0) -> dict[str, Any]:
        picture = np.zeros((sheet.height, sheet.width), bool)
        x, y = raster.x0 - sheet.corner[0] + column, raster.y0 - sheet.corner[1] + row
        picture[y : y + pixels.shape[0], x : x + pixels.shape[1]] = pixels
        return run_lengths(picture[::-1])

    def whole(name: str, outline: Silhouette) -> Document:
        return {
            "image_id": 1, "category_id": numbers[category[name]], "object": name, "shape_index": outline.row,
            "bbox_whole": box(outline.whole), "area_whole": outline.whole_pixels,
            "segmentation_whole": mask(outline.alone, outline.whole[0], outline.whole[2]),
        }  # fmt: skip

    def annotation(name: str, outline: Silhouette, ends: Box) -> Document:
        is_own = not (shapes.instanced and shapes.instanced[shapes.name_index[outline.row]])
        triples = {seen.point.name: _triple(sheet, seen) for seen in points if is_own and seen.point.owner == name}
        return whole(name, outline) | {
            "iscrowd": 0, "bbox": box(ends), "area": outline.visible_pixels, "segmentation": mask(index == outline.row),
            "visible_fraction": outline.visible_pixels / outline.whole_pixels,
            **_key_points(triples, key_names[category[name]]),
        }  # fmt: skip

    pairs = list(zip(names, outlines, strict=True))
    shown = [annotation(name, outline, outline.visible) for name, outline in pairs if outline.visible is not None]
    return {
        "info": {"description": "Made by Camera Ray Caster", "version": VERSION},
        "images": [{"id": 1, **image, "width": sheet.width, "height": sheet.height}],
        "categories": [_category(number, name, key_names[name]) for name, number in numbers.items()],
        "annotations": [{"id": number, **entry} for number, entry in enumerate(shown, 1)],
        "hidden": [whole(name, outline) for name, outline in pairs if outline.visible is None],
        "keypoints": [
            {
                "image_id": 1, "name": seen.point.name, "object": seen.point.owner, "world": list(seen.point.position),
                "pixel": seen.pixel and sheet.point(seen.pixel), "depth": seen.depth,
                "visibility": seen.visibility.name.lower(),
            }
            for seen in points
        ],
        "objects": [{"image_id": 1, **pose} for pose in object_poses(shapes, category_of)],
    }  # fmt: skip


LISTS = "images", "annotations", "hidden", "keypoints", "objects"
"""The parts of a document that have entries of each picture."""


class Merging:
    """Several documents as one, numbered anew, one after the other; categories of the same name are merged. They are
    read twice: first all categories are counted, then the entries are made.
    """

    def __init__(self, documents: Iterable[Document]):
        self.info: Document = {}
        self.key_names: dict[str, list[str]] = {}
        for document in documents:
            self.info = document["info"]
            for category in document["categories"]:
                known = self.key_names.setdefault(category["name"], [])
                known += [name for name in category.get("keypoints", ()) if name not in known]
        self.numbers = {name: number for number, name in enumerate(self.key_names, 1)}
        self._images = self._annotations = 0

    @property
    def categories(self) -> list[Document]:
        """The merged categories."""
        return [_category(number, name, self.key_names[name]) for name, number in self.numbers.items()]

    def entries(self, document: Document) -> dict[str, list[Document]]:
        """Return the entries of the next document, by their list in LISTS."""
        self._images += 1
        image = {"image_id": self._images}
        categories = {category["id"]: category for category in document["categories"]}
        made: dict[str, list[Document]] = {"images": [document["images"][0] | {"id": self._images}]}
        for kind in ("annotations", "hidden"):
            made[kind] = [self._entry(entry | image, categories[entry["category_id"]]) for entry in document[kind]]
        for kind in ("keypoints", "objects"):
            made[kind] = [entry | image for entry in document[kind]]
        for entry in made["annotations"]:
            self._annotations += 1
            entry["id"] = self._annotations
        return made

    def _entry(self, entry: Document, category: Document) -> Document:
        entry["category_id"] = self.numbers[category["name"]]
        if "bbox" in entry:
            values = entry.get("keypoints", [])
            triples = [values[k : k + 3] for k in range(0, len(values), 3)]
            points = dict(zip(category.get("keypoints", ()), triples, strict=True))
            entry |= _key_points(points, self.key_names[category["name"]])
        return entry


def merged(documents: Iterable[Document]) -> Document:
    """Return several documents as one; see ``Merging``."""
    documents = list(documents)
    merging = Merging(documents)
    result: Document = {"info": merging.info, "images": [], "categories": merging.categories}
    result |= {kind: [] for kind in LISTS if kind != "images"}
    for document in documents:
        for kind, entries in merging.entries(document).items():
            result[kind] += entries
    return result


def merged_text(documents: Iterable[Document], folder: Path) -> Iterator[str]:
    """Yield the text of several documents as one, as JSON without white space. ``documents`` is iterated twice, and one
    document is held at a time: the entries wait in files without names, on the disk of a folder.
    """
    merging = Merging(documents)
    with ExitStack() as stack:
        waiting = {kind: stack.enter_context(TemporaryFile("w+", encoding="utf-8", dir=folder)) for kind in LISTS}
        begun = set()
        for document in documents:
            for kind, entries in merging.entries(document).items():
                if entries:
                    waiting[kind].write("," * (kind in begun) + as_text(entries)[1:-1])
                    begun.add(kind)
        yield f'{{"info":{as_text(merging.info)}'
        for kind in ("images", "categories", *LISTS[1:]):
            yield f',"{kind}":'
            if kind == "categories":
                yield as_text(merging.categories)
                continue
            yield "["
            waiting[kind].seek(0)
            yield from iter(partial(waiting[kind].read, CHUNK), "")
            yield "]"
        yield "}"


def as_text(document: Any) -> str:
    """Return plain values as JSON without white space."""
    return json.dumps(document, separators=(",", ":"))


def run_lengths(mask: np.ndarray) -> dict[str, Any]:
    """Return a mask (rows, columns), row 0 at the top, as COCO's run lengths by columns, alternately of 0 and of 1."""
    flat = mask.ravel(order="F")
    changes = np.flatnonzero(np.diff(flat, prepend=False))
    return {"size": list(mask.shape), "counts": np.diff(changes, prepend=0, append=len(flat)).tolist()}


def unpacked(lengths: dict[str, Any]) -> np.ndarray:
    """Return the mask (rows, columns) bool of run lengths, row 0 at the top: undoes ``run_lengths``."""
    values = np.arange(len(lengths["counts"])) % 2 == 1
    return np.repeat(values, lengths["counts"]).reshape(lengths["size"], order="F")


def _category(number: int, name: str, key_names: list[str]) -> Document:
    entry = {"id": number, "name": name, "supercategory": ""}
    return entry | {"keypoints": key_names, "skeleton": []} if key_names else entry


def _triple(sheet: Sheet, seen: SeenKeyPoint) -> list[float]:
    if seen.pixel is None or not seen.visibility:
        return NO_POINT
    return [*sheet.point(seen.pixel), int(seen.visibility)]


def _key_points(points: dict[str, list[float]], names: list[str]) -> Document:
    """Return COCO's entries for an object's key points, in the order of its category; none if the category has none."""
    triples = [points.get(name, NO_POINT) for name in names]
    entry = {"keypoints": list(chain(*triples)), "num_keypoints": sum(triple[2] > 0 for triple in triples)}
    return entry if names else {}
