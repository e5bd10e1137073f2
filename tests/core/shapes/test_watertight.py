"""No ray falls between the triangles of a surface: sheets and balls whose edges and corners lie on rays."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast

from ..casting.test_cast import camera_at, pose
from .meshes import ball, grid, mesh_of, shapes_of
from .test_mesh import examples


@pytest.mark.parametrize("key", [model.key for model in MODELS])
def test_every_ray_from_within_a_closed_surface_meets_it(key):
    """A ball of uneven triangles around all origins, and one whose corners are seen through pixel centers."""
    rng = np.random.default_rng(8)
    for cam in examples(key):
        rays = cam.rays()
        origins = np.broadcast_to(rays.origins, rays.directions.shape)[rays.valid]
        radius = 2 + 4 * np.abs(origins).max()
        sphere = ball(16, 24, radius)
        uneven = mesh_of((sphere.vertices * rng.uniform(0.7, 1.3, sphere.vertices.shape[1])).T, sphere.triangles.T)
        seen = cast(cam, shapes_of((uneven, (0, 0, 0), 1.0)), passes=("face_index", "valid"))
        assert ((seen["face_index"] >= 0) == seen["valid"]).all()
        on_rays = origins + 2 * radius * rays.directions[rays.valid]
        fan = np.arange(len(on_rays) - 2)
        strip = mesh_of(on_rays[:600], np.stack((fan, fan + 1, fan + 2), axis=1)[:598])
        seen = cast(
            cam, shapes_of((sphere, (0, 0, 0), 1.5), (strip, strip.middle, 1.0)), passes=("face_index", "valid")
        )
        assert ((seen["face_index"] >= 0) == seen["valid"]).all()


def sheets(rng):
    """Sheets that cover the picture of a camera of 90 degrees and 64 x 64 pixels, at z = -4 or about there."""
    pitch = 4 * 2 / 64
    on_centers = grid(70, 70, lambda u, v: ((70 * u - 35 + 0.5) * pitch, (70 * v - 35 + 0.5) * pitch, -4 + 0 * u))
    finer = grid(210, 210, lambda u, v: ((70 * u - 35 + 0.5) * pitch, (70 * v - 35 + 0.5) * pitch, -4 + 0 * u))
    moved = on_centers.vertices + np.float32(rng.normal(size=on_centers.vertices.shape) * 0.02)
    fan = np.arange(1, 2001)
    around = 2 * np.pi * fan / 2000
    slivers = np.stack((9 * np.cos(around), 9 * np.sin(around), -4 + 0 * around), axis=1)
    center = [(0.5 * pitch, 0.5 * pitch, -4)]
    return {
        "corners on pixel centers": on_centers,
        "nine triangles a pixel": finer,
        "moved corners": mesh_of(moved.T, on_centers.triangles.T),
        "slivers": mesh_of(np.concatenate((center, slivers)), np.stack((0 * fan, fan, fan % 2000 + 1), axis=1)),
    }


@pytest.mark.parametrize("name", sheets(np.random.default_rng(0)))
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO", "PANO"])
def test_no_pixel_is_lost_in_a_sheet(name, kind):
    """Seen straight on, rolled, and by rays of a panorama."""
    rng = np.random.default_rng(1)
    sheet = sheets(rng)[name]
    turn = np.array([[np.cos(0.3), -np.sin(0.3), 0], [np.sin(0.3), np.cos(0.3), 0], [0, 0, 1]])
    for basis in (np.eye(3), turn):
        more = {
            "PANO": {"settings": {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_lens": 10.5, "fisheye_fov": 3.0}}
        }.get(kind, {})
        cam = camera_at(pose(basis, (0, 0, 0)), type=kind, ortho_scale=8.0, resolution_x=64, resolution_y=64, **more)
        images = cast(
            cam,
            shapes_of((sheet, sheet.middle, 1.0)),
            passes=("face_index", "ray_direction", "ray_origin"),
            dtype=np.float64,
        )
        ahead = -images["ray_direction"][..., 2:]
        crossing = images["ray_origin"] + 4 * images["ray_direction"] / np.where(ahead > 0.1, ahead, np.nan)
        covered = np.abs(crossing[..., :2]).max(axis=2) < 4.1
        assert covered.sum() > 300
        assert (images["face_index"][covered] >= 0).all()


@pytest.mark.parametrize("turn", [0.0, 0.3, 2.0])
def test_a_scene_of_any_size_has_the_same_picture(turn):
    """All numbers are scaled by powers of two, and so is every rounding; but an orthographic camera's lattice counts in
    units, so that in small scenes it leaves more pixels to the exact test, which has to find the same hits.
    """
    rng = np.random.default_rng(2)
    rolled = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    round_one = ball(40, 60)
    uneven = (round_one.vertices * rng.uniform(0.7, 1.3, round_one.vertices.shape[1])).T
    pictures = []
    for size in (1.0, 2.0**-13, 2.0**-17):
        mesh = mesh_of(uneven * np.float32(size), round_one.triangles.T)
        cam = camera_at(pose(rolled, (0, 0, 8 * size)), type="ORTHO", ortho_scale=3 * size, resolution_x=150,
                        resolution_y=150, clip_start=size / 64)  # fmt: skip
        images = cast(cam, shapes_of((mesh, mesh.middle, 1.0)), passes=("depth", "face_index"), dtype=np.float64)
        pictures.append((images["depth"] / size, images["face_index"]))
    for depth, face in pictures[1:]:
        np.testing.assert_array_equal(face, pictures[0][1])
        np.testing.assert_array_equal(depth, pictures[0][0])
