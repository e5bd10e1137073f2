"""flow_hidden: rays that are aimed at points, in any order, and what never hides a point."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.casting import aimed
from camera_ray_caster.core.records import PLANE, SPHERE

from ..camera.test_pixel_time import turn
from ..cameras.model_examples import raw_of
from ..shapes import meshes
from .neighbors import with_others
from .test_cast import shapes_of
from .test_flow import cast, moved_matrix, moved_shapes


@pytest.mark.parametrize("key", ["PERSP", "FISHEYE_EQUIDISTANT", "CROSS_SLIT"])
def test_what_is_hidden_is_the_same_in_any_order_of_rays(key, monkeypatch):
    """By rows and columns of the own picture, or of the other one, also of a camera that has rolled."""
    rng = np.random.default_rng(7)
    size = {"resolution_x": 160, "resolution_y": 120}
    balls = [(meshes.ball(20, 30), place, 0.8) for place in rng.uniform((-3, -2, -8), (3, 2, -3), (12, 3))]
    shapes = meshes.shapes_of(*balls, (meshes.ball(4, 5), (0, 0, -30), 20.0))
    after = moved_shapes(shapes, rng)
    for roll in 0.0, 2.0:
        matrix = moved_matrix(np.eye(4))
        matrix[:3, :3] = matrix[:3, :3] @ turn(roll, 2)
        later = camera_from(raw_of(key, size | {"matrix_world": matrix}))
        scene = with_others(camera_from(raw_of(key, size)), shapes, later, after)
        hidden = []
        for width in np.inf, -np.inf:
            monkeypatch.setattr(aimed, "NARROW", width)
            hidden.append(cast(*scene, passes="flow_hidden")["flow_hidden"])
        assert hidden[0].any()
        assert (hidden[0] == hidden[1]).all()


GROWN = (-2.52e-4, -2.36e-4, 2.13e-4), (3.6e-5, 7.2e-5, 2.18e-4), (-1.5e-4, 2.84e-4, 2.28e-4)
"""Places of a ball at which the rounding of its point in the next frame is to its disadvantage."""


def test_a_ball_that_grows_does_not_hide_its_own_point_whatever_the_error_of_others():
    """A ball becomes a million times as large beside a wall with a screen before it: all points have a hit before them
    or near them, and the ball's error is the larger one by far.
    """
    camera = crc.camera("PERSP", (2, 1), np.eye(4))
    left, right = camera.rays().directions[0]
    for shift in GROWN:
        now = shapes_of((SPHERE, right * 5 + shift, 1e-3), (PLANE, left * 5, 0.5))
        center = right * 1205 + np.multiply(shift, 1e6)
        after = shapes_of((SPHERE, center, 1e3), (PLANE, left * 5, 0.5), (PLANE, left * 2.5, 0.2))
        images = cast(*with_others(camera, now, camera, after), passes=("flow_hidden", "shape_index"))
        assert images["shape_index"].tolist() == [[1, 0]]
        assert not images["flow_hidden"][0, 1, 0]
