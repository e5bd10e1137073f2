"""Kalibr's camchain.yaml: the lenses of a rig, and each camera's pose beside the one before it.

T_cn_cnm1 leads from the camera before to the camera, x right, y down, z ahead; lengths are in meters. The center of the
first pixel is (0, 0).
Reference: Kalibr wiki, YAML formats.
"""

from __future__ import annotations

import json

import numpy as np

from ..programs.kalibr import DISTORTIONS, SHAPES
from ..programs.parts.document import matrix_of
from ..records import InputError
from ..units import METERS
from . import lenses

TABLE = {
    f"{kind}-{bend}": (model, (*SHAPES[kind][1], *terms))
    for (kind, bend), (model, terms) in DISTORTIONS.items()
    if bend != "radialtangential8"  # OKVIS's word, not Kalibr's
} | {f"{kind}-none": SHAPES[kind] for kind in ("omni", "eucm", "ds")}

MOVED = 1e-5
"""Largest change of a pose beside another camera that counts as rounding of float32 matrices, in radians and parts."""


class Kalibr(lenses.LensFormat):
    """One file with all cameras, which must not move against each other."""

    key = "kalibr"
    label = "Kalibr"
    description = "camchain.yaml: the lenses of a rig that does not change, and their poses beside each other"
    table = TABLE
    unit = METERS

    def files(self, shots):
        """See Format. Raises InputError if a lens, or a camera's pose beside the first one, changes."""
        chain = "# Made by Camera Ray Caster\n"
        names = list(dict.fromkeys(shot.name for shot in shots))
        before: dict = {}
        for number, name in enumerate(names):
            own = {shot.frame: shot for shot in shots if shot.name == name}
            told = {_lens(shot) for shot in own.values()}
            beside = [_beside(before[frame], shot) for frame, shot in own.items()] if before else []
            if len(told) > 1 or any(np.abs(one - beside[0]).max() > MOVED * (1 + np.abs(one).max()) for one in beside):
                what = "its lens" if len(told) > 1 else f"it moves beside {names[number - 1]!r}"
                raise InputError(f"a camchain is of one rig, but camera {name!r} changes ({what}): export one frame")
            chain += f"cam{number}:\n{told.pop()}  rostopic: {json.dumps('/' + name, ensure_ascii=False)}\n"
            if beside:
                chain += "  T_cn_cnm1:\n" + "".join(f"  - {row}\n" for row in beside[0].tolist())
            before = own
        yield "camchain.yaml", chain


def _beside(before, shot) -> np.ndarray:
    """Return the matrix from one camera to another."""
    return shot.camera.world_to_opencv @ np.linalg.inv(before.camera.world_to_opencv)


def _lens(shot) -> str:
    model, lens = lenses.lens_of(TABLE, shot.camera)
    kind, bend = model.split("-")
    shape, terms = SHAPES[kind][1], DISTORTIONS.get((kind, bend), ("", ()))[1]
    width, height = shot.camera.raster.picture_size
    entries = {
        "camera_model": kind, "intrinsics": lenses.values(lens, shape) + matrix_of(lens.settings),
        "distortion_model": bend, "distortion_coeffs": lenses.values(lens, terms), "resolution": [width, height],
    }  # fmt: skip
    return "".join(f"  {name}: {value}\n" for name, value in entries.items())
