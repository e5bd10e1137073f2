"""WoodScape's calibration of a fisheye, as JSON: a polynomial from the angle to the radius, in pixels.

The center of the first pixel is (0, 0); the offsets count from the middle of the picture. The aspect ratio stretches
the picture along y.
Reference: S. Yogamani et al., WoodScape (2019), and its code, calibration.
"""

from __future__ import annotations

from .parts.document import Document
from .parts.lens import Lens, mapping

TERMS = "k1", "k2", "k3", "k4"


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document; see the package."""
    given = mapping(document.raw.get("intrinsic"))
    if "cx_offset" not in given:
        return None
    document.one_of(given.get("model"), "model", ("radial_poly",))
    width, height, across, down = (document.number(given, one) for one in ("width", "height", "cx_offset", "cy_offset"))
    aspect = document.number(given, "aspect_ratio", 1.0)
    if aspect <= 0:
        raise document.refusal(f"its aspect_ratio is {aspect:g}: it must be above 0")
    terms = [document.number(given, term) * aspect for term in TERMS]
    return [Lens("", "FTHETA", document.size(width, height) | {
        "cx": (width - 1) / 2 + across, "cy": (height - 1) / 2 + down, "ftheta_reference": "ANGLE_TO_RADIUS",
        "ftheta_angle_to_radius": " ".join(map(repr, (0.0, *terms))), "ftheta_c": 1 / aspect,
    })]  # fmt: skip
