"""The intrinsics of Meshroom's and AliceVision's .sfm files, as JSON.

Lengths are in pixels (pxFocalLength), or the focal length and the sensor's width in millimeters. The principal point is
measured from the corner of the picture, and from version 1.2.1 on from its middle. The center of the first pixel is
(0, 0). Numbers may be text.
Reference: AliceVision, sfmDataIO: the changes of its file format, and its camera models.
"""

from __future__ import annotations

from .document import Document, Lens, mapping, one_of_several

MODELS = {
    "pinhole": ("OPENCV_PINHOLE", ()),
    "none": ("OPENCV_PINHOLE", ()),
    "radial1": ("OPENCV_PINHOLE", ("k1",)),
    "radialk1": ("OPENCV_PINHOLE", ("k1",)),
    "radial3": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    "radialk3": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    "brown": ("OPENCV_PINHOLE", ("k1", "k2", "k3", "p1", "p2")),
    "fisheye4": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "fisheye": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "fisheye1": ("FOV", ("fov_omega",)),
}
"""Our model for a type, or for the distortionType of a pinhole, and its coefficients."""

CENTERED = 1, 2, 1
"""The version of files from which on principal points are measured from the middle."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    entries = document.entries
    intrinsics = entries.get("intrinsics")
    if not isinstance(intrinsics, list) or not all("intrinsicId" in mapping(one) for one in intrinsics):
        return None
    version = tuple(document.numbers(entries.get("version", [1, 2, 1]), "version"))
    return [one_of_several(str(one["intrinsicId"]), _lens, document, one, version) for one in intrinsics]


def _lens(document: Document, camera: dict, version: tuple[float, ...]) -> Lens:
    name = str(camera["intrinsicId"])
    kind = str(camera.get("type", "pinhole")).lower()
    kind = str(camera.get("distortionType") or kind).lower() if kind == "pinhole" else kind
    model, terms = MODELS[document.one_of(kind, f"type of {name}", MODELS)]
    width, height = document.number(camera, "width"), document.number(camera, "height")
    if document.number(camera, "pixelRatio", 1.0) != 1:
        raise document.refusal(f"pixelRatio of {name} is {camera['pixelRatio']}: only square pixels are read")
    if "pxFocalLength" in camera:
        focal = document.numbers(camera["pxFocalLength"], f"pxFocalLength of {name}")
    else:
        focal = [document.number(camera, "focalLength") / document.number(camera, "sensorWidth") * width]
    center = document.numbers(camera.get("principalPoint"), f"principalPoint of {name}", 2)
    if version >= CENTERED:
        center = [center[0] + width / 2, center[1] + height / 2]
    given = camera.get("distortionParams")
    rest = [0.0] * len(terms) if given in (None, "", []) else document.numbers(given, f"distortionParams of {name}")
    if len(rest) != len(terms) and any(rest):
        raise document.refusal(f"distortionParams of {name} has {len(rest)} numbers: {kind} has {len(terms)}")
    settings = {"fx": focal[0], "fy": focal[-1], "cx": center[0], "cy": center[1]}
    return Lens(name, model, document.size(width, height) | settings | dict(zip(terms, rest, strict=False)))
