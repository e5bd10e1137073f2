"""The report's error bounds: those of the whole picture's passes at evenly spread pixels, and no others."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.pixel_time import ImageTime, LinearTime
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import SPHERE, Raster
from camera_ray_caster.core.report.accuracy import MOMENTS, PIXELS, QUANTITIES, Accuracy, accuracy, sample

from ..casting.neighbors import with_motion
from ..truth import truth
from .extreme_cases import Case, around, pose, shapes_of

BOUNDS = ("distance_bound", "position_bound", "normal_bound")
DUST = [(SPHERE, center, 0.15) for center in np.random.default_rng(2).uniform(-4, 4, (200, 3)) - (0, 0, 8)]
"""Shapes of few pixels, which are cast many at once."""
TIMED = {"resolution_x": 70, "resolution_y": 80}


def raster_of(width, height, window=None):
    return Raster(width, height, 1.0, *(window or (0, 0, width, height)))


@pytest.mark.parametrize(
    ("raster", "rows", "columns"),
    [
        (raster_of(1, 1), 1, 1),
        (raster_of(64, 64), 64, 64),
        (raster_of(100, 40), 40, 100),
        (raster_of(1920, 1080), 47, 84),
        (raster_of(65536, 1), 1, 4096),
        (raster_of(1, 65536), 4096, 1),
        (raster_of(1920, 1080, (500, 300, 510, 304)), 4, 10),
    ],
)
def test_the_sample_is_even_and_holds_all_pixels_where_they_are_few(raster, rows, columns):
    x, y = sample(raster)
    assert (x.shape, y.shape) == ((1, columns), (rows, 1))
    for places, every in ((x[0], raster.columns()[0]), (y[:, 0], raster.rows()[:, 0])):
        assert np.isin(places, every).all()
        step = len(every) / len(places)
        assert (np.abs(np.diff(places) - step) < 1).all()
        assert max(places[0] - every[0], every[-1] - places[-1]) <= step / 2
    assert x.size * y.size <= PIXELS


def expected(images, camera, x, y, numbers=("distance", "position")):
    """The bounds and the numbers of the whole picture's passes at pixels, only where something is hit there."""
    rows, columns = (y - 0.5 - camera.raster.y0).astype(int), (x - 0.5 - camera.raster.x0).astype(int)
    hit = images["shape_index"][rows, columns] >= 0
    return {name: images[name][rows, columns][hit] for name in (*BOUNDS, *numbers)}


def agrees(measured, passes, rounded=2.0**-9):
    """Whether a sample has a picture's bounds: the passes' are rounded up and count what storing loses."""
    storing = {
        "distance_bound": passes["distance"],
        "position_bound": np.sqrt((passes["position"] ** 2).sum(axis=-1)),
        "normal_bound": np.ones(len(passes["normal_bound"])),
    }
    assert measured.hits == len(passes["distance_bound"]) > 0
    for name in BOUNDS:
        up = (1 + rounded) * (1 + 1e-12)
        bound = passes[name] / up - np.finfo(float).eps * storing[name] * (1 + 1e-6)
        for measure, of_picture in ((measured.median, np.median), (measured.worst, np.max)):
            low, high = (of_picture(each) for each in (bound, passes[name]))
            assert low <= measure(name.removesuffix("_bound")) <= high, name


@pytest.mark.parametrize("settings", [
    {"resolution_x": 150, "resolution_y": 90},
    {"resolution_x": 150, "resolution_y": 90, "type": "ORTHO", "ortho_scale": 12.0},
    {"resolution_x": 150, "resolution_y": 90, "type": "EQUIRECTANGULAR", "matrix_world": pose(None, (0.2, 0.1, 1))},
    {"resolution_x": 600, "resolution_y": 300, "use_border": True, "border_min_x": 0.2, "border_max_x": 0.7,
     "border_min_y": 0.1, "border_max_y": 0.6},
])  # fmt: skip
@pytest.mark.parametrize("rows", [around(), DUST], ids=["large shapes", "small shapes"])
def test_the_bounds_are_those_of_the_passes_at_the_sampled_pixels(rows, settings):
    case = Case("", "", rows, settings)
    images = cast(case.camera, case.shapes, passes=(*BOUNDS, "shape_index", "distance", "position"), dtype=np.float64)
    measured = accuracy(case.camera, case.shapes, images.plan)
    x, y = sample(case.camera.raster)
    assert measured.pixels == x.size * y.size < images["distance"].size
    agrees(measured, expected(images, case.camera, x, y))


def test_errors_are_below_the_worst_bound_and_the_relative_one_is_of_the_distance():
    case = Case("", "", around(), {"resolution_x": 5, "resolution_y": 5})
    images = cast(case.camera, case.shapes, passes=("distance", "shape_index"), dtype=np.float64)
    measured = accuracy(case.camera, case.shapes, images.plan)
    for (j, i), distance in np.ndenumerate(images["distance"]):
        if images["shape_index"][j, i] >= 0:
            ray = truth.ray(case.raw, i + 0.5, j + 0.5)
            exact = truth.nearest(case.shapes, ray, case.camera.clip_start, case.camera.clip_end).distance
            error = abs(truth.mpf(float(distance)) - exact)
            assert error <= measured.worst("distance") + float(np.spacing(distance))
            assert error / exact <= measured.worst("relative_distance") + np.finfo(float).eps
    ratio = measured.bounds[:, 0] / measured.bounds[:, 1]
    np.testing.assert_allclose(np.sort(ratio), np.sort(images["distance"][images["shape_index"] >= 0]))


def test_the_search_is_one_in_float64():
    case = Case("", "", around(), {"resolution_x": 32, "resolution_y": 32})
    plan = cast(case.camera, case.shapes, passes=("depth",)).plan
    bound = accuracy(case.camera, case.shapes, plan).median("relative_distance")
    assert 2.0**-57 < bound < 2.0**-44, "float64 has 53 digits"


@pytest.mark.parametrize("rows", [[], [(SPHERE, (0, 0, 5), 1.0)]], ids=["no shapes", "a shape behind"])
def test_where_nothing_is_hit_there_is_no_bound(rows):
    case = Case("", "", rows)
    measured = accuracy(case.camera, case.shapes, cast(case.camera, case.shapes, passes=("depth",)).plan)
    assert (measured.pixels, measured.hits) == (81, 0)
    assert [measured.worst(name) for name in QUANTITIES] == [measured.median(name) for name in QUANTITIES] == [None] * 4
    assert (measured + Accuracy()).hits == 0


def test_where_there_is_no_ray_there_is_no_hit():
    case = Case("", "", [(SPHERE, (0, 0, 0), 3.0)], {"type": "FISHEYE_EQUIDISTANT", "resolution_x": 31,
                "resolution_y": 31})  # fmt: skip
    images = cast(case.camera, case.shapes, passes=("valid",))
    measured = accuracy(case.camera, case.shapes, images.plan)
    assert measured.hits == np.count_nonzero(images["valid"]) < measured.pixels
    assert np.isfinite(measured.bounds).all()


@dataclass(frozen=True)
class Passing:
    """A sphere that comes from far on the left, is before the camera from frame 0 to 1, and goes."""

    camera: object
    is_still = False

    def shapes_at(self, frame):
        return shapes_of([(SPHERE, (8 * (frame - 0.5), 0, -7.0), 4.0)])

    def camera_at(self, frame):
        return replace(self.camera, pixel_time=None)

    def at(self, frame):
        return self.camera_at(frame), self.shapes_at(frame)


def timed(pixel_time):
    """A camera with this pixel_time, and shapes that pass."""
    still = Case("", "", [], TIMED).camera
    motion = Passing(still)
    return with_motion(replace(still, pixel_time=pixel_time), motion.shapes_at(0.0), motion)


@pytest.mark.parametrize("pixel_time", [
    LinearTime(-6.0, 0.0, 0.1, -5.95, 1.95, 0.1, 256),
    LinearTime(-5.0, 0.1, 0.0, -4.95, 1.95, 0.1, 256),
    ImageTime(np.linspace(-6, 2, 7 * 80).reshape(80, 7).repeat(10, axis=1).round(0), 0.1, 256),
], ids=["rows", "columns", "image"])  # fmt: skip
def test_each_pixel_is_asked_at_its_own_moment(pixel_time):
    """In the middle of all times nothing is to be seen."""
    camera, shapes = timed(pixel_time)
    images = cast(camera, shapes, passes=(*BOUNDS, "shape_index", "distance", "position"), dtype=np.float64)
    assert cast(camera.at(-2.0), shapes.at(-2.0), passes=("shape_index",))["shape_index"].max() == -1
    measured = accuracy(camera, shapes, images.plan)
    x, y = sample(camera.raster)
    x, y = (places.ravel() for places in np.broadcast_arrays(x, y))
    frames = pixel_time.frame_at(x, y)
    every = np.unique(frames)
    times = every[:: -(-len(every) // MOMENTS)]
    asked = np.isin(frames, times)
    assert measured.pixels == np.count_nonzero(asked)
    agrees(measured, expected(images, camera, x[asked], y[asked]))


def test_no_more_than_so_many_moments_are_asked():
    levels = np.linspace(0, 1, 256)[np.random.default_rng(3).integers(0, 256, (80, 70))]
    camera, shapes = timed(ImageTime(levels, 0.1, 256))
    measured = accuracy(camera, shapes, cast(camera.at(0.5), shapes, passes=("depth",)).plan)
    assert 0 < measured.pixels <= PIXELS * MOMENTS / 256 * 1.5
