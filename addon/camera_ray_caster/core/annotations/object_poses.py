"""The pose of each object: a box around it in its own axes, at the time of the picture."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..maths.rotations import transform
from ..records import INFINITE_PLANE, MESH, PLANE, Shapes

DIGITS = 9
"""Decimal digits of a float32, as which Blender has places: they are read back as the same float32."""


def shortened(numbers: np.ndarray) -> list[float]:
    """Return numbers (n,) with the digits that Blender's have."""
    return [float(f"{number:.{DIGITS}g}") for number in numbers.tolist()]


def object_poses(shapes: Shapes, category_of: Callable[[str], str]) -> list[dict[str, Any]]:
    """Return an entry for each shape, in the order of the index pass, but for infinite planes.

    ``matrix`` is (4, 4), from the box to the world: the columns are the object's axes, each of unit length, as Blender
    has them, and the middle of the box; ``size`` is the box's, of 0 for a plane's third side, in Blender units. An
    instance has the number ``instance`` among the shapes of its object. Axes are at right angles unless the object is
    sheared; an axis of length 0 has the direction 0.
    """
    counts: dict[str, int] = {}
    entries = []
    for row in range(len(shapes)):
        name = shapes.names[shapes.name_index[row]]
        number = counts[name] = counts.get(name, -1) + 1
        if shapes.kind[row] == INFINITE_PLANE:
            continue
        half, middle = np.ones(3), np.zeros(3)
        if shapes.kind[row] == MESH:
            mesh = shapes.meshes[shapes.mesh[row]]
            low, high = (ends.astype(np.float64) - mesh.middle for ends in (mesh.vertices.min(1), mesh.vertices.max(1)))
            half, middle = (high - low) / 2, (high + low) / 2
        axes = shapes.axes[row]
        lengths = np.linalg.norm(axes, axis=0)
        matrix = transform(axes / np.where(lengths > 0, lengths, 1.0), shapes.center[row] + axes @ middle)
        half = half * (1, 1, 0) if shapes.kind[row] == PLANE else half
        entries.append({
            "object": name, "instance": number, "shape_index": row, "category": category_of(name),
            "matrix": [shortened(side) for side in matrix], "size": shortened(2 * half * lengths),
        })  # fmt: skip
    return entries
