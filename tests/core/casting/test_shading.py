"""The combined pass: light by hand geometry, and what lies where nothing is hit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS32
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE, Lights

from ..cameras.model_examples import camera as camera_of
from .test_cast import camera_at, shapes_of

WORLD = np.float32([0.1, 0.2, 0.3, 1.0])


def test_sun_point_light_and_headlight_by_hand():
    wall = (INFINITE_PLANE, (0, 0, -2), 1.0)
    color = np.float32([0.5, 0.25, 1.0])
    middle = 16, 16
    sun = Lights(np.array([[0.0, 0.6, 0.8]]), np.array([True]), np.array([[np.pi, np.pi, np.pi]]))
    assert cast(camera_at(), shapes_of(wall, lights=sun), passes=("combined",))["combined"][middle] == pytest.approx(
        [*(0.8 * color), 1.0], rel=8 * EPS32
    )
    point = Lights(np.array([[0.0, 0.0, 1.0]]), np.array([False]), np.full((1, 3), 36 * np.pi**2))
    assert cast(camera_at(), shapes_of(wall, lights=point), passes=("combined",))["combined"][middle] == pytest.approx(
        [*color, 1.0], rel=8 * EPS32
    )
    head = cast(camera_at(), shapes_of(wall), passes=("combined", "ray_direction"), dtype=np.float64)
    assert head["combined"][..., 0] == pytest.approx(0.5 * -head["ray_direction"][..., 2])


def test_the_grid_draws_lines_of_constant_uv():
    square = shapes_of((PLANE, (0, 0, -1), 1.0))
    images = cast(camera_at(), square, passes=("combined", "uv"), dtype=np.float64, shading="GRID")
    off_line = np.abs(images["uv"][..., 0] * 24 - np.rint(images["uv"][..., 0] * 24)) > 0.06
    off_line &= np.abs(images["uv"][..., 1] * 12 - np.rint(images["uv"][..., 1] * 12)) > 0.06
    light = images["combined"][..., 0] / cast(camera_at(), square, passes=("combined",))["combined"][..., 0]
    assert light[off_line] == pytest.approx(1.0, rel=1e-6)
    assert light[~off_line] == pytest.approx(0.15, rel=1e-6)


@pytest.mark.parametrize("shading", ["MATERIAL", "GRID"])
def test_the_worlds_color_lights_each_channel_by_its_own(shading):
    """A square seen straight on is lit by 1 and the world: color times both, or 0.15 of that on a line."""
    square = replace(shapes_of((PLANE, (0, 0, -2), 1.0)), world_color=WORLD)
    images = cast(camera_at(), square, passes=("combined", "ray_direction", "uv"), dtype=np.float64, shading=shading)
    hit = images["uv"].any(axis=-1)
    cells = images["uv"] * (24, 12, 0)
    on_line = (np.abs(cells - np.rint(cells))[..., :2] < 0.06).any(axis=-1) & (shading == "GRID")
    light = -images["ray_direction"][..., 2:] + WORLD[:3].astype(float)
    expected = np.float32([0.5, 0.25, 1.0]) * light * np.where(on_line, 0.15, 1.0)[..., None]
    assert images["combined"][hit][:, :3] == pytest.approx(expected[hit], rel=1e-14)
    assert (images["combined"][~hit] == WORLD).all()
    assert 0 < hit.sum() < hit.size


def test_what_has_no_ray_is_transparent_black():
    camera = camera_of("FISHEYE_EQUIDISTANT", {"fisheye_fov": 1.5, "resolution_x": 40, "resolution_y": 40})
    images = cast(
        camera, replace(shapes_of((SPHERE, (0, 0, -5), 1.0)), world_color=WORLD), passes=("combined", "valid")
    )
    assert 0 < images["valid"].sum() < images["valid"].size
    assert (images["combined"][~images["valid"]] == 0).all()
    assert (images["combined"][images["valid"]][:, 3] == 1).all()
