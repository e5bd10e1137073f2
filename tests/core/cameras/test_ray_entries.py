"""Tables of rays behind microlenses: without interpolation, and interpolated within blocks."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.conventions import EPS

from .table_examples import pinhole, stacked


def microlenses(rows=5, columns=6, pixels=8):
    """Origins and directions of pixels behind small lenses: rays jump from lens to lens."""
    j, i = np.mgrid[: rows * pixels, : columns * pixels]
    origins = stacked(0.01 * (i // pixels), 0.01 * (j // pixels), 0.0)
    return origins, stacked(0.08 * (i % pixels - pixels / 2 + 0.5), 0.08 * (j % pixels - pixels / 2 + 0.5), -1.0)


def test_without_interpolation_each_pixel_has_its_own_ray_and_no_other():
    """Behind microlenses, which other tables would blend or refuse; a hole stays one; casts are those of the rays."""
    origins, directions = microlenses()
    directions[3, 4] = np.nan
    table = {"ray_directions": directions, "ray_origins": origins, "ray_interpolation": "NONE"}
    cam = crc.camera("RAY_TABLE", (48, 40), **table)
    rays = cam.rays()
    unit = directions / np.linalg.norm(directions, axis=2, keepdims=True)
    np.testing.assert_allclose(rays.directions, unit, rtol=0, atol=2 * EPS)
    np.testing.assert_array_equal(rays.origins[rays.valid], origins[rays.valid])
    x, y = np.broadcast_arrays(cam.raster.columns(), cam.raster.rows())
    moved = cam.rays_at(x + 0.4, y - 0.4)
    np.testing.assert_array_equal(moved.directions, rays.directions)
    back = cam.project(rays.origins + 3.7 * rays.directions)
    np.testing.assert_array_equal(back[rays.valid], np.stack((x, y), axis=-1)[rays.valid])
    assert np.isnan(cam.project([(0, 0, 1.0), (9.0, 0, -1.0)])).all()  # behind, and beyond all rays
    _is_cast_as(rays, cam)
    with pytest.raises(crc.InputError, match="single beams"):
        crc.cast(cam, crc.spheres([(0, 0, -4)], 1.0), passes="solid_angle")


def test_without_interpolation_neighbors_of_one_eye_may_look_anywhere():
    """A point between the rays of neighbors is seen by the nearest, and a picture twice as large has each ray 4 times.
    """
    table = pinhole(12, 9)[::-1]  # folded, but for the order of its rows
    table[:, ::2] = table[:, ::2][:, ::-1]
    cam = crc.camera("RAY_TABLE", (24, 18), ray_directions=table, ray_interpolation="NONE")
    unit = table / np.linalg.norm(table, axis=2, keepdims=True)
    np.testing.assert_allclose(cam.rays().directions, unit.repeat(2, axis=0).repeat(2, axis=1), rtol=0, atol=2 * EPS)
    np.testing.assert_array_equal(cam.project(5 * table[4, 3] + (0.01, 0.02, 0)), (7, 9))
    images = crc.cast(cam, crc.spheres([(0, 0, -4)], 1.0), passes="shape_index")
    whole = crc.cast(cam, crc.spheres([(0, 0, -4)], 1.0), passes="shape_index", cull=False)
    np.testing.assert_array_equal(images["shape_index"], whole["shape_index"])


@pytest.mark.parametrize("kind", ["CUBIC", "LINEAR"])
def test_a_block_has_the_rays_of_a_table_of_its_own_and_points_lead_back(kind):
    """A point that several lenses see leads back to a pixel whose ray meets it. A lens and a half have no rays."""
    origins, directions = microlenses()
    directions[:8, :8], directions[8:16, 4:8] = np.nan, np.nan
    table = {"ray_origins": origins, "ray_directions": directions, "ray_interpolation": kind}
    cam = crc.camera("RAY_TABLE", (96, 80), **table, ray_block_columns=8, ray_block_rows=8)
    rays = cam.rays()
    for row, column in ((1, 0), (2, 3), (4, 5)):
        entries, pixels = (np.s_[row * n : row * n + n, column * n : column * n + n] for n in (8, 16))
        alone = crc.camera("RAY_TABLE", (16, 16), ray_interpolation=kind, ray_origins=origins[entries],
                           ray_directions=directions[entries]).rays()  # fmt: skip
        np.testing.assert_array_equal(rays.valid[pixels], alone.valid)
        np.testing.assert_allclose(rays.directions[pixels], alone.directions, rtol=0, atol=8 * EPS)
        np.testing.assert_allclose(rays.origins[pixels], alone.origins, rtol=0, atol=EPS)
    assert not rays.valid[:16, :16].any()
    assert rays.valid.sum() == 96 * 80 - 16 * 16 - 16 * 8
    points = (rays.origins + 3.7 * rays.directions)[rays.valid]
    edge = cam.rays_at(np.array([16.0, 48.0, 95.9]), np.array([16.0, 48.0, 64.0]))
    points = np.concatenate((points, edge.origins + 2 * edge.directions))
    back = cam.rays_at(*cam.project(points).T)
    missed = np.linalg.norm(np.cross(points - back.origins, back.directions), axis=1)
    assert missed.max() < 64 * EPS * 5  # and none is NaN
    assert np.isnan(cam.project([(0, 0, 1.0), (9.0, 0, -1.0)])).all()  # behind, and beyond all rays
    _is_cast_as(rays, cam)


def _is_cast_as(rays, cam):
    """Hold a picture of a ball and a triangle against the casts of the camera's rays."""
    shapes = crc.join(crc.spheres([(0, 0, -4)], 1.0), crc.mesh([(-3, -3, -6), (3, -3, -6), (0, 3, -6)], [(0, 1, 2)]))
    images = crc.cast(cam, shapes, passes=("distance", "shape_index"), dtype=np.float64)
    others = crc.cast_rays(rays.origins, rays.directions, shapes, passes=("distance", "shape_index"), dtype=np.float64)
    assert set(np.unique(images["shape_index"])) == {-1, 0, 1}
    for name, image in images.items():
        np.testing.assert_array_equal(image, others[name])
