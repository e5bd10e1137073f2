"""Finished data sets, read back and written for other programs: one module per format.

A set is a folder that ``cast.py`` or ``dataset.py`` made, with passes as NPZ or as EXR. A format is a function
that takes the views of a set and yields names and contents of files, which may lie in folders; it needs numpy only.
"""

from collections.abc import Iterable
from pathlib import Path

from . import frame_list, labels, maps, object_scenes, sparse
from .finished_set import Files, View, chosen, read_set, views_of, with_splits
from .set_formats import SetFormat

SET_FORMATS = {
    **object_scenes.FORMAT, **sparse.FORMAT, **frame_list.FORMAT,
    "panoptic": SetFormat("COCO panoptic: ids of segments as PNG, and panoptic.json", labels.panoptic, True),
    "yolo": SetFormat("YOLO: images, and boxes in labels, by category", labels.yolo, True),
    "masks": SetFormat("a PNG of each object's visible and whole mask", labels.masks),
    "depth16": SetFormat("16-bit PNG of depths in millimeters, as the scale in depth16.json tells", maps.depth16),
    "normals": SetFormat("16-bit PNG of normals in the camera's frame, x right, y down, z ahead", maps.normals),
    "preview": SetFormat("preview.png: picture, depth, indices and normals side by side", maps.preview),
}  # fmt: skip
"""Formats of finished sets, by their keys."""


READER = "reader.py"


def companions(folder: Path, reports: Iterable[str]) -> Files:
    """Yield what lies in every set: reader.py, which reads it in 20 lines, unless another program's is there; and
    preview.png of the pictures whose reports have these names, if they have a pass that previews show.
    """
    reader, there = Path(__file__).with_name("set_reader.py").read_text(encoding="utf-8"), folder / READER
    if not there.is_file() or there.read_bytes().startswith(reader.partition(":")[0].encode()):
        yield READER, reader
    views = [view for name in reports for view in views_of(folder / f"{name}.json")]
    shown = [view for view in views if view.file.is_file() and any(view.has(key) for key in maps.SHOWN)]
    if shown:
        yield from maps.preview(shown)


__all__ = ["SET_FORMATS", "SetFormat", "View", "chosen", "companions", "read_set", "with_splits"]
