"""The contract of an export format: what a file in this folder has to say.

A format is one class under ``Format`` and one word in FORMATS. It gives ``key``, ``label``, ``description``,
``refusal``, which says what it cannot represent, and ``files``. Lengths are Blender units unless it says otherwise. It
computes contents and writes nothing: the files of an export appear together or not at all, by whoever asked for them.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..camera.camera import Camera
from ..names import frame_digits

Content = str | bytes | np.ndarray
"""Of a file: text, bytes, or an image, (rows, columns, 3) float32 from the bottom up, to be stored as float32 EXR."""

OWN_TIMES = "each pixel of which has its own time"
"""Why a format of pictures taken at once refuses a camera."""


@dataclass(frozen=True)
class Shot:
    """A camera at a frame."""

    camera_name: str
    """In names of files; see ``names``."""
    frame: float
    camera: Camera
    meters: float = 1.0
    """How long a Blender unit is."""
    target: Camera | None = None
    """The camera to whose picture a map leads; None for the perspective of the same lens."""
    suffix: str = ""
    """Of the view, for one eye of a camera; "" for a camera with one."""

    @property
    def name(self) -> str:
        """The name of the files of this camera, or this eye, at all frames, without an ending."""
        return self.camera_name + self.suffix

    @property
    def stem(self) -> str:
        """The name of the files of this frame, without an ending: as renders of it are called."""
        return f"{self.camera_name}_{frame_digits(self.frame)}{self.suffix}"

    @property
    def image(self) -> str:
        """The name of its picture."""
        return f"{self.stem}.png"


class Format(ABC):
    """An export format; see the module's page."""

    key: ClassVar[str]
    """Its name in a command line."""
    label: ClassVar[str]
    """Its name in menus."""
    description: ClassVar[str]
    """One line for menus."""
    rigid: ClassVar[bool] = False
    """Whether it stores a pose as a rotation: it is given cameras with the rotation nearest to their axes."""
    takes_target: ClassVar[bool] = False
    """Whether it uses ``Shot.target``."""

    @abstractmethod
    def refusal(self, shot: Shot) -> str | None:
        """Return what of a camera the format cannot say, as a clause ("whose k3 is not 0"), or "" where it is the model
        itself; None where it says all of it.
        """

    def unsaid(self, shot: Shot) -> list[str]:
        """Return what the files leave out of a camera that is no reason to refuse it, in lines."""
        camera, raster = shot.camera, shot.camera.raster
        lines = {
            f"the depth of field of camera {camera.name!r} is not in the files": camera.aperture is not None,
            f"the files are of the full frame of camera {camera.name!r}, without its render border": (
                raster.shape != (raster.height, raster.width)
            ),
        }
        return [line for line, is_so in lines.items() if is_so]

    @abstractmethod
    def files(self, shots: Sequence[Shot]) -> Iterator[tuple[str, Content]]:
        """Yield the name and the content of each file of an export of these, one or more, none of which it refuses.

        Raises InputError for what does not go together.
        """
