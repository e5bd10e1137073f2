"""Bounds that are right could be huge: for every camera model they are small multiples of what cannot be avoided."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS

from ..cameras.model_examples import EXAMPLES, camera, raw_of
from .condition import TIGHT, condition
from .extreme_cases import around, shapes_of

GRID = 5
"""Pixels along each side of an example's picture that are held against the exact one."""

USUAL = 28
"""What half of a model's bounds stay below, in the unit of TIGHT: measured are 7 to 22, and 25 of the real lens, whose
polynomials are compared with a trace that rounds, too.
"""


@cache
def factors(key):
    """The bounds of distances over the unit roundoff and the condition, of all examples, shapes all around the eye."""
    ratios = []
    for settings in EXAMPLES[key]:
        raw, cam = raw_of(key, settings), camera(key, settings)
        shapes = shapes_of([(kind, np.add(center, cam.pose.eye), axes) for kind, center, axes in around()])
        images = cast(cam, shapes, passes=("shape_index", "distance_bound"), dtype=np.float64)
        rows, columns = (np.unique(np.linspace(0, side - 1, GRID).round().astype(int)) for side in cam.raster.shape)
        for j, i in np.argwhere(images["shape_index"][np.ix_(rows, columns)] >= 0):
            pixel = rows[j], columns[i]
            moved = condition(raw, shapes, cam.raster.columns()[0, pixel[1]], cam.raster.rows()[pixel[0], 0])
            if moved is not None:
                ratios.append(images["distance_bound"][pixel] / EPS / moved)
    return np.array(ratios)


def assert_tight(ratios):
    """Such factors are those of tight bounds."""
    assert len(ratios) >= 9
    assert 1 < np.median(ratios) <= USUAL
    assert ratios.max() <= TIGHT


@pytest.mark.filterwarnings("ignore:Descending")  # the order of coefficients that every mpmath knows
@pytest.mark.parametrize("key", [model.key for model in MODELS])
def test_bounds_are_small_multiples_of_roundoff_times_condition(key):
    assert_tight(factors(key))


@pytest.mark.parametrize("key", ["PERSP", "MIRRORBALL", "STRIP"])
def test_a_bound_that_is_four_times_as_large_is_found(key):
    ratios = factors(key)
    assert_tight(ratios)
    with pytest.raises(AssertionError):
        assert_tight(4 * ratios)
