"""The terms of a pixel's color: by hand geometry, and their product against the picture."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.lesson.lesson import lesson
from camera_ray_caster.core.lesson.light import MOST_LAMPS
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, Lights

from ..casting.test_cast import camera_at, random_shapes, shapes_of

WALL = shapes_of((INFINITE_PLANE, (0, 0, -2), 1.0))
MIDDLE = {"resolution_x": 33, "resolution_y": 33}
"""The ray of pixel 16, 16 is the axis."""


def color_of(shapes, column=16, row=16, **look):
    return dict(lesson(camera_at(**MIDDLE), shapes, column, row, **look).steps)["Color"]


def numbers(line):
    """The last vector of a line."""
    return np.array([float(number) for number in line.rsplit("(", 1)[1].rstrip(")").split(",")])


def test_each_lamps_share_by_hand():
    """A wall of color (0.5, 0.25, 1) at depth 2; the sun stands at cosine 0.8, the lamp 3 before it and 4 beside it."""
    lights = Lights(np.array([[0, 0.6, 0.8], [4, 0, 1]]), np.array([True, False]), np.array([[np.pi, 0, 2 * np.pi],
                    [100 * np.pi**2, 50 * np.pi**2, 0]]))  # fmt: skip
    color_lines = color_of(replace(WALL, lights=lights, world_color=(0.1, 0.2, 0.3, 1.0)))
    assert color_lines == (
        "material (0.5, 0.25, 1, 1)",
        "sun 1 towards (0, 0.6, 0.8), cosine 0.8, E = (3.14159, 0, 6.28319)",
        "  E cosine / pi = (0.8, 0, 1.6)",
        "point light 2 towards (0.8, 0, 0.6), cosine 0.6, distance = 5, P = (986.96, 493.48, 0)",
        "  P cosine / (4 pi² distance²) = (0.6, 0.3, 0)",
        "world, from all directions (0.1, 0.2, 0.3)",
        "light, of lamps and world (1.5, 0.5, 1.9)",
        "linear, material · light: (0.75, 0.125, 1.9, 1)",
    )


def test_without_lamps_there_is_a_headlight_and_without_a_hit_the_world():
    assert color_of(WALL)[1:3] == ("headlight along the ray, as there are no lamps: cosine 1", "  cosine = (1, 1, 1)")
    beside = replace(shapes_of((PLANE, (50, 0, -2), 1.0)), world_color=(0.1, 0.2, 0.3, 1.0))
    assert color_of(beside) == ("linear, of the world: (0.1, 0.2, 0.3, 1)",)


@pytest.mark.full
@pytest.mark.parametrize("count", [1, MOST_LAMPS, MOST_LAMPS + 1, 40])
@pytest.mark.parametrize("shading", ["MATERIAL", "GRID"])
def test_the_terms_make_the_color_of_the_picture(shading, count):
    """To the digits that are shown, and no lamp is left out."""
    rng = np.random.default_rng(count)
    is_sun = rng.random(count) < 0.5
    position = rng.normal(size=(count, 3))
    position = np.where(is_sun[:, None], position / np.linalg.norm(position, axis=1, keepdims=True), 9 * position)
    lights = Lights(position, is_sun, rng.uniform(0, 9, (count, 3)) * np.where(is_sun, 1, 900)[:, None])
    shapes = replace(random_shapes(rng, 60), lights=lights, world_color=(0.1, 0.2, 0.3, 1.0))
    images = cast(camera_at(**MIDDLE), shapes, passes=("combined", "shape_index"), dtype=np.float64, shading=shading)
    factors = set()
    for row, column in np.argwhere(images["shape_index"] >= 0)[::17]:
        color_lines = color_of(shapes, column, row, shading=shading)
        material, world, light, color = (
            numbers(next(line for line in color_lines if line.startswith(begin)))
            for begin in ("material", "world", "light", "linear")
        )
        shares = [numbers(line) for line in color_lines if line.startswith("  ") or "more lamps" in line]
        assert len(shares) == min(count, MOST_LAMPS + 1)
        assert light == pytest.approx(world + sum(shares), rel=1e-4)
        grid = [float(line.split()[1].rstrip(",")) for line in color_lines if line.startswith("grid")]
        assert color[:3] == pytest.approx(material[:3] * light * np.prod(grid), rel=1e-4)
        assert color == pytest.approx(images["combined"][row, column], rel=1e-5)
        factors.update(grid)
    assert factors == ({0.15, 1.0} if shading == "GRID" else set())
