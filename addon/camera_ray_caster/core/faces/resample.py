"""The picture of a camera from the pictures of its faces.

A pixel is the mean of SIDE x SIDE places in it, each of which the camera's own formula turns into a ray, whose color is
interpolated linearly between the four nearest texels of its face. Faces have FINER texels across a pixel. Places
without a ray are transparent; a pixel whose middle has no ray is, too.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..camera.camera import Camera
from ..camera.pixel_coordinates import in_blocks
from .faces import Face, chosen, turn_of
from .lens_points import LensPoint

SIDE = 2
"""Places across a pixel."""
FINER = 1.5
"""Texels across a pixel, where texels are largest for it. Of a checker of 10 squares a radian through a fisheye of 180
degrees and 200 pixels, the mean error (99th percentile) is 0.015 (0.14) beside the mean over each pixel's square; of 2
texels, whose faces take 1.8 times the time, 0.011 (0.11), of 1 texel 0.024 (0.19).
"""
BLOCK_PIXELS = 1 << 16
"""Pixels that are made at once."""


def resampled(
    camera: Camera, faces: Sequence[Face], pictures: Sequence[np.ndarray], lens: LensPoint | None = None
) -> np.ndarray:
    """Return the picture of a camera's render window, (rows, columns, channels) float32, row 0 at the bottom.

    pictures: of the faces, (height, width, channels) float32 with premultiplied alpha, row 0 at the bottom, made of the
    camera as it is at one time. lens: the point of the aperture from which they are seen; default its center.
    """
    still, turn, raster = replace(camera, pixel_time=None), turn_of(camera), camera.raster
    result = np.zeros((*raster.shape, pictures[0].shape[-1] if pictures else 4), np.float32)
    x, y = raster.columns(), raster.rows()
    offsets = (np.arange(SIDE) + 0.5) / SIDE - 0.5

    def put(rows: slice) -> None:
        sums = result[rows].reshape(-1, result.shape[-1])
        for up in offsets:
            for right in offsets:
                rays = still.rays_at(x + right, y[rows] + up)
                directions = rays.directions.reshape(-1, 3) @ turn
                if lens is not None:
                    directions = lens.directions(directions)
                face_of = np.where(rays.valid.ravel(), chosen(faces, directions), -1)
                for index, (face, picture) in enumerate(zip(faces, pictures, strict=True)):
                    here = np.flatnonzero(face_of == index)
                    sums[here] += _between(picture, face.places(directions[here]))
        sums /= SIDE**2
        result[rows][~still.rays_at(x, y[rows]).valid] = 0.0

    if faces:
        in_blocks(put, raster.shape, BLOCK_PIXELS)
    return result


def _between(picture: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Return a picture's colors at places (n, 2) in texels, between the middles of the four nearest ones."""
    height, width, channels = picture.shape
    at = np.clip(places - 0.5, 0, (width - 1, height - 1))
    first = np.minimum(at.astype(np.intp), (width - 2, height - 2))
    right, up = (at - first).astype(np.float32).T
    weights = np.stack(((1 - right) * (1 - up), right * (1 - up), (1 - right) * up, right * up), axis=-1)
    texels = (first[:, 0] + width * first[:, 1])[:, None] + (0, 1, width, width + 1)
    return np.einsum("nk,nkc->nc", weights, picture.reshape(-1, channels).take(texels, axis=0))
