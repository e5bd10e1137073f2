"""Blocks of triangles, and pictures as a whole: nothing that is seen is left out, and what is hidden costs little."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core import tuning
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.pixels import passes_at
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.shapes.mesh.mesh_in_camera import MeshesInView
from camera_ray_caster.core.shapes.windows import pixels_in

from ..cameras.model_examples import EXAMPLES, IDENTITY, camera
from ..cameras.table_examples import pinhole
from ..casting.test_cast import camera_at
from .meshes import ball, mesh_of, shapes_of, soup
from .test_mesh import SMALL, assert_nearest, each_model, examples


@pytest.mark.parametrize("key", ["PERSP", "RAY_TABLE"])
def test_meshes_pay_for_what_is_seen_of_them(key, monkeypatch):
    """A mesh out of the picture is not bounded. One behind another is not placed, and none of its triangles is looked
    at, from one eye or from many near each other. Small meshes would be looked at together.
    """
    monkeypatch.setattr(tuning, "CHUNK", 1 << 10)
    monkeypatch.setattr(tuning, "BALLS", 1 << 10)
    cam = camera_at(resolution_x=400, resolution_y=400)
    if key == "RAY_TABLE":
        rays = pinhole(20, 20, 0.7)
        table = {"ray_directions": rays, "ray_origins": 0.02 * rays, "matrix_world": IDENTITY}
        cam = camera(key, table | {"resolution_x": 400, "resolution_y": 400, "resolution_percentage": 100})
    front, apart = ball(40, 40), ball(9, 9)
    behind = ball(30, 30)
    shapes = shapes_of((front, (0, 0, -2), 1.0), (apart, (0, 50, -5), 1.0), (behind, (0.1, 0, -9), 0.5))
    looked_at, placed = Counter(), set()

    def place_blocks(self, blocks, rows):
        placed.update(blocks.tolist())
        return original_place(self, blocks, rows)

    def triangles(self, blocks):
        looked_at.update(np.repeat(self.blocks.shape[blocks], self.blocks.count[blocks]).tolist())
        return original_triangles(self, blocks)

    original_triangles, original_place = MeshesInView.triangles, MeshesInView._place
    monkeypatch.setattr(MeshesInView, "triangles", triangles)
    monkeypatch.setattr(MeshesInView, "_place", place_blocks)
    images = cast(cam, shapes, passes=("depth", "shape_index"))
    ((meshes,),) = ([blocks.meshes] for blocks in images.plan.sets)
    assert set(meshes.blocks.shape) == {0, 2}
    assert looked_at[0] > len(front) / 2
    assert looked_at[2] == 0
    assert placed == {0}
    assert set(np.unique(images["shape_index"])) == {-1, 0}
    assert EPS < images["depth"].min() < 2


@pytest.mark.parametrize("far", [0.0, 1e7])
@each_model
def test_blocks_leave_out_nothing_that_is_seen(key, far):
    """Triangles in random order, so that blocks hold neighbors and others; far from the world's origin, too, where
    vertices are rounded to 1e-9.
    """
    rng = np.random.default_rng(5)
    mesh = ball(12, 20)
    mixed = replace(mesh, triangles=mesh.triangles[:, rng.permutation(len(mesh))].copy())
    matrix = np.eye(4)
    matrix[:3, 3] = far
    flat = np.diag([1, -0.5, 0])
    shapes = shapes_of((mesh, (far + 0.5, far, far - 3), 1.2), (mixed, (far - 0.5, far, far - 2), flat))
    for settings in EXAMPLES[key]:
        cam = camera(key, settings | SMALL | {"matrix_world": matrix})
        if cam.pixel_time is not None:
            continue
        seen, everywhere = (
            cast(cam, shapes, passes=("shape_index", "face_index"), cull=cull) for cull in (True, False)
        )
        for name, image in seen.items():
            np.testing.assert_array_equal(image, everywhere[name])


@pytest.mark.parametrize("key", ["OPENCV_PINHOLE", "OPENCV_FISHEYE", "EQUIRECTANGULAR", "PUSHBROOM", "CROSS_SLIT"])
def test_bounds_of_wide_triangles_are_those_of_their_quarters(key, monkeypatch):
    """They have fewer pixels, and leave out nothing that brute force sees. The triangles are large, long and thin."""
    random = np.random.default_rng(8)
    corners = random.normal(size=(12, 1, 3)) * 2 + random.normal(size=(12, 3, 3)) * random.uniform(0, 4, (12, 1, 3))
    shapes = shapes_of((mesh_of(corners.reshape(-1, 3), np.arange(36).reshape(-1, 3)), (0.0, 0.0, -2.0), 1.0))
    pixels = []

    def triangles(self, blocks):
        bounded = original(self, blocks)
        pixels[-1] += pixels_in(bounded.bounds.astype(int)).sum()
        return bounded

    original = MeshesInView.triangles
    monkeypatch.setattr(MeshesInView, "triangles", triangles)
    for wide in (1 << 20, 4):
        monkeypatch.setattr(tuning, "HALVED_PIXELS", wide)
        pixels.append(0)
        for cam in examples(key):
            assert_nearest(cam, shapes)
    assert 0 < pixels[1] < 0.9 * pixels[0], pixels


def test_no_quarter_of_a_wide_triangle_is_left_out(monkeypatch):
    """A narrow camera looks into the middle of each quarter's quarters: it meets the balls of few others."""
    monkeypatch.setattr(tuning, "HALVED_PIXELS", 4)
    monkeypatch.setattr(tuning, "HALVINGS", 2)
    corners = np.array(((-2.0, -1.75, 0.0), (2.0, -1.5, 0.0), (0.2, 1.75, 0.0)))  # their box has its middle at 0
    shapes = shapes_of((mesh_of(corners, np.array([[0, 1, 2]])), (0.0, 0.0, 0.0), 1.0))
    middles = [np.array((i + third, j + third, 4 - i - j - 2 * third)) / 4 @ corners
               for third in (1 / 3, 2 / 3) for i in range(4) for j in range(4) if i + j + 2 * third < 4]  # fmt: skip
    assert len(middles) == 16
    for middle in middles:
        pose = np.eye(4)
        pose[:3, 3] = *middle[:2], 1.0
        cam = crc.camera("OPENCV_FISHEYE", (12, 8), pose, fx=800.0, fy=800.0)
        assert (cast(cam, shapes, passes="shape_index")["shape_index"] == 0).all()


@each_model
def test_pictures_whose_rays_are_polynomials_show_what_single_pixels_show(key):
    """Such pictures have at least 36 x 256 pixels; single pixels take the formula."""
    shapes = shapes_of((ball(9, 12), (0.5, 0, -3), 1.2), (soup(np.random.default_rng(3), 60), (0.3, -0.2, -2), 1.5))
    for settings in EXAMPLES[key]:
        frame = {"resolution_x": 320, "resolution_y": 180, "resolution_percentage": 100, "use_border": False}
        cam = camera(key, settings | frame)
        if cam.pixel_time is not None:
            continue
        whole = cast(cam, shapes, passes=("depth", "face_index"), dtype=np.float64)
        columns, rows = np.arange(3, 320, 29), np.arange(5, 180, 17)
        some = passes_at(cam, shapes, columns, rows, ("depth", "face_index", "distance_bound"))
        at = np.ix_(rows, columns)
        same = some["face_index"] == whole["face_index"][at]
        assert same.mean() > 0.99  # rounding may decide otherwise at an edge
        met = same & np.isfinite(some["depth"])
        error = np.abs(some["depth"][met] - whole["depth"][at][met])
        assert (error <= 2 * some["distance_bound"][met]).all()
