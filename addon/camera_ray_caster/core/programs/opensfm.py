"""OpenSfM's camera_models.json: cameras by name, whose lengths are parts of the longer side of the picture.

The center of the first pixel is (0, 0), and the middle of the picture is the center unless c_x and c_y move it.
Reference: OpenSfM documentation, Geometric Models.
"""

from __future__ import annotations

from .parts.document import Document, Lens, mapping, one_of_several

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


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    cameras = document.entries
    if not all("projection_type" in mapping(camera) for camera in cameras.values()):
        return None
    return [one_of_several(name, _lens, document, name, camera) for name, camera in cameras.items()]


def _lens(document: Document, name: str, camera: dict) -> Lens:
    model, terms = MODELS[document.one_of(camera["projection_type"], f"projection_type of {name}", MODELS)]
    width, height = document.number(camera, "width"), document.number(camera, "height")
    size = document.size(width, height)
    if model == "EQUIRECTANGULAR":
        return Lens(name, model, size)
    one, unit = document.number(camera, "focal", 0.0), max(width, height)
    settings = {f"f{axis}": document.number(camera, f"focal_{axis}", one or None) * unit for axis in "xy"}
    for axis, side in (("x", width), ("y", height)):
        settings[f"c{axis}"] = (side - 1) / 2 + document.number(camera, f"c_{axis}", 0.0) * unit
    return Lens(name, model, size | settings | {term: document.number(camera, term, 0.0) for term in terms})
