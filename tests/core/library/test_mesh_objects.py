"""Meshes of other libraries, with the colors of their vertices or faces; trimesh itself where it is installed."""

from types import SimpleNamespace

import numpy as np
import pytest

import camera_ray_caster as crc

VERTICES = np.array([(-1, -1, -3), (1, -1, -3), (1, 1, -3), (-1, 1, -3)], float)
FACES = np.array([(0, 1, 2), (0, 2, 3)])
FACE_COLORS = np.array([(255, 0, 0, 255), (0, 188, 0, 255)], np.uint8)
CAMERA = crc.camera("PERSP", (40, 40), lens=60.0)


def thing(**visual):
    return SimpleNamespace(vertices=VERTICES, faces=FACES, visual=SimpleNamespace(**visual))


def albedo(mesh, **keywords):
    return crc.cast(CAMERA, crc.mesh(mesh, **keywords), passes=("albedo",))["albedo"]


def test_faces_and_vertices_keep_their_colors():
    color = albedo(thing(kind="face", face_colors=FACE_COLORS))
    assert color[5, 30] == pytest.approx((1, 0, 0))
    assert color[30, 5] == pytest.approx((0, 0.5029, 0), abs=1e-4)  # 188 of 255 in sRGB
    ramp = np.array([(0, 0, 0), (1, 1, 1), (1, 1, 1), (0, 0, 0)], float)
    row = albedo(thing(vertex_colors=ramp))[20, :, 0]
    across = crc.cast(CAMERA, crc.mesh(VERTICES, FACES), passes=("position",))["position"][20, :, 0]
    np.testing.assert_allclose(row[4:36], ((across + 1) / 2)[4:36], atol=1e-6)
    assert albedo(thing(kind="face", face_colors=FACE_COLORS), color=(0, 0, 1))[5, 30] == pytest.approx((0, 0, 1))
    assert albedo(thing(kind=None, vertex_colors=ramp))[20, 20] == pytest.approx((0.8, 0.8, 0.8))


def test_what_is_transparent_is_no_hit():
    glass = FACE_COLORS.copy()
    glass[0, 3] = 0
    hit = crc.cast(CAMERA, crc.mesh(thing(kind="face", face_colors=glass)), passes=("shape_index",))["shape_index"]
    assert (hit[5, 30], hit[30, 5]) == (-1, 0)


def test_what_is_no_mesh_is_refused_in_one_line():
    with pytest.raises(crc.InputError, match="has no vertices and faces"):
        crc.mesh(VERTICES)
    with pytest.raises(crc.InputError, match=r"colors of the mesh are of shape \(1, 4\)"):
        crc.mesh(thing(kind="face", face_colors=FACE_COLORS[:1]))


def test_a_mesh_of_trimesh():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.Trimesh(VERTICES, FACES, process=False, face_colors=FACE_COLORS)
    np.testing.assert_array_equal(albedo(mesh), albedo(thing(kind="face", face_colors=FACE_COLORS)))
