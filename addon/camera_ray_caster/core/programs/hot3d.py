"""The cameras of HOT3D and its clips, as JSON: by stream, each a calibration with projection_params.

One focal length is that of both axes. The coefficients are those of Project Aria; the center of the first pixel is
(0, 0). T_world_from_camera leads from the camera to the world, T_device_from_camera to the headset, where the file does
not tell the world.
Reference: HOT3D documentation, and the hand tracking toolkit that reads its clips.
"""

from __future__ import annotations

from .aria import MODELS as ARIA
from .parts.document import Document
from .parts.lens import Lens, mapping, matrix, numbers_of
from .parts.placed import Placed, of_quaternion

KINDS = {"FISHEYE624": ARIA["FisheyeRadTanThinPrism"][:2], "PINHOLE": ("OPENCV_PINHOLE", ())}
"""Our model for the last part of a projection_model_type, and the settings that follow the center."""

WORLD, DEVICE = "T_world_from_camera", "T_device_from_camera"


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lens of a document, a single calibration; see the package, which looks for those inside."""
    entries = document.raw
    if not {"projection_model_type", "projection_params"} <= entries.keys():
        return None
    kind = str(entries["projection_model_type"]).rpartition(".")[2]
    model, terms = KINDS[document.one_of(kind, "projection_model_type", KINDS)]
    given = entries["projection_params"]
    focal = 1 if len(numbers_of(given)) == len(terms) + 3 else 2
    numbers = document.numbers(given, "projection_params", focal + 2 + len(terms))
    size = [document.number(entries, side) if side in entries else None for side in ("image_width", "image_height")]
    settings = matrix(numbers[0], numbers[focal - 1], *numbers[focal : focal + 2])
    rest = dict(zip(terms, numbers[focal + 2 :], strict=True))
    return [Lens(str(entries.get("label", "")), model, document.size(*size) | settings | rest)]


def poses(document: Document) -> list[Placed] | None:
    """Return the poses of the cameras; None of any other file. Raises InputError."""
    streams = {name: mapping(one) for name, one in document.raw.items()}
    own = {name: mapping(one.get("calibration")) for name, one in streams.items()}
    if not all("projection_model_type" in one for one in own.values()):
        return None
    in_world = all(WORLD in one for one in streams.values())
    placed = []
    for name, one in streams.items():
        pose = mapping(one[WORLD] if in_world else own[name].get(DEVICE))
        label = str(own[name].get("label") or f"{name}.calibration")
        turn, place = pose.get("quaternion_wxyz"), pose.get("translation_xyz")
        placed.append(Placed(label, "", None, of_quaternion(document, turn, place, label)))
    return placed
