"""Meanings of the numbers in the index passes, so that files can be used without the .blend."""

from typing import Any

import numpy as np

from ..records import Shapes
from ..shapes import kinds


def indices_of(shapes: Shapes) -> dict[str, Any]:
    """Return the meanings of the numbers in the index passes, by the name of the pass.

    ``object_index`` and ``material_index`` have for each pass index the names of its objects or materials.
    ``shape_index`` has runs of shapes: the index of the first, their number, their object and kind. Only materials that
    a shape has are listed; a pixel without a material has material_index 0, too.
    """
    objects: dict[str, list[str]] = {}
    for index, name in np.unique(np.stack((shapes.object_index, shapes.name_index), axis=1), axis=0).tolist():
        objects.setdefault(str(index), []).append(shapes.names[name])
    materials: dict[str, list[str]] = {}
    for index, name in sorted(shapes.materials):
        materials.setdefault(str(index), []).append(name)
    return {"object_index": objects, "material_index": materials, "shape_index": _runs(shapes)}


def _runs(shapes: Shapes) -> list[dict[str, Any]]:
    pairs = np.stack((shapes.name_index, shapes.kind.astype(np.int64)), axis=1)
    begins = np.flatnonzero(np.any(np.diff(pairs, axis=0, prepend=-1), axis=1))
    counts = np.diff(begins, append=len(shapes))
    names = {kind.number: kind.name.upper().replace(" ", "_") for kind in kinds.SHAPE_KINDS}
    return [
        {"first": first, "count": count, "object": shapes.names[name], "kind": names[kind]}
        for first, count, (name, kind) in zip(begins.tolist(), counts.tolist(), pairs[begins].tolist(), strict=True)
    ]
