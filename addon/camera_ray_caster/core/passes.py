"""The passes of a picture: what each stores, for a tile of hits. A new pass is one function and one row in PASSES.

Where a ray hits nothing depth and distance are inf, shape_index is -1, combined the world's colour, all others 0;
a pixel without a ray is the same with combined (0, 0, 0, 0) and valid False.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .hits import Hits
from .shading import shade
from .vector import dot, matvec, norm, unit


@dataclass(frozen=True)
class Pass:
    """How a pass is stored and made. ``write(hits, out)`` fills a tile of ``out``, (rows, columns[, channels])."""

    write: Callable[[Hits, np.ndarray], None]
    channels: int = 0
    dtype: type | None = None
    """What it is stored as; None takes the cast's dtype."""


def combined(hits: Hits, out):
    """Linear RGBA: the shading's colour, the world's where nothing is hit, transparent black where there is no ray."""
    out[...] = hits.shapes.world_colour
    out[~_has_ray(hits)] = 0
    for surface in hits.surfaces:
        out[surface.where] = shade(surface, normals(surface), hits.plan.shading)


def depth(hits: Hits, out):
    """Blender's Z: along the viewing direction for perspective and orthographic, the distance for panoramas."""
    out[...] = hits.t


def distance(hits: Hits, out):
    """The length of the ray from its origin to the hit."""
    out[...] = np.where(hits.seen, hits.finite_t * norm(hits.world_direction), np.inf)


def position(hits: Hits, out):
    """The hit point in the world."""
    _write(hits, out, matvec(hits.camera.pose.basis, hits.point), hits.seen, hits.camera.pose.eye)


def normal(hits: Hits, out):
    """The surface's unit normal in the world, turned towards the ray's origin."""
    out[...] = 0
    for surface in hits.surfaces:
        out[surface.where] = np.stack(normals(surface), axis=-1)


def uv(hits: Hits, out):
    """The surface's own coordinates, (u, v, 0); see the shapes."""
    out[...] = 0
    for surface in hits.surfaces:
        u, v = surface.kind.uv(surface.q)
        out[surface.where] = np.stack((u, v, np.zeros_like(u)), axis=-1)


def object_index(hits: Hits, out):
    """Blender's pass index of the object."""
    _take(hits, out, hits.shapes.object_index)


def material_index(hits: Hits, out):
    """Blender's pass index of the material."""
    _take(hits, out, hits.shapes.material_index)


def shape_index(hits: Hits, out):
    """The row of the shape in ``Shapes``, instances apart."""
    out[...] = hits.index


def valid(hits: Hits, out):
    """Whether the pixel has a ray."""
    out[...] = _has_ray(hits)


def ray_origin(hits: Hits, out):
    """The origin of the chief ray in the world."""
    _write(hits, out, matvec(hits.camera.pose.basis, hits.origin), _has_ray(hits), hits.camera.pose.eye)


def ray_direction(hits: Hits, out):
    """The unit direction of the chief ray in the world."""
    _write(hits, out, unit(hits.world_direction), _has_ray(hits))


def normals(surface):
    """Return unit world normals, turned towards the rays' origins, as components over a surface's pixels."""
    hits = surface.hits
    covector = surface.kind.normal_covector(surface.shape_from_camera, surface.q)
    facing = -np.sign(dot(covector, surface.select(hits.direction)))
    world_from_covector = np.linalg.inv(hits.camera.pose.basis).T
    return tuple(facing * component for component in unit(matvec(world_from_covector, covector)))


def _has_ray(hits: Hits) -> np.ndarray:
    ray = np.ones(hits.t.shape, bool)
    for component in hits.direction:
        ray &= ~np.isnan(component)
    return ray


def _write(hits: Hits, out, vector, where, offset=(0.0, 0.0, 0.0)):
    for axis, component in enumerate(vector):
        out[..., axis] = np.where(where, component + offset[axis], 0.0)


def _take(hits: Hits, out, table):
    out[...] = np.append(table, 0)[hits.index]


PASSES = {
    "combined": Pass(combined, 4),
    "depth": Pass(depth),
    "distance": Pass(distance),
    "position": Pass(position, 3),
    "normal": Pass(normal, 3),
    "uv": Pass(uv, 3),
    "object_index": Pass(object_index, 0, np.int32),
    "material_index": Pass(material_index, 0, np.int32),
    "shape_index": Pass(shape_index, 0, np.int32),
    "valid": Pass(valid, 0, np.bool_),
    "ray_origin": Pass(ray_origin, 3),
    "ray_direction": Pass(ray_direction, 3),
}
"""Every pass by its name, in the order of the report."""

