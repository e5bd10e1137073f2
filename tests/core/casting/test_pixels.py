"""Casting at given pixels gives what the whole picture has there, for every model and wherever they lie."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.pixels import hits_at, passes_at

from ..cameras.model_examples import camera as camera_of
from ..shapes import meshes
from ..still import passes_of
from .neighbors import at_rest
from .test_cast import camera_at, random_shapes

SIZE = {"resolution_x": 64, "resolution_y": 48}
LATTICES = [([31], [7]), ([0, 63], [0, 47]), ([5, 6, 7, 40], [3, 11, 30, 31, 46]), (range(64), [20])]


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_passes_at_pixels_are_those_of_the_picture(model):
    camera, shapes = at_rest(camera_of(model.key, SIZE), random_shapes(np.random.default_rng(0), 40))
    passes = passes_of(model)
    whole = cast(camera, shapes, passes=passes, dtype=np.float64)
    assert (whole["shape_index"] >= 0).any()
    for columns, rows in LATTICES:
        some = passes_at(camera, shapes, np.array(columns), np.array(rows), passes)
        for name in passes:
            assert some[name].dtype == whole[name].dtype
            assert np.array_equal(some[name], whole[name][np.ix_(rows, columns)], equal_nan=True), name


def test_pixels_beside_the_render_window_are_cast_too():
    shapes = random_shapes(np.random.default_rng(0), 40)
    whole = cast(camera_at(**SIZE), shapes, passes=("distance",), dtype=np.float64)["distance"]
    border = camera_at(**SIZE, use_border=True, border_min_x=0.5, border_max_y=0.5)
    some = passes_at(border, shapes, np.array([3, 50]), np.array([10, 40]), ("distance",))["distance"]
    assert np.array_equal(some, whole[np.ix_([10, 40], [3, 50])])


def test_the_plan_of_a_picture_serves_pixels_of_its_window_and_tests_only_what_they_may_see():
    shapes = random_shapes(np.random.default_rng(0), 40)
    camera = camera_at(**SIZE, use_border=True, border_min_x=0.25, border_min_y=0.25)
    images = cast(camera, shapes, passes=("depth", "shape_index"), dtype=np.float64)
    raster = camera.raster
    columns, rows = np.array([raster.x0, 40, 41]), np.array([raster.y0 + 1, raster.y1 - 1])
    hits = hits_at(images.plan, columns, rows)
    at = np.ix_(rows - raster.y0, columns - raster.x0)
    assert np.array_equal(hits.t, images["depth"][at])
    assert np.array_equal(hits.index, images["shape_index"][at])
    assert 0 < len(images.plan.at_pixels(columns - raster.x0, rows - raster.y0).seen) < len(images.plan.seen)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_meshes_at_pixels_are_those_of_the_picture_and_are_not_placed_again(model):
    """To rounding: single pixels have no spans."""
    camera = camera_of(model.key, SIZE)
    shapes = meshes.shapes_of((meshes.soup(np.random.default_rng(2), 300), (0, 0, -1), 2.0))
    images = cast(camera, shapes, passes=("distance", "face_index"), dtype=np.float64)
    for columns, rows in LATTICES:
        some = passes_at(camera, shapes, np.array(columns), np.array(rows), ("distance", "face_index"))
        at = np.ix_(rows, columns)
        assert np.array_equal(some["face_index"], images["face_index"][at])
        np.testing.assert_allclose(some["distance"], images["distance"][at], rtol=1e-12)
    if camera.pixel_time is None:
        plan = images.plan.at_pixels(np.array([3, 7]), np.array([2]))
        assert [blocks.meshes for blocks in plan.sets] == [blocks.meshes for blocks in images.plan.sets][
            : len(plan.sets)
        ]


def test_the_time_of_a_pixel_is_left_out():
    camera = camera_at(**SIZE)
    shapes = random_shapes(np.random.default_rng(11), 5)
    pixel = np.array([30]), np.array([20])
    timed = passes_at(replace(camera, pixel_time=object()), shapes, *pixel, ("depth",))
    assert np.array_equal(timed["depth"], passes_at(camera, shapes, *pixel, ("depth",))["depth"])
