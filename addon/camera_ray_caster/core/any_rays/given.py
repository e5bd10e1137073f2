"""Given rays as the camera of a cast, so that the passes of pictures are written for them, too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..camera.camera import Camera
from ..cameras.model import Model, Step
from ..records import BlenderCamera, Raster
from .search import WORLD


@dataclass(frozen=True, eq=False)
class GivenRays(Model):
    """A camera of a single row, whose pixel k has ray k, in the world. The rays are taken as exact.
    """

    origin: np.ndarray
    """(3, n)."""
    direction: np.ndarray
    """(3, n), of any length; NaN for no ray."""

    key, label, group = "GIVEN_RAYS", "Given Rays", "Multiperspective"
    description = "Rays given as arrays"
    central = False
    FORMULA = (Step("Origin and direction", "as given"),)

    def rays(self, x, y):
        """See Model."""
        which = np.floor(x).astype(np.intp)
        return tuple(self.origin[:, which]), tuple(self.direction[:, which])

    def pixel_rounding(self, x, y):
        """See Model."""
        return 0.0, 0.0

    @property
    def ray_rounding(self) -> float:
        """See Model."""
        return 0.0


def camera_of(origin: np.ndarray, direction: np.ndarray, near: float, far: float) -> Camera:
    """Return the camera whose only row of pixels has these rays, (3, n) each."""
    count = origin.shape[1]
    return Camera(
        name="rays",
        model=GivenRays((count, 1), origin, direction),
        pose=WORLD,
        raster=Raster(count, 1, 1.0, 0, 0, count, 1),
        clip_start=near,
        clip_end=far,
        record=BlenderCamera("rays", GivenRays.key, np.eye(4)),
    )
