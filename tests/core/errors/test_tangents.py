"""Rays that touch a sphere: hit or miss is open within a bound that is stated, and decided beyond it."""

import numpy as np

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import SPHERE
from camera_ray_caster.core.shapes.in_camera import in_camera

from ..cameras.model_examples import camera
from .decisions import decision
from .extreme_cases import shapes_of

ALONG_MINUS_X = [[0, 0, 1, 4], [0, 1, 0, -2], [-1, 0, 0, 5], [0, 0, 0, 1]]
"""A camera at (4, -2, 5) that looks along -x; y is to its up side."""

BESIDE = 1e-12
"""Fraction of the radius by which a ray may pass inside or outside, and is decided."""


def touched(center, radius):
    """Whether the ray through the middle pixel hits, the value that decides it, and its bound."""
    cam = camera("PERSP", {"matrix_world": ALONG_MINUS_X, "resolution_x": 1, "resolution_y": 1})
    shapes = shapes_of([(SPHERE, center, radius)])
    value, bound = decision(cam, in_camera(shapes, cam.pose), 0, np.array([0.5]), np.array([0.5]))
    hit = np.isfinite(cast(cam, shapes, passes=("distance",))["distance"]).item()
    return hit, value.item(), bound.item()


def test_a_tangent_is_open_and_what_is_beside_it_is_not():
    """Centers and radii are whole numbers: the ray touches the sphere exactly, 6 away for the first."""
    for away, radius, side in [(6, 7, -1), *((a, r, s) for a in range(1, 9, 2) for r in (1, 3, 7) for s in (1, -1))]:
        center = (4 - away, -2 + side * radius, 5)
        _, value, bound = touched(center, float(radius))
        assert abs(value) <= bound
        assert bound <= 1e-13
        for factor, hits in ((1 + BESIDE, True), (1 - BESIDE, False)):
            hit, value, bound = touched(center, radius * factor)
            assert hit == hits == (value > bound)
            assert abs(value) > bound
