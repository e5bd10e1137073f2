"""Is a mesh a sphere or a flat parallelogram? Judged by its vertices and faces, which is all that a mesh keeps.

A renderer draws the faces, the caster the shape that they stand for, so the faces have to leave no doubt about it: they
must go once round the ball, or fill the parallelogram. Everything is computed in float64 from the stored float32.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .conventions import EPS32
from .placement import Primitive
from .records import PLANE, SPHERE

SPHERE_TOLERANCE = 2e-5
"""Largest spread of the vertices' distances from the centre, over the radius.

Blender tabulates the icosahedron with so few digits that ten of its twelve vertices lie 1.08e-5 short, while its UV
spheres spread by 2.6e-6 at most (128 segments) and its finer ico spheres by 4e-7. What is only nearly a sphere, such as
a cube under Subdivision Surface, spreads by 1e-3 and more."""

ROUNDING = 8 * EPS32
"""Allowance for float32, over the largest coordinate: a turn, a scale and an offset applied, in three dimensions."""

MIN_INRADIUS = 0.74
"""How near a face's plane may come to the centre, over the radius.

The vertices of any prism, cube or cylinder can lie on one sphere, but then some face comes to 1/√2 or nearer; an
octahedron's are at 0.577, an icosahedron's at 0.795. UV spheres pass from 6 segments and 3 rings (0.750) on; coarser
ones cannot be told from a cylinder."""


@dataclass(frozen=True)
class MeshArrays:
    """What Blender's ``foreach_get`` gives of a mesh; a loop is a corner of a face and the edge that leaves it."""

    vertices: np.ndarray
    """(vertices, 3) float32."""
    loop_vertices: np.ndarray
    """(loops,) int32, face by face."""
    loop_edges: np.ndarray
    """(loops,) int32."""
    loop_starts: np.ndarray
    """(faces,) int32: the first loop of each face."""
    edge_count: int


def recognise(mesh: MeshArrays) -> Primitive | str:
    """Return the sphere or plane that a mesh with faces is, in object space, or in words why it is neither.

    A mesh whose faces all look one way is judged as a plane, any other as a sphere. A sphere's axes are its radius
    times the object's axes; a plane's are half its sides, the first along its first edge, and a normal as long as the
    root of their area. Centre and axes are right to the stated tolerances.
    """
    if not np.isfinite(mesh.vertices).all():
        return "its vertices are not all finite"
    middle = mesh.vertices.mean(axis=0, dtype=np.float64)
    vertices = mesh.vertices - middle  # small numbers: an offset that was applied costs no digits
    rounding = ROUNDING * float(np.abs(mesh.vertices).max())
    corners = vertices[mesh.loop_vertices]
    following = np.arange(1, len(corners) + 1)
    following[np.append(mesh.loop_starts[1:], len(corners)) - 1] = mesh.loop_starts
    areas = np.add.reduceat(np.cross(corners, corners[following]), mesh.loop_starts) / 2
    total, area = areas.sum(axis=0), np.linalg.norm(areas, axis=1).sum()
    if np.linalg.norm(total) > 0.99 * area:
        found = _parallelogram(mesh, vertices, mesh.loop_vertices[following], total, area, rounding)
    else:
        found = _sphere(mesh, vertices, corners[mesh.loop_starts], areas, rounding)
    if isinstance(found, str):
        return found
    kind, centre, axes, uncertainty = found
    centre = centre + middle
    centre[np.abs(centre) <= uncertainty] = 0  # rounding, where the user has the object's origin
    return Primitive(kind, centre[None], axes, np.ones(1))


def _sphere(mesh, vertices, corners, areas, rounding):
    """Return a closed mesh's sphere: centre by least squares, radius to the farthest vertex.

    The farthest vertex, as the tabulated ones of the icosahedron fall short of the radius that the user chose.
    """
    squares = (vertices * vertices).sum(axis=1)
    centre = np.linalg.lstsq(np.c_[2 * vertices, np.ones(len(vertices))], squares, rcond=None)[0][:3]
    distances = np.linalg.norm(vertices - centre, axis=1)
    radius, spread = distances.max(), np.ptp(distances)
    if spread > SPHERE_TOLERANCE * radius + rounding:
        return f"its vertices are not on one sphere: they are {spread / radius:.1%} of its radius off it"
    if rounding > 0.01 * radius:
        return "it is too small for its distance from the object's origin: float32 has rounded its shape away"
    if (np.bincount(mesh.loop_edges, minlength=mesh.edge_count) != 2).any():
        return "its vertices are on a sphere, but its surface is not closed"
    heights = ((corners - centre) * areas).sum(axis=1)
    if (np.abs(heights) < MIN_INRADIUS * radius * np.linalg.norm(areas, axis=1)).any():
        return "its vertices are on a sphere, but its faces cut deep into it, as a box's or a cylinder's do"
    if abs(heights.sum() / 3) < MIN_INRADIUS**3 * (4 / 3 * np.pi) * radius**3:
        return "its vertices are on a sphere, but its faces do not go round it once, all facing outwards"
    return SPHERE, centre, radius * np.eye(3), spread


def _parallelogram(mesh, vertices, loop_ends, total, area, rounding):
    """Return the parallelogram that a flat mesh fills: its outline has four corners, and it neither folds nor laps."""
    normal = total / np.linalg.norm(total)
    if np.ptp(vertices @ normal) > rounding:
        return "it is nearly a plane, but not flat"
    # An edge between two faces is passed once in each direction; what is left over is the outline.
    ahead = mesh.loop_vertices < loop_ends
    net = np.bincount(mesh.loop_edges, np.where(ahead, 1, -1), mesh.edge_count)[mesh.loop_edges]
    outline = dict(zip(mesh.loop_vertices[net != 0].tolist(), loop_ends[net != 0].tolist(), strict=True))
    start = vertex = next(iter(outline))
    walk = []
    while vertex in outline:
        walk.append(vertex)
        vertex = outline.pop(vertex)
    if outline or vertex != start:
        return "it is flat, but has holes or parts"
    points = vertices[walk]
    sides = np.roll(points, -1, axis=0) - points
    before = np.roll(sides, 1, axis=0)
    bends = np.linalg.norm(np.cross(before, sides), axis=1)
    reach = np.maximum(np.linalg.norm(before, axis=1), np.linalg.norm(sides, axis=1))
    quad = points[bends > rounding * reach]
    if len(quad) != 4:
        return f"it is flat, but its outline has {len(quad)} corners"
    centre = quad.mean(axis=0)
    x, y = (quad[1] - quad[0] + quad[2] - quad[3]) / 4, (quad[3] - quad[0] + quad[2] - quad[1]) / 4
    gap = np.linalg.norm(quad[0] - quad[1] + quad[2] - quad[3])
    if gap > 2 * rounding:
        return f"it is flat, but no parallelogram: opposite sides differ by {gap:.2g}"
    third = np.cross(x, y)
    size = np.linalg.norm(third)
    if size <= rounding * max(np.linalg.norm(x), np.linalg.norm(y)):
        return "it has no area"
    if abs(area - 4 * size) > rounding * (np.linalg.norm(x) + np.linalg.norm(y)) * 8:
        return "it is flat, but its faces do not fill its outline once"
    return PLANE, centre, np.column_stack([x, y, third / np.sqrt(size)]), rounding
