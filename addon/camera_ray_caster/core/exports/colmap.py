"""COLMAP's text model: cameras.txt, images.txt, and a points3D.txt without points.

Poses are from the world to OpenCV's camera frame; the center of the first pixel is (0.5, 0.5). COLMAP's equirectangular
panorama is the whole sphere. In its files a name ends at the first space.
Reference: COLMAP documentation, Output Format; Camera Models.
"""

from __future__ import annotations

from math import pi

import numpy as np

from ..conventions import EPS32
from ..maths.rotations import quaternion
from ..programs.colmap import MODELS, SPHERE
from ..programs.parts.document import Lens, matrix_of
from . import lenses
from .format import Shot

TABLE = {
    kind: (key, tuple(name for name in names.split() if name not in lenses.MATRIX))
    for kind, (key, names) in MODELS.items()
    if names.startswith("fx") and kind != "FISHEYE"  # OPENCV_FISHEYE says the same, and every COLMAP reads it
} | {SPHERE: (SPHERE, ())}

CAMERAS = """# Camera list with one line of data per camera:
#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
"""
IMAGES = """# Image list with two lines of data per image:
#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME
#   POINTS2D[] as (X, Y, POINT3D_ID)
"""
POINTS = """# 3D point list with one line of data per point:
#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
"""


class Colmap(lenses.LensFormat):
    """One line in cameras.txt for each lens of each camera, one image for each frame."""

    key = "colmap"
    label = "COLMAP"
    description = "cameras.txt, images.txt and points3D.txt: calibrated lenses and poses"
    table = TABLE

    def refusal(self, shot):
        """See Format."""
        if " " in shot.image:
            return "whose name has a space, which ends a name in COLMAP: rename it"
        found = lenses.find_lens(TABLE, shot.camera)
        if found is not None and found[0] == SPHERE and not _is_whole(found[1], shot.camera.raster.picture_size):
            return "which is not the whole sphere"
        return super().refusal(shot)

    def files(self, shots):
        """See Format."""
        ids: dict[tuple[str, str], int] = {}
        images = []
        for number, shot in enumerate(shots, 1):
            camera = ids.setdefault((shot.name, _line(shot)), len(ids) + 1)
            pose = shot.camera.world_to_opencv
            numbers = " ".join(map(repr, (*quaternion(pose[:3, :3]).tolist(), *pose[:3, 3].tolist())))
            images.append(f"{number} {numbers} {camera} {shot.image}\n\n")
        yield "cameras.txt", CAMERAS + "".join(f"{number} {line}\n" for (_, line), number in ids.items())
        yield "images.txt", IMAGES + "".join(images)
        yield "points3D.txt", POINTS


def _line(shot: Shot) -> str:
    """Return a camera's line in cameras.txt, without its number."""
    kind, lens = lenses.lens_of(TABLE, shot.camera)
    width, height = shot.camera.raster.picture_size
    if kind == SPHERE:
        return f"{kind} {width} {height} {width} {height}"
    values = matrix_of(lens.settings, 0.5) + lenses.values(lens, TABLE[kind][1])
    return f"{kind} {width} {height} {' '.join(map(repr, values))}"


def _is_whole(lens: Lens, size: tuple[int, int]) -> bool:
    """Whether a panorama is the whole sphere with the viewing direction in the middle, up to the rounding of Blender's
    angles, which are float32: pi is off by 3e-8 of itself.
    """
    (width, height), near = size, EPS32
    found = matrix_of(lens.settings, 0.5)
    return bool(np.allclose(found, (width / (2 * pi), height / pi, width / 2, height / 2), near, near * max(size)))
