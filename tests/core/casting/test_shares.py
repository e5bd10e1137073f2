"""How a picture is divided among threads: it is the same however many share it, and none wait in vain."""

from __future__ import annotations

import os
import tracemalloc
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from threading import get_ident
from types import SimpleNamespace

import numpy as np
import pytest

from camera_ray_caster.core import tuning
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.tiles import shares
from camera_ray_caster.core.maths.speed import release
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


class Asked(Exception):
    """How many threads were asked for."""


def threads_of(monkeypatch, function):
    """Return how many threads a function asks for before it begins, on a machine of 16; 1 where it asks for none."""

    def asked(pool, threads, **_):
        raise Asked(threads)

    monkeypatch.setattr(os, "sched_getaffinity", lambda process: range(16), raising=False)
    monkeypatch.setattr(ThreadPoolExecutor, "__init__", asked)
    try:
        function()
    except Asked as stopped:
        return stopped.args[0]
    return 1


@pytest.mark.parametrize("samples", [1, 4])
def test_threads_share_large_pictures_and_do_not_wait_for_each_other_in_small_ones(monkeypatch, samples):
    large, timed = {"resolution_x": 1280, "resolution_y": 960}, {"resolution_y": 960, "settings": ROWS}
    asked = [
        threads_of(monkeypatch, lambda raw=raw: cast(camera_at(**raw), HIGH_UP, passes=("combined",), samples=samples))
        for raw in (large, {}, timed)  # of the last each row has its own time and plan, and is done soon
    ]
    assert 1 < asked[0] < 16
    assert asked[1:] == [1, 1]


@pytest.mark.parametrize(("samples", "tiles"), [(1, 1), (16, 2)])
def test_each_thread_has_a_tile_of_a_small_picture_with_many_samples(samples, tiles):
    heavy = SimpleNamespace(camera=camera_at(resolution_x=640, resolution_y=400), work=np.full(400, 1e6))
    assert len(list(shares(heavy, 2, samples))) == tiles


@pytest.mark.parametrize("key", ["PERSP", "OMNIMAX", "PUSHBROOM"])
def test_rays_of_large_pictures_are_shared_by_threads_and_those_of_small_ones_are_not(monkeypatch, key):
    small, large = (model_camera(key, {"resolution_x": 320 * k, "resolution_y": 240 * k}) for k in (1, 5))
    assert threads_of(monkeypatch, small.rays) == 1
    assert threads_of(monkeypatch, large.rays) > 1


def test_the_memory_beside_a_picture_does_not_grow_with_it():
    """It is that of the tile under way, once the picture has more than one of the largest."""
    beside = []
    for side in (2500, 3500):
        release()
        tracemalloc.start()
        images = cast(camera_at(resolution_x=side, resolution_y=side), HIGH_UP, passes=("depth",), threads=1)
        beside.append(tracemalloc.get_traced_memory()[1] - images["depth"].nbytes)
        tracemalloc.stop()
    assert beside[1] < 1.2 * beside[0]


@pytest.mark.parametrize("count", [1, 128, 129, 1 << 15, (1 << 15) + 1])
def test_of_many_shapes_the_last_is_told_from_the_others(count):
    """A pixel keeps which shape it sees in as few bytes as hold it."""
    behind = shapes_of((SPHERE, (0, 0, 5), 1.0))
    fields = ("kind", "center", "axes", "object_index", "material_index", "color", "name_index")
    shapes = replace(behind, **{name: np.repeat(getattr(behind, name), count, axis=0) for name in fields})
    shapes.center[-1, 2] = -5
    seen = cast(camera_at(), shapes, passes=("shape_index",))["shape_index"]
    assert set(np.unique(seen)) == {-1, count - 1}


@pytest.mark.parametrize("passes", [(), ("depth",), ("shape_index", "normal")])
def test_the_picture_is_the_same_in_one_share_and_in_many(monkeypatch, passes):
    camera = camera_at(resolution_x=320, resolution_y=240)
    whole = cast(camera, HIGH_UP, passes=passes, dtype=np.float64, threads=1)
    monkeypatch.setattr(tuning, "TILE_PIXELS", (1 << 10, 1 << 14))
    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 12)
    fractions = []
    parts = cast(
        camera, HIGH_UP, passes=passes, dtype=np.float64, threads=2, progress=lambda done: not fractions.append(done)
    )
    assert len(fractions) >= (4 if passes else 1)
    assert fractions[-1] == 1.0
    assert list(parts) == list(passes)
    for name in passes:
        np.testing.assert_array_equal(parts[name], whole[name])


@pytest.mark.parametrize("key", ["PERSP", "OPENCV_PINHOLE", "OPENCV_FISHEYE", "FISHEYE_LENS_POLYNOMIAL"])
def test_a_ray_does_not_depend_on_how_threads_share_the_picture(monkeypatch, key):
    """Bit for bit, though lenses are solved panel by panel."""
    camera = model_camera(key, {"resolution_x": 320, "resolution_y": 288, **LENSES.get(key, {})})
    passes = ("ray_direction", "depth", "valid")
    whole = cast(camera, HIGH_UP, passes=passes, dtype=np.float64, threads=1)
    monkeypatch.setattr(tuning, "TILE_PIXELS", (1 << 14, 1 << 14))
    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 12)
    parts = cast(camera, HIGH_UP, passes=passes, dtype=np.float64, threads=3)
    for name in passes:
        np.testing.assert_array_equal(parts[name], whole[name])


@pytest.mark.parametrize("samples", [1, 4])
def test_rows_are_told_once_each_when_they_are_complete(samples, monkeypatch):
    """In the calling thread, before the whole picture is done."""
    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 16)
    camera, finished_rows = camera_at(resolution_x=1024, resolution_y=512), []

    def finished(images, rows):
        assert get_ident() == here
        finished_rows.append((rows, {name: image[rows].copy() for name, image in images.items()}))

    here = get_ident()
    images = cast(
        camera, shapes_of((SPHERE, (0, 0, -5), 1.0)), passes=("depth", "combined"), samples=samples, finished=finished
    )
    assert len(finished_rows) >= 2
    assert sorted(row for rows, _ in finished_rows for row in range(512)[rows]) == list(range(512))
    for rows, parts in finished_rows:
        for name, rows_of in parts.items():
            np.testing.assert_array_equal(rows_of, images[name][rows])
    assert images.seconds["write"] > 0


def test_a_picture_of_many_times_is_told_as_a_whole():
    """Though it is cast time by time, since columns are complete long before a row is."""
    finished_rows = []
    camera = camera_at(settings=ROWS | {"time_mode": "COLUMNS"})
    cast(camera, shapes_of((SPHERE, (0, 0, -5), 1.0)), finished=lambda images, rows: finished_rows.append(rows))
    assert finished_rows == [slice(0, 33)]
