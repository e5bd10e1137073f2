"""What rays are cast at: shapes in the frame of the rays, and the tables in which passes look up values by shape."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..records import Pose, Shapes
from ..shapes.normals import NormalTable, normal_table
from ..shapes.shape_frames import InCamera
from .request import Request


@dataclass(frozen=True, eq=False)
class RayTarget:
    """The shapes that rays are cast at. The last entries of the tables are for no shape, index -1."""

    placed: InCamera
    """The shapes in the frame of the rays: that of the camera, or the world."""
    seen: np.ndarray
    """(m,) indices into ``Shapes``, ascending: the shapes that some ray may hit."""
    request: Request
    """The options of the passes."""

    @property
    def shapes(self) -> Shapes:
        """All shapes."""
        return self.placed.shapes

    @property
    def pose(self) -> Pose:
        """The frame of the rays."""
        return self.placed.pose

    @cached_property
    def kinds(self) -> np.ndarray:
        """(n + 1,): the numbers of the shapes' kinds, and -1 for no shape."""
        return np.append(self.shapes.kind.astype(np.int16), np.int16(-1))

    @cached_property
    def object_index(self) -> np.ndarray:
        """(n + 1,): the shapes' object indices, and 0 for no shape."""
        return np.append(self.shapes.object_index, np.int32(0))

    @cached_property
    def material_index(self) -> np.ndarray:
        """(n + s + 1,): the shapes' material indices, those of ``Slots``, and 0 for no shape."""
        slots = () if self.shapes.slots is None else self.shapes.slots.material_index
        return np.concatenate((self.shapes.material_index, slots, [0])).astype(np.int32)

    @cached_property
    def colors(self) -> np.ndarray:
        """(4, n + s + 1) float64: the shapes' colors, those of ``Slots``, and transparent black for no shape."""
        slots = np.zeros((4, 0)) if self.shapes.slots is None else self.shapes.slots.color.T
        return np.hstack((self.shapes.color.T, slots, np.zeros((4, 1)))).astype(np.float64, order="C")

    @cached_property
    def normals(self) -> NormalTable:
        """The constants of the normals, computed when a pass first needs them."""
        return normal_table(self.placed, self.seen)
