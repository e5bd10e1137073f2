"""The shader's picture: the shapes and distances of our cast, for every model, in a browser with WebGL in software."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.web.page import example
from camera_ray_caster.core.web.room import BALLS, EYE, SCENE

from .programs import KEYS

NOTHING, NO_RAY = 254, 255
NEAR, ROUNDING = 1e-4, 16 * 2**-24 * 8
"""Of the distance: what float32 may change; and sixteen roundings of places eight units from the middle of the room."""
SLOWEST = 200
"""Milliseconds of a picture of 320 x 180 in software: five frames a second."""
TRIES = 20
"""At most, until a measurement is not of a busy machine; each is the mean of five pictures."""

pytestmark = pytest.mark.full


def room_from(eye):
    """The room as shapes for the caster: balls, then walls; ``eye`` is the origin."""
    _, centers, radii, _ = zip(*BALLS, strict=True)
    walls = [(np.subtract(wall["center"], eye), np.transpose((wall["u"], wall["v"]))) for wall in SCENE["rectangles"]]
    return crc.join(crc.spheres(np.subtract(centers, eye), radii), *(crc.planes(*wall) for wall in walls))


def even(index):
    """Where all neighbors of a pixel have its index: it is at least half a pixel from an edge."""
    around = np.pad(index, 1, mode="edge")
    rows, columns = index.shape
    views = [around[i : i + rows, k : k + columns] for i in range(3) for k in range(3)]
    return np.all([view == index for view in views], axis=0)


@pytest.mark.parametrize("key", KEYS)
def test_the_shader_sees_what_our_cast_sees(opened, key):
    camera = example(crc.models()[key], clip_start=1e-4, clip_end=1e4)
    images = crc.cast(camera, room_from((0.0, EYE, 3.0)), passes=("shape_index", "distance", "valid"))
    expected = np.where(images["valid"], np.where(images["shape_index"] < 0, NOTHING, images["shape_index"]), NO_RAY)
    text = opened.execute_script("return window.lesson.indices(arguments[0]).flat().join(' ')", key)
    seen = np.array(text.split(), np.float64).reshape(*expected.shape, 2)
    sure = even(expected)
    assert sure.mean() > 0.5
    assert np.array_equal(seen[..., 0][sure], expected[sure])
    hit = sure & (expected < NOTHING)
    assert (np.abs(seen[..., 1] - images["distance"])[hit] <= NEAR * images["distance"][hit] + ROUNDING).all()


@pytest.mark.parametrize("key", KEYS)
def test_software_draws_five_pictures_a_second(opened, key):
    measured = (opened.execute_script("return window.lesson.speed(arguments[0], 320)", key) for _ in range(TRIES))
    assert any(milliseconds <= SLOWEST for milliseconds in measured)
