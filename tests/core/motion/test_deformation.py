"""Meshes that change their form between evaluations, against the form that they have."""

from dataclasses import replace

import numpy as np

from camera_ray_caster.core.maths.rotations import polar
from camera_ray_caster.core.mesh import Mesh
from camera_ray_caster.core.motion.evaluations import measured, resolve

from ..casting.test_cast import camera_at
from ..shapes.meshes import ball, grid, shapes_of

CAMERA = camera_at(resolution_x=200, resolution_y=200)
SPHERE = ball(12, 16)


def swelling(frame: float) -> Mesh:
    """A ball that swells to one side, so that the middle of its box moves, too."""
    swell = 1 + 0.3 * np.sin(frame / 4) * (SPHERE.vertices[0] > 0.1)
    return replace(SPHERE, vertices=SPHERE.vertices * swell)


def scene(frame: float):
    """Camera and shapes: the ball, moving and turning, before a wall that stands still."""
    mesh = swelling(frame)
    turn = frame / 10
    axes = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])
    center = np.array([0.1 * frame - 0.5, 0, -4])
    wall = grid(1, 1, lambda u, v: (8 * u - 4, 8 * v - 4, 0 * u))
    return CAMERA, shapes_of((mesh, center + axes @ mesh.middle, axes), (wall, (0, 0, -7), 1.0))


def test_vertices_between_evaluations_keep_the_tolerance():
    """In pixels, at frames that were never evaluated; the wall stays the mesh that it is."""
    motion = resolve(scene, 0.0, 12.0, 0.05, 200)
    assert not motion.unresolved
    assert 10 < len(motion.states) < 60
    frames = np.linspace(0.1, 11.9, 29)
    off = measured(motion, scene, frames).measured
    assert 1e-9 < off <= 0.05
    for frame in frames[::7]:
        between, (_, true) = motion.shapes_at(frame), scene(frame)
        places = [shapes.axes[0] @ (mesh.vertices - mesh.middle[:, None]) + shapes.center[0][:, None]
                  for shapes, mesh in ((between, between.meshes[0]), (true, true.meshes[0]))]  # fmt: skip
        there, here = (CAMERA.project(vertices.T) for vertices in places)
        assert np.abs(there - here).max() <= 0.05
        assert between.center[1].tolist() == [0, 0, -7]


def test_a_mesh_between_evaluations_stays_in_the_space_of_its_object():
    """So that textures by object coordinates stay in place, whatever the middle of the mesh."""
    square = np.array([[1.0, 3, 3, 1], [1, 1, 3, 3], [0, 0, 0, 0]])
    flat = Mesh(square, np.array([[0, 0], [1, 2], [2, 3]], np.int32), np.zeros(2, np.int32))

    def growing(frame):
        mesh = replace(flat, vertices=square + [[0.0], [frame], [0.0]] * (square > 2))
        return CAMERA, shapes_of((mesh, mesh.middle, 1.0))

    then = resolve(growing, 0.0, 1.0, 0.1, 20).shapes_at(0.3)
    np.testing.assert_allclose(then.meshes[0].vertices[1], [1, 1, 3.3, 3.3], atol=1e-14)
    np.testing.assert_allclose(then.center[0], [2, 2.15, 0], atol=1e-14)


def test_a_mesh_of_other_triangles_is_another_one():
    """Each frame has its own: between them the first stands still, and the interval in which it changes is short."""

    def changing(frame):
        return CAMERA, shapes_of((ball(6, 8 if frame < 5.3 else 9), (0, 0, -4), 1.0))

    motion = resolve(changing, 5.0, 6.0, 0.1, 200)
    assert not motion.unresolved
    assert len(motion.shapes_at(5.29).meshes[0]) == len(ball(6, 8))
    assert len(motion.shapes_at(5.31).meshes[0]) == len(ball(6, 9))


def test_flat_matrices_turn_as_others_do():
    """The rotation of a flattened object is proper, and its stretch not mirrored, whatever signs the SVD finds."""
    rng = np.random.default_rng(4)
    turns = np.linalg.qr(rng.normal(size=(200, 3, 3)))[0]
    turns[np.linalg.det(turns) < 0, 0] *= -1
    rotation, stretch = polar(turns @ np.diag([2.0, 3.0, 0.0]))
    np.testing.assert_allclose(rotation, turns, atol=1e-14)
    np.testing.assert_allclose(stretch, np.tile(np.diag([2.0, 3.0, 0.0]), (200, 1, 1)), atol=1e-14)
