"""The UV maps of meshes that are cast as exact shapes, in the coordinates of the surfaces: see ``Shapes.uv``."""

from dataclasses import replace

import numpy as np

from ..records import SPHERE
from .instances import COORDINATES, NO_MAP, Primitive
from .plane import PLANES
from .sphere import SPHERES

AFFINE = 1e-5
"""Largest distance of a corner's u or v from an affine map, over the largest of them above 1."""

SPHERICAL = 1e-3
"""Largest distance of a corner's u or v from longitude and latitude: those of Blender's UV spheres differ by 1e-7."""

POLE = 1e-4
"""Distance from a sphere's axis, over the radius, within which a vertex has no longitude."""

OTHER_MAP = "its UV map is not {}, so its uv pass has the coordinates of the exact shape: Cast As Mesh has the map"
"""Note on a shape with a UV map that it cannot have."""


def with_map(primitive: Primitive, points: np.ndarray, uv: np.ndarray | None) -> Primitive:
    """Return a sphere or plane with the UV map of a mesh; if it cannot have it, with its coordinates and a note.

    ``points`` and ``uv`` are the corners of the mesh, (n, 3) in object space and (n, 2); ``uv`` is None without a map.
    A plane has any map that is affine, a sphere only longitude and latitude.
    """
    if uv is None:
        return replace(primitive, uv=NO_MAP)
    places = np.linalg.pinv(primitive.axes) @ (points - primitive.centers[0]).T  # axes may lie in one plane
    is_sphere = primitive.kind == SPHERE
    uv_map = None
    if np.isfinite(uv).all():
        uv_map = _spherical(places, uv) if is_sphere else _affine(places, uv)
    if uv_map is None:
        note = OTHER_MAP.format("longitude and latitude" if is_sphere else "affine")
        return replace(primitive, uv=COORDINATES, note=note)
    return replace(primitive, uv=uv_map)


def _spherical(places: np.ndarray, uv: np.ndarray) -> np.ndarray | None:
    """Return COORDINATES if u and v of corners, (n, 2), are longitude and latitude of places (3, n), else None."""
    u, v = np.abs(np.stack(SPHERES.surface_coordinates(places)) - uv.T)
    u = np.where(np.hypot(places[0], places[1]) > POLE, np.abs(u - np.rint(u)), 0.0)
    return COORDINATES if np.maximum(u, v).max() <= SPHERICAL else None


def _affine(places: np.ndarray, uv: np.ndarray) -> np.ndarray | None:
    """Return the affine map, (2, 3), from a plane's coordinates of places (3, n) to uv (n, 2), or None."""
    terms = np.column_stack((*PLANES.surface_coordinates(places), np.ones(len(uv))))
    affine = np.linalg.lstsq(terms, uv.astype(np.float64), rcond=None)[0]
    off = np.abs(terms @ affine - uv).max()
    return affine.T if off <= AFFINE * max(1.0, float(np.abs(uv).max())) else None
