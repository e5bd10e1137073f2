"""Corresponding shapes in two readings of a scene."""

from __future__ import annotations

import numpy as np

from ..records import MESH, Shapes
from .deformation import same_faces
from .interpolation import matched


def rows_in(before: Shapes, after: Shapes) -> np.ndarray:
    """Return the rows (n,) of the shapes of ``before`` in ``after``; -1 for shapes that are not in ``after``.

    Two shapes correspond if they have the same identity, the kinds are equal, and meshes have the same faces. Shapes
    without identities have the name of their object in place of it. Of several shapes with the same identity those with
    the same place among them correspond, if both readings have the same number of them.
    """
    if matched(before, after):
        return np.arange(len(before))
    own, other = _numbers(before, after)
    most = max(own.max(initial=-1), other.max(initial=-1)) + 1
    counts, other_counts = (np.bincount(one, minlength=most) for one in (own, other))
    there = np.flatnonzero((counts == other_counts)[own])
    rows = np.full(len(before), -1)
    here = there[np.argsort(own[there], kind="stable")]
    found = np.flatnonzero((counts == other_counts)[other])
    rows[here] = found[np.argsort(other[found], kind="stable")]
    own = np.flatnonzero(rows >= 0)
    is_other = np.zeros(len(before), bool)
    is_other[own] = before.kind[own] != after.kind[rows[own]]
    meshes = np.flatnonzero((rows >= 0) & ~is_other & (before.kind == MESH))
    pairs = np.stack((before.mesh[meshes], after.mesh[rows[meshes]])) if meshes.size else np.zeros((2, 0), int)
    for one, another in np.unique(pairs, axis=1).T:
        if not same_faces(before.meshes[one], after.meshes[another]):
            is_other[meshes[(pairs == [[one], [another]]).all(axis=0)]] = True
    rows[is_other] = -1
    return rows


def _numbers(before: Shapes, after: Shapes) -> list[np.ndarray]:
    """Return two arrays of numbers that are equal for shapes with the same identity, or the same name without one."""
    if all(len(one.identity) == len(one) for one in (before, after)):
        _, numbers = np.unique(np.concatenate((before.identity, after.identity)), return_inverse=True)
        return np.split(numbers, [len(before)])
    known = {name: number for number, name in enumerate(dict.fromkeys((*before.names, *after.names)))}
    return [np.array([known[name] for name in one.names], int)[one.name_index] for one in (before, after)]
