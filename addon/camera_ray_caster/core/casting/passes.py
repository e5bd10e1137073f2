"""The passes of a picture: what each stores, for a tile of hits. A new pass is one function and one row in PASSES.

Where a ray hits nothing depth and distance are inf, shape_index is -1, combined the world's color, all others 0;
a pixel without a ray is the same with combined (0, 0, 0, 0) and valid False.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..maths.speed import whole_rows
from ..maths.vector import matvec, norm, unit
from ..shapes.normals import ZERO
from . import painting
from .hits import Hits
from .shading import shade

ROUNDED_UP = 1 + 2.0**-9
"""Makes up for rounding the bounds themselves, to what they are stored as."""


def unpainted(hits: Hits) -> None:
    """A pass that no brush paints."""


@dataclass(frozen=True)
class Pass:
    """How a pass is stored and made. ``write(hits, out)`` fills a part of ``out``, (rows, columns[, channels])."""

    write: Callable[[Hits, np.ndarray], None]
    channels: int = 0
    dtype: type | None = None
    """What it is stored as; None takes the cast's dtype."""
    whole: bool = False
    """Whether ``write`` is called for a whole tile, not for blocks whose working arrays stay in a core's cache."""
    brush: Callable[[Hits], painting.Brush | None] = unpainted
    """Given the hits of a tile, returns what paints it; None where ``write`` takes less."""


def combined(hits: Hits, out):
    """Linear RGBA: the shading's color, the world's where nothing is hit, transparent black where there is no ray."""
    shade(hits, out)
    if hits.lost is not None:
        out[hits.lost] = 0


def depth(hits: Hits, out):
    """Blender's Z: along the viewing direction for perspective and orthographic, the distance for panoramas."""
    out[...] = hits.t


def distance(hits: Hits, out):
    """The length of the ray from its origin to the hit."""
    np.multiply(hits.t, hits.length, out=out, casting="same_kind")
    if hits.missed is not None:
        out[hits.missed] = np.inf


def position(hits: Hits, out):
    """The hit point in the world."""
    _write(out, hits.point, hits.plan.camera.pose.eye[:, None, None], hits.missed)


def normal(hits: Hits, out):
    """The surface's unit normal in the world, turned towards the ray's origin."""
    _write(out, *hits.normal_terms, hits.missed)


def uv(hits: Hits, out):
    """The surface's own coordinates, (u, v, 0); see the shapes."""
    out[...] = 0
    for surface in hits.surfaces:
        u, v = surface.kind.uv(surface.q)
        out[surface.where] = np.stack((u, v, np.zeros_like(u)), axis=-1)


def object_index(hits: Hits, out):
    """Blender's pass index of the object."""
    hits.look_up(hits.plan.object_index, out)


def material_index(hits: Hits, out):
    """Blender's pass index of the material."""
    hits.look_up(hits.plan.material_index, out)


def shape_index(hits: Hits, out):
    """The row of the shape in ``Shapes``, instances apart."""
    out[...] = hits.index


def valid(hits: Hits, out):
    """Whether the pixel has a ray."""
    out[...] = hits.has_ray


def ray_origin(hits: Hits, out):
    """The origin of the chief ray in the world."""
    pose = hits.plan.camera.pose
    _write(out, matvec(pose.basis, hits.origin), pose.eye[:, None, None], hits.lost)


def ray_direction(hits: Hits, out):
    """The unit direction of the chief ray in the world."""
    _write(out, unit(hits.world_direction), ZERO, hits.lost)


def distance_bound(hits: Hits, out):
    """How far the stored distance, and the depth, are from the exact ones at most; world units."""
    _bound(hits, out, hits.bounds.distance, hits.t[hits.seen] * norm(hits.bounds.rays.direction))


def position_bound(hits: Hits, out):
    """How far the stored position is from the exact one at most; world units."""
    places = (p + e for p, e in zip(hits.point, hits.plan.camera.pose.eye, strict=True))
    _bound(hits, out, hits.bounds.position, norm(tuple(place[hits.seen] for place in places)))


def normal_bound(hits: Hits, out):
    """How far the stored unit normal is from the exact one at most."""
    _bound(hits, out, hits.bounds.normal, 1.0)


def _bound(hits: Hits, out, bound, size):
    """Write bounds rounded up, with what storing a number of this size loses."""
    out[...] = 0
    out[hits.seen] = (bound + np.finfo(out.dtype).eps * size) * ROUNDED_UP


def _write(out, vector, offset, blank):
    """Store vector plus offset, three components each, and 0 where ``blank``, which may be None."""
    if isinstance(vector, np.ndarray):  # all at once: fewer calls, between which other threads wait
        np.add(vector, offset, out=out.transpose(2, 0, 1), casting="same_kind")
    else:
        for axis, component in enumerate(vector):
            np.add(component, offset[axis], out=out[..., axis], casting="same_kind")
    if blank is not None:
        for axis in range(3):
            np.copyto(out[..., axis], 0, where=blank)


PASSES = {
    "combined": Pass(combined, 4),
    "depth": Pass(depth, whole=True),
    "distance": Pass(distance),
    "position": Pass(position, 3),
    "normal": Pass(normal, 3, brush=painting.normal),
    "uv": Pass(uv, 3),
    "object_index": Pass(object_index, 0, np.int32, brush=lambda hits: painting.constant(hits, hits.plan.object_index)),
    "material_index": Pass(
        material_index, 0, np.int32, brush=lambda hits: painting.constant(hits, hits.plan.material_index)
    ),
    "shape_index": Pass(shape_index, 0, np.int32, whole=True),
    "valid": Pass(valid, 0, np.bool_),
    "ray_origin": Pass(ray_origin, 3),
    "ray_direction": Pass(ray_direction, 3),
    "distance_bound": Pass(distance_bound),
    "position_bound": Pass(position_bound),
    "normal_bound": Pass(normal_bound),
}
"""Every pass by its name, in the order of the report."""


def store(hits: Hits, outs: dict[str, np.ndarray], where=None) -> None:
    """Write passes into parts of images, only ``where`` they are meant: (rows, columns) bool, None for all pixels."""
    if where is not None:
        meant = {name: np.empty_like(out) for name, out in outs.items()}
        store(hits, meant)
        for name, out in outs.items():
            put(meant[name], out, where)
        return
    with whole_rows(hits.t.shape[1]):
        painted = {name: brush for name in outs if (brush := PASSES[name].brush(hits)) is not None}
        if painted:
            painting.paint(hits, [(brush, outs[name]) for name, brush in painted.items()])
        for name in outs:
            if PASSES[name].whole:
                PASSES[name].write(hits, outs[name])
        in_blocks = [name for name in outs if name not in painted and not PASSES[name].whole]
        for rows, block in hits.blocks() if in_blocks else ():
            for name in in_blocks:
                PASSES[name].write(block, outs[name][rows])


def add_combined(hits: Hits, total: np.ndarray) -> None:
    """Add the combined pass to a sum, (rows, columns, 4)."""
    with whole_rows(hits.t.shape[1]):
        for rows, block in hits.blocks():
            once = hits.scratch("once", total[rows].shape, total.dtype)
            combined(block, once)
            total[rows] += once


def put(image: np.ndarray, out: np.ndarray, where) -> None:
    """Copy an image, (rows, columns[, channels]), only ``where`` it is meant; None for all pixels."""
    meant = True if where is None else where if image.ndim == 2 else where[..., None]
    np.copyto(out, image, where=meant, casting="same_kind")
