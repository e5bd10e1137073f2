"""Ranges of recorded formulas: they hold what the operations give at numbers in the ranges of their operands."""

import numpy as np
import pytest

from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.maths.recording import NUMPY, look_up, loop, record
from camera_ray_caster.core.maths.recording.ranges import ranges
from camera_ray_caster.core.maths.recording.record import DOMAIN, NUMERIC

from ..cameras.model_examples import EXAMPLES, camera
from .test_recording import each_model

TABLE = (0.0, 0.3, 0.1, 2.0, 1.5)
BINARY = {"add", "subtract", "multiply", "divide", "remainder", "power", "minimum", "maximum", "hypot", "arctan2"}
BRANCHES = {
    "smaller": lambda a, b: np.where(a < b, a, b * b),
    "root or none": lambda a, b: np.where(a >= b, np.sqrt(a - b), np.nan),
    "without a root": lambda a, b: np.where(np.sqrt(a) > b, 1.0, 2.0),
    "not, and, or": lambda a, b: np.where(~(a <= b) & (a > 0) | (a == b), a, -b),
    "square": lambda a, b: a * a - b**3 + a**-2 + abs(b) ** 0.5,
    "table": lambda a, b: look_up(TABLE, np.clip(np.floor(a), 0, 4)) + np.searchsorted((-1.0, 0.5, 1.0), b),
    "loop": lambda a, b: loop(lambda x: ((x / 2,), x < 0.1), (a,), 9)[0] + b,
    "NaN": lambda a, b: np.where(np.isnan(np.where(a > 0, np.nan, b)), a, b),
}


def held(function, count):
    """Whether ranges of a function of ``count`` numbers hold its values, and how wide they are over these at most."""
    rng = np.random.default_rng(5)
    low = rng.uniform(-4, 4, (count, 400, 1)).round(1)
    high = low + 10 ** rng.uniform(-3, 0.7, low.shape)
    inside = low + (high - low) * np.concatenate(([0, 1], rng.uniform(size=60)))
    recorded = record(lambda *x: [function(*x)], count)
    (interval,) = ranges(recorded, list(zip(low, high, strict=True)))
    with np.errstate(all="ignore"):
        (values,) = recorded.evaluate(NUMPY, inside)
    if function.__name__ in DOMAIN:
        values = np.where(DOMAIN[function.__name__](*inside), values, np.nan)
    values = np.broadcast_to(values, inside[0].shape)
    off = 16 * EPS * np.maximum(1, np.abs(values))
    none, gaps = np.isnan(values), np.broadcast_to(interval.has_gaps, low[0].shape)
    assert ((interval.low <= values + off) & (values <= interval.high + off) | none).all()
    assert gaps[none.any(axis=1) & ~none.all(axis=1)].all()
    with np.errstate(all="ignore"):
        wide = (interval.high - interval.low)[:, 0] / (np.nanmax(values, axis=1) - np.nanmin(values, axis=1))
    return wide


@pytest.mark.filterwarnings("ignore:All-NaN")
@pytest.mark.parametrize("name", sorted(NUMERIC))
def test_ranges_hold_what_each_operation_gives(name):
    wide = held(getattr(np, name), 2 if name in BINARY else 1)
    if name not in {"remainder", "power", "divide", "tan", "floor", "ceil", "rint", "sign"}:
        assert np.nanmedian(wide) < 1.6  # of 62 numbers in the range


@pytest.mark.filterwarnings("ignore:All-NaN")
@pytest.mark.parametrize("name", BRANCHES)
def test_ranges_hold_what_branches_and_tables_give(name):
    held(BRANCHES[name], 2)


@each_model
def test_ranges_hold_the_rays_of_every_model(key):
    """In parts of the picture, many of them beyond its rim."""
    cam = camera(key, EXAMPLES[key][0])
    width, height = cam.raster.size
    rng = np.random.default_rng(2)
    corner = rng.uniform(-2, 1, (2, 100, 1)) + np.array((width, height))[:, None, None] * rng.uniform(size=(2, 100, 1))
    bounds = ranges(cam.model.recorded, [(low, low + 3) for low in corner])
    x, y = corner + 3 * rng.uniform(size=(2, 100, 20))
    rays = np.array(np.broadcast_arrays(*cam.model.recorded.evaluate(NUMPY, (x, y))))
    off = 1e-9 * np.maximum(1, np.abs(rays))
    for component, its_range, most in zip(rays, bounds, off, strict=True):
        inside = (its_range.low <= component + most) & (component <= its_range.high + most)
        assert (inside | np.isnan(rays[3])).all()
