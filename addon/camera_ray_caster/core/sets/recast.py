"""Views of a set, cast anew with the meshes of objects in place of the exact spheres and planes that were cast.

So depths, masks, boxes and poses are of the surfaces that the models of ``object_scenes`` have.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import Any

import numpy as np

from ..annotations.coco import Sheet, document
from ..cast import cast
from ..records import Shapes
from .finished_set import View
from .object_models import check_size, no_shape

ShapesAt = Callable[[float], Shapes]


@dataclass(frozen=True, eq=False)
class MeshView(View):
    """A view whose distances and annotations are those of the shapes of its frame."""

    shapes_at: ShapesAt | None = None
    _is_top_down = False

    @property
    def annotations(self) -> dict[str, Any]:
        """Return the annotations of the cast. Raises InputError if the shapes are not those of the set."""
        return _cast(self)[1]

    @property
    def written(self) -> dict[str, Any]:
        """Return the annotations that the set has."""
        return super().annotations

    @property
    def _passes(self) -> Mapping[str, np.ndarray]:
        return _cast(self)[0]


def with_meshes(views: Sequence[View], shapes_at: ShapesAt) -> list[View]:
    """Return the views, those with exact shapes as views of the shapes of their frames."""
    return [
        MeshView(**{each.name: getattr(view, each.name) for each in fields(View)}, shapes_at=shapes_at)
        if view.report.get("exact") else view
        for view in views
    ]  # fmt: skip


@lru_cache(maxsize=1)
def _cast(view: MeshView) -> tuple[Mapping[str, np.ndarray], dict[str, Any]]:
    assert view.shapes_at is not None
    shapes, before = view.shapes_at(view.frame), view.written
    category = {entry["object"]: entry["category"] for entry in before["objects"]}
    names = {shapes.names[index] for index in shapes.name_index.tolist()}
    if missing := sorted(category.keys() - names):
        raise no_shape(missing[0])
    images = cast(view.camera, shapes, passes=("distance", "shape_index"), dtype=np.float64)
    sheet = Sheet.of(view.camera.raster)
    image = {name: value for name, value in before["images"][0].items() if name not in ("id", "width", "height")}
    annotations = document(image, sheet, view.camera, shapes, lambda name: category.get(name, name), (), images)
    sizes = {(entry["object"], entry["instance"]): entry["size"] for entry in before["objects"]}
    for entry in annotations["objects"]:
        check_size(entry, sizes.get((entry["object"], entry["instance"]), entry["size"]))
    return images, annotations
