"""Shapes made from arrays, without Blender: spheres, planes and triangle meshes."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arguments import flag, keywords, numbers, shape_of, shown
from ..arguments import name as a_name
from ..cameras.parts.pose import flaw_of_last_row
from ..mesh import Mesh
from ..records import INFINITE_PLANE, PLANE, SPHERE, InputError, Shapes, no_shapes
from ..shapes.instances import Primitive, castable, mesh_primitive, put_in_world
from .mesh_object import arrays_of, with_colors

GRAY = 0.8, 0.8, 0.8, 1.0
"""Blender's color of a surface without a material."""

LARGEST_INDEX = 2**31 - 1


@keywords
def spheres(
    centers, radii=1.0, *, axes=None, object_index=0, material_index=0, color=GRAY, name: str | Sequence[str] = "sphere"
) -> Shapes:
    """Return spheres, or ellipsoids, one per row of ``centers``.

    centers: (n, 3), or (3,) for one, or [] for none; world, in Blender units.
    radii: a number or (n,), above 0.
    axes: (3, 3) or (n, 3, 3), by default the identity: the columns are the images of the axes, so that the surface is
        center + radius axes q with |q| = 1.
    object_index, material_index: a whole number or (n,): what these passes show.
    color: linear RGB or RGBA, (3,), (4,) or one per row: the base color of the combined pass.
    name: a name, or n names: what reports and explanations call the shapes.

    ``shape_index`` of a pixel is the row. Raises InputError, in one line, for arrays of another shape, numbers that are
    not finite, and shapes without volume.
    """
    centers = _rows(centers, "centers")
    radii = _per_row(numbers(radii, "radii"), "radii", len(centers), ())
    if not (radii > 0).all():
        raise InputError(f"radii of spheres are {shown(radii.min())} or more: they must be above 0")
    matrices = _matrices(axes, len(centers)) * radii[:, None, None]
    return _exact(SPHERE, centers, matrices, object_index, material_index, color, name)


def planes(
    centers,
    axes=None,
    *,
    infinite: bool = False,
    object_index=0,
    material_index=0,
    color=GRAY,
    name: str | Sequence[str] = "plane",
) -> Shapes:
    """Return planes: parallelograms, or with ``infinite`` unbounded, one per row of ``centers``.

    centers: (n, 3), or (3,) for one, or [] for none; world, in Blender units.
    axes: (3, 3) or (n, 3, 3), by default the identity: the first two columns lead from the center to the middle of a
        side, the third is any vector off the plane. Or (3, 2) or (n, 3, 2), without the third.

    The others are those of ``spheres``. Raises InputError, in one line, for arrays of another shape, numbers that are
    not finite, and axes that lie on one line.
    """
    centers = _rows(centers, "centers")
    kind = INFINITE_PLANE if flag(infinite, "infinite") else PLANE
    return _exact(kind, centers, _matrices(axes, len(centers), True), object_index, material_index, color, name)


@keywords
def mesh(
    vertices,
    faces=None,
    *,
    normals=None,
    uv=None,
    pose=None,
    object_index=0,
    material_index=0,
    color=GRAY,
    name: str | Sequence[str] = "mesh",
) -> Shapes:
    """Return a mesh, or several instances of it.

    vertices: (v, 3). float32 is kept as it is, as Blender has it; all else becomes float64. Or an object with vertices
        and faces, such as a mesh of trimesh or Open3D: ``mesh(object)``, with its UV map and, unless ``color`` is
        given, the colors of its vertices or faces, or its texture.
    faces: (k, 3) triangles, (k, 4) quads, or a list of faces with any number of corners: whole numbers, the vertices of
        each face, counterclockwise as seen from its front. A face of more than three corners is cut into triangles from
        its first corner on, as fits a convex one. ``face_index`` of a pixel is the row.
    normals: (v, 3) for a smooth surface, or one per corner, face by face; of any length but 0. Default: flat faces.
    uv: (v, 2), or one per corner: what the pass uv shows.
    pose: (4, 4), or (n, 4, 4) for n instances: the matrices from the vertices' frame to the world.

    The others are those of ``spheres``; with n instances they are for each instance. A mesh without faces gives no
    shapes. Raises InputError, in one line, for arrays of another shape, numbers that are not finite, and faces with
    vertices that do not exist.
    """
    if faces is None:
        looks = {"object_index": object_index, "material_index": material_index, "color": color, "name": name}
        arrays = arrays_of(vertices)
        overrides = {key: value for key, value in (("normals", normals), ("uv", uv)) if value is not None}
        shapes = mesh(**(arrays | overrides), pose=pose, **looks)
        return with_colors(shapes, vertices) if color is GRAY else shapes
    points = numbers(vertices, "vertices")
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise InputError(f"vertices are {shape_of(points)}: they must be (v, 3) finite numbers")
    kept = np.float32 if getattr(vertices, "dtype", None) == np.float32 else np.float64
    corners, starts = _faces(faces, len(points))
    if not len(starts):
        return no_shapes()
    counts = np.diff(starts, append=len(corners))
    polygon = np.repeat(np.arange(len(starts), dtype=np.int32), counts - 2)
    step = np.arange(len(polygon)) - np.repeat(np.cumsum(counts - 2) - (counts - 2), counts - 2)
    loops = (starts[polygon] + np.stack((np.zeros_like(step), step + 1, step + 2))).astype(np.int32)
    triangles = Mesh(
        vertices=np.array(points.T, kept, order="C"),
        triangles=np.ascontiguousarray(corners[loops]),
        polygon=polygon,
        loops=None if normals is None and uv is None else loops,
        normals=None if normals is None else _unit(_at_corners(normals, "normals", 3, len(points), corners)),
        uv=None if uv is None else _at_corners(uv, "uv", 2, len(points), corners),
    )
    placed = np.eye(4)[None] if pose is None else numbers(pose, "pose")
    placed = placed[None] if placed.ndim == 2 else placed
    if placed.ndim != 3 or placed.shape[1:] not in ((4, 4), (3, 4)):
        raise InputError(f"pose is of shape {placed.shape}: it must be (4, 4), or (n, 4, 4) for n instances")
    flaw = next(filter(None, map(flaw_of_last_row, placed)), None)
    if flaw:
        raise InputError(f"pose {flaw}")
    shapes = _placed(mesh_primitive(triangles), placed[:, :3], object_index, material_index, color, name)
    n = len(shapes)
    return replace(shapes, meshes=(triangles,), mesh=np.zeros(n, np.int32), shared=np.full(n, n > 1))


def _exact(kind: int, centers: np.ndarray, axes: np.ndarray, *looks) -> Shapes:
    primitive = Primitive(kind, np.zeros((1, 3)), np.eye(3), np.ones(1))
    return _placed(primitive, np.concatenate((axes, centers[:, :, None]), axis=2), *looks)


def _placed(primitive: Primitive, matrices: np.ndarray, object_index, material_index, color, name) -> Shapes:
    """Return the rows of a shape under (n, 3, 4) matrices. Raises InputError for one that has no extent."""
    n = len(matrices)
    (well,) = castable([(primitive, matrices)])
    if not well.all():
        row = int(np.flatnonzero(~well)[0])
        raise InputError(f"row {row} is not finite, or has its axes in one plane: leave it out, or give other axes")
    center, axes = np.empty((n, 3)), np.empty((n, 3, 3))
    put_in_world(primitive, matrices, center, axes)
    color, rgba = numbers(color, "color"), np.ones((n, 4), np.float32)
    channels = 3 if color.shape[-1:] == (3,) else 4
    rgba[:, :channels] = _per_row(color, "color", n, (channels,))
    names = (a_name(name),) if isinstance(name, str) else tuple(a_name(row_name, "one of name") for row_name in name)
    if len(names) not in (1, n):
        raise InputError(f"{len(names)} names are given for {n} shapes: give one, or as many")
    return Shapes(
        kind=np.full(n, primitive.kind, np.uint8),
        center=center,
        axes=axes,
        object_index=_index(object_index, "object_index", n),
        material_index=_index(material_index, "material_index", n),
        color=rgba,
        name_index=np.arange(n, dtype=np.int32) if len(names) > 1 else np.zeros(n, np.int32),
        names=names,
    )


def _rows(values, name: str) -> np.ndarray:
    rows = np.atleast_2d(numbers(values, name))
    if np.shape(values) == (0,):
        rows = rows.reshape(0, 3)
    if rows.ndim != 2 or rows.shape[1] != 3 or not np.isfinite(rows).all():
        raise InputError(f"{name} are {shape_of(rows)}: they must be (n, 3) finite numbers")
    return rows


def _per_row(values: np.ndarray, name: str, n: int, width: tuple[int, ...]) -> np.ndarray:
    """Return values for each row, (n, *width), of one value or of n."""
    if values.shape not in (width, (n, *width)) or not np.isfinite(values).all():
        raise InputError(f"{name} is {shape_of(values)}: it must be {width} or {(n, *width)} finite numbers")
    return np.broadcast_to(values, (n, *width))


def _index(values, name: str, n: int) -> np.ndarray:
    indices = _per_row(numbers(values, name), name, n, ())
    if not ((indices == np.rint(indices)) & (np.abs(indices) <= LARGEST_INDEX)).all():
        raise InputError(f"{name} is {shown(values)}: it must be whole numbers of 32 bits")
    return indices.astype(np.int32)


def _matrices(axes, n: int, may_be_two: bool = False) -> np.ndarray:
    """Return axes as (n, 3, 3), the third of two columns perpendicular to them."""
    matrices = np.eye(3) if axes is None else numbers(axes, "axes")
    width = 2 if may_be_two and matrices.shape[-1:] == (2,) else 3
    columns = _per_row(matrices, "axes", n, (3, width))
    if width == 3:
        return columns
    third = np.cross(columns[:, :, 0], columns[:, :, 1])
    length = np.linalg.norm(third, axis=1, keepdims=True)
    return np.concatenate((columns, (third / np.where(length > 0, length, 1))[:, :, None]), axis=2)


def _faces(faces, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices of all corners, face by face, (l,) int32, and the first corner of each face, (k,)."""
    try:
        sizes = [len(face) for face in faces]
        corners = np.concatenate([np.asarray(face) for face in faces]) if sizes else np.zeros(0, np.int32)
    except (TypeError, ValueError) as error:
        raise InputError("faces cannot be read: give (k, 3) whole numbers, or a list of faces") from error
    if corners.dtype.kind not in "iu" or corners.ndim != 1:
        raise InputError(f"faces are of type {corners.dtype}: they must be whole numbers, the vertices of each face")
    if len(sizes) and min(sizes) < 3:
        raise InputError(f"face {sizes.index(min(sizes))} has {min(sizes)} corners: it must have 3 or more")
    if len(corners) and not 0 <= corners.min() <= corners.max() < count:
        raise InputError(f"faces have vertices {corners.min()} to {corners.max()}: there are only 0 to {count - 1}")
    return corners.astype(np.int32), np.cumsum([0, *sizes])[:-1]


def _at_corners(values, name: str, width: int, count: int, corners: np.ndarray) -> np.ndarray:
    """Return float32 values at the corners, of values at the vertices or at the corners."""
    array = numbers(values, name)
    if array.shape not in ((count, width), (len(corners), width)) or not np.isfinite(array).all():
        allowed = f"({count}, {width}), one per vertex, or ({len(corners)}, {width}), one per corner"
        raise InputError(f"{name} are {shape_of(array)}: they must be {allowed}, finite numbers")
    return (array[corners] if len(array) == count else array).astype(np.float32)


def _unit(normals: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(normals.astype(np.float64), axis=1, keepdims=True)
    if not (length > 0).all():
        raise InputError(f"normals have length 0 at corner {int(length.argmin())}: give a direction everywhere")
    return (normals / length).astype(np.float32)
