"""nerfstudio's transforms.json of a set, with images, depths and masks.

Depths are 16 bits in millimeters along the viewing direction, as nerfstudio's depth_unit_scale_factor of 0.001 has them
where a Blender unit is a meter; 0 is no hit. Masks are white where a pixel has a ray. Splits are train_filenames,
val_filenames and test_filenames, of which the last two are the same.
Reference: nerfstudio documentation, Data conventions.
"""

import json
from itertools import chain
from typing import Any

import numpy as np

from ..programs.nerfstudio import camera_model, frame_of
from ..records import InputError
from .finished_set import TRAIN, VALIDATION, Files, View
from .png import MOST_16_BITS, png
from .set_formats import SetFormat
from .streams import Waiting, records_of


def files(views: list[View]) -> Files:
    """Yield the files of a set; see the package. Raises InputError for cameras that nerfstudio cannot represent, and
    for depths beyond 65 m.
    """
    each, frames = records_of("nerfstudio", views), Waiting()
    transforms: dict[str, Any] = {"camera_model": camera_model(each), "frames": [""]}
    for frame, view in zip(map(frame_of, each), views, strict=True):
        depth = np.round(view.planar_depth() * 1000)
        if depth.max(initial=0) > MOST_16_BITS:
            raise InputError(f"depths of {view.name} are up to {depth.max() / 1000:.0f}: 16 bits hold 65 units")
        valid = view.framed(view.camera.rays().valid)
        for key, folder, pixels in (
            ("depth_file_path", "depths", depth.clip(0).astype(np.uint16)),
            ("mask_path", "masks", valid.astype(np.uint8) * 255),
        ):
            frame[key] = f"{folder}/{view.name}.png"
            yield frame[key], png(pixels[::-1])
        frame["file_path"] = f"images/{view.name}.png"
        frames.add(json.dumps(frame, indent=1).replace("\n", "\n  "), ",\n  ")
        yield from view.picture_as(frame["file_path"])
    if views[0].split:
        names = {split: [f"images/{view.name}.png" for view in views if view.split == split]
                 for split in (TRAIN, VALIDATION)}  # fmt: skip
        parts = {"train": names[TRAIN], "val": names[VALIDATION], "test": names[VALIDATION]}
        transforms |= {f"{split}_filenames": paths for split, paths in parts.items()}
    before, after = json.dumps(transforms, indent=1).split('""', 1)
    yield "transforms.json", chain([before], frames, [after])


FORMAT = {
    "nerfstudio-scene": SetFormat("nerfstudio: transforms.json, images, depths and masks", files, splits=True),
}  # fmt: skip
