"""The rays of a tile: the pixels within bounds that have a ray, against a loop, and rays at even distances."""

import numpy as np
import pytest

from camera_ray_caster.core.casting.rays import chief_rays
from camera_ray_caster.core.maths.speed import Scratch
from camera_ray_caster.core.shapes.mesh.spans import RayLattice
from camera_ray_caster.core.shapes.mesh.triangles import EDGES, edge_vectors
from camera_ray_caster.core.shapes.search_rays import Cells, Present, SearchRays

from ..casting.test_cast import camera_at


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


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_each_part_of_a_picture_of_planar_rays_is_a_lattice(kind):
    """However its coordinates are rounded: otherwise its triangles are tested pixel by pixel, in twice the time."""
    cam = camera_at(type=kind, resolution_x=1920, resolution_y=1080, shift_x=0.13, ortho_scale=7.3)
    x, y = cam.raster.columns(), cam.raster.rows()
    rays = chief_rays(cam, x, y, (0, 0), Scratch())
    whole = SearchRays(None if rays.from_eye else rays.origin, rays.direction, (0, 0), rays.shape, rays.scratch)
    random = np.random.default_rng(0)
    for _ in range(500):
        (first_row, last_row), (first, last) = (np.sort(random.choice(size, 2, replace=False)) for size in rays.shape)
        assert RayLattice.of(whole.within((slice(first_row, last_row + 1), slice(first, last + 1)))) is not None


@pytest.mark.parametrize(("spread", "most"), [(0.0, 0.3), (0.01, 0.6), (0.1, 0.6)])
def test_the_cells_cut_off_no_ray_that_hits_a_triangle_and_many_others(spread, most):
    """Rays of a fisheye, some missing, from the eye or from points around it, against each triangle's volumes. Those of
    many origins keep the triangles behind them, too.
    """
    random = np.random.default_rng(3)
    y, x = np.mgrid[-1:1:90j, -1:1:130j]
    r = np.maximum(np.hypot(x, y), 1e-9)
    direction = np.where(r < 1.2, [x / r * np.sin(2 * r), y / r * np.sin(2 * r), -np.cos(2 * r)], np.nan)
    origin = spread * np.array([np.cos(3 * x), np.sin(3 * x), y])
    moment = np.cross(origin, direction, axis=0) if spread else None
    corners = random.normal(size=(3, 1, 300)) + random.uniform(0, 0.5, 300) * random.normal(size=(3, 3, 300))
    turned = (np.cross(corners[0], corners[1], axis=0) * corners[2]).sum(axis=0) < 0
    corners[1:, :, turned] = corners[:0:-1, :, turned]  # seen from the eye, all volumes of a hit are positive
    ends = [np.sort(random.integers(0, size + 1, (2, 300)), axis=0) for size in x.shape[::-1]]
    bounds = np.concatenate(ends).T
    edges = edge_vectors(corners, from_eye=not spread)
    at, parts = Cells(direction, moment, x.shape).parts(edges, np.zeros(300), bounds)
    kept = 0
    for k, (x0, x1, y0, y1) in enumerate(bounds.tolist()):
        places = corners[..., k, None, None] - origin
        volumes = np.array([(direction * np.cross(places[i], places[j], axis=0)).sum(axis=0) for i, j in EDGES])
        met = (volumes >= 1e-15).all(axis=0) | (volumes <= -1e-15).all(axis=0) & bool(spread)
        within = np.zeros(x.shape, bool)
        within[y0:y1, x0:x1] = True
        covered = np.zeros(x.shape, int)
        for left, right, low, high in parts[at == k].tolist():
            covered[low:high, left:right] += 1
        assert covered.max() <= 1
        assert not covered[~within].any()
        assert covered[within & met].all()
        kept += covered.sum()
    asked = ((bounds[:, 1] - bounds[:, 0]) * (bounds[:, 3] - bounds[:, 2])).sum()
    assert 0 < kept < most * asked
