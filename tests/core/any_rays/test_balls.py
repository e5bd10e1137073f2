"""Which rays are left out before the exact test: none that hits, whatever its length, however near its tangent."""

from fractions import Fraction

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays.balls import may_meet, unit_directions
from camera_ray_caster.core.maths.speed import Scratch

MIDDLE, RADIUS = np.array([3.0, -1.0, 2.0]), 0.75


def hits(origin, direction):
    """Whether a ray meets the ball, in exact arithmetic."""
    to = [Fraction(m) - Fraction(o) for m, o in zip(MIDDLE.tolist(), origin.tolist(), strict=True)]
    d = [Fraction(number) for number in direction.tolist()]
    b, a, c = (sum(x * y for x, y in zip(*pair, strict=True)) for pair in ((to, d), (d, d), (to, to)))
    c -= Fraction(RADIUS) ** 2
    return c <= 0 or (b >= 0 and b * b >= a * c)


@pytest.mark.parametrize("away", [0.0, 2.0, 100.0])
def test_no_ray_that_hits_is_left_out_and_few_others_stay(away):
    random, count = np.random.default_rng(3), 600
    ahead = unit_directions(random.normal(size=(3, count)))
    aside = unit_directions(np.cross(ahead, random.normal(size=(3, count)), axis=0))
    beside = RADIUS * (1 + random.choice([-1, 1], count) * 10.0 ** random.uniform(-16, -0.5, count))
    origin = MIDDLE[:, None] + beside * aside - away * ahead
    power = random.uniform(-300, 300, count)
    with np.errstate(over="ignore"):
        kept = may_meet(MIDDLE, RADIUS, origin, unit_directions(ahead * 10.0**power), Scratch())
    true = np.array([hits(*ray) for ray in zip(origin.T, (ahead * 10.0**power).T, strict=True)])
    assert kept[true].all()
    assert 100 < true.sum() < 500
    clear = (np.abs(power) < 140) & (beside**2 > RADIUS**2 * (1 + 1e-6) + 2e-9 * away**2)
    assert clear.sum() > 20
    assert not kept[clear].any()


def test_many_rays_see_what_each_sees_alone():
    """Few rays are tested at all bodies, without their balls."""
    random = np.random.default_rng(4)
    shapes = crc.join(
        crc.spheres(random.uniform(-2, 2, (6, 3)), random.uniform(0.1, 0.8, 6)),
        crc.planes((1, 0, 0), [[1, 0.2], [0.1, 0.4], [0.3, 1]]), crc.planes((0, 0, -2), infinite=True),
    )  # fmt: skip
    for origin in (random.uniform(-3, 3, (2000, 3)), np.array([3.0, 1.0, 0.5])):
        direction = random.normal(size=(2000, 3))
        many = crc.cast_rays(origin, direction, shapes, passes=("depth", "normal", "shape_index"))
        for k in range(0, 2000, 100):
            some = slice(k, k + 100)
            few = crc.cast_rays(
                origin[some] if origin.ndim > 1 else origin, direction[some], shapes, passes=tuple(many)
            )
            for name, image in few.items():
                assert image.tobytes() == many[name][some].tobytes()
