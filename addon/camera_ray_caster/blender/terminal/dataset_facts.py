"""What is the same for all pictures of a data set, from the first picture: see ``core.sets.shared_facts``."""

from typing import Any

import bpy

from ...core.annotations.object_poses import object_poses
from ...core.report.indices import indices_of
from ...core.report.report import Report, as_data, uncolored
from ..output.annotations import category_of
from ..read.frames import frame_rate
from ..read.scene_reader import read_shapes
from ..verification.check import verify_camera
from .jobs import PictureJob
from .picture_jobs import Pictures

ENTRIES = "version", "conventions", "layers", "passes", "findings", "left_out", "notes", "exact", "host", "indices"
"""Entries of reports that are the same for all pictures of a scene that stands still. The camera and its record, which
``camera_from_json`` takes, are in every report.
"""


def common_of(pictures: Pictures, first: PictureJob) -> dict[str, Any]:
    """Return ``common`` and ``objects`` of dataset.json. A picture that differs in an entry has its own."""
    camera, scene = pictures.camera_at(first), pictures.scene
    shapes = read_shapes(scene)
    layers = [layer.name for layer in scene.view_layers if layer.use]
    passes = pictures.passes[layers[0]]
    report = Report(
        camera={}, frame=0.0, layers=tuple(layers), passes=tuple(passes), findings=tuple(verify_camera(scene)),
        left_out=(*shapes.left_out, *uncolored(shapes, passes)), notes=shapes.notes,
        exact=tuple(dict.fromkeys(shapes.exact)), indices={layers[0]: indices_of(shapes)},
        host={"blender": bpy.app.version_string, "meters": scene.unit_settings.scale_length,
              "frame_rate": frame_rate(scene)},
    )  # fmt: skip
    data = as_data(report)
    common: dict[str, Any] = {"common": {key: data[key] for key in ENTRIES}}
    if pictures.keypoints is not None and camera.pixel_time is None:
        common["objects"] = [{"image_id": 1, **pose} for pose in object_poses(shapes, category_of)]
    return common
