"""Cameras of stella_vslam and OpenVSLAM that OpenCV does not have: the part Camera of a configuration, with the model
equirectangular or radial_division.

Their other cameras have the names of OpenCV's, and are read as such. The middle of a panorama looks ahead. The center
of the first pixel is (0, 0).
Reference: stella_vslam documentation, Parameters.
"""

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import MATRIX, Lens, matrix
from .parts.program import ProgramFiles

MODELS = "equirectangular", "radial_division"


def _camera(document: Document) -> Fields:
    entries = document.entries
    if entries.has("Camera"):
        return entries.part("Camera")
    names = {name.removeprefix("Camera."): value for name, value in entries.values.items()}
    return Fields(document, names)


def looks(document: Document) -> bool:
    camera = _camera(document)
    return camera.has("model", "cols") and camera.text("model") in MODELS


def read(document: Document) -> list[Lens]:
    camera = _camera(document)
    name, size = camera.text("name"), camera.sides("cols", "rows")
    if camera.text("model") == MODELS[0]:
        return [Lens(name, "EQUIRECTANGULAR", size)]
    numbers = matrix(*map(camera.number, MATRIX))
    return [Lens(name, "DIVISION", size | numbers | {"division_lambda": camera.number("distortion")})]


PROGRAM = ProgramFiles(
    "stella_vslam", "cameras of a configuration, .yaml", looks, marks="Camera model equirectangular cols rows",
    reads="equirectangular, radial_division", read=read,
)  # fmt: skip
