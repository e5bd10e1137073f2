"""Rays of many pixels and pixels of many points: in blocks, which threads share; whole pictures also by polynomials.

Working arrays are reused from block to block only while they are small: C's malloc returns larger ones to the system,
which clears their memory anew, and that takes longer than the arithmetic. ``camera``: a ``Camera`` without pixel times.
"""

from contextlib import nullcontext
from dataclasses import replace
from typing import Any

import numpy as np

from ..cameras.model import NOWHERE
from ..maths.panels import ROWS, is_raster, on_raster
from ..maths.speed import whole_rows
from ..maths.vector import ALL, components, cut, dot, inverse, is_grid, matvec, norm
from ..records import Rays
from .guard import checked
from .pixel_coordinates import in_blocks

FARTHEST = 1e15
"""Coordinate, in pixels or Blender units, up to which no length or polynomial overflows."""

BLOCK_PIXELS = 1 << 16
"""Number of pixels whose rays are computed at once by a thread. 2**17: 1.0 to 2.4 times the time, for the memory;
2**15: 1.1 to 1.6 times the time, since threads wait for each other in numpy.
"""

BLOCK_POINTS = 1 << 14
"""Number of points that are projected at once by a thread. 2**13: 1.0 to 1.4 times the time; 2**15: 1.0 to 1.8 times.
"""

POLYNOMIAL_PIXELS = 1 << 20
"""Number of pixels at once where polynomials give most of them and the formula is evaluated for few. 2**19: 1.0 to 1.3
times the time.
"""


def rays_through(camera: Any, x, y, shape: tuple[int, ...]) -> Rays:
    """Return the world rays for pixel coordinates that broadcast to a shape; see ``Camera.rays_at``."""
    near = _is_near(x) and _is_near(y)
    if not (is_grid(x, y) and len(shape) == 2):
        x, y = (np.broadcast_to(coordinate, shape).reshape(-1, 1) for coordinate in (x, y))
    picture = np.broadcast_shapes(x.shape, y.shape)
    directions, valid = np.empty((*picture, 3)), np.empty(picture, bool)
    central = camera.model.central
    origins = np.broadcast_to(camera.pose.eye, directions.shape) if central else np.empty(directions.shape)

    def put(rows: slice) -> None:
        window = rows, ALL
        with _quiet(near):
            _write(camera, cut(x, window), cut(y, window), origins[rows], directions[rows])
            np.equal(directions[rows, :, 0], directions[rows, :, 0], out=valid[rows])  # False for NaN

    if _by_polynomials(camera, x, y):
        in_blocks(put, picture, POLYNOMIAL_PIXELS, ROWS)  # whole panels
    else:
        in_blocks(put, picture, BLOCK_PIXELS)
    if not near:
        is_unit = norm(components(directions)) > 0.5  # 0 or NaN where something overflowed
        lost = ~(np.isfinite(x) & np.isfinite(y) & is_unit)
        directions[lost], valid[...] = np.nan, ~lost
    directions = directions.reshape(*shape, 3)
    origins = np.broadcast_to(camera.pose.eye, directions.shape) if central else origins.reshape(directions.shape)
    return Rays(origins, directions, valid.reshape(shape))


def pixels_of(camera: Any, points: np.ndarray) -> np.ndarray:
    """Return the pixel coordinates (n, 2) of world points (n, 3); see ``Camera.project``."""
    near, camera_from_world = _is_near(points), inverse(camera.pose.basis)
    pixels = np.empty((len(points), 2))

    def put(block: slice) -> None:
        with _quiet(near):
            beside = [axis - eye for axis, eye in zip(components(points[block]), camera.pose.eye.tolist(), strict=True)]
            # not by BLAS, which rounds a single point otherwise
            seen = np.stack(matvec(camera_from_world, beside)).T
            pixels[block] = checked(camera.model, seen, camera.model.project(seen))

    in_blocks(put, (len(points), 1), BLOCK_POINTS)
    if not near:
        pixels[~(np.isfinite(points).all(axis=-1) & np.isfinite(pixels).all(axis=-1))] = np.nan
    return pixels


def _by_polynomials(camera: Any, x, y) -> bool:
    return camera.model.polynomials != NOWHERE and is_raster(x, y)


def _write(camera: Any, x, y, origins, directions) -> None:
    """Write the world rays through pixel coordinates; the origins only if the rays do not all leave the eye."""
    if _by_polynomials(camera, x, y):
        parts = (directions,) if camera.model.central else (directions, origins)
        out = [np.moveaxis(vectors, -1, 0) for vectors in parts]
        endless = replace(camera, model=camera.model.endless)
        on_raster(lambda x, y: _by_formula(endless, x, y), x, y, camera.model.disc, 3 * len(out), out)
    else:
        with whole_rows(directions.shape[1]):
            _write_by_formula(camera, x, y, components(origins), components(directions))


def _write_by_formula(camera: Any, x, y, origins, directions) -> None:
    """Write the components of the world rays; those of the origins only if the rays do not all leave the eye."""
    origin, direction = camera.camera_rays(x, y)
    scale = 1.0 / camera.length_of(direction) if camera.model.planar else 1.0
    for axis, row in enumerate(camera.pose.basis):
        np.multiply(dot(row, direction), scale, out=directions[axis])
        if not camera.model.central:
            np.add(dot(row, origin), camera.pose.eye[axis], out=origins[axis])


def _by_formula(camera: Any, x, y):
    """Return the components of the directions, and of the origins unless all rays leave the eye."""
    directions, origins = np.empty((2, 3, *np.broadcast_shapes(x.shape, y.shape)))
    with np.errstate(all="ignore"):  # the formula may have no value beyond the model's disc
        _write_by_formula(camera, x, y, origins, directions)
    return (*directions,) if camera.model.central else (*directions, *origins)


def _is_near(places) -> bool:
    """Whether all coordinates are finite and less than FARTHEST in magnitude."""
    return bool(-FARTHEST < places.min(initial=0.0) <= places.max(initial=0.0) < FARTHEST)


def _quiet(near: bool):
    """Silence warnings of overflow and NaN for far coordinates, where these are valid answers."""
    return nullcontext() if near else np.errstate(all="ignore")
