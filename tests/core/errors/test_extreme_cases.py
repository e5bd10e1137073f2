"""The extreme cases against the exact picture: each hit and miss, and each number within its own bound."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mpmath import cos, mpf, pi, sin

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.motion.evaluations import resolve
from camera_ray_caster.core.records import PLANE, SPHERE, InputError

from ..truth import truth
from .condition import TIGHT, condition
from .decisions import decision
from .extreme_cases import CASES, STIFF, TURN, Case, shapes_of

PASSES = (
    "depth", "distance", "position", "normal", "shape_index", "valid",
    "distance_bound", "position_bound", "normal_bound",
)  # fmt: skip
MOST = 49
"""Pixels of a case that are compared: the exact picture takes a millisecond a pixel and shape."""

ARRAYS = ("kind", "center", "axes", "object_index", "material_index", "color", "name_index")

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


def at_edges(images, camera, x, y):
    """Where rounding may decide between hit and miss, as at an edge of some shape: bool, of pixel coordinates (n,)."""
    undecided = np.zeros(len(x), bool)
    for k in range(len(images.plan.shapes)):
        value, bound = decision(camera, images.plan.target.placed, k, x[None], y[None])
        undecided |= (np.abs(value) <= bound)[0]
    return undecided


def at_clip(shapes, camera, ray):
    """Whether rounding may decide that something lies within the clip range."""
    ends = [t for k in range(len(shapes)) for t in truth.crossings(shapes, k, ray)[0]]
    return any(abs(t - clip) <= 64 * EPS * clip for t in ends for clip in (camera.clip_start, camera.clip_end))


@each_case
def test_hits_and_misses_are_the_exact_ones_and_numbers_lie_within_their_bounds(case):
    camera, shapes = case.camera, case.shapes
    images = cast(camera, shapes, passes=PASSES, dtype=np.float64)
    seen = images["shape_index"] >= 0
    for name in PASSES:
        assert not np.isnan(images[name]).any(), name
    pixels = sample(images)
    at = tuple(np.transpose(pixels))
    x_of, y_of = camera.raster.columns()[0, at[1]], camera.raster.rows()[at[0], 0]
    for pixel, x, y, at_edge in zip(pixels, x_of, y_of, at_edges(images, camera, x_of, y_of), strict=True):
        ray = truth.ray(case.raw, x, y)
        assert images["valid"][pixel] == (ray is not None), pixel
        if ray is None:
            continue
        is_open = at_edge or at_clip(shapes, camera, ray)
        exact = truth.nearest(shapes, ray, camera.clip_start, camera.clip_end)
        if seen[pixel] != (exact is not None):
            assert is_open, f"{pixel} is {'hit' if seen[pixel] else 'missed'}"
            continue
        if exact is None:
            continue
        if images["shape_index"][pixel] != exact.shape:
            other = truth.crossings(shapes, images["shape_index"][pixel], ray)[0]
            gap = min((abs(t * ray.length - exact.distance) for t in other), default=truth.mp.inf)
            assert gap <= images["distance_bound"][pixel] or is_open, pixel
            continue
        errors = {
            "distance": abs(exact.distance - truth.mp.mpf(images["distance"][pixel])),
            "position": truth.norm(truth.minus(exact.position, truth.exact(images["position"][pixel]))),
            "normal": truth.norm(truth.minus(exact.normal, truth.exact(images["normal"][pixel]))),
        }
        if is_open:
            errors.pop("normal")
        for name, error in errors.items():
            assert error <= images[name + "_bound"][pixel], f"{name} at {pixel}"
        assert abs(exact.t - truth.mp.mpf(images["depth"][pixel])) <= images["distance_bound"][pixel]
        if not is_open:
            assert images["distance_bound"][pixel] <= TIGHT * EPS * condition(case.raw, shapes, x, y), pixel


@pytest.mark.full
def test_a_million_spheres_at_one_point():
    """All hit at exactly the same t: the first counts, and none is lost on the way."""
    count, rows = 1_000_000, shapes_of([(SPHERE, (0, 0, -5), 2.0)])
    fields = {name: np.repeat(getattr(rows, name), count, axis=0) for name in ARRAYS}
    shapes = replace(rows, **fields)
    single, many = (
        cast(Case("", "", [], {"resolution_x": 1, "resolution_y": 1}).camera, s, passes=PASSES, dtype=np.float64)
        for s in (rows, shapes)
    )
    for name in PASSES:
        assert np.array_equal(single[name], many[name]), name


@pytest.mark.parametrize("axes", [
    pytest.param(np.diag([1.0, 0, 1]), id="an axis of length zero"),
    pytest.param(np.zeros((3, 3)), id="no axes"),
    pytest.param(np.array([[1, 2, 0], [2, 4, 0], [0, 0, 1.0]]), id="parallel axes"),
    pytest.param(TURN @ np.diag([1, 1, 0]) @ TURN.T, id="parallel but for rounding"),
    pytest.param(np.diag([1, np.nan, 1]), id="not a number"),
    pytest.param(np.eye(3) * 1e-160, id="squares vanish"),
    pytest.param(np.eye(3) * 1e160, id="squares overflow"),
])  # fmt: skip
@pytest.mark.parametrize("kind", [SPHERE, PLANE])
def test_what_cannot_be_cast_is_refused_by_name(kind, axes):
    shapes = shapes_of([(SPHERE, (0, 0, -5), 1.0), (kind, (0, 0, -5), axes)])
    with pytest.raises(InputError, match=r"'shape 1' (is flat|has a size)"):
        cast(Case("", "", []).camera, shapes)


def test_a_needle_is_not_called_flat():
    """Sheared, its three axes are nearly one line, although they do not lie in a plane."""
    needle = TURN @ np.diag([1, 1e-8, 1e-8]) @ TURN
    with pytest.raises(InputError, match=r"'shape 0' is 1e\+08 times as long as it is thick"):
        cast(Case("", "", []).camera, shapes_of([(SPHERE, (0, 0, -5), needle)]))


@pytest.mark.full
@pytest.mark.parametrize(("turns", "why"), STIFF.values(), ids=STIFF)
def test_stiff_motion_is_resolved_or_said_not_to_be(turns, why):
    """A bar that spins about the viewing axis: where it ends is known exactly at each time, the closed form turned."""

    def turned(frame):
        angle = 2 * mpf(turns) * mpf(float(frame)) * pi
        return np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]], float)

    def evaluate(frame):
        return camera, shapes_of([(PLANE, (0, 0, -5), turned(frame) @ np.diag([2.0, 0.2, 1.0]))])

    camera = Case("", "", [], {"resolution_x": 64, "resolution_y": 64}).camera
    motion = resolve(evaluate, 0.0, 1.0, tolerance=0.05, limit=2000)
    if abs(turns) > 1000:
        assert motion.unresolved, why
        return
    assert not motion.unresolved, why
    pixels = 32.0  # what the bar's end is from the axis, at most
    for frame in np.random.default_rng(5).uniform(0, 1, 40):
        away = np.abs(motion.shapes_at(frame).axes[0] - turned(frame) @ np.diag([2.0, 0.2, 1.0])).max()
        assert away / 2.0 * pixels <= 0.05, why
