"""The pixels within bounds that have a ray, against a loop."""

import numpy as np

from camera_ray_caster.core.shapes.search_rays import Present


def test_each_window_has_its_rays_row_by_row_and_nothing_else():
    random = np.random.default_rng(7)
    shape = 11, 17
    x = np.where(random.random(shape) < 0.4, random.random(shape), np.nan)
    bounds = np.sort(random.integers(0, 12, (40, 2, 2)), axis=2).reshape(-1, 4)  # some are empty
    there = Present((x, 0.0, -1.0), shape)
    pixels, which = there.within(bounds)
    expected = [
        (row * shape[1] + column, k)
        for k, (x0, x1, y0, y1) in enumerate(bounds.tolist())
        for row in range(y0, y1)
        for column in range(x0, x1)
        if not np.isnan(x[row, column])
    ]
    assert list(zip(pixels.tolist(), which.tolist(), strict=True)) == expected
    assert len(set(which.tolist())) > 20


def test_rays_that_broadcast_are_there_everywhere():
    there = Present((np.zeros((1, 5)), np.zeros((4, 1)), -1.0), (4, 5))
    pixels, which = there.within(np.array([[1, 3, 2, 4]]))
    assert (pixels.tolist(), which.tolist()) == ([11, 12, 16, 17], [0, 0, 0, 0])
