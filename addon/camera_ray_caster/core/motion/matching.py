"""Corresponding shapes in two readings of a scene."""

import numpy as np

from ..records import MESH, Shapes
from .deformation import same_faces
from .interpolation import matched


def same_rows(before: Shapes, after: Shapes) -> bool:
    """Whether the rows of two evaluations are of the same objects, if perhaps in other forms."""
    return before.names == after.names and np.array_equal(before.name_index, after.name_index)


def rows_in(before: Shapes, after: Shapes) -> np.ndarray:
    """Return the rows (n,) of the shapes of ``before`` in ``after``; -1 for shapes that are not in ``after``.

    Two shapes correspond if they have the same identity, the kinds are equal, and meshes have the same faces. Shapes
    without identities have the name of their object in place of it. Of several shapes with the same identity those with
    the same place among them correspond, if both readings have the same number of them.
    """
    if matched(before, after):
        return np.arange(len(before))
    numbers, other_numbers = _numbers(before, after)
    count = max(numbers.max(initial=-1), other_numbers.max(initial=-1)) + 1
    counts, other_counts = (np.bincount(array, minlength=count) for array in (numbers, other_numbers))
    there = np.flatnonzero((counts == other_counts)[numbers])
    rows = np.full(len(before), -1)
    here = there[np.argsort(numbers[there], kind="stable")]
    matches = np.flatnonzero((counts == other_counts)[other_numbers])
    rows[here] = matches[np.argsort(other_numbers[matches], kind="stable")]
    shared = np.flatnonzero(rows >= 0)
    is_other = np.zeros(len(before), bool)
    is_other[shared] = before.kind[shared] != after.kind[rows[shared]]
    meshes = np.flatnonzero((rows >= 0) & ~is_other & (before.kind == MESH))
    pairs = np.stack((before.mesh[meshes], after.mesh[rows[meshes]])) if meshes.size else np.zeros((2, 0), int)
    for mesh_before, mesh_after in np.unique(pairs, axis=1).T:
        if not same_faces(before.meshes[mesh_before], after.meshes[mesh_after]):
            is_other[meshes[(pairs == [[mesh_before], [mesh_after]]).all(axis=0)]] = True
    rows[is_other] = -1
    return rows


def _numbers(before: Shapes, after: Shapes) -> list[np.ndarray]:
    """Return two arrays of numbers that are equal for shapes with the same identity, or the same name without one."""
    if all(len(shapes.identity) == len(shapes) for shapes in (before, after)):
        _, numbers = np.unique(np.concatenate((before.identity, after.identity)), return_inverse=True)
        return np.split(numbers, [len(before)])
    known = {name: number for number, name in enumerate(dict.fromkeys((*before.names, *after.names)))}
    return [np.array([known[name] for name in shapes.names], int)[shapes.name_index] for shapes in (before, after)]
