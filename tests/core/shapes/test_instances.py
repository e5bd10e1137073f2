"""Shapes in their object's space, and their instances in the world."""

import numpy as np

from camera_ray_caster.core.mesh import Mesh
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE
from camera_ray_caster.core.shapes.instances import (
    Primitive,
    castable,
    enclosing_primitive,
    mesh_primitive,
    points_primitive,
    put_in_world,
)

from .test_recognize import ULP, turn


def test_the_bounds_of_any_vertices():
    vertices = np.array([(0, 0, 0), (4, 0, 0), (0, 2, 0), (0, 0, 6)], np.float32)
    ball = enclosing_primitive(SPHERE, vertices)
    np.testing.assert_array_equal(ball.centers, [(2, 1, 3)])
    np.testing.assert_allclose(ball.axes, np.sqrt(14) * np.eye(3), rtol=ULP)
    plane = enclosing_primitive(PLANE, vertices)
    np.testing.assert_array_equal(plane.centers, [(2, 1, 1.5)])
    np.testing.assert_array_equal(plane.axes, np.diag([2, 1, 1]))
    np.testing.assert_array_equal(enclosing_primitive(INFINITE_PLANE, vertices).axes, np.eye(3))


def test_the_bounds_of_vertices_whose_squares_float32_cannot_hold():
    ball = enclosing_primitive(SPHERE, np.array([(-3e38, 0, 0), (3e38, 0, 0)], np.float32))
    np.testing.assert_allclose(ball.axes, np.float32(3e38) * np.eye(3), rtol=ULP)


def test_points_without_a_radius_are_no_spheres():
    positions = np.array([(0, 0, 0), (1, 0, 0), (2, 0, 0), (np.nan, 0, 0)], np.float32)
    primitive = points_primitive(positions, np.array([1, 0, np.inf, 1], np.float32), np.arange(4))
    np.testing.assert_array_equal(primitive.centers, [(0, 0, 0)])


def test_placing_is_the_matrix_instance_by_instance():
    random = np.random.default_rng(5)
    primitive = Primitive(SPHERE, random.normal(size=(3, 3)), np.diag([1.0, 2.0, 3.0]), np.array([1.0, 2.0, 0.5]))
    matrices = random.normal(size=(2, 3, 4))
    centers, axes = np.empty((6, 3)), np.empty((6, 3, 3))
    put_in_world(primitive, matrices, centers, axes)
    for row, (matrix, k) in enumerate((m, k) for m in matrices for k in range(3)):
        at = np.eye(4)
        at[:3] = matrix
        local = np.eye(4)
        local[:3, :3], local[:3, 3] = primitive.sizes[k] * primitive.axes, primitive.centers[k]
        expected = at @ local
        np.testing.assert_allclose(centers[row], expected[:3, 3], rtol=1e-14, atol=1e-14)
        np.testing.assert_allclose(axes[row], expected[:3, :3], rtol=1e-14, atol=1e-14)


def test_matrices_that_span_no_space_are_told_from_thin_ones():
    unit = Primitive(SPHERE, np.zeros((1, 3)), np.eye(3), np.ones(1))
    flat_and_turned = np.float32(turn()) @ np.diag(np.float32([1, 0, 1])) @ np.float32(turn(0.3))
    linear = [np.diag([1e-12, 1.0, 1e12]), np.diag([1.0, 0.0, 1.0]), flat_and_turned, np.full((3, 3), np.nan)]
    matrices = np.array([np.c_[matrix, np.zeros(3)] for matrix in linear])
    assert castable([(unit, matrices)])[0].tolist() == [True, False, False, False]
    matrices[0, 0, 3] = np.inf
    assert not castable([(unit, matrices)])[0][0]


def test_a_mesh_is_placed_by_its_middle_and_may_be_flat():
    random = np.random.default_rng(6)
    mesh = Mesh(random.normal(size=(3, 5)).astype(np.float32), np.array([[0], [1], [2]]), np.zeros(1, np.int32))
    primitive = mesh_primitive(mesh)
    matrices = random.normal(size=(3, 3, 4))
    matrices[1, :, 1] = 0
    matrices[2, 0, 3] = np.nan
    assert castable([(primitive, matrices)])[0].tolist() == [True, True, False]
    centers, axes = np.empty((2, 3)), np.empty((2, 3, 3))
    put_in_world(primitive, matrices[:2], centers, axes)
    for matrix, center, columns in zip(matrices, centers, axes, strict=False):
        placed = center[:, None] + columns @ (mesh.vertices - mesh.middle[:, None])
        np.testing.assert_allclose(placed, matrix[:, :3] @ mesh.vertices + matrix[:, 3:], atol=1e-14)


def test_matrices_of_several_primitives_are_told_apart():
    ball = Primitive(SPHERE, np.zeros((1, 3)), np.diag([1.0, 1.0, 2.0]), np.ones(1))
    mesh = mesh_primitive(Mesh(np.eye(3, dtype=np.float32), np.array([[0], [1], [2]]), np.zeros(1, np.int32)))
    round_, flat = (np.c_[np.diag(sizes), np.zeros(3)] for sizes in ((1.0, 1.0, 1.0), (1.0, 0.0, 1.0)))
    placed = [(ball, np.array([round_, flat, round_])), (mesh, np.array([flat])), (ball, np.array([flat]))]
    assert [each.tolist() for each in castable(placed)] == [[True, False, True], [True], [False]]
    assert castable([]) == []
