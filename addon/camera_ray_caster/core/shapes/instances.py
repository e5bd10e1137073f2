"""Shapes in object space, stored once per mesh or point cloud, and their instances in the world."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..conventions import EPS32
from ..mesh import Mesh
from ..records import EVERYWHERE, INFINITE_PLANE, MESH, SPHERE, Lights

COORDINATES, NO_MAP = np.eye(2, 3), np.zeros((2, 3))
"""The maps of a shape whose u and v are its coordinates, and of one without a UV map, whose u and v are 0."""


@dataclass(frozen=True)
class Primitive:
    """n shapes of one kind in their object's space: object = centers[k] + sizes[k] axes @ q (see the conventions)."""

    kind: int
    centers: np.ndarray
    """(n, 3) float64."""
    axes: np.ndarray
    """(3, 3) float64: the columns are the images of the shape's axes."""
    sizes: np.ndarray
    """(n,) float64."""
    mesh: Mesh | None = None
    """The triangles; None except for kind MESH."""
    uv: np.ndarray = field(default_factory=lambda: COORDINATES)
    """(2, 3) float64: the UV map of a sphere or plane: see ``Shapes``."""
    ids: np.ndarray | None = None
    """(n,) int64: numbers that are equal for the same point of a cloud at other times; None for one shape."""
    note: str = ""
    """What the shape's passes show otherwise than the mesh."""
    apart: float | None = None
    """Largest distance of the shape from the mesh that it was recognized in, over its radius or longer half side."""

    def __len__(self) -> int:
        return len(self.sizes)


def points_primitive(positions: np.ndarray, radii: np.ndarray, ids: np.ndarray) -> Primitive:
    """Return the spheres of a point cloud: those of (n, 3) positions and (n,) radii that are finite, with radius > 0.
    """
    real = (radii > 0) & np.isfinite(radii) & np.isfinite(positions).all(axis=1)
    places, sizes = positions[real].astype(np.float64), radii[real].astype(np.float64)
    return Primitive(SPHERE, places, np.eye(3), sizes, ids=ids[real].astype(np.int64))


def enclosing_primitive(kind: int, vertices: np.ndarray) -> Primitive:
    """Return the sphere or plane that encloses a mesh of another form, from its vertices, (n, 3), all finite.

    A sphere is centered in the vertices' bounding box and reaches the farthest vertex. A plane is their bounding
    rectangle in the object's XY, at their mean z.
    """
    vertices = vertices.astype(np.float64)  # squares in float32 may overflow or underflow
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    center = (low + high) / 2
    if kind == SPHERE:
        axes = np.eye(3) * np.linalg.norm(vertices - center, axis=1).max()
    else:
        center[2] = vertices[:, 2].mean()
        sides = (high - low)[:2] / 2
        axes = np.diag([*(np.ones(2) if kind == INFINITE_PLANE else sides), 1.0])
    return Primitive(kind, center[None], axes, np.ones(1))


def mesh_primitive(mesh: Mesh) -> Primitive:
    """Return a mesh as a shape in its object's space, centered on its middle."""
    return Primitive(MESH, mesh.middle[None], np.eye(3), np.ones(1), mesh)


def castable(placed: Sequence[tuple[Primitive, np.ndarray]]) -> list[np.ndarray]:
    """Return, for each primitive, under which of its (k, 3, 4) object matrices it is finite and its axes are not
    coplanar, however thin it is; the axes of a mesh may be coplanar.

    Axes that were scaled to zero under a rotated parent are coplanar to a few roundings of float32. If each axis is
    divided by its largest component, a determinant below 8 EPS32 cannot be distinguished from zero.
    """
    if not placed:
        return []
    counts = [len(matrices) for _, matrices in placed]
    matrices = np.concatenate([matrices for _, matrices in placed])
    own_axes, may_be_flat = (
        np.repeat(values, counts, axis=0)
        for values in ([each.axes for each, _ in placed], [each.mesh is not None for each, _ in placed])
    )
    finite = np.isfinite(matrices).all(axis=(1, 2))
    axes = np.where(finite[:, None, None], matrices[:, :, :3], 0.0) @ own_axes
    lengths = np.abs(axes).max(axis=1, keepdims=True)
    spans = np.abs(np.linalg.det(axes / np.where(lengths > 0, lengths, 1.0))) > 8 * EPS32
    return np.split(finite & (may_be_flat | spans), np.cumsum(counts)[:-1])


def put_in_world(primitive: Primitive, matrices: np.ndarray, centers: np.ndarray, axes: np.ndarray) -> None:
    """Write the centers (k n, 3) and axes (k n, 3, 3), in the world, of n shapes under each of (k, 3, 4) object
    matrices.

    They are ordered instance by instance and computed in float64, right to gamma(4) of the sum of the magnitudes.
    """
    linear, offset = matrices[:, :, :3], matrices[:, :, 3]
    shape = len(matrices), len(primitive)
    np.add(primitive.centers @ linear.transpose(0, 2, 1), offset[:, None], out=centers.reshape(*shape, 3))
    sizes, columns = primitive.sizes[:, None, None], (linear @ primitive.axes)[:, None]
    np.multiply(sizes, columns, out=axes.reshape(*shape, 3, 3))


def lights_in_world(lights) -> Lights:
    """Return the record of lights, each given as (is_sun, color (3,), cone (2,), matrices (k, 3, 4)).

    A light stands at its matrix's offset. A sun shines along its -Z; its ``position`` is the unit vector along +Z.
    """
    rows = [(is_sun, color, cone, matrix) for is_sun, color, cone, matrices in lights for matrix in matrices]
    rows = [row for row in rows if np.isfinite(row[3]).all() and row[3][:, 2].any()]
    cones = np.array([cone for _, _, cone, _ in rows]).reshape(-1, 2)
    is_turned = (cones != EVERYWHERE).any(axis=1)
    return Lights(
        position=np.array([_unit(m[:, 2]) if is_sun else m[:, 3] for is_sun, _, _, m in rows]).reshape(-1, 3),
        is_sun=np.array([is_sun for is_sun, _, _, _ in rows], bool),
        color=np.array([color for _, color, _, _ in rows]).reshape(-1, 3),
        **(
            {"axis": np.array([-_unit(m[:, 2]) for _, _, _, m in rows]) * is_turned[:, None], "cone": cones}
            if is_turned.any()
            else {}
        ),
    )


def _unit(vector: np.ndarray) -> np.ndarray:
    return vector / np.linalg.norm(vector)
