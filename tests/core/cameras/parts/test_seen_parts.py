"""Bounds that follow from a formula; that they hold all that is seen is a test of the contract."""

from functools import partial

import numpy as np
import pytest

from camera_ray_caster.core.cameras.model import Model
from camera_ray_caster.core.cameras.parts.seen_parts import SeenParts

from ..model_examples import IDENTITY, camera
from ..test_model import inner_pixels


@pytest.mark.parametrize("key", ["PERSP", "EQUIRECTANGULAR", "CYLINDRICAL", "CROSS_SLIT", "RAY_TABLE"])
def test_bounds_of_a_formula_are_not_much_wider_than_what_is_seen(key):
    """By a few parts of a 288th of the picture, for small balls; with many eyes by a tenth."""
    cam = camera(key, {"resolution_x": 576, "resolution_y": 324, "matrix_world": IDENTITY})
    bounds = cam.model.bounds if key == "RAY_TABLE" else partial(Model.bounds, cam.model)
    x, y = inner_pixels(cam)
    rays = cam.rays_at(x, y)
    x0, x1, y0, y1 = bounds(rays.origins + 20 * rays.directions, np.full(len(x), 0.01)).T
    most = 20 if cam.model.central else 60
    assert np.median(x1 - x0) < most
    assert np.median(y1 - y0) < most


@pytest.mark.parametrize("components", [3, 6])
def test_a_ball_of_an_unknown_place_may_be_anywhere(components):
    """Rays of two parts, from one eye or each from its own: (direction[, origin])."""
    low = np.array([[(-0.5, -0.5, -1.0, 0, 0, 0), (0.0, 0.5, -1.0, 1, 0, 0)]])[..., :components]
    parts = SeenParts(low, low + 0.01, np.array([[(0, 8, 0, 8), (8, 16, 0, 8)]]))
    bounds = parts.bounds(np.array(((np.nan,) * 3, (-0.495, -0.495, -1.0))), np.array((1e-5, 1e-5)))
    assert bounds[0].tolist() == [0, 16, 0, 8]
    assert bounds[1].tolist() == [0, 8, 0, 8]
