"""The cast of a scanner beam by beam: each is a ray, with a time of its own if it or the shapes move."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace

import numpy as np

from ..camera.camera import Camera
from ..casting.passes import PASSES
from ..casting.request import Request
from ..records import Cancelled, InputError, Raster, Shapes
from .door import WITHOUT_PIXEL, cast_rays

RAYS = 1 << 16
"""Number of rays that are cast at once, between two calls of ``progress``."""


def check_passes(camera: Camera, passes: Collection[str]) -> None:
    """Raise InputError for passes that need neighboring pixels, if the camera's pixels are single beams."""
    absent = [name for name in passes if name in WITHOUT_PIXEL]
    if absent and not camera.model.differentiable:
        raise InputError(
            f"{camera.model.label} of camera {camera.name!r} has no {', '.join(absent)}: its pixels are single beams, "
            "not parts of a picture"
        )


def is_cast_by_rays(camera: Camera) -> bool:
    """Whether a picture of one time is cast as single rays, too: of a scanner whose beams have origins of their own.
    Its plan bounds what rays see by balls around all origins and azimuths of the beams. As single rays a street and a
    room take 0.4 to 0.5 times the processor time, a table 0.5 to 1.2 times.
    """
    return not camera.model.differentiable and not camera.model.central


def cast_sweep(
    camera: Camera, shapes: Shapes, request: Request, dtype, progress: Callable[[float], bool] | None
) -> dict[str, np.ndarray]:
    """Return the passes of the render window of a scanner, (rows, columns[, channels]); see ``cast``."""
    height, width = camera.raster.shape
    images = {name: PASSES[name].empty((height, width), dtype) for name in request.passes}
    step = max(1, RAYS // width)
    for first in range(0, height, step):
        if progress is not None and not progress(first / height):
            raise Cancelled
        rows = slice(first, min(first + step, height))
        rays = replace(camera, raster=_part(camera.raster, rows)).rays()
        found = cast_rays(
            rays.origins, rays.directions, shapes, passes=request.passes, times=rays.time, near=camera.clip_start,
            far=camera.clip_end, dtype=dtype,
        )  # fmt: skip
        for name, image in images.items():
            image[rows] = found[name]
    return images


def _part(raster: Raster, rows: slice) -> Raster:
    return replace(raster, y0=raster.y0 + rows.start, y1=raster.y0 + rows.stop)
