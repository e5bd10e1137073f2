"""Recognition of spheres and flat parallelograms among meshes, from vertices and faces: a mesh stores nothing else.

A renderer draws the faces, the caster the shape that they represent. So the faces have to leave no doubt about it: they
must go round the sphere once, or fill the parallelogram. All is computed in float64 from the stored float32.
"""

from dataclasses import dataclass

import numpy as np

from ..conventions import EPS32
from ..maths.vector import cross
from ..records import PLANE, SPHERE
from .instances import Primitive

SPHERE_TOLERANCE = 2e-5
"""Largest spread of the vertices' distances from the center, over the radius.

Blender tabulates the icosahedron with so few digits that ten of its twelve vertices are 1.08e-5 too near. Its UV
spheres, made by adding up small rotations, spread by up to 6.7e-6 (among 6 to 256 segments, at 200), its finer ico
spheres by 4e-7. Meshes that are only nearly spheres, such as a cube under Subdivision Surface, spread by 1e-3 or more.
"""

VERTEX_ROUNDING = 8 * EPS32
"""Allowance for float32, over the largest coordinate: an applied rotation, scale and offset, in three dimensions."""

MIN_INRADIUS = 0.74
"""Least distance of a face's plane from the center, over the radius.

The vertices of any prism, cube or cylinder can lie on one sphere, but then some face is at a distance of at most 1/√2.
An octahedron's faces are at 0.577, an icosahedron's at 0.795. UV spheres pass from 6 segments and 3 rings (0.750) on;
coarser UV spheres cannot be distinguished from a cylinder."""

SAMPLE = 256
"""Number of vertices from which a large mesh is found to be no sphere or plane, in a hundredth of the time."""

CORRUPT = "it is corrupt, with faces of vertices or edges that it does not have: repair it with mesh.validate()"
NOT_FINITE = "its vertices are not all finite"
NOT_ROUND = "its vertices are not on one sphere or ellipsoid"
ROUNDED_AWAY = (
    "it is too thin, or too small for its distance from the object's origin: float32 rounding has destroyed its shape"
)


@dataclass(frozen=True)
class MeshArrays:
    """A mesh as Blender's ``foreach_get`` returns it; a loop is a corner of a face and the edge that starts there."""

    vertices: np.ndarray
    """(vertices, 3) float32."""
    loop_vertices: np.ndarray
    """(loops,) int32, face by face."""
    loop_edges: np.ndarray
    """(loops,) int32."""
    loop_starts: np.ndarray
    """(faces,) int32: the first loop of each face."""
    edge_count: int

    @property
    def is_whole(self) -> bool:
        """Whether every face has at least three corners, each with an existing vertex and edge: not in corrupt files.

        The starts of the faces have to ascend from the first loop on.
        """
        starts, ends = self.loop_starts, np.append(self.loop_starts[1:], len(self.loop_vertices))
        return bool(
            starts[0] == 0
            and (ends - starts >= 3).all()
            and _within(self.loop_vertices, len(self.vertices))
            and _within(self.loop_edges, self.edge_count)
        )


def _within(indices, count: int) -> bool:
    return bool(len(indices) and indices.min() >= 0 and indices.max() < count)


def defect(mesh: MeshArrays) -> str:
    """Return the reason why the faces of a mesh cannot be used, or ""."""
    if not mesh.is_whole:
        return CORRUPT
    return "" if np.isfinite(mesh.vertices).all() else NOT_FINITE


def exclude(mesh: MeshArrays) -> str:
    """Return the reason why a mesh is neither sphere nor plane, if a sample of its vertices shows it, or ""."""
    if len(mesh.vertices) < 4 * SAMPLE:
        return ""
    sample = mesh.vertices[np.random.default_rng(0).integers(len(mesh.vertices), size=SAMPLE)]
    sample = sample - sample.mean(axis=0, dtype=np.float64)
    rounding = VERTEX_ROUNDING * float(np.abs(mesh.vertices).max())
    _, _, (_, _, across) = np.linalg.svd(sample, full_matrices=False)
    is_flat = np.ptp(sample @ across) <= 4 * rounding
    return "" if is_flat or _fitted(sample, rounding, slack=16.0) else NOT_ROUND


def recognize(mesh: MeshArrays) -> Primitive | str:
    """Return the sphere or plane that a mesh with faces represents, in object space, or the reason why it is neither.

    A mesh whose faces all look one way is tested as a plane, any other as a sphere, or as an ellipsoid if an affine
    matrix was applied to one. A sphere's axes are its radius times the object's axes. A plane's are half its sides, the
    first along its first edge, and a normal as long as the root of their area. All are right to the tolerances above.
    """
    if reason := defect(mesh) or exclude(mesh):
        return reason
    middle = mesh.vertices.mean(axis=0, dtype=np.float64)
    vertices = mesh.vertices - middle  # small numbers: an applied offset costs no digits
    rounding = VERTEX_ROUNDING * float(np.abs(mesh.vertices).max())
    _, areas = _faces(mesh, vertices)
    total, area = areas.sum(axis=0), np.linalg.norm(areas, axis=1).sum()
    if np.linalg.norm(total) > 0.99 * area:
        form = _parallelogram(mesh, vertices, total, area, rounding)
    else:
        form = _ellipsoid(mesh, vertices, rounding)
    if isinstance(form, str):
        return form
    kind, center, axes, uncertainty, apart = form
    center = center + middle
    center[np.abs(center) <= uncertainty] = 0  # rounding: the user placed the center at the object's origin
    return Primitive(kind, center[None], axes, np.ones(1), apart=float(apart))


def _following(mesh) -> np.ndarray:
    """Return for each loop the next loop of its face."""
    following = np.arange(1, len(mesh.loop_vertices) + 1)
    following[np.append(mesh.loop_starts[1:], len(following)) - 1] = mesh.loop_starts
    return following


def _faces(mesh, vertices):
    """Return a corner and the area vector of every face, each (faces, 3)."""
    corners = vertices.T[:, mesh.loop_vertices]
    sums = np.add.reduceat(np.stack(cross(corners, corners[:, _following(mesh)])), mesh.loop_starts, axis=1)
    return corners[:, mesh.loop_starts].T, sums.T / 2


def _ellipsoid(mesh, vertices, rounding):
    """Return the ellipsoid whose surface the mesh goes round once, or the reason why it is none.

    The radius is half the extent of the vertices in Z if that is in the range of their distances from the center, since
    Blender's spheres have their poles there, at the radius that the user chose. Otherwise it is their mean distance.
    """
    if not np.ptp(vertices, axis=0).all():
        return "it is neither flat nor round"
    fitted = _fitted(vertices, rounding)
    if fitted is None:
        return NOT_ROUND
    center, axes, ball, noise = fitted
    if noise > 0.01:
        return ROUNDED_AWAY
    if (np.bincount(mesh.loop_edges, minlength=mesh.edge_count) != 2).any():
        return "its vertices are on a sphere, but its surface is not closed"
    corners, areas = _faces(mesh, ball)
    heights, sizes = (corners * areas).sum(axis=1), np.linalg.norm(areas, axis=1)
    if (np.abs(heights) < MIN_INRADIUS * sizes).any():
        return "its vertices are on a sphere, but its faces cut deep into it, as a box's or a cylinder's do"
    if abs(heights.sum() / 3) < MIN_INRADIUS**3 * (4 / 3 * np.pi):
        return "its vertices are on a sphere, but its faces do not cover the sphere exactly once, all facing outwards"
    distances, pole = np.linalg.norm(ball, axis=1), np.ptp(ball[:, 2]) / 2
    reach = pole if distances.min() <= pole <= distances.max() else distances.mean()
    apart = 1 - (np.abs(heights[sizes > 0]) / sizes[sizes > 0]).min() / reach
    return SPHERE, center, axes * reach, np.ptp(distances) * np.abs(axes).max(), apart


def _fitted(vertices, rounding, slack=1.0):
    """Return center and axes of the sphere, or else the ellipsoid, that vertices lie on within ``slack`` tolerances,
    the vertices in its frame, and how far rounding may move them there; None if there is neither.
    """
    for fit in (_fitted_sphere, _fitted_ellipsoid):
        center, axes = fit(vertices)
        if axes is None:
            continue
        thinnest = np.linalg.norm(axes, -2)
        if thinnest <= rounding:
            return center, axes, vertices, np.inf
        ball, noise = np.linalg.solve(axes, (vertices - center).T).T, rounding / thinnest
        if np.ptp(np.linalg.norm(ball, axis=1)) <= slack * (SPHERE_TOLERANCE + noise):
            return center, axes, ball, noise
    return None


def _least_squares(terms, values):
    """Return the solution of the normal equations; scaled and centered terms keep these well conditioned."""
    return np.linalg.lstsq(terms.T @ terms, terms.T @ values, rcond=None)[0]


def _fitted_sphere(vertices):
    """Return center and radius times the identity, by linear least squares on 2 c.v + k = v.v."""
    squares = (vertices * vertices).sum(axis=1)
    *center, k = _least_squares(np.c_[2 * vertices, np.ones(len(vertices))], squares)
    return np.array(center), np.sqrt(np.dot(center, center) + k) * np.eye(3)


def _fitted_ellipsoid(vertices):
    """Return center and axes by linear least squares on v.Q v + 2 b.v = 1; None, None unless Q is positive definite."""
    sides = np.ptp(vertices, axis=0) / 2
    x, y, z = (vertices / sides).T
    terms = np.column_stack([x * x, y * y, z * z, 2 * y * z, 2 * x * z, 2 * x * y, 2 * x, 2 * y, 2 * z])
    xx, yy, zz, yz, xz, xy, *b = _least_squares(terms, np.ones(len(x)))
    values, vectors = np.linalg.eigh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if values[0] <= 1e-6 * values[2]:
        return None, None
    center = -vectors @ (vectors.T @ b / values)
    root = vectors / np.sqrt(values) @ vectors.T
    return sides * center, sides[:, None] * root * np.sqrt(1 - np.dot(center, b))


def _parallelogram(mesh, vertices, total, area, rounding):
    """Return the parallelogram that a flat mesh fills once, without folds or overlaps, or why it fills none."""
    normal = total / np.linalg.norm(total)
    if np.ptp(vertices @ normal) > rounding:
        return "it is nearly a plane, but not flat"
    loop_ends = mesh.loop_vertices[_following(mesh)]
    # An edge between two faces is traversed once in each direction; the other edges are the outline.
    ahead = mesh.loop_vertices < loop_ends
    net = np.bincount(mesh.loop_edges, np.where(ahead, 1, -1), mesh.edge_count)[mesh.loop_edges]
    outline = dict(zip(mesh.loop_vertices[net != 0].tolist(), loop_ends[net != 0].tolist(), strict=True))
    if not outline:
        return CORRUPT  # the edges do not fit their corners
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
    center = quad.mean(axis=0)
    x, y = (quad[1] - quad[0] + quad[2] - quad[3]) / 4, (quad[3] - quad[0] + quad[2] - quad[1]) / 4
    gap = np.linalg.norm(quad[0] - quad[1] + quad[2] - quad[3])
    if gap > 2 * rounding:
        return f"it is flat, but not a parallelogram: opposite sides differ by {gap:.2g}"
    third = np.cross(x, y)
    size = np.linalg.norm(third)
    if size <= rounding * max(np.linalg.norm(x), np.linalg.norm(y)):
        return "it has no area"
    if abs(area - 4 * size) > rounding * (np.linalg.norm(x) + np.linalg.norm(y)) * 8:
        return "it is flat, but its faces do not fill its outline once"
    apart = np.ptp(vertices @ normal) / max(np.linalg.norm(x), np.linalg.norm(y))
    return PLANE, center, np.column_stack([x, y, third / np.sqrt(size)]), rounding, apart
