"""Anipose's and aniposelib's calibration.toml: cameras with rotation and translation from the world.

Coefficients are OpenCV's; fisheye = true makes them those of its fisheye. The center of the first pixel is (0, 0), and
lengths are those of the pattern that was calibrated with.
Reference: aniposelib documentation, Calibration.
"""

import numpy as np

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.placed import inverted, of_rotation
from .parts.plain import of_matrix
from .parts.program import ProgramFiles, of_cameras


def looks(document: Document) -> bool:
    return bool(_cameras(document))


def _cameras(document: Document) -> list[Fields]:
    sections = document.entries.named().items()
    return [camera.labeled(camera.text("name", section)) for section, camera in sections
            if camera.has("matrix", "distortions", "rotation", "translation")]  # fmt: skip


def _lens(camera: Fields) -> Lens:
    kind = "fisheye" if camera.text("fisheye", "False") != "False" else "plumb_bob"
    return of_matrix(camera, "matrix", "distortions", camera.size("size"), kind)


def _pose(camera: Fields) -> np.ndarray:
    turn, translation = camera.numbers("rotation", 3), camera.numbers("translation", 3)
    return inverted(of_rotation(camera.document, turn, translation, camera.said("rotation")))


PROGRAM = ProgramFiles(
    "Anipose", "calibration.toml", looks, marks="matrix distortions rotation translation size fisheye",
    reads="pinhole, fisheye", **of_cameras(_cameras, _lens, _pose),
)  # fmt: skip
