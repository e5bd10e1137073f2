"""Maps of pictures as PNG: depth in 16 bits, normals in the camera's frame, and a preview of all."""

import json
from collections.abc import Iterator

import numpy as np

from ..conventions import FROM_BLENDER
from ..records import InputError
from ..units import MILLIMETERS, factor
from .finished_set import View
from .png import MOST_16_BITS, png, srgb

SHOWN = "combined", "depth", "distance", "shape_index", "object_index", "normal"
"""Passes of which a preview shows those that there are."""


def depth16(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield NAME_depth.png for each view, 0 where nothing is hit, and depth16.json: millimeters of a step, and whether
    depths are along the viewing direction ("planar") or from the eye ("distance"), as Blender's Depth is.
    """
    farthest = max(float(_millimeters(view).max(initial=0)) for view in views)
    step = 1.0 if farthest <= MOST_16_BITS else farthest / MOST_16_BITS
    kinds = {}
    for view in views:
        yield f"{view.name}_depth.png", png(np.round(_millimeters(view) / step).astype(np.uint16)[::-1])
        kinds[view.name] = "planar" if view.camera.model.planar else "distance"
    yield "depth16.json", json.dumps({"millimeters": step, "depth": kinds}, indent=1)


def _millimeters(view: View) -> np.ndarray:
    """Return the depths of a view, as files of pictures have them; 0 where nothing is hit."""
    depth = view.pixels("depth")
    return view.framed(np.where(np.isfinite(depth), depth, 0).astype(np.float64)) * factor(MILLIMETERS, view.meters)


def normals(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield NAME_normal.png for each view: 0 to 65535 stands for -1 to 1; the middle where nothing is hit, and outside
    of a render border.
    """
    for view in views:
        opencv_from_world = FROM_BLENDER[:3, :3] @ view.camera.pose.basis.T
        turned = view.framed(view.pixels("normal").astype(np.float64) @ opencv_from_world.T)
        yield f"{view.name}_normal.png", png(np.round((turned + 1) / 2 * MOST_16_BITS).astype(np.uint16)[::-1])


def preview(views: list[View]) -> Iterator[tuple[str, str | bytes]]:
    """Yield preview.png: of the first view of each camera a row of picture, depth or distance, indices and normals."""
    firsts = {view.camera_name: view for view in reversed(views)}
    rows = [row for view in firsts.values() if (row := _row(view)) is not None]
    if not rows:
        raise InputError(f"the set has none of the passes {', '.join(SHOWN)}, which previews show")
    width = max(row.shape[1] for row in rows)
    padded = [np.pad(row, ((0, 0), (0, width - row.shape[1]), (0, 0))) for row in rows]
    yield "preview.png", png(np.vstack(padded)[::-1])


def _row(view: View) -> np.ndarray | None:
    parts = []
    if view.has("combined"):
        parts.append(srgb(view.pixels("combined")[..., :3]))
    if depths := [key for key in ("depth", "distance") if view.has(key)]:
        depth = view.pixels(depths[0]).astype(np.float64)
        hit = np.isfinite(depth)
        near, far = (depth[hit].min(), depth[hit].max()) if hit.any() else (0.0, 1.0)
        gray = np.where(hit, 255 - 205 * (np.where(hit, depth, near) - near) / max(far - near, 1e-30), 0)
        parts.append(np.repeat(gray.astype(np.uint8)[..., None], 3, axis=2))
    for key in ("shape_index", "object_index"):
        if view.has(key):
            index = view.pixels(key).astype(np.int64)[..., None] + (key == "shape_index")
            parts.append(np.where(index > 0, index * (97, 57, 151) % 206 + 50, 0).astype(np.uint8))
            break
    if view.has("normal"):
        turned = view.pixels("normal").astype(np.float64) @ view.basis
        parts.append(np.round((turned + 1) / 2 * 255).astype(np.uint8))
    return np.hstack(parts) if parts else None
