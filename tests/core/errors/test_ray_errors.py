"""Error bounds of rays at the rim of a picture, where rays end or turn with the square root of a move."""

from fractions import Fraction

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.records import SPHERE

from ..cameras.model_examples import camera, raw_of
from ..truth import truth
from .extreme_cases import shapes_of

RADIUS = 5.0


def rim(width, height):
    """The pixels whose centers are exactly on the circle of the frame's smaller side, and their places on it."""
    side = min(width, height)
    for row in range(height):
        for column in range(width):
            a, b = (Fraction(2 * at + 1 - size, side) for at, size in ((column, width), (row, height)))
            if a * a + b * b == 1:
                yield row, column, (float(a), float(b), 0.0)


def test_bounds_hold_at_the_rim_of_an_orthographic_fisheye():
    """Its rays there lie in the plane of the picture, and turn with the square root of the distance to the rim."""
    worst, count = 0.0, 0
    for width in range(3, 60):
        images = bounds(camera("FISHEYE_ORTHOGRAPHIC", {"resolution_x": width, "resolution_y": width + 1}))
        for row, column, unit in rim(width, width + 1):
            if images["valid"][row, column]:
                count += 1
                error = np.linalg.norm(images["position"][row, column] - RADIUS * np.array(unit))
                worst = max(worst, error / images["position_bound"][row, column])
    assert count > 60
    assert 0 < worst <= 1


@pytest.mark.parametrize("key", ["FISHEYE_ORTHOGRAPHIC", "DOME_MASTER", "FISHEYE_STEREOGRAPHIC", "OMNIMAX"])
def test_every_ray_has_bounds(key):
    for width in range(3, 30):
        for height in (width, width + 1):
            images = bounds(camera(key, {"resolution_x": width, "resolution_y": height, "fov": 2.0}))
            for name in ("distance_bound", "position_bound"):
                assert np.isfinite(images[name][images["valid"]]).all()


@pytest.mark.full
def test_bounds_hold_where_a_cross_slits_rays_meet_in_a_small_place():
    """Slits near each other, nearly parallel, or far away; against rays with 60 digits."""
    rng = np.random.default_rng(6)
    worst = 0.0
    for _ in range(80):
        first = rng.normal(size=3) * 10 ** rng.uniform(-6, 2)
        second = first + rng.normal(size=3) * 10 ** rng.uniform(-6, 1)
        along = rng.normal(size=3) * [1, 1, rng.choice([0, 1e-3, 1])]
        other = along + rng.normal(size=3) * 10 ** rng.uniform(-3, 0)
        settings = {"slit_1": (first, first + along), "slit_2": (second, second + other)}
        settings |= {"resolution_x": 9, "resolution_y": 7}
        raw, cam = raw_of("CROSS_SLIT", settings), camera("CROSS_SLIT", settings)
        x, y = (grid.ravel() for grid in np.meshgrid(cam.raster.columns(), cam.raster.rows()))
        rays = world_rays(cam, x, y)
        for k in rng.integers(0, 63, 4):
            exact = truth.ray(raw, x[k], y[k])
            for name in ("origin", "direction"):
                ours = truth.exact([np.broadcast_to(numbers, x.shape)[k] for numbers in getattr(rays, name)])
                off = truth.norm(truth.minus(ours, getattr(exact, name)))
                worst = max(worst, float(off / getattr(rays, f"{name}_error")[k]))
    assert 0.01 < worst <= 1


def bounds(cam):
    """A cast of a sphere around the eye."""
    passes = "position", "valid", "distance_bound", "position_bound"
    return cast(cam, shapes_of([(SPHERE, (0, 0, 0), RADIUS)]), passes=passes, dtype=np.float64, threads=1)
