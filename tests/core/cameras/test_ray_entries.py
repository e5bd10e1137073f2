"""Tables of rays without interpolation: each pixel has the ray of its entry."""

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
    shapes = crc.join(crc.spheres([(0, 0, -4)], 1.0), crc.mesh([(-3, -3, -6), (3, -3, -6), (0, 3, -6)], [(0, 1, 2)]))
    images = crc.cast(cam, shapes, passes=("distance", "shape_index"), dtype=np.float64)
    others = crc.cast_rays(rays.origins, rays.directions, shapes, passes=("distance", "shape_index"), dtype=np.float64)
    assert set(np.unique(images["shape_index"])) == {-1, 0, 1}
    for name, image in images.items():
        np.testing.assert_array_equal(image, others[name])
    with pytest.raises(crc.InputError, match="single beams"):
        crc.cast(cam, shapes, passes="solid_angle")


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
