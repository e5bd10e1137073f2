"""The interface of an export format.

A format is a subclass of ``Format`` and an entry in EXPORT_FORMATS. It defines ``key``, ``label``,
``description``, ``refusal``, which tells what the format cannot represent, and ``files``. Lengths are in its ``unit``.
A format computes contents and writes nothing: the caller writes all files of an export or none.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..camera.camera import Camera
from ..names import frame_digits
from ..programs.parts.program import Content
from ..records import Raster
from ..units import BLENDER_UNITS, Unit

OWN_TIMES = "each pixel of which has its own time"
"""Reason for refusal by a format whose pictures are taken at one time."""


class Each(Sequence):
    """Items made of others each time that they are asked for: of cameras of a large set a few are held."""

    def __init__(self, others: Sequence, make: Callable):
        self._others, self._make = others, make

    def __len__(self) -> int:
        return len(self._others)

    def __getitem__(self, number):
        return self._make(self._others[number])


@dataclass(frozen=True)
class Shot:
    """A camera at a frame."""

    camera_name: str
    """Name of the camera in names of files; see ``names``."""
    frame: float
    camera: Camera
    meters: float = 1.0
    """Length of a Blender unit in meters."""
    target: Camera | None = None
    """Other camera of a map; None for the perspective of the same lens."""
    suffix: str = ""
    """Suffix of the view for one eye of a multi-view camera; "" for any other camera."""

    rate: float = 24.0
    """Frames in a second."""

    fit: str = ""
    """Remark on a lens that was fitted to the camera's; empty for the camera's own lens."""

    last: Camera | None = None
    """Of a rolling shutter the camera at the last row that is read; ``camera`` is that at the first one."""
    offsets: tuple[float, float] = (0.0, 0.0)
    """Times of these rows, in seconds from the frame's."""

    @property
    def remark(self) -> dict[str, str]:
        """Return the entry of JSON with the remark on a fitted lens; none for the camera's own lens."""
        return {"fit": self.fit} if self.fit else {}

    @property
    def seconds(self) -> float:
        """Time of the frame; frame 0 is at 0 seconds."""
        return self.frame / self.rate

    @property
    def name(self) -> str:
        """Name of the files of this camera or eye for all frames together, without an ending."""
        return self.camera_name + self.suffix

    @property
    def stem(self) -> str:
        """Name of the files of this frame, without an ending; the same as the name of its render."""
        return f"{self.camera_name}_{frame_digits(self.frame)}{self.suffix}"

    @property
    def image(self) -> str:
        """Name of the picture's file."""
        return f"{self.stem}.png"


class Format(ABC):
    """An export format; see the module's docstring."""

    key: ClassVar[str]
    """Name in a command line."""
    label: ClassVar[str]
    """Name in menus."""
    description: ClassVar[str]
    """Description in menus, one line."""
    unit: ClassVar[Unit] = BLENDER_UNITS
    """Unit of lengths. The format gets cameras whose places are in this unit; see ``units``."""
    rigid: ClassVar[bool] = False
    """Whether the format stores a pose as a rotation. It then gets cameras with the rotation nearest to their axes."""
    takes_target: ClassVar[bool] = False
    """Whether the format uses ``Shot.target``."""
    formula: ClassVar[bool] = True
    """Whether the files have a formula for all pixels, rather than a ray for each pixel that has one."""

    @abstractmethod
    def refusal(self, shot: Shot) -> str | None:
        """Return the reason why the format cannot represent a camera; None if it can.

        The reason is a clause ("whose k3 is not 0"), or "" if the reason is the model itself.
        """

    def at_ends(self, shot: Shot) -> Shot:
        """Return what the format writes of a shot: of a rolling shutter its ends, if the format has them."""
        return shot

    def omissions(self, shot: Shot) -> list[str]:
        """Return lines on what the files omit of a camera without the format refusing it."""
        camera, raster = shot.camera, shot.camera.raster
        lines = {
            f"the depth of field of camera {camera.name!r} is not in the files": camera.aperture is not None,
            f"the files are of the full frame of camera {camera.name!r}, without its render border": (
                raster.shape != raster.picture_size[::-1]
            ),
            f"the files are of the picture of camera {camera.name!r}, cropped to its render border": (
                raster.size != raster.picture_size
            ),
            f"corners of the frame of camera {camera.name!r} have no ray, but the files' formula gives them one": (
                self.formula and not camera.rays_at(*_corners(raster)).valid.all()
            ),
        }
        return [line for line, is_so in lines.items() if is_so]

    @abstractmethod
    def files(self, shots: Sequence[Shot]) -> Iterator[tuple[str, Content]]:
        """Yield the name and the content of each file of an export. The format refuses none of the shots, one or more.

        Raises InputError for shots that cannot be exported together.
        """


def _corners(raster: Raster) -> tuple[np.ndarray, np.ndarray]:
    """Return x (2,) and y (2, 1) of the pixel centers in the corners of the picture."""
    x0, x1, y0, y1 = raster.picture
    return np.array([x0 + 0.5, x1 - 0.5]), np.array([[y0 + 0.5], [y1 - 0.5]])
