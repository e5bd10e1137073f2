"""Error bounds of rays at the rim of a picture, where rays end or turn with the square root of a move."""

from fractions import Fraction

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import SPHERE

from ..cameras.model_examples import camera
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
        for row, column, place in rim(width, width + 1):
            if images["valid"][row, column]:
                count += 1
                error = np.linalg.norm(images["position"][row, column] - RADIUS * np.array(place))
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


def bounds(cam):
    """A cast of a sphere around the eye."""
    passes = "position", "valid", "distance_bound", "position_bound"
    return cast(cam, shapes_of([(SPHERE, (0, 0, 0), RADIUS)]), passes, np.float64, threads=1)
