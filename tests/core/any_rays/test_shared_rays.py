"""Rays that threads share: the bits of one thread, whatever is asked of them."""

from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays import door
from camera_ray_caster.core.maths import speed
from camera_ray_caster.core.motion.evaluations import resolve

from .test_cast_rays import PASSES, Falling, scene
from .test_own_times import SCENES

RANDOM = np.random.default_rng(6)
ORIGINS, DIRECTIONS = RANDOM.uniform(-3, 3, (3000, 3)), RANDOM.normal(size=(3000, 3))


@pytest.fixture
def pools(monkeypatch):
    """The sizes of the pools of threads, which are made from some ten rays on."""
    sizes, make = [], speed.ThreadPoolExecutor
    monkeypatch.setattr(door, "SHARED_RAYS", 4)
    monkeypatch.setattr(speed, "ThreadPoolExecutor", lambda size: sizes.append(size) or make(size))
    return sizes


def moving():
    """A mesh that bends, another that moves, and a floor."""
    camera = crc.camera("PERSP", (8, 8))
    floor = crc.planes((0, 0, -1.2), [[3, 0], [0, 3], [0, 0]])

    def at(frame):
        return camera, crc.join(floor, *SCENES["a mesh that bends"](frame))

    return replace(at(0.0)[1], motion=resolve(at, 0.0, 1.0, 0.1, 64)), RANDOM.uniform(0, 1, len(ORIGINS))


@pytest.mark.parametrize(
    ("origins", "shapes", "times"), [
        (ORIGINS, scene(), None),
        (ORIGINS[0] + 0.001 * ORIGINS, scene(), None),
        (ORIGINS, crc.spheres(ORIGINS[:9], 0.8), None),
        (ORIGINS, *moving()),
    ],
    ids=["random", "near each other", "spheres", "times"],
)  # fmt: skip
def test_many_threads_give_the_bits_of_one(pools, origins, shapes, times):
    def results(threads):
        shared = {"times": times, "threads": threads}
        hits = crc.cast_rays(origins, DIRECTIONS, replace(shapes), passes=PASSES, **shared)
        every = crc.cast_rays(origins, DIRECTIONS, replace(shapes), passes=PASSES, all_hits=True, **shared)
        hidden = crc.occluded(origins, origins + DIRECTIONS, replace(shapes), **shared)
        return {**hits, "hidden": hidden, **{f"all {name}": values for name, values in every.items()}}

    alone = results(1)
    assert not pools
    shared = results(5)
    assert pools == [5, 5, 5]
    assert 100 < np.count_nonzero(alone["hidden"]) < len(DIRECTIONS) - 100
    for name, values in alone.items():
        assert values.tobytes() == shared[name].tobytes(), name


def test_few_rays_start_no_thread(monkeypatch):
    monkeypatch.delattr(speed, "ThreadPoolExecutor")
    crc.cast_rays(ORIGINS, DIRECTIONS, scene(), threads=64)


def test_shapes_made_at_each_time_are_cast_by_one_thread(pools):
    shapes = replace(Falling().shapes_at(0.0), motion=Falling())
    crc.cast_rays(ORIGINS, DIRECTIONS, shapes, times=1.0, threads=4)
    assert not pools


def test_an_error_of_a_thread_is_that_of_the_cast(pools, monkeypatch):
    write = door.write_nearest

    def refuse(shapes, origin, *rays):
        if (origin[:, 0] == ORIGINS[2000]).all():
            raise crc.InputError("the third share")
        write(shapes, origin, *rays)

    monkeypatch.setattr(door, "write_nearest", refuse)
    with pytest.raises(crc.InputError, match="the third share"):
        crc.cast_rays(ORIGINS, DIRECTIONS, scene(), threads=3)


def test_numbers_of_threads_are_refused():
    with pytest.raises(crc.InputError, match="threads"):
        crc.occluded(ORIGINS, DIRECTIONS, scene(), threads=0)
