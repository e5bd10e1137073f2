"""The extreme cases against the exact picture: each hit and miss, and each number within its own bound."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core.bounds import decision
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.records import SPHERE

from . import truth
from .extreme_cases import CASES

PASSES = (
    "depth", "distance", "position", "normal", "shape_index", "valid",
    "distance_bound", "position_bound", "normal_bound",
)  # fmt: skip
MOST = 90
"""Pixels of a case that are compared: the exact picture takes a millisecond a pixel and shape."""

TIGHT = 100
"""What a bound may be at most, over the unit roundoff times the condition number."""

each_case = pytest.mark.parametrize(
    "case",
    [
        pytest.param(case, id=f"{i} {case.name}", marks=[pytest.mark.xfail(reason=case.not_held)] * bool(case.not_held))
        for i, case in enumerate(CASES)
    ],
)


def sample(images):
    """Pixels all over the picture, the corners among them, as (row, column)."""
    shape = images["valid"].shape
    flat = np.unique(np.linspace(0, shape[0] * shape[1] - 1, MOST).round().astype(int))
    return list(zip(*np.unravel_index(flat, shape), strict=True))


def is_open(images, camera, pixel, x, y, ray):
    """Whether rounding may decide between hit and miss at a pixel: at an edge of some shape, or of the clip range."""
    for k in range(len(images.plan.shapes)):
        value, bound = decision(images.plan, k, np.array([[x]]), np.array([[y]]))
        if abs(value[0, 0]) <= bound[0, 0]:
            return True
    ends = [t for k in range(len(images.plan.shapes)) for t in truth.crossings(images.plan.shapes, k, ray)[0]]
    return any(abs(t - clip) <= 64 * EPS * clip for t in ends for clip in (camera.clip_start, camera.clip_end))


def condition(hit, ray, shapes):
    """How far the hit moves, in distance, when ray and shape move by a unit of their own size."""
    k = hit.shape
    to_shape = truth.inverse(truth.exact(shapes.axes[k]))
    away = truth.minus(truth.exact(shapes.centre[k]), ray.origin)
    q = truth.times(to_shape, truth.minus(hit.position, truth.exact(shapes.centre[k])))
    d = truth.times(to_shape, ray.direction)
    rows = to_shape if shapes.kind[k] == SPHERE else to_shape[2:]
    slope = abs(truth.dot(q, d) if shapes.kind[k] == SPHERE else d[2])
    size = truth.mp.sqrt(sum(truth.dot(row, row) for row in rows))
    skew = truth.mp.mpf(1)
    for axis in truth.columns(truth.exact(shapes.axes[k])):
        skew *= truth.norm(axis)
    skew *= abs(truth.dot(to_shape[0], truth.cross(to_shape[1], to_shape[2])))
    reach = hit.distance + truth.norm(away) + truth.norm(ray.origin)
    return float(ray.length * size * reach * min(skew, 40) / slope + hit.distance)


@each_case
def test_hits_and_misses_are_the_exact_ones_and_numbers_lie_within_their_bounds(case):
    camera, shapes = case.camera, case.shapes
    images = cast(camera, shapes, PASSES, np.float64)
    seen = images["shape_index"] >= 0
    for name in PASSES:
        assert not np.isnan(images[name]).any(), name
    rows, columns = camera.raster.rows()[:, 0], camera.raster.columns()[0]
    for pixel in sample(images):
        x, y = columns[pixel[1]], rows[pixel[0]]
        ray = truth.ray(case.raw, x, y)
        assert images["valid"][pixel] == (ray is not None), pixel
        if ray is None:
            continue
        exact = truth.nearest(shapes, ray, camera.clip_start, camera.clip_end)
        if seen[pixel] != (exact is not None):
            assert is_open(images, camera, pixel, x, y, ray), f"{pixel} is {'hit' if seen[pixel] else 'missed'}"
            continue
        if exact is None:
            continue
        if images["shape_index"][pixel] != exact.shape:
            other = truth.crossings(shapes, images["shape_index"][pixel], ray)[0]
            gap = min((abs(t * ray.length - exact.distance) for t in other), default=truth.mp.inf)
            assert gap <= images["distance_bound"][pixel] or is_open(images, camera, pixel, x, y, ray), pixel
            continue
        errors = {
            "distance": abs(exact.distance - truth.mp.mpf(images["distance"][pixel])),
            "position": truth.norm(truth.minus(exact.position, truth.exact(images["position"][pixel]))),
            "normal": truth.norm(truth.minus(exact.normal, truth.exact(images["normal"][pixel]))),
        }
        if is_open(images, camera, pixel, x, y, ray):
            errors.pop("normal")
        for name, error in errors.items():
            assert error <= images[name + "_bound"][pixel], f"{name} at {pixel}"
        assert abs(exact.t - truth.mp.mpf(images["depth"][pixel])) <= images["distance_bound"][pixel]
        if camera.model.planar:
            limit = TIGHT * EPS * condition(exact, ray, shapes)
            assert images["distance_bound"][pixel] <= limit or is_open(images, camera, pixel, x, y, ray), pixel
