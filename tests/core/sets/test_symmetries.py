"""Symmetries and normals of BOP's models, judged by the transformations that BOP's toolkit makes of the entries."""

from itertools import product

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.sets.object_models import ObjectModel, model_of, ply
from camera_ray_caster.core.sets.symmetries import of_ellipsoid

CUBE = np.array(list(product((-1.0, 1.0), repeat=3)))
QUADS = np.array(((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)))


def triangles(quads=QUADS):
    return np.vstack((quads[:, :3], quads[:, (0, 2, 3)]))


def prism(fold, tip=False):
    """A prism about z from 0 to 3, or a cone."""
    angle = 2 * np.pi * np.arange(fold) / fold
    ring = np.stack((np.cos(angle), np.sin(angle), np.zeros(fold)), axis=1)
    k, after = np.arange(fold), (np.arange(fold) + 1) % fold
    bottom, top = np.full(fold, 2 * fold), np.full(fold, 2 * fold + 1)
    vertices = np.vstack((ring, ring * (1 - tip) + (0, 0, 3), (0, 0, 0), (0, 0, 3)))
    faces = [(k, after, fold + after), (k, fold + after, fold + k), (after, k, bottom), (fold + k, fold + after, top)]
    return vertices, np.vstack([np.stack(grid, axis=1) for grid in faces])


def transformations(info, steps=12):
    """What bop_toolkit_lib.misc.get_symmetry_transformations makes of an entry: products of both kinds."""
    discrete = [np.eye(4), *(np.reshape(matrix, (4, 4)) for matrix in info.get("symmetries_discrete", ()))]
    continuous = []
    for symmetry in info.get("symmetries_continuous", ()):
        x, y, z = symmetry["axis"]
        cross = np.array(((0, -z, y), (z, 0, -x), (-y, x, 0)))
        for k in range(1, steps):
            angle, move = 2 * np.pi * k / steps, np.eye(4)
            move[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
            move[:3, 3] = symmetry["offset"] - move[:3, :3] @ symmetry["offset"]
            continuous.append(move)
    return [a @ b for b in discrete for a in continuous or [np.eye(4)]]


def model(vertices, faces, colors=(0.5, 0.5, 0.5), kind=3):
    middle = (vertices.min(0) + vertices.max(0)) / 2
    return ObjectModel(vertices - middle, faces, np.broadcast_to(colors, vertices.shape).astype(float), kind)


RED = np.where(np.arange(8)[:, None] >= 4, (1.0, 0, 0), (0.0, 0, 1))
"""The half of a cube at x > 0 is red, the other blue."""
WEDGE = np.array(((0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3.0))), np.array(((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)))
MODELS = {
    "cube": (model(CUBE, triangles()), 23, []),
    "box": (model(CUBE * (1, 2, 3), triangles()), 3, []),
    "square bar": (model(CUBE * (1, 1, 3), triangles()), 7, []),
    "half red cube": (model(CUBE, triangles(), RED), 3, []),
    "open box": (model(CUBE, triangles(QUADS[:5])), 3, []),
    "wedge": (model(*WEDGE), 0, []),
    "triangle prism": (model(*prism(3)), 5, []),
    "pentagon pyramid": (model(*prism(5, True)), 4, []),
    "cylinder": (model(*prism(24)), 1, [(0, 0, 1)]),
    "cone": (model(*prism(24, True)), 0, [(0, 0, 1)]),
    "square": (model(np.array(((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0.0))), np.array(((0, 1, 2), (0, 2, 3))),
                     kind=1), 7, []),
}  # fmt: skip
"""A model, the number of its discrete symmetries, and the axes of the continuous ones."""


@pytest.mark.parametrize("name", MODELS)
def test_each_symmetry_of_the_toolkit_brings_the_model_upon_itself(name):
    made, count, axes = MODELS[name]
    symmetries = made.symmetries(1000.0)
    assert len(symmetries.get("symmetries_discrete", ())) == count
    assert [tuple(symmetry["axis"]) for symmetry in symmetries.get("symmetries_continuous", ())] == axes
    places = 1000 * made.vertices
    moves = transformations(symmetries)
    assert len(moves) == (count + 1) * (11 if axes else 1)
    for move in moves:
        moved = places @ move[:3, :3].T + move[:3, 3]
        apart = np.linalg.norm(moved[:, None] - places[None], axis=2).min(axis=1)
        assert apart.max() < 1e-9 * np.abs(places).max()
        assert np.linalg.det(move) == pytest.approx(1)
        if not axes:
            nearest = np.linalg.norm(moved[:, None] - places[None], axis=2).argmin(axis=1)
            np.testing.assert_array_equal(made.colors[nearest], made.colors)
    unique = {tuple(np.round(move, 6).ravel() + 0.0) for move in moves}
    assert len(unique) == len(moves)


def test_an_ellipsoid_turns_about_the_axis_whose_other_two_are_equal():
    for size, discrete, axes in (((2, 2, 2), 0, 3), ((2, 2, 5), 1, 1), ((5, 2, 2), 1, 1), ((1, 2, 3), 3, 0)):
        symmetries = of_ellipsoid(np.array(size, float))
        assert len(symmetries.get("symmetries_discrete", ())) == discrete
        assert len(symmetries.get("symmetries_continuous", ())) == axes
        stretch = np.diag((*(0.25 * np.square(size, dtype=float)), 1.0))  # x of the surface: x^T stretch^-1 x = 1
        for move in transformations(symmetries):
            np.testing.assert_allclose(move @ stretch @ move.T, stretch, atol=1e-12)


def test_normals_are_weighted_by_angles_not_by_triangles():
    """At a cube's corner three right angles meet, however its squares are cut."""
    made = model(CUBE, triangles())
    np.testing.assert_allclose(made.normals, CUBE / np.sqrt(3), atol=1e-15)
    uneven = ObjectModel(np.array(((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1.0))),
                   np.array(((0, 1, 2), (0, 3, 1), (3, 4, 1))), np.zeros((5, 3)), 3)  # fmt: skip
    up, ahead = np.array((0, 0, 1.0)), np.array((0, 1.0, 0))
    np.testing.assert_allclose(uneven.normals[0], (up * 90 + ahead * 90) / np.hypot(90, 90), atol=1e-15)
    np.testing.assert_allclose(uneven.normals[1], (up * 45 + ahead * 90) / np.hypot(45, 90), atol=1e-15)


def test_a_model_has_normals_and_the_colors_of_its_materials_and_what_has_no_area_no_normal():
    shapes = crc.mesh(CUBE, QUADS, color=(0.2, 0.5, 1.0), name="box")
    item = {"object": "box", "instance": 0, "size": [2, 2, 2]}
    made = model_of(shapes, item)
    head, _, body = ply(made, 1000.0).partition(b"end_header\n")
    names = [line.split()[-1] for line in head.decode().splitlines() if line.startswith("property")]
    assert names[:9] == ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"]
    kinds = [*((name, "<f4") for name in names[:6]), *((name, "u1") for name in names[6:9])]
    points = np.frombuffer(body, np.dtype(kinds), 8)
    assert points[0].tolist() == pytest.approx((-1000, -1000, -1000, *-np.ones(3) / 3**0.5, 124, 188, 255), rel=1e-6)
    flat = ObjectModel(np.zeros((3, 3)), np.array(((0, 1, 2),)), np.zeros((3, 3)), 3)
    assert (flat.normals == 0).all()
    assert flat.symmetries(1.0) == {}
