"""The panoramas of stella_vslam and OpenVSLAM: the part Camera of a configuration, with model: equirectangular.

Their other cameras have the names of OpenCV's, and are read as such. The middle of the picture looks ahead.
Reference: stella_vslam documentation, Parameters.
"""

from __future__ import annotations

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.program import ProgramFiles

MODEL = "equirectangular"


def _camera(document: Document) -> Fields:
    return document.entries.part("Camera") if document.entries.has("Camera") else document.entries


def looks(document: Document) -> bool:
    """See ProgramFiles."""
    camera = _camera(document)
    return any(camera.has(name, size) and camera.text(name) == MODEL
               for name, size in (("model", "cols"), ("Camera.model", "Camera.cols")))  # fmt: skip


def read(document: Document) -> list[Lens]:
    """See ProgramFiles."""
    camera, before = _camera(document), "" if document.entries.has("Camera") else "Camera."
    return [Lens(camera.text(f"{before}name", ""), "EQUIRECTANGULAR", camera.sides(f"{before}cols", f"{before}rows"))]


PROGRAM = ProgramFiles(
    "stella_vslam", "panoramas of a configuration, .yaml", looks, marks="Camera model equirectangular cols rows",
    reads="equirectangular", read=read,
)  # fmt: skip
