"""Tables of rays as numpy's arrays: the NPZ of the add-on's ray maps, and NPZ or NPY of other programs.

directions are (rows, columns, 3), origins the same if there are any, valid (rows, columns) bool tells where rays
are; row 0 is the bottom row. With pose, a (4, 4) matrix from the camera's frame to the world, as in ray maps, the rays
are in the world; without it in the camera's frame. With area (4,), they fill a part of the frame: see ``ray_area``. An
NPY holds directions, or (rows, columns, 6): origins, then directions.
"""

import re
import zipfile
from collections.abc import Callable, Mapping, Sequence
from io import BytesIO
from typing import Any

import numpy as np

from ... import memory
from ...arguments import DAMAGED, numbers
from ...cameras.parts.pose import flaw_of
from ...maths.vector import inverse
from ...records import InputError
from .document import Document
from .lens import Lens

ZIP, NPY = b"PK\x03\x04", b"\x93NUMPY"
KEY = "RAY_TABLE"
ENTRIES = 128
"""Entries of a table that is computed, along its longer side."""


def looks(document: Document) -> bool:
    """Whether it is a file of numpy."""
    return document.data.startswith((ZIP, NPY)) and not is_poses_bounds(document)


def is_poses_bounds(document: Document) -> bool:
    """Whether it is an array of numpy with rows of 17 numbers, as LLFF's poses_bounds.npy."""
    return document.data.startswith(NPY) and re.search(rb"'shape': \(\d+, 17\)", document.data[:256]) is not None


def array_of(document: Document) -> np.ndarray:
    """Return the array of an .npy as float64. Raises InputError."""
    return _arrays(document)["directions"]


def lens_of(document: Document) -> Lens:
    """Return the lens of a file of arrays. Raises InputError."""
    arrays = _arrays(document)
    if "time" in arrays:
        raise document.refusal(
            "its pixels have their own times, which a table of rays has not: export a camera without pixel times"
        )
    if "directions" not in arrays:
        raise document.refusal("it has no directions: no array has this name")
    directions, origins = arrays["directions"], arrays.get("origins")
    if directions.ndim != 3 or directions.shape[2] != 3:
        raise document.refusal(f"directions are of shape {directions.shape}: they must be (rows, columns, 3)")
    if origins is not None and origins.shape != directions.shape:
        raise document.refusal(f"origins are of shape {origins.shape}, and directions of {directions.shape}")
    if "valid" in arrays:
        if arrays["valid"].shape != directions.shape[:2]:
            raise document.refusal(f"valid is of shape {arrays['valid'].shape}, directions of {directions.shape}")
        directions = np.where(arrays["valid"][..., None] != 0, directions, np.nan)
    area = arrays.get("area", np.array((0.0, 0.0, 1.0, 1.0)))
    if area.shape != (4,) or not (area[2:] > area[:2]).all():
        raise document.refusal("area must be left, bottom, right, top, 0 to 1 over the frame")
    return table(document, directions, origins, area, arrays.get("pose"))


def pose_in(document: Document) -> np.ndarray | None:
    """Return the pose, (4, 4) to the world, of a document that ``read`` has read; None if it has none."""
    return _arrays(document).get("pose") if document.data.startswith(ZIP) else None


def table(document: Document, directions: np.ndarray, origins: np.ndarray | None, area, pose=None) -> Lens:
    """Return the lens of rays in the camera's frame, or with its pose, (4, 4), in the world; area: see ``ray_area``."""
    settings: dict[str, Any] = {"ray_area": tuple(area.tolist())}
    if pose is not None:
        if pose.shape != (4, 4) or not np.isfinite(pose).all() or not np.linalg.det(pose[:3, :3]):
            raise document.refusal("pose must be a (4, 4) matrix of finite numbers that can be inverted")
        flaw = flaw_of(pose)
        if flaw:
            raise document.refusal(f"pose {flaw}")
        camera_from_world = inverse(pose[:3, :3])
        directions = directions @ camera_from_world.T
        origins = None if origins is None else (origins - pose[:3, 3]) @ camera_from_world.T
        settings["ray_axes"] = "BLENDER"
    sides = np.array(directions.shape[1::-1]) / (area[2:] - area[:2])
    size = dict(zip(("calibration_width", "calibration_height"), sides.round().tolist(), strict=True))
    for array in (directions, origins):
        if array is not None:
            array.setflags(write=False)
    return Lens("", KEY, {**size, **settings, "ray_directions": directions, "ray_origins": origins})


def sampled(document: Document, sides: Sequence[int], rays: Callable[..., tuple], axes: str) -> Lens:
    """Return the lens of a camera with pictures of these sides whose rays have no model: ENTRIES along the longer one.

    ``rays`` takes columns and rows, (rows, columns), with (0, 0) the center of the first pixel, y down, and returns
    directions and origins, (rows, columns, 3), in ``axes``: see ``cameras.ray_table``.
    """
    columns, rows = (max(1, round(min(side, ENTRIES * side / max(sides)))) for side in sides)
    x, y = ((np.arange(count) + 0.5) * side / count - 0.5 for count, side in zip((columns, rows), sides, strict=True))
    directions, origins = rays(*np.meshgrid(x, y[::-1]))
    lens = table(document, directions, origins, np.array((0.0, 0.0, 1.0, 1.0)))
    return lens._replace(settings=lens.settings | document.size(*sides) | {"ray_axes": axes})


def _arrays(document: Document) -> Mapping[str, np.ndarray]:
    """Return the arrays of a file by name as float64. Raises InputError for what is damaged or too large."""
    try:
        return _loaded(document)
    except DAMAGED as error:
        damage = "" if isinstance(error, InputError) else "it is no array of numpy, or damaged: "
        raise document.refusal(damage + (" ".join(str(error).split()) or type(error).__name__)) from error


def _loaded(document: Document) -> Mapping[str, np.ndarray]:
    data = BytesIO(document.data)
    if document.data.startswith(NPY):
        array = numbers(np.load(data, allow_pickle=False), "the array")
        if array.ndim == 3 and array.shape[2] == 6:
            return {"origins": array[..., :3], "directions": array[..., 3:]}
        return {"directions": array}
    with zipfile.ZipFile(data) as archive:
        size = sum(entry.file_size for entry in archive.infolist())
    memory.require(4 * size, f"the arrays of calibration file {document.path!r}", "give a coarser table")
    with np.load(data, allow_pickle=False) as archive:
        wanted = [name for name in ("directions", "origins", "valid", "pose", "area", "time") if name in archive.files]
        return {name: numbers(archive[name], name) for name in wanted}
