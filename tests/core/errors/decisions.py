"""Whether rounding can decide between hit and miss: values that decide it, with the bounds of their errors.

A value beyond its bound is positive on a hit and negative on a miss; within the bound the decision is open.
"""

import numpy as np

from camera_ray_caster.core.conventions import gamma
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.maths.vector import cross, difference, norm
from camera_ray_caster.core.records import INFINITE_PLANE, MESH, PLANE, SPHERE
from camera_ray_caster.core.shapes.local_rays import LocalRays
from camera_ray_caster.core.shapes.mesh.errors import TriangleErrors
from camera_ray_caster.core.shapes.mesh.mesh_surface import HitTriangles
from camera_ray_caster.core.shapes.mesh.triangles import VOLUME_ROUNDING, volumes
from camera_ray_caster.core.shapes.sphere import outside

CHUNK = 1 << 16
"""Number of pairs of rays and triangles that are processed at once."""


def decision(camera, shapes, at, x, y):
    """The value for rays at pixel coordinates x, y and one shape, by index, and its error bound."""
    with np.errstate(all="ignore"):
        rays = world_rays(camera, x, y)
        which = np.full(np.broadcast_shapes(np.shape(x), np.shape(y)), at)
        kind = shapes.shapes.kind[at]
        if kind == MESH:
            return of_mesh(shapes, which, rays)
        return BY_KIND[kind](shapes, LocalRays(shapes, which, rays, camera.model.central))


def of_sphere(shapes, local):
    """The discriminant |D|^2 - |N x D|^2, in scaled units, with the bound EPS (distance / radius).

    Or b^2 - |D|^2 c with the exact c, if that has the smaller error bound, as it has near the surface.
    """
    d, across = norm(local.d), norm(cross(local.n, local.d))
    moved = local.product_error()
    value = (d - across) * (d + across)
    d_squared = 2 * d * local.d_error + local.d_error**2
    error = d_squared + 2 * across * moved + moved**2 + gamma(8) * (d * d + across * across)
    if (known := outside(shapes, local)) is None:
        return value, error
    (c, c_rest), b = known, local.inner
    c_error = gamma(4) * np.abs(c) + c_rest
    near = 2 * np.abs(b) * moved + moved**2 + (np.abs(c) + c_error) * d_squared + d * d * c_error
    near = near + gamma(8) * (b * b + d * d * np.abs(c))
    return np.where(near < error, b * b - d * d * c, value), np.fmin(error, near)


def of_plane(shapes, local):
    """|D_z| - max(|(N x D)_x|, |(N x D)_y|), which is positive inside the edges."""
    d, _, d_error, _ = local.z()
    steep, across = np.abs(d), cross(local.n, local.d)
    inside = np.minimum(steep - np.abs(across[0]), steep - np.abs(across[1]))
    return inside, d_error + local.product_error()


def of_infinite_plane(shapes, local):
    """|D_z|: a ray misses only if it is parallel to the plane."""
    d, _, d_error, _ = local.z()
    return np.abs(d), d_error


BY_KIND = {SPHERE: of_sphere, PLANE: of_plane, INFINITE_PLANE: of_infinite_plane}


def of_mesh(shapes, at, rays):
    """The largest value of the mesh's triangles: the least of the volumes of a triangle's edges, counted positive
    inside, over its longest corner's square times |direction|.
    """
    at = np.broadcast_to(at, np.broadcast_shapes(np.shape(at), *map(np.shape, rays.direction)))
    origin, direction = (
        np.array([np.broadcast_to(c, at.shape).ravel() for c in v]) for v in (rays.origin, rays.direction)
    )
    value, moved = np.full(at.size, -np.inf), np.zeros(at.size)
    for row in np.unique(at).tolist():
        mine = np.flatnonzero(at.ravel() == row)
        mesh = shapes.shapes.meshes[shapes.shapes.mesh[row]]
        step = max(1, CHUNK // mine.size)
        for first in range(0, len(mesh), step):
            number = np.arange(first, min(first + step, len(mesh)))
            some = HitTriangles(shapes, np.arange(len(number)), np.full(len(number), row), number, False)
            corners = [difference([c[:, None] for c in corner], origin[:, None, mine]) for corner in some.corners]
            lengths = [norm(corner) for corner in corners]
            scale = np.maximum.reduce(lengths) ** 2 * norm(direction[:, mine])
            volume_bounds = [v / scale for v in volumes(corners, direction[:, None, mine])]
            inner = np.maximum(np.minimum.reduce(volume_bounds), -np.maximum.reduce(volume_bounds))
            value[mine] = np.maximum(value[mine], inner.max(axis=0))
            reach = np.minimum.reduce(np.maximum.reduce(lengths))
            bound = TriangleErrors(some, np.zeros(len(number)), rays)._moved.max()
            moved[mine] = np.maximum(
                moved[mine], 4 * (bound + np.broadcast_to(rays.origin_error, at.shape).ravel()[mine]) / reach
            )
    turned = np.broadcast_to(rays.direction_error, at.shape).ravel() / norm(direction)
    return value.reshape(at.shape), (moved + 4 * turned + VOLUME_ROUNDING).reshape(at.shape)
