"""Points of shapes at which the expressions of materials are evaluated."""

from typing import Any

import numpy as np

from ..materials.values import OBJECT, UV, Places
from ..maths.speed import lazy, taken
from ..records import Shapes
from .kind import HitPixels, Kind
from .shape_frames import InCamera


class KindPlaces:
    """The points of all pixels that hit shapes of one kind; what materials need of them is computed at first use."""

    def __init__(self, kind: Kind, shapes: InCamera, pixels: HitPixels, point: Any):
        """Take the hit points as components relative to the eye, world."""
        self.kind, self.shapes, self.pixels, self.point = kind, shapes, pixels, point
        self._layers: dict[str, np.ndarray] = {}

    @lazy
    def uv(self) -> np.ndarray:
        """(2, m): the surface coordinates, as the uv pass has them."""
        return np.array(self.kind.uv(self.shapes, self.pixels, self.point))

    @lazy
    def place(self) -> np.ndarray:
        """(3, m): the points in their objects' spaces."""
        return self.kind.in_object(self.shapes, self.pixels, self.point)

    def layer(self, name: str, channels: int) -> np.ndarray:
        """Return a layer of the meshes, (channels, m)."""
        if name not in self._layers:
            self._layers[name] = self.kind.layer(self.shapes, self.pixels, self.point, name, channels)
        return self._layers[name]

    @lazy
    def surface(self) -> np.ndarray:
        """(m,): the surfaces that are hit, as indices into ``Shapes.surfaces``; -1 for plain materials."""
        rows = material_rows(self.shapes.shapes, self.pixels.at, self.kind.slot(self.shapes, self.pixels))
        return self.shapes.surfaces[rows]

    def each_surface(self) -> list[tuple[int, np.ndarray]]:
        """Return each surface that is hit, by its index, with the indices (k,) of its points."""
        there = np.unique(self.surface)
        return [(number, np.flatnonzero(self.surface == number)) for number in there[there >= 0].tolist()]


class SurfacePlaces(Places):
    """Some of the points of a kind, (k,) indices: see ``materials.values.Places``."""

    def __init__(self, places: KindPlaces, indices: np.ndarray):
        super().__init__()
        self._places, self._indices = places, indices

    def coordinates(self, name: str) -> np.ndarray:
        result = np.zeros((3, len(self._indices)))
        if name == UV:
            result[:2] = taken(self._places.uv, self._indices)
        elif name == OBJECT:
            result[:] = taken(self._places.place, self._indices)
        return result

    def layer(self, name: str, channels: int) -> np.ndarray:
        return taken(self._places.layer(name, channels), self._indices)


def material_rows(shapes: Shapes, at: np.ndarray, slot: np.ndarray) -> np.ndarray:
    """Return the rows of materials in a table of the shapes' own materials, followed by those of ``Slots``, given the
    hit shapes, (m,), and the slots that are hit.
    """
    if shapes.slots is None:
        return at
    first = shapes.slots.first[at]
    return np.where(first < 0, at, len(shapes) + first + slot).astype(np.intp)
