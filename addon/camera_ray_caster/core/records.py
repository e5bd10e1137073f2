"""The plain records that the steps of a cast exchange. They hold values; the steps hold the arithmetic.

Records with arrays compare by identity: one is equal to itself only.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .shape_records import AREA, EVERYWHERE, INFINITE_PLANE, MESH, PLANE, SPHERE, Lights, Shapes, Slots, no_shapes  # noqa: F401


class InputError(ValueError):
    """Input of the user that cannot be cast. The message is one line that says what is wrong and what to do."""

    def __init__(self, message: str):
        super().__init__(" ".join(message.splitlines()))  # quoted text may have several lines


class Cancelled(Exception):
    """The user stopped the work."""


@dataclass(frozen=True, eq=False)
class BlenderCamera:
    """A camera and its render settings, copied from Blender; nothing is derived.

    Names, units and meanings are those of Blender's Python API (Camera, RenderSettings). ``matrix_world`` is the matrix
    of the evaluated object, (4, 4) float64. ``settings`` holds the properties that only some models have, by name.
    """

    name: str
    type: str
    matrix_world: np.ndarray
    lens: float = 50.0
    sensor_fit: str = "AUTO"
    sensor_width: float = 36.0
    sensor_height: float = 24.0
    shift_x: float = 0.0
    shift_y: float = 0.0
    ortho_scale: float = 6.0
    clip_start: float = 0.1
    clip_end: float = 1000.0
    resolution_x: int = 1920
    resolution_y: int = 1080
    resolution_percentage: int = 100
    pixel_aspect_x: float = 1.0
    pixel_aspect_y: float = 1.0
    use_border: bool = False
    border_min_x: float = 0.0
    border_max_x: float = 1.0
    border_min_y: float = 0.0
    border_max_y: float = 1.0
    use_crop_to_border: bool = False
    model: str = ""
    """Key of the model chosen in place of Blender's camera type; empty if Blender's type is used."""
    settings: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Raster:
    """The full frame in pixels, and its window that is rendered: columns x0 .. x1 - 1, rows y0 .. y1 - 1."""

    width: int
    height: int
    pixel_aspect: float
    """Height of a pixel over its width."""
    x0: int
    y0: int
    x1: int
    y1: int
    cropped: bool = False
    """Whether files of pictures have the window only; else they have the full frame, empty outside of the window."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the full frame."""
        return self.width, self.height

    @property
    def picture(self) -> tuple[int, int, int, int]:
        """The part of the frame that files of pictures have: columns x0 .. x1 - 1, rows y0 .. y1 - 1, as x0, x1, y0,
        y1.
        """
        return (self.x0, self.x1, self.y0, self.y1) if self.cropped else (0, self.width, 0, self.height)

    @property
    def picture_size(self) -> tuple[int, int]:
        """Width and height of files of pictures."""
        x0, x1, y0, y1 = self.picture
        return x1 - x0, y1 - y0

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the render window: the shape of every image."""
        return self.y1 - self.y0, self.x1 - self.x0

    def columns(self) -> np.ndarray:
        """Return the x of the window's pixel centers, (1, columns) float64, exact."""
        return np.arange(self.x0, self.x1, dtype=np.float64)[None, :] + 0.5

    def rows(self) -> np.ndarray:
        """Return the y of the window's pixel centers, (rows, 1) float64, exact."""
        return np.arange(self.y0, self.y1, dtype=np.float64)[:, None] + 0.5


@dataclass(frozen=True, eq=False)
class Pose:
    """Position and orientation of the camera: world = eye + basis @ camera."""

    eye: np.ndarray
    """(3,) float64: the camera's origin in the world."""
    basis: np.ndarray
    """(3, 3) float64: the columns are the camera's X, Y and Z axes in the world, each of unit length."""

    def __repr__(self) -> str:
        return f"<Pose: eye {self.eye.tolist()}, basis {self.basis.tolist()}>"


@dataclass(frozen=True, eq=False)
class Rays:
    """The chief rays of a picture, in the world; see the conventions."""

    origins: np.ndarray
    """(rows, columns, 3) float64; a read-only broadcast view if all rays leave one eye."""
    directions: np.ndarray
    """(rows, columns, 3) float64, unit length to 8 EPS, NaN where there is no ray."""
    valid: np.ndarray
    """(rows, columns) bool."""
    time: np.ndarray | None = None
    """(rows, columns) float64: the frame at which each ray is cast; None if the picture has one time."""

    def __repr__(self) -> str:
        return f"<Rays {np.shape(self.valid)}: {np.count_nonzero(self.valid)} valid>"


@dataclass(frozen=True, eq=False)
class RaysJacobian:
    """The derivatives of a picture's chief rays, in the world, with respect to the pixel's x and y: the last axis."""

    origins: np.ndarray
    """(rows, columns, 3, 2) float64; a read-only broadcast view of 0 if all rays leave one eye."""
    directions: np.ndarray
    """(rows, columns, 3, 2) float64: derivatives of the unit directions; NaN where there is no ray."""

    def __repr__(self) -> str:
        return f"<RaysJacobian {self.directions.shape[:-2]}>"


@dataclass(frozen=True)
class Finding:
    """The errors of a camera's rays against one independent reference, and the bounds that the reference can reach."""

    witness: str
    points: int
    worst_pixels: float
    median_pixels: float
    bound_pixels: float
    worst_radians: float
    median_radians: float
    bound_radians: float
    not_compared: str = ""
    """Reason why nothing was compared; empty if there was a comparison."""

    @property
    def passed(self) -> bool:
        """Whether no error exceeds its bound. NaN fails; a finding without a comparison passes."""
        if self.not_compared:
            return True
        return self.worst_pixels <= self.bound_pixels and self.worst_radians <= self.bound_radians
