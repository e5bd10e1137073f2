"""A pixel of a mesh does not depend on what else is cast with it."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast

from ..casting.test_cast import camera_at
from .meshes import ball, grid, shapes_of, soup


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_a_pixel_is_the_same_in_every_part_of_the_picture(kind):
    """To the last bit, with another part of the meshes in view and whichever way finds a hit; a sheet is there twice,
    so that every hit on it is tied with one on another face.
    """
    rng = np.random.default_rng(8)
    sheet = grid(9, 11, lambda u, v: (2 * u - 1 + 0.03 * np.sin(40 * v), v - 0.5, 0.4 * np.sin(9 * u + 5 * v)))
    twice = replace(
        sheet,
        triangles=np.tile(sheet.triangles, 2),
        polygon=np.arange(2 * len(sheet), dtype=np.int32),
    )
    tilt = np.array([[1, 0.3, 0], [-0.2, 1, 0.1], [0.1, 0, 2]])
    rows = (twice, (0.1, 0.1, -3), 1.5 * tilt), (soup(rng, 40), (0.2, 0, -4), 1.0), (ball(9, 14), (1, 0, -4), 0.8)
    shapes = shapes_of(*rows)
    size = {"type": kind, "ortho_scale": 4.0, "resolution_x": 240, "resolution_y": 160, "shift_x": 0.1}
    passes = "depth", "position", "normal", "face_index", "shape_index"
    whole = cast(camera_at(**size), shapes, passes=passes, dtype=np.float64)
    assert (whole["face_index"] >= 0).mean() > 0.2
    again = cast(camera_at(**size), shapes, passes=passes, dtype=np.float64, threads=1, cull=False)
    for name in passes:
        np.testing.assert_array_equal(again[name], whole[name], name)
    ends = np.sort(2 * rng.integers(0, (120, 80), (30, 2, 2)), axis=1)
    ends[:, 1] += 1
    for (x0, y0), (x1, y1) in (((0, 70), (240, 71)), ((91, 0), (92, 160)), *ends):
        border = {"border_min_x": x0, "border_max_x": x1, "border_min_y": y0, "border_max_y": y1}
        border = {name: value / (240 if name.endswith("x") else 160) for name, value in border.items()}
        cam = camera_at(**size, use_border=True, **border)
        alone = cast(cam, shapes, passes=passes, dtype=np.float64)
        rows, columns = (np.s_[a:b] for a, b in ((cam.raster.y0, cam.raster.y1), (cam.raster.x0, cam.raster.x1)))
        for name in passes:
            np.testing.assert_array_equal(alone[name], whole[name][rows, columns], name)
