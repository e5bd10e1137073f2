"""Meshes for tests, and the hits of all rays with all triangles in long double: every pair, nothing left out."""

from __future__ import annotations

import numpy as np

from camera_ray_caster.core.mesh import Mesh
from camera_ray_caster.core.records import MESH, Shapes

LONG = np.longdouble


def mesh_of(vertices, triangles, **more) -> Mesh:
    """A mesh from vertices (v, 3) and triangles (k, 3), each a face of its own unless ``polygon`` says else."""
    triangles = np.ascontiguousarray(np.transpose(triangles), np.int32)
    more.setdefault("polygon", np.arange(triangles.shape[1], dtype=np.int32))
    return Mesh(np.ascontiguousarray(np.transpose(vertices), np.float32), triangles, **more)


def grid(rows: int, columns: int, position) -> Mesh:
    """A sheet of rows x columns squares of two triangles, its vertices where ``position(u, v)`` says, of 0 .. 1."""
    v, u = np.mgrid[: rows + 1, : columns + 1]
    vertices = np.stack(np.broadcast_arrays(*position(u / columns, v / rows)), axis=-1).reshape(-1, 3)
    at = (v * (columns + 1) + u)[:-1, :-1].ravel()
    right, up = at + 1, at + columns + 1
    return mesh_of(vertices, np.concatenate((np.stack((at, right, up + 1), 1), np.stack((at, up + 1, up), 1))))


def ball(rows: int, columns: int, radius: float = 1.0) -> Mesh:
    """A closed sphere of latitudes and longitudes, smooth and with a map; its poles are many triangles' corner."""
    v, u = np.meshgrid(np.linspace(0, np.pi, rows + 1)[1:-1], np.arange(columns) * 2 * np.pi / columns, indexing="ij")
    ring = np.stack((np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)), axis=-1).reshape(-1, 3)
    vertices = np.concatenate((ring, [[0, 0, 1], [0, 0, -1]])) * radius
    at = np.arange(len(ring)).reshape(rows - 1, columns)
    beside = np.roll(at, -1, axis=1)
    a, b, c, d = (corners.ravel() for corners in (at[:-1], at[1:], beside[1:], beside[:-1]))
    north, south = np.full(columns, len(ring)), np.full(columns, len(ring) + 1)
    triangles = np.concatenate([
        np.stack(three, axis=1)
        for three in ((a, b, c), (a, c, d), (north, at[0], beside[0]), (south, beside[-1], at[-1]))
    ])  # fmt: skip
    loops = np.arange(triangles.size, dtype=np.int32).reshape(-1, 3)
    corners = vertices.astype(np.float32)[triangles.ravel()]
    normals = (corners / np.linalg.norm(corners, axis=1, keepdims=True)).astype(np.float32)
    uv = corners[:, :2] / 2 + 0.5
    return mesh_of(vertices, triangles, loops=np.ascontiguousarray(loops.T), normals=normals, uv=uv)


def soup(rng, count: int) -> Mesh:
    """Triangles anywhere, of all sizes and widths."""
    sizes = 10.0 ** rng.uniform(-3, 0.3, (count, 1, 1)) * 10.0 ** rng.uniform(-2, 0, (count, 3, 1))
    corners = rng.uniform(-3, 3, (count, 1, 3)) + rng.normal(size=(count, 3, 3)) * sizes
    return mesh_of(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


def shapes_of(*rows, **more) -> Shapes:
    """Shapes of meshes, from (mesh, center, axes or scale) rows."""
    meshes = tuple({id(mesh): mesh for mesh, _, _ in rows}.values())
    n = len(rows)
    axes = [np.eye(3) * a if np.ndim(a) == 0 else np.array(a, float) for _, _, a in rows]
    fields = dict(
        kind=np.full(n, MESH, np.uint8),
        center=np.array([center for _, center, _ in rows], float).reshape(n, 3),
        axes=np.array(axes).reshape(n, 3, 3),
        object_index=np.arange(10, 10 + n, dtype=np.int32),
        material_index=np.arange(20, 20 + n, dtype=np.int32),
        color=np.tile(np.float32([0.5, 0.25, 1.0, 1.0]), (n, 1)),
        name_index=np.arange(n, dtype=np.int32),
        names=tuple(f"mesh {k}" for k in range(n)),
        meshes=meshes,
        mesh=np.array([meshes.index(mesh) for mesh, _, _ in rows], np.int32),
        shared=np.zeros(n, bool),
    )
    return Shapes(**(fields | more))


def every_hit(shapes: Shapes, row: int, origins, directions):
    """t, (rays, triangles), of all rays (m, 3) with all triangles of a shape, inf where they do not meet; and by how
    much the least barycentric coordinate is inside (negative outside), all in long double.
    """
    mesh = shapes.meshes[shapes.mesh[row]]
    vertices = mesh.vertices.astype(LONG) - mesh.middle[:, None].astype(LONG)
    vertices = shapes.axes[row].astype(LONG) @ vertices + shapes.center[row][:, None].astype(LONG)
    a, b, c = (vertices[:, corner].T for corner in mesh.triangles)
    first, second = b - a, c - a
    o, d = origins[:, None].astype(LONG), directions[:, None].astype(LONG)
    across = np.cross(d, second[None])
    volume = (across * first).sum(axis=-1)
    from_a = o - a
    with np.errstate(all="ignore"):
        u = (from_a * across).sum(axis=-1) / volume
        turned = np.cross(from_a, first[None])
        v = (d * turned).sum(axis=-1) / volume
        t = (second * turned).sum(axis=-1) / volume
        inside = np.minimum(np.minimum(u, v), 1 - u - v)
    met = (inside >= 0) & (t > 0)
    return np.where(met, t, np.inf), np.where(np.isnan(inside), -np.inf, inside)
