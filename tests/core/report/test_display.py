"""Passes as pictures: what is near is light, what is nothing is black, and every number keeps its order."""

import numpy as np
import pytest

from camera_ray_caster.core.casting.passes import PASSES
from camera_ray_caster.core.report.display import displayed


def test_depth_is_white_where_it_is_nearest_and_black_where_there_is_nothing():
    colors, legend = displayed("depth", np.array([[2.0, 4.0, 6.0, np.inf, 1e10]]))
    assert np.allclose(colors[0, :, 0], [1, 0.55, 0.1, 0, 0], atol=1e-6)
    assert (colors == colors[..., :1]).all()
    assert legend == "white to dark: 2 to 6"


def test_a_wide_range_is_shown_by_its_logarithm():
    colors, legend = displayed("footprint", np.array([[1e-6, 1e-3, 1.0]]))
    assert np.allclose(colors[0, :, 0], [1, 0.55, 0.1], atol=1e-6)
    assert legend == "white to dark: 1e-06 to 1, logarithmic"


def test_directions_are_half_way_and_what_has_none_is_black():
    colors, _ = displayed("normal", np.array([[[1.0, 0, -1], [0, 0, 0]]]))
    assert np.array_equal(colors[0], np.array([[1, 0.5, 0], [0, 0, 0]], np.float32))


def test_each_index_has_a_color_of_its_own():
    colors, _ = displayed("shape_index", np.arange(-1, 300)[None])
    assert not colors[0, 0].any()
    apart = np.abs(colors[0, 1:, None] - colors[0, None, 1:]).max(axis=-1) + np.eye(300)
    assert apart.min() > 0.004  # more than a step of 8 bits


@pytest.mark.parametrize("key", PASSES)
@pytest.mark.parametrize("value", [0.0, -1.0, 0.3, 1e10, np.inf, np.nan])
def test_every_pass_of_any_value_is_a_picture(key, value):
    channels = PASSES[key].empty((1, 1), np.float64).reshape(-1).size
    colors, legend = displayed(key, np.full((3, 2, channels), value))
    assert colors.shape == (3, 2, 3)
    assert ((colors >= 0) & (colors <= 1)).all()
    assert legend


def test_distances_of_a_wide_range_are_even_in_their_inverse():
    colors, legend = displayed("depth", np.array([[2.0, 4.0], [20.0, np.inf]]))
    assert legend == "white to dark: 2 to 20, even in 1/distance"
    assert colors[..., 0] == pytest.approx(np.array([[1.0, 1 - 0.9 * 5 / 9], [0.1, 0.0]]))
    _, legend = displayed("distance", np.array([[2.0, 7.9]]))
    assert legend == "white to dark: 2 to 7.9"
