"""A shape as a camera sees it lies inside its bounding sphere: what lies outside is culled."""

import numpy as np
import pytest

from camera_ray_caster.core.camera.camera import Pose
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.records import PLANE, SPHERE, Shapes
from camera_ray_caster.core.shapes.in_camera import in_camera

RNG = np.random.default_rng(12)
SQUARE = np.array([(x, y, 0.0) for x in (-1, 1) for y in (-1, 1)])
BALL = RNG.normal(size=(500, 3))
BALL /= np.linalg.norm(BALL, axis=1, keepdims=True)


@pytest.mark.parametrize(("kind", "surface"), [(PLANE, SQUARE), (SPHERE, BALL)])
@pytest.mark.parametrize("skew", [0.0, 1.0, 20.0])
def test_the_bounding_sphere_holds_the_shape_however_skewed(kind, surface, skew):
    n = 40
    axes = RNG.normal(size=(n, 3, 3)) + skew * RNG.normal(size=(n, 3, 1))  # the more skew, the more alike the axes
    center = RNG.normal(size=(n, 3))
    none = np.zeros(n, np.int32)
    shapes = Shapes(np.full(n, kind, np.uint8), center, axes, none, none, np.ones((n, 4), np.float32), none, ("x",))
    pose = Pose(np.array([3.0, 1.0, 2.0]), np.array([[1, 0.6, 0], [0, 0.8, 0.6], [0, 0, 0.8]]))
    placed = in_camera(shapes, pose)
    world = center[:, None] + np.einsum("nij,mj->nmi", axes, surface)
    away = np.linalg.norm((world - pose.eye) @ np.linalg.inv(pose.basis).T - placed.center[:, None], axis=-1)
    assert (away <= placed.radius[:, None] * (1 + 64 * EPS)).all()
    assert (away.max(axis=1) > placed.radius / 2).all()


def test_the_bounding_sphere_of_a_ball_is_the_ball():
    turned = np.linalg.qr(RNG.normal(size=(50, 3, 3)))[0]
    radius = 10.0 ** RNG.uniform(-6, 6, 50)
    none = np.zeros(50, np.int32)
    shapes = Shapes(
        np.full(50, SPHERE, np.uint8), np.zeros((50, 3)), turned * radius[:, None, None], none, none,
        np.ones((50, 4), np.float32), none, ("x",),
    )  # fmt: skip
    placed = in_camera(shapes, Pose(np.zeros(3), np.eye(3)))
    assert placed.radius == pytest.approx(radius, rel=1e-8)  # MARGIN is 1e-9
    assert (placed.radius >= radius).all()
