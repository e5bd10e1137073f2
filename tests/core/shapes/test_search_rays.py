"""The rays of a tile: rays at even distances, and cells in which rays are nearly linear in the pixel."""

import tracemalloc

import numpy as np
import pytest

from camera_ray_caster.core import tuning
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.rays import rays_of
from camera_ray_caster.core.maths.speed import Scratch
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE
from camera_ray_caster.core.shapes.mesh.spans import RayLattice
from camera_ray_caster.core.shapes.mesh.triangles import EDGES, Planes, edge_vectors
from camera_ray_caster.core.shapes.ray_cells import RayCells
from camera_ray_caster.core.shapes.search_rays import SearchRays

from ..cameras.model_examples import camera as camera_of
from ..casting.test_cast import camera_at, shapes_of


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_each_part_of_a_picture_of_planar_rays_is_a_lattice(kind):
    """However its coordinates are rounded: otherwise its triangles are tested pixel by pixel, in twice the time."""
    cam = camera_at(type=kind, resolution_x=1920, resolution_y=1080, shift_x=0.13, ortho_scale=7.3)
    x, y = cam.raster.columns(), cam.raster.rows()
    rays = rays_of(cam, x, y, (0, 0), Scratch())
    whole = SearchRays(None if rays.from_eye else rays.origin, rays.direction, (0, 0), rays.shape, rays.scratch)
    random = np.random.default_rng(0)
    for _ in range(500):
        (first_row, last_row), (first, last) = (np.sort(random.choice(size, 2, replace=False)) for size in rays.shape)
        assert RayLattice.of(whole.within((slice(first_row, last_row + 1), slice(first, last + 1)))) is not None


@pytest.mark.parametrize("spread", [0.0, 0.01, 0.1])
def test_the_spans_of_cells_are_hits_and_leave_few_pixels_open(spread, monkeypatch):
    """Rays of a fisheye, some missing, from the eye or from points around it, against each triangle's volumes. Those of
    many origins hit the triangles behind them, too; a few rays are far from those beside them.
    """
    monkeypatch.setattr(tuning, "RAY_CELL", 8)  # as large as cells of 24 in a picture of 570 columns
    random = np.random.default_rng(3)
    y, x = np.mgrid[-1:1:130j, -1:1:190j]
    r = np.maximum(np.hypot(x, y), 1e-9)
    direction = np.where(r < 1.2, [x / r * np.sin(2 * r), y / r * np.sin(2 * r), -np.cos(2 * r)], np.nan)
    direction[:, 40, 50:53] *= -1
    origin = spread * np.array([np.cos(3 * x), np.sin(3 * x), y])
    moment = np.cross(origin, direction, axis=0) if spread else None
    corners = random.normal(size=(3, 1, 300)) + random.uniform(0, 0.5, 300) * random.normal(size=(3, 3, 300))
    along = 0.7 * corners[0] + 0.3 * corners[1] + 10.0 ** random.uniform(-14, -2, 300) * corners[2]
    corners[2, :, ::10] = along[:, ::10]  # slivers, whose edges are nearly parallel
    turned = (np.cross(corners[0], corners[1], axis=0) * corners[2]).sum(axis=0) < 0
    corners[1:, :, turned] = corners[:0:-1, :, turned]  # seen from the eye, all volumes of a hit are positive
    ends = [np.sort(random.integers(0, size + 1, (2, 300)), axis=0) for size in x.shape[::-1]]
    bounds = np.concatenate(ends).T
    edges, doubt = edge_vectors(corners, from_eye=not spread), np.full(300, 1e-14)
    turns = np.arange(300 if spread else 0)
    cells = RayCells(direction, moment, x.shape, 8, origin if spread else None)
    planes = Planes(corners, not spread, 1.0)
    runs = cells.spans(edges, doubt, bounds, turns, planes, np.full((17, 24), np.inf))
    met, opened = (np.concatenate([*each.pieces(limit=1000)], axis=-1) for each in runs)
    at, windows = RayCells(direction, moment, x.shape, 32).windows(edges, doubt, bounds, turns)
    farthest = random.choice((0.01, 0.3, 1.0), (17, 24))
    shown = [piece for run in cells.spans(edges, doubt, bounds, turns, planes, farthest) for piece in run.pieces(1000)]
    triangle_shown, pixel_shown = np.concatenate(shown, axis=-1)
    assert len(pixel_shown) < 0.8 * (len(met[0]) + len(opened[0]))
    farthest = np.repeat(np.repeat(farthest, 8, axis=0), 8, axis=1)[: len(x), : x.shape[1]]
    asked, undecided, looked_at, bounded = 0, 0, 0, 0
    for k, (x0, x1, y0, y1) in enumerate(bounds.tolist()):
        places = corners[..., k, None, None] - origin
        volumes = np.array([(direction * np.cross(places[i], places[j], axis=0)).sum(axis=0) for i, j in EDGES])
        meets = (volumes >= 1e-15).all(axis=0) | (volumes <= -1e-15).all(axis=0) & bool(spread)
        within = np.zeros(x.shape, bool)
        within[y0:y1, x0:x1] = True
        certain, left = (
            np.bincount(pixel[triangle == k], minlength=x.size).reshape(x.shape) for triangle, pixel in (met, opened)
        )
        assert (certain + left).max() <= 1 + bool(spread)  # a triangle may be seen from both sides
        assert not (certain + left)[~within].any()
        assert meets[(certain > 0) & ~np.isnan(direction[0])].all()
        assert (certain + left)[within & meets].all()
        normal = np.cross(places[1] - places[0], places[2] - places[0], axis=0)
        t = (normal * places[0]).sum(axis=0) / (normal * direction).sum(axis=0)
        is_shown = np.bincount(pixel_shown[triangle_shown == k], minlength=x.size).reshape(x.shape) > 0
        assert is_shown[within & meets & (np.abs(t) <= farthest)].all()
        covered = np.zeros(x.shape, int)
        for first, last, low, high in windows[at == k].tolist():
            covered[low:high, first:last] += 1
        assert covered.max() <= 1
        assert not covered[~within].any()
        assert covered[within & meets].all()
        looked_at, bounded = looked_at + covered.sum(), bounded + within.sum()
        asked += (within & ~np.isnan(direction[0])).sum()
        undecided += left[~np.isnan(direction[0])].sum()
    assert 0 < undecided < 0.15 * asked, (undecided, asked)
    assert looked_at < 0.8 * bounded, (looked_at, bounded)  # many of these triangles are as wide as the picture


def test_cells_of_a_pinholes_rays_leave_no_pixel_open():
    """Its directions of unit length curve in a cell; over their depth they are linear."""
    y, x = np.mgrid[-0.3:0.3:80j, -0.5:0.5:120j]
    direction = np.array((x, y, np.full_like(x, -1.0))) / np.sqrt(x * x + y * y + 1)
    corners = np.random.default_rng(0).uniform(-1, 1, (3, 3, 40)) - np.array((0, 0, 2))[:, None]
    turned = (np.cross(corners[0], corners[1], axis=0) * corners[2]).sum(axis=0) < 0
    corners[1:, :, turned] = corners[:0:-1, :, turned]
    bounds, doubt = np.tile((0, 120, 0, 80), (40, 1)), np.full(40, 1e-14)
    cells = RayCells(direction, None, x.shape, tuning.RAY_CELL)
    planes, farthest = Planes(corners, True, 1.0), np.full((4, 5), np.inf)
    met, opened = cells.spans(edge_vectors(corners, from_eye=True), doubt, bounds, np.arange(0), planes, farthest)
    assert len(met.at) > 1000
    assert not len(opened.at)


def test_bounds_of_functions_hold_each_pixel_in_front():
    """The first of three linear functions of the direction is at least 0 and at least the others' magnitudes there."""
    random = np.random.default_rng(1)
    y, x = np.mgrid[-1:1:130j, -1:1:190j]
    r = np.maximum(np.hypot(x, y), 1e-9)
    direction = np.where(r < 1.2, [x / r * np.sin(2 * r), y / r * np.sin(2 * r), -np.cos(2 * r)], np.nan)
    functions = random.normal(size=(3, 3, 200)) * np.array((1.0, 3.0, 3.0))[:, None, None]
    bounds = np.concatenate([np.sort(random.integers(0, size + 1, (2, 200)), axis=0) for size in x.shape[::-1]]).T
    here, narrowed = RayCells(direction, None, x.shape, 8).in_front(functions, bounds)
    pixels = 0
    for k, (x0, x1, y0, y1) in enumerate(bounds.tolist()):
        first, *others = np.einsum("nc,cyx->nyx", functions[..., k], direction)
        meets = (first >= 0) & (np.abs(others) <= first).all(axis=0)
        inside = np.zeros((2, *x.shape), bool)
        inside[0, y0:y1, x0:x1] = True
        for left, right, low, high in narrowed[here == k].tolist():
            inside[1, low:high, left:right] = True
        assert not (inside[1] & ~inside[0]).any()
        assert inside[1][meets & inside[0]].all()
        pixels += inside.sum(axis=(1, 2))
    assert pixels[1] < 0.6 * pixels[0], pixels


@pytest.mark.parametrize("kind", [PLANE, INFINITE_PLANE])
def test_a_plane_through_the_eye_is_hit_on_both_sides_whatever_is_behind_it(kind):
    """At t = 0, as one that is cast alone is."""
    floor = [[1, 0, 0], [0, 0, 1], [0, 1, 0]]
    rows = (kind, (0.3, 0, 0.2), floor), *((kind, (0, 0, -5 - k), 50.0) for k in range(12))
    cam = camera_of("EQUIRECTANGULAR", {"resolution_x": 160, "resolution_y": 90, "clip_start": 0.0})
    assert not cast(cam, shapes_of(*rows), passes="shape_index")["shape_index"].any()


def test_many_planes_are_narrowed_in_little_memory(monkeypatch):
    """At most eight numbers for each pixel that is prepared at once, whatever the number of planes (four measured)."""
    random, peaks = np.random.default_rng(2), []
    shapes = shapes_of(*((PLANE, center, 20.0) for center in random.uniform(-20, 20, (2000, 3))))
    cam = camera_of("EQUIRECTANGULAR", {"resolution_x": 320, "resolution_y": 160})
    for tiles in (np.inf, np.inf, tuning.NARROWED_TILES):  # the first cast of a process also allocates what is kept
        monkeypatch.setattr(tuning, "NARROWED_TILES", tiles)
        tracemalloc.start()
        cast(cam, shapes, passes="depth", threads=1)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[2] - peaks[1] < 8 * 8 * tuning.PREPARED_PIXELS, peaks
