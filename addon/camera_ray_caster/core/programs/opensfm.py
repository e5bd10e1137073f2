"""OpenSfM's camera_models.json: cameras by name, whose lengths are parts of the longer side of the picture.

The center of the first pixel is (0, 0), and the middle of the picture is the center unless c_x and c_y move it.
Reference: OpenSfM documentation, Geometric Models.
"""

from __future__ import annotations

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, one_of_several
from .parts.program import ProgramFiles

RADIAL, EQUIDISTANT = ("k1", "k2"), ("k1", "k2", "k3", "k4")
MODELS = {
    "perspective": ("OPENCV_PINHOLE", RADIAL),
    "brown": ("OPENCV_PINHOLE", ("k1", "k2", "p1", "p2", "k3")),
    "simple_radial": ("OPENCV_PINHOLE", ("k1",)),
    "radial": ("OPENCV_PINHOLE", RADIAL),
    "fisheye": ("OPENCV_FISHEYE", RADIAL),
    "fisheye_opencv": ("OPENCV_FISHEYE", EQUIDISTANT),
    "spherical": ("EQUIRECTANGULAR", ()),
    "equirectangular": ("EQUIRECTANGULAR", ()),
}
"""Our model for a projection_type, and its coefficients."""


def looks(document: Document) -> bool:
    """See ProgramFiles."""
    cameras = document.entries.named()
    return len(cameras) == len(document.entries) and all(one.has("projection_type") for one in cameras.values())


def read(document: Document) -> list[Lens]:
    """See ProgramFiles."""
    return [one_of_several(name, _lens, camera, name) for name, camera in document.entries.named().items()]


def _lens(camera: Fields, name: str) -> Lens:
    model, terms = MODELS[camera.word("projection_type", MODELS)]
    width, height = camera.number("width"), camera.number("height")
    size = camera.document.size(width, height)
    if model == "EQUIRECTANGULAR":
        return Lens(name, model, size)
    focal, unit = camera.number("focal", 0.0), max(width, height)
    settings = {f"f{axis}": camera.number(f"focal_{axis}", focal or None) * unit for axis in "xy"}
    for axis, side in (("x", width), ("y", height)):
        settings[f"c{axis}"] = (side - 1) / 2 + camera.number(f"c_{axis}", 0.0) * unit
    return Lens(name, model, size | settings | {term: camera.number(term, 0.0) for term in terms})


PROGRAM = ProgramFiles(
    "OpenSfM", "camera_models.json", looks, marks="projection_type focal focal_x width height k1",
    reads="perspective, brown, radial, fisheye, fisheye_opencv, spherical",
    lost="poses; other projections are refused", models=MODELS, read=read,
)  # fmt: skip
