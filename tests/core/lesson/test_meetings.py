"""Boxes that the line of a ray misses are left out: it meets what it meets without them."""

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.lesson import meetings
from camera_ray_caster.core.library.shapes import mesh

from ..cameras.model_examples import camera

RNG = np.random.default_rng(36)


def test_a_line_through_a_point_of_a_box_passes_it_and_one_beside_it_does_not():
    half = RNG.uniform(0, 2, (3, 20_000)) * RNG.integers(0, 2, (3, 20_000))  # flat boxes and points, too
    inside = half * RNG.uniform(-1, 1, half.shape)
    along = RNG.normal(size=half.shape) * RNG.integers(0, 2, half.shape)
    at = inside - RNG.uniform(-1e3, 1e3, half.shape[1]) * along
    assert meetings._pass(at, along, half + 1e-12).all()
    corner, up = half * [[1.01], [1.01], [0]] + [[0.1], [0.1], [0]], np.array([[0.0], [0], [1]])
    assert not meetings._pass(corner, up, half).any()
    assert meetings._pass(corner, up, np.full((3, 1), np.inf)).all(), "endless"


@pytest.mark.parametrize("model", MODELS[:1] + MODELS[4:6], ids=lambda model: model.key)
def test_meetings_are_those_without_boxes(model, monkeypatch):
    """A wrinkled ground of 5,000 triangles, moved, stretched and turned: many lines graze it."""
    side = np.linspace(-3, 3, 51)
    x, y = np.meshgrid(side, side)
    points = np.stack((x, y, -4 + 0.2 * np.sin(7 * x) * np.cos(5 * y)), axis=-1).reshape(-1, 3)
    first = (np.arange(50)[:, None] * 51 + np.arange(50)).ravel()
    faces = np.concatenate((np.stack((first, first + 1, first + 52), 1), np.stack((first, first + 52, first + 51), 1)))
    shapes, cam = mesh(points, faces), camera(model.key, {})
    with np.errstate(all="ignore"):
        pixels = [(column, row) for column in range(3, 96, 11) for row in range(2, 54, 7)]
        rays = [[np.array([float(p) for p in v]) for v in cam.camera_rays(a + 0.5, b + 0.5)] for a, b in pixels]
    rays = [(o, d / np.linalg.norm(d)) for o, d in rays if np.isfinite(d).all()]
    with_boxes = [meetings.meetings(cam, shapes, *ray) for ray in rays]
    assert sum(map(len, with_boxes)) > 10
    monkeypatch.setattr(meetings, "SLACK", 1e9)
    assert [meetings.meetings(cam, shapes, *ray) for ray in rays] == with_boxes
