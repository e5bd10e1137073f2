"""The shapes of a motion that move, apart from those that stand still."""

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from ..mesh import Mesh
from ..records import Shapes
from .deformation import alike
from .evaluations import Motion
from .interpolation import TimeInterval, matched
from .means import same

BY_SHAPE = (
    "kind", "center", "axes", "object_index", "material_index", "color", "name_index", "mesh", "shared", "surface",
    "identity",
)  # fmt: skip
"""The arrays of ``Shapes`` with a row for each shape, or empty."""

OF_ALL = "slots", "surfaces", "uv"
"""What several shapes show."""

LIGHT = "lights", "world"
"""What lights all shapes and stands behind them: in the combined pass alone."""

LOOPS = "normals", "uv"
"""Values at the loops of a mesh that may change as it bends."""


def rows_of(shapes: Shapes, rows: np.ndarray) -> Shapes:
    """Return some of the shapes, by index, without other times."""
    each = {name: getattr(shapes, name) for name in BY_SHAPE}
    kept = {name: values[rows] if len(values) else values for name, values in each.items()}
    slots = None if shapes.slots is None else replace(shapes.slots, first=shapes.slots.first[rows])
    used, numbers = np.unique(kept["mesh"], return_inverse=True)
    first = np.count_nonzero(used < 0)
    meshes, kept["mesh"] = tuple(shapes.meshes[k] for k in used[first:]), (numbers - first).astype(np.int32)
    return replace(shapes, meshes=meshes, slots=slots, motion=None, next=None, previous=None, **kept)


def moving(motion: Motion, but: Collection[str] = ()) -> np.ndarray | None:
    """Return which shapes differ between evaluations, in place or in looks, (n,) bool; None if there are not the same
    shapes in all. ``but`` are arrays whose differences do not count; with "meshes" those of vertices neither.
    """
    first, *others = (shapes for _, shapes in motion.states.values())
    moves = np.zeros(len(first), bool)
    if not all(matched(first, other) for other in others):
        return None
    for other in others:
        for name in BY_SHAPE:
            values = getattr(first, name)
            if len(values) and name not in but:
                moves |= (values != getattr(other, name)).reshape(len(values), -1).any(axis=1)
        changed = [not same(*meshes) for meshes in zip(first.meshes, other.meshes, strict=True)]
        if any(changed) and "meshes" not in but:
            moves |= np.append(changed, False)[first.mesh]
        if not all(same(getattr(first, name), getattr(other, name)) for name in OF_ALL):
            moves[:] = True
    return moves


def light_changes(motion: Motion) -> bool:
    """Whether lights or the background differ between evaluations."""
    first, *others = (shapes for _, shapes in motion.states.values())
    return not all(same(getattr(first, name), getattr(other, name)) for other in others for name in LIGHT)


def bends(forms: Sequence[Mesh]) -> bool:
    """Whether the evaluations of a mesh differ in its vertices, normals and maps alone."""
    first, *others = forms
    return all(
        alike([first], [other])
        and [name for name, _ in other.layers] == [name for name, _ in first.layers]
        and all(
            np.array_equal(layer, other_layer)
            for (_, layer), (_, other_layer) in zip(first.layers, other.layers, strict=True)
        )
        and all(np.shape(getattr(first, name)) == np.shape(getattr(other, name)) for name in LOOPS)
        for other in others
    )


def mesh_of(shapes, row: int) -> Mesh:
    """Return the mesh of a shape."""
    return shapes.meshes[shapes.mesh[row]]


def of_rows(motion: Motion, rows: np.ndarray) -> Motion:
    """Return the motion of some of the shapes, by ascending index."""
    states = {frame: (camera, rows_of(shapes, rows)) for frame, (camera, shapes) in motion.states.items()}
    intervals = tuple(TimeInterval.of(states, interval.frames) for interval in motion.intervals)
    return replace(motion, states=states, intervals=intervals)


def place_at(motion: Motion, row: int, frames: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the centers (n, 3) and the axes (n, 3, 3) of one shape at frames (n,); all evaluations have to have the
    same shapes.
    """
    center, axes = np.empty((len(frames), 3)), np.empty((len(frames), 3, 3))
    for interval, within in motion.parts(frames):
        center[within], axes[within] = interval.place_at(row, frames[within])
    return center, axes


def centers_at(motion: Motion, rows: slice, frames: np.ndarray) -> np.ndarray:
    """Return the centers of some shapes at frames (n,), (shapes, n, 3); all evaluations have to have the same shapes.
    """
    count = len(next(iter(motion.states.values()))[1].center[rows])
    centers = np.empty((count, len(frames), 3))
    for interval, within in motion.parts(frames):
        centers[:, within] = interval.centers_at(rows, frames[within])
    return centers
