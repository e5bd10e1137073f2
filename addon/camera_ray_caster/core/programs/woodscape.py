"""WoodScape's calibration of a fisheye, as JSON: a polynomial from the angle to the radius, in pixels.

The center of the first pixel is (0, 0); the offsets count from the middle of the picture. The aspect ratio stretches
the picture along y. The extrinsic quaternion x, y, z, w and the translation lead from the camera, x right, y down, z
ahead, to the vehicle, x ahead, y left, z up, in meters.
Reference: S. Yogamani et al., WoodScape (2019), and its code, calibration.
"""

from ..units import METERS
from .parts.document import Document
from .parts.lens import Lens
from .parts.placed import Placed, of_quaternion
from .parts.program import ProgramFiles

TERMS = "k1", "k2", "k3", "k4"


def looks(document: Document) -> bool:
    return document.entries.part("intrinsic").has("cx_offset")


def read(document: Document) -> list[Lens]:
    intrinsics = document.entries.part("intrinsic")
    intrinsics.word("model", ("radial_poly",))
    width, height, across, down = (intrinsics.number(name) for name in ("width", "height", "cx_offset", "cy_offset"))
    aspect = intrinsics.number("aspect_ratio", 1.0)
    if aspect <= 0:
        raise document.refusal(f"its aspect_ratio is {aspect:g}: it must be above 0")
    terms = [intrinsics.number(term) * aspect for term in TERMS]
    return [Lens("", "FTHETA", document.size(width, height) | {
        "cx": (width - 1) / 2 + across, "cy": (height - 1) / 2 + down, "ftheta_reference": "ANGLE_TO_RADIUS",
        "ftheta_angle_to_radius": " ".join(map(repr, (0.0, *terms))), "ftheta_c": 1 / aspect,
    })]  # fmt: skip


def poses(document: Document) -> list[Placed]:
    extrinsic = document.entries.part("extrinsic")
    if not len(extrinsic):
        return []
    *vector, w = extrinsic.numbers("quaternion", 4)
    pose = of_quaternion(document, (w, *vector), extrinsic.numbers("translation", 3), "extrinsic")
    return [Placed("", "", None, pose)]


PROGRAM = ProgramFiles(
    "WoodScape", "calibration .json", looks,
    marks="intrinsic cx_offset cy_offset poly_order radial_poly aspect_ratio", reads="radial_poly", read=read,
    poses=poses, unit=METERS,
)  # fmt: skip
