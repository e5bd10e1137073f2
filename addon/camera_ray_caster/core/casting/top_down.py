"""Pictures in the conventions of other programs, with row 0 at the top: rows, flow, pixels and the camera matrix."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..arguments import shown
from ..conventions import TOP
from .images import Images

OFFSETS = "flow_forward", "flow_backward"
"""Passes whose last axis is an offset in pixels, x and y."""


class TopDown(Images):
    """Passes by name with row 0 at the top and y down, C-contiguous, and the camera in the same pixels."""

    camera: Any = None
    """The camera of the pictures; None of arrays that no cast returned."""
    rows = TOP

    @property
    def K(self) -> np.ndarray | None:
        """The camera matrix, (3, 3), of these pictures: pixel (0, 0) is the center of the top left one, also of a
        render border. None for models without a camera matrix.
        """
        if self.camera is None or self.camera.K is None:
            return None
        matrix = self.camera.K.copy()
        matrix[:2, 2] -= self._corner()
        return matrix

    def project(self, points) -> np.ndarray:
        """Return the pixels (..., 2), x right and y down from the center of the top left one, of world points (..., 3);
        see ``Camera.project``.
        """
        if self.camera is None:
            raise TypeError("these pictures have no camera: use top_down(images) of a cast")
        return self.camera.project(points, rows=TOP) - self._corner()

    def _corner(self) -> tuple[int, int]:
        """Return the columns left of the pictures, and the rows above."""
        return self.camera.raster.x0, self.camera.raster.height - self.camera.raster.y1


def top_down(images: Mapping[str, np.ndarray]) -> TopDown:
    """Return the pictures of a cast, or other passes by name, as OpenCV and most programs have them: row 0 at the top,
    y down, offsets of flow as well, in new C-contiguous arrays. ``K`` and ``project`` of the result are for its pixels.
    Names may have that of a layer in front, as in NPZ files: "Layer.flow_forward". What is top down already is
    returned as it is.

    Positions, normals and all other values are in the world, as before. Raises TypeError for a single array.
    """
    if isinstance(images, TopDown):
        return images
    if not isinstance(images, Mapping):
        raise TypeError(f"top_down takes passes by name, such as the images of a cast, not {shown(type(images))}")
    turned = TopDown()
    vars(turned).update(vars(images) if isinstance(images, Images) else {})
    for name, image in images.items():
        turned[name] = np.ascontiguousarray(np.asarray(image)[::-1])
        if name.rpartition(".")[2] in OFFSETS:
            turned[name] = turned[name] * np.array((1, -1), turned[name].dtype)
    return turned
