"""mrcal's .cameramodel: one lens and one pose per file.

extrinsics are the rotation vector and the translation from the world to the camera, x right and y down; the center of
the first pixel is (0, 0).
Reference: mrcal documentation, Lens models; The .cameramodel file format.
"""

from __future__ import annotations

from ..maths.rotations import half_turn_vector
from ..programs.mrcal import LONLAT, MODELS, STEREOGRAPHIC
from ..programs.parts.document import Lens, matrix_of
from . import lenses

TABLE = {kind: one for kind, one in MODELS.items() if kind != STEREOGRAPHIC} | {
    LONLAT: ("EQUIRECTANGULAR", ()),
    STEREOGRAPHIC: ("UCM", ("unified_xi",)),
}


class Mrcal(lenses.LensFormat):
    """One file per camera and frame."""

    key = "mrcal"
    label = "mrcal"
    description = "<camera>_<frame>.cameramodel: OpenCV's lenses, panoramas and stereographic fisheyes, and poses"
    table = TABLE

    def refusal(self, shot):
        """See Format."""
        found = lenses.find_lens(TABLE, shot.camera)
        if found is not None and found[0] == STEREOGRAPHIC and found[1].settings["unified_xi"] != 1:
            return "whose unified_xi is not 1"
        return super().refusal(shot)

    def files(self, shots):
        """See Format."""
        for shot in shots:
            kind, lens = lenses.lens_of(TABLE, shot.camera)
            pose = shot.camera.world_to_opencv
            numbers = {
                "intrinsics": _intrinsics(kind, lens),
                "extrinsics": [*half_turn_vector(pose[:3, :3]).tolist(), *pose[:3, 3].tolist()],
                "imagersize": list(shot.camera.raster.picture_size),
            }
            lines = "".join(f"    '{name}': [ {', '.join(map(repr, own))} ],\n" for name, own in numbers.items())
            yield f"{shot.stem}.cameramodel", f"{{\n    'lensmodel': '{kind}',\n{lines}}}\n"


def _intrinsics(kind: str, lens: Lens) -> list[float]:
    fx, fy, cx, cy = matrix_of(lens.settings)
    if kind == STEREOGRAPHIC:
        return [fx / 2, fy / 2, cx, cy]
    return [fx, fy, cx, cy, *lenses.values(lens, TABLE[kind][1])]
