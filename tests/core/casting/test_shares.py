"""How a picture is divided among threads: every pixel once, about the same work for each."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core import tuning
from camera_ray_caster.core.camera import camera as camera_module
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting import tiles
from camera_ray_caster.core.casting.passes import PASSES
from camera_ray_caster.core.casting.plan import make_plan
from camera_ray_caster.core.casting.request import Request
from camera_ray_caster.core.maths.speed import STRIP, sharing
from camera_ray_caster.core.records import SPHERE

from ..camera.test_pixel_time import ROWS
from ..cameras.model_examples import camera as model_camera
from .test_cast import camera_at, shapes_of

LENSES = {
    "OPENCV_PINHOLE": {"k1": -0.28, "k2": 0.07, "p1": 1e-3, "calibration_width": 96, "calibration_height": 54},
    "OPENCV_FISHEYE": {"k1": 0.05, "k2": 0.01, "calibration_width": 96, "calibration_height": 54},
}

HIGH_UP = shapes_of(*[(SPHERE, (x / 4, 2.6, -8), 0.9) for x in range(-12, 13)])
"""25 overlapping balls in the upper quarter of the picture."""


def plan_of(camera, passes=("depth",)):
    return make_plan(camera, HIGH_UP, Request(passes, tuple(PASSES)))


def test_the_work_of_a_row_is_the_pixels_that_are_tested_in_it_and_all_its_pixels_once():
    plan = plan_of(camera_at(resolution_x=640, resolution_y=480), ("depth", "normal"))
    counted = np.full(480, 640.0)
    for x0, x1, y0, y1 in plan.bounds:
        counted[y0:y1] += x1 - x0
    np.testing.assert_array_equal(plan.work, counted)
    assert counted.max() > 3 * counted.min()


@pytest.mark.parametrize(("shapes", "size"), [(0, 1), (1, 1), (128, 1), (129, 2), (1 << 15, 2), ((1 << 15) + 1, 4)])
def test_rows_take_as_few_bytes_as_hold_them(shapes, size):
    plan = replace(plan_of(camera_at()), shapes=range(shapes))
    assert plan.index_type.itemsize == size
    assert np.iinfo(plan.index_type).min < 0
    assert np.iinfo(plan.index_type).max >= shapes - 1


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
@pytest.mark.parametrize(("size", "work"), [((640, 480), 1 << 23), ((1000, 999), 1 << 23), ((1000, 999), 1 << 18)])
def test_shares_hold_each_row_once_and_about_the_same_work(monkeypatch, threads, size, work):
    monkeypatch.setattr(tuning, "TILE_WORK", work)
    plan = plan_of(camera_at(resolution_x=size[0], resolution_y=size[1]))
    rows = [(tile.rows.start, tile.rows.stop) for tile in tiles.shares(plan, threads)]
    assert [first for first, _ in rows] == [0, *(last for _, last in rows[:-1])]
    assert rows[-1][1] == size[1]
    most = -(-size[0] * size[1] // tuning.TILE_PIXELS[0])
    threads = sharing(threads, plan.work.sum() / tuning.SERIAL_WORK)
    assert len(rows) <= min(most, threads * -(-int(plan.work.sum()) // (threads * work)))
    assert len(rows) >= min(most, threads) / 2
    assert min(last - first for first, last in rows) >= STRIP
    assert all(first % STRIP == 0 for first, _ in rows)
    if len(rows) == threads == 2:
        shares = [plan.work[first:last].sum() for first, last in rows]
        assert np.ptp(shares) <= STRIP * plan.work.max()  # half a strip more here, half a strip less there
        assert rows[0][1] > 0.6 * size[1]  # the upper share is thinner, since all the balls are there


@pytest.mark.parametrize(("work", "least"), [(0.0, 1), (0.5, 1), (1.0, 1), (2.9, 2), (20.0, 4), (1000.0, 31)])
def test_so_many_threads_share_work_that_none_waits(work, least):
    """Each share takes its part of the work, and 1 more that no two of them do at a time."""
    time = {n: max(work / n + 1, n) for n in range(1, 65)}
    assert time[sharing(64, work)] <= min(time.values()) + 1
    assert sharing(64, work) >= least
    assert sharing(2, work) == min(2, sharing(64, work))


class Pools(list):
    """Stands in for the pool of threads, and notes how many threads were asked for."""

    def __call__(self, threads, **settings):
        self.append(threads)
        return ThreadPoolExecutor(threads, **settings)


@pytest.mark.parametrize("samples", [1, 4])
def test_threads_that_would_wait_are_not_asked(monkeypatch, samples):
    pools = Pools()
    monkeypatch.setattr(tiles, "ThreadPoolExecutor", pools)
    large, timed = {"resolution_x": 1280, "resolution_y": 960}, {"resolution_y": 960, "settings": ROWS}
    for raw in (large, {}, timed):  # of the last each row has its own time and plan, and is done soon
        cast(camera_at(**raw), HIGH_UP, ("combined",), threads=16, samples=samples)
    assert 2 <= pools[0] <= 4  # work of 0.9 million: 3.3 times SERIAL_WORK
    assert pools[1:] == [1, 1]


@pytest.mark.parametrize(("size", "used"), [((320, 240), 1), ((800, 660), 2), ((1600, 1320), 4)])
def test_rays_of_small_pictures_are_not_shared_by_many_threads(monkeypatch, size, used):
    pools = Pools()
    monkeypatch.setattr(camera_module, "ThreadPoolExecutor", pools)
    monkeypatch.setattr(camera_module.os, "cpu_count", lambda: 16)
    for key in ("PERSP", "OMNIMAX", "PUSHBROOM"):
        pools.clear()
        model_camera(key, {"resolution_x": size[0], "resolution_y": size[1]}).rays()
        assert set(pools) <= {used}, key
        assert pools or used == 1, key


def test_no_tile_is_larger_than_the_memory_that_is_stated():
    plan = plan_of(camera_at(resolution_x=4000, resolution_y=3000))
    heights = [tile.rows.stop - tile.rows.start for tile in tiles.shares(plan, 1)]
    assert max(heights) * 4000 <= tuning.TILE_PIXELS[1]
    assert sum(heights) == 3000


@pytest.mark.parametrize("passes", [(), ("depth",), ("shape_index", "normal")])
def test_the_picture_is_the_same_in_one_share_and_in_many(monkeypatch, passes):
    camera = camera_at(resolution_x=320, resolution_y=240)
    whole = cast(camera, HIGH_UP, passes, np.float64, threads=1)
    monkeypatch.setattr(tuning, "TILE_PIXELS", (1 << 10, 1 << 14))
    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 12)
    fractions = []
    parts = cast(camera, HIGH_UP, passes, np.float64, threads=2, progress=lambda done: not fractions.append(done))
    assert len(fractions) >= (4 if passes else 1)
    assert list(parts) == list(passes)
    for name in passes:
        np.testing.assert_array_equal(parts[name], whole[name])


@pytest.mark.parametrize("key", ["PERSP", "OPENCV_PINHOLE", "OPENCV_FISHEYE", "FISHEYE_LENS_POLYNOMIAL"])
def test_a_ray_does_not_depend_on_how_threads_share_the_picture(monkeypatch, key):
    """Bit for bit, though lenses are solved panel by panel."""
    camera = model_camera(key, {"resolution_x": 320, "resolution_y": 288, **LENSES.get(key, {})})
    passes = ("ray_direction", "depth", "valid")
    whole = cast(camera, HIGH_UP, passes, np.float64, threads=1)
    monkeypatch.setattr(tuning, "TILE_PIXELS", (1 << 14, 1 << 14))
    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 12)
    parts = cast(camera, HIGH_UP, passes, np.float64, threads=3)
    for name in passes:
        np.testing.assert_array_equal(parts[name], whole[name])
