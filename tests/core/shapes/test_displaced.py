"""Vertices that are displaced: by hand."""

from dataclasses import replace

import numpy as np

from camera_ray_caster.core.materials.values import OBJECT, UV, Coordinates, Layer, channel, constant
from camera_ray_caster.core.mesh import Mesh
from camera_ray_caster.core.shapes.mesh.displaced import Displacement, MeshNormals, displaced

SQUARE = Mesh(
    vertices=np.array([[0, 2, 2, 0], [0, 0, 2, 2], [1, 1, 1, 1]], np.float32),
    triangles=np.array([[0, 0], [1, 2], [2, 3]], np.int32),
    polygon=np.array([0, 0], np.int32),
    loops=np.array([[0, 0], [1, 2], [2, 3]], np.int32),
    uv=np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32),
    layers=(("color:Height", np.full((3, 2, 4), 0.25, np.float32)),),
)
"""Two triangles of one face that looks up."""

UP = np.repeat([[0.0], [0.0], [1.0]], 4, axis=1).astype(np.float32)
FLAT, SMOOTH = (MeshNormals(np.full(2, smooth), UP) for smooth in (False, True))


def test_vertices_move_along_normals_by_map_attribute_and_place():
    for height, expected in (
        (constant(0.5), [1.5, 1.5, 1.5, 1.5]),
        (channel(Coordinates(UV), 0), [1, 2, 2, 1]),
        (channel(Coordinates(OBJECT), 1), [1, 1, 3, 3]),
        (channel(Layer("color:Height", 4), 0), [1.25] * 4),
        (channel(Layer("color:None", 4), 0), [1] * 4),
    ):
        moved = displaced(SQUARE, FLAT, [Displacement(height, True)])
        np.testing.assert_array_equal(moved.vertices[2], np.float32(expected))
        np.testing.assert_array_equal(moved.vertices[:2], SQUARE.vertices[:2])
        assert moved.normals is None


def test_only_triangles_of_the_material_move():
    two = replace(SQUARE, slot=np.array([0, 1], np.int16))
    moved = displaced(two, FLAT, [None, Displacement(constant(1.0), True)])
    np.testing.assert_array_equal(moved.vertices[2], np.float32([2, 1, 2, 2]))


def test_normals_are_the_mean_of_the_faces_around_or_kept():
    """One corner is lifted by 2: the triangle that has it leans, the other stays level."""
    height = Layer("color:Height", 4)
    lifted = np.zeros((3, 2, 4), np.float32)
    lifted[2, 1] = 2
    mesh = replace(SQUARE, layers=(("color:Height", lifted),))
    turned = displaced(mesh, SMOOTH, [Displacement(channel(height, 0), True)])
    leaning = np.array([1, -1, 1]) / np.sqrt(3)
    mean = leaning + np.array([0, 0, 1])
    mean /= np.linalg.norm(mean)
    at = turned.normals[turned.loops]  # corner, triangle, axis
    np.testing.assert_allclose(at[:, 0], [mean, (0, 0, 1), mean], atol=1e-7)
    np.testing.assert_allclose(at[:, 1], [mean, mean, leaning], atol=1e-7)
    np.testing.assert_array_equal(turned.uv[turned.loops], mesh.uv[mesh.loops])
    kept = displaced(mesh, SMOOTH, [Displacement(channel(height, 0), False)])
    np.testing.assert_array_equal(kept.normals[kept.loops], np.broadcast_to([0, 0, 1], (3, 2, 3)))
    mixed = displaced(mesh, MeshNormals(np.array([True, False]), UP), [Displacement(channel(height, 0), True)])
    np.testing.assert_allclose(mixed.normals[mixed.loops][:, 1], [leaning] * 3, atol=1e-7)


def test_heights_that_are_no_numbers_move_nothing():
    for height in (np.nan, np.inf, 1e300):
        values = np.full((3, 2, 4), height)
        mesh = replace(SQUARE, layers=(("color:Height", values),))
        moved = displaced(mesh, SMOOTH, [Displacement(channel(Layer("color:Height", 4), 0), True)])
        np.testing.assert_array_equal(moved.vertices, SQUARE.vertices)


def test_flat_faces_move_along_the_normals_of_their_vertices():
    aslant = np.repeat([[0.6], [0.0], [0.8]], 4, axis=1).astype(np.float32)
    moved = displaced(SQUARE, MeshNormals(np.zeros(2, bool), aslant), [Displacement(constant(0.5), True)])
    np.testing.assert_allclose(moved.vertices - SQUARE.vertices, aslant / 2, atol=1e-7)


def test_vectors_move_any_way():
    moved = displaced(SQUARE, FLAT, [Displacement(constant(1, 2, 3), True)])
    np.testing.assert_array_equal(moved.vertices - SQUARE.vertices, np.repeat([[1], [2], [3]], 4, axis=1))
