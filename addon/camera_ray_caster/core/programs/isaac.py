"""The camera_params.json of NVIDIA's Omniverse Replicator and Isaac Sim: pinholes, and fisheyes by a polynomial.

The polynomial gives the angle, rad, of a radius in pixels of the nominal picture. A pinhole has square pixels. The
center counts from the picture's corner, so that half the width is the middle.
Reference: NVIDIA Omniverse Replicator documentation, Annotators: CameraParams.
"""

from __future__ import annotations

from math import radians

from .parts.document import Document
from .parts.lens import Lens, matrix

NOMINAL = "cameraFisheyeNominalWidth", "cameraFisheyeNominalHeight"
FISHEYE, PINHOLE = "fisheyePolynomial", "pinhole"


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document; see the package."""
    entries = document.raw
    if "cameraModel" not in entries or "renderProductResolution" not in entries:
        return None
    kind = document.one_of(entries["cameraModel"], "cameraModel", (PINHOLE, FISHEYE))
    width, height = document.numbers(entries["renderProductResolution"], "renderProductResolution", 2)
    if kind == PINHOLE:
        if any(document.numbers(entries.get("cameraApertureOffset", [0.0]), "cameraApertureOffset")):
            raise document.refusal("its cameraApertureOffset is not 0, which is not read")
        aperture = document.numbers(entries.get("cameraAperture"), "cameraAperture", 2)
        focal = document.number(entries, "cameraFocalLength") / aperture[0] * width if aperture[0] else 0.0
        middle = matrix(focal, focal, width / 2, height / 2, 0.5)
        return [Lens("", "OPENCV_PINHOLE", document.size(width, height) | middle)]
    cx, cy = document.numbers(entries.get("cameraFisheyeOpticalCentre"), "cameraFisheyeOpticalCentre", 2)
    numbers = document.numbers(entries.get("cameraFisheyePolynomial"), "cameraFisheyePolynomial")
    return [Lens("", "FTHETA", document.size(*(document.number(entries, side) for side in NOMINAL)) | {
        "cx": cx - 0.5, "cy": cy - 0.5, "ftheta_reference": "RADIUS_TO_ANGLE",
        "ftheta_radius_to_angle": " ".join(map(repr, numbers)),
        "ftheta_max_angle": radians(document.number(entries, "cameraFisheyeMaxFOV") / 2),
    })]  # fmt: skip
