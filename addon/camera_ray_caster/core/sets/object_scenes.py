"""BOP scenes: one per camera, with pictures, depth, masks and the poses of objects.

Objects are the categories, numbered by name in models_info.json; the frame of an object is the middle of its box, in
its axes. With the .blend of the set, each has a model, models/obj_OBJECT.ply, and its symmetries; without, diameters
are those of boxes. Splits are the folders train and val in place of test.
Lengths are in millimeters; depth in 16 bits is along the viewing direction, in steps of depth_scale.
References: BOP toolkit documentation, BOP dataset format; T. Hodan et al., BOP Challenge 2020.
"""

import json
from collections.abc import Callable
from itertools import chain
from typing import Any

import numpy as np

from ..annotations.coco import unpacked
from ..exports import find_format, records
from ..programs.bop import image_of
from ..records import InputError, Shapes
from ..units import MILLIMETERS, factor
from .finished_set import Files, View
from .object_models import diameter, model_of, ply
from .png import MOST_16_BITS, png
from .set_formats import SetFormat
from .streams import Waiting

DEPTH_STEP = 0.1
"""Millimeters of a step of depth, if the farthest hit is then within 16 bits; else as coarse as needed."""


def files(views: list[View], shapes_at: Callable[[float], Shapes] | None = None) -> Files:
    """Yield the files of a set; see the package. ``shapes_at`` returns the shapes of a frame, of which models are made.
    Raises InputError for cameras that are no pinholes.
    """
    for view in views:
        reason = find_format("bop").refusal(view.shot)
        if reason is not None:
            raise InputError(f"BOP has pinholes only, and camera {view.camera_name!r} is none {reason}".strip()
                             + ": choose others (--cameras)")  # fmt: skip
    named = {entry["category"]: (entry, view.frame) for view in views for entry in view.annotations["objects"]}
    numbers = {name: number for number, name in enumerate(sorted(named), 1)}
    cameras = list(dict.fromkeys(view.camera_name for view in views))
    for scene, name in enumerate(cameras):
        of_camera = [view for view in views if view.camera_name == name]
        for split in dict.fromkeys(view.split for view in of_camera):
            of_split = [view for view in of_camera if view.split == split]
            yield from _scene(f"{split or 'test'}/{scene:06}", of_split, numbers)
    models = {}
    for name, number in numbers.items():
        entry, frame = named[name]
        millimeters = factor(MILLIMETERS, views[0].meters)
        size = np.array(entry["size"]) * millimeters
        across, same = float(np.linalg.norm(size)), dict[str, list[Any]]()
        if shapes_at is not None:
            model = model_of(shapes_at(frame), entry)
            across, same = diameter(model.vertices * millimeters), model.symmetries(millimeters)
            yield f"models/obj_{number:06}.ply", ply(model, millimeters)
        models[str(number)] = {
            "name": name, "diameter": across,
            **{f"min_{axis}": -side / 2 for axis, side in zip("xyz", size.tolist(), strict=True)},
            **{f"size_{axis}": side for axis, side in zip("xyz", size.tolist(), strict=True)}, **same,
        }  # fmt: skip
    yield "models/models_info.json", json.dumps(models, indent=1)


def _scene(folder: str, views: list[View], numbers: dict[str, int]) -> Files:
    cameras, truth, facts = Waiting(), Waiting(), Waiting()
    for view in views:
        number = f"{int(view.frame):06}"
        depth = view.planar_depth() * factor(MILLIMETERS, view.meters)
        step = DEPTH_STEP if depth.max(initial=0) <= MOST_16_BITS * DEPTH_STEP else float(depth.max()) / MOST_16_BITS
        yield f"{folder}/depth/{number}.png", png(np.round(depth / step).astype(np.uint16)[::-1])
        yield from view.picture_as(f"{folder}/rgb/{number}.png")
        (record,) = records("bop", [view.shot])
        cameras.add(_entry(view, image_of(record) | {"depth_scale": step}))
        poses = {entry["shape_index"]: entry for entry in view.annotations["objects"]}
        entries = [entry for kind in ("annotations", "hidden") for entry in view.annotations[kind]]
        entries = [entry for entry in entries if entry["shape_index"] in poses]
        truth.add(_entry(view, [_truth(view, poses[entry["shape_index"]], numbers) for entry in entries]))
        facts.add(_entry(view, [_facts(entry) for entry in entries]))
        for k, entry in enumerate(entries):
            whole = unpacked(entry["segmentation_whole"])
            visible = unpacked(entry["segmentation"]) if "segmentation" in entry else np.zeros_like(whole)
            yield f"{folder}/mask/{number}_{k:06}.png", png(whole.astype(np.uint8) * 255)
            yield f"{folder}/mask_visib/{number}_{k:06}.png", png(visible.astype(np.uint8) * 255)
    for name, texts in (("scene_camera", cameras), ("scene_gt", truth), ("scene_gt_info", facts)):
        yield f"{folder}/{name}.json", chain(["{"], texts, ["}"])


def _entry(view: View, content: Any) -> str:
    return f'"{int(view.frame)}": {json.dumps(content)}'


def _truth(view: View, entry: dict[str, Any], numbers: dict[str, int]) -> dict[str, Any]:
    matrix, millimeters = view.camera.opencv_from_world @ np.array(entry["matrix"]), factor(MILLIMETERS, view.meters)
    return {
        "cam_R_m2c": matrix[:3, :3].ravel().tolist(), "cam_t_m2c": (matrix[:3, 3] * millimeters).tolist(),
        "obj_id": numbers[entry["category"]],
    }  # fmt: skip


def _facts(entry: dict[str, Any]) -> dict[str, Any]:
    return {
        "bbox_obj": entry["bbox_whole"], "bbox_visib": entry.get("bbox", [-1, -1, -1, -1]),
        "px_count_all": entry["area_whole"], "px_count_valid": entry["area_whole"],
        "px_count_visib": entry.get("area", 0),
        "visib_fract": entry.get("visible_fraction", 0.0),
    }  # fmt: skip


FORMAT = {"bop-scenes": SetFormat(
    "BOP: a scene per camera: rgb, depth, masks, poses of objects, boxes", files, splits=True, option="models"
)}  # fmt: skip
