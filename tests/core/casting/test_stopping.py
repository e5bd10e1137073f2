"""How long a cast goes on after it was told to stop: the time between the moments at which it listens.

In seconds of a processor, not of a clock: other programs do not count.
"""

import threading
from time import thread_time

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting import tiles
from camera_ray_caster.core.records import SPHERE, Cancelled

from ..cameras.model_examples import EXAMPLES
from ..cameras.model_examples import camera as camera_of
from ..shapes import meshes
from .test_cast import camera_at, shapes_of

HEARD = 0.3
"""Seconds within which a stop is heard."""


def many_spheres(count):
    centers = np.random.default_rng(1).uniform((-8, -8, -20), (8, 8, -8), (count, 3))
    return shapes_of(*((SPHERE, center, 0.2) for center in centers))


CASTS = {
    "4,096 samples": (256, 5, {"passes": "combined", "samples": 4096}),
    "samples of a large picture": (2048, 3000, {"passes": "combined", "samples": 16}),
    "a large picture": (6000, 50, {"passes": ("depth", "normal", "position", "object_index", "combined")}),
    "many shapes": (1024, 20_000, {"passes": "depth", "cull": False}),
}


def steps_of(monkeypatch, *scene, **request):
    """The seconds between the moments at which a cast listens that is stopped after a second of them."""
    began, steps = {}, []
    listen = tiles.Effort.listen

    def timed(effort):
        now, thread = thread_time(), threading.get_ident()
        steps.append(now - began.get(thread, 0.0))
        began[thread] = now
        if sum(steps) > 1:
            effort.stop()
        listen(effort)

    monkeypatch.setattr(tiles.Effort, "listen", timed)
    with pytest.raises(Cancelled):
        cast(*scene, threads=2, **request)
    return steps


def assert_heard(monkeypatch, *scene, **request):
    """The longest step is short enough, in one of three casts: what else the machine does can only lengthen it."""
    longest = []
    while not longest or (min(longest) + tiles.LISTEN >= HEARD and len(longest) < 3):
        with monkeypatch.context() as patch:
            longest.append(max(steps_of(patch, *scene, **request)))
    assert min(longest) + tiles.LISTEN < HEARD, longest


@pytest.mark.cases(1)
@pytest.mark.parametrize("case", CASTS)
def test_a_stop_is_heard_within_the_steps_of_a_cast(case, monkeypatch):
    size, count, request = CASTS[case]
    assert_heard(monkeypatch, camera_at(resolution_x=size, resolution_y=size), many_spheres(count), **request)


def test_a_stop_is_heard_between_triangles(monkeypatch):
    """Of a camera whose rays have an origin each, so that every triangle takes long."""
    size = {"resolution_x": 512, "resolution_y": 256}
    shapes = meshes.shapes_of((meshes.ball(100, 400, 3.0), (0, 0, -4), 1.0))
    assert_heard(monkeypatch, camera_of("STRIP", EXAMPLES["STRIP"][0] | size), shapes, passes="combined", samples=64)


def test_a_stop_is_heard_while_the_tiles_of_pixel_times_are_found(monkeypatch):
    """Those of 65,536 columns take many seconds, in which a picture said nothing."""
    monkeypatch.setattr(tiles, "LISTEN", 0.0)
    fractions = []

    def stop(fraction):
        fractions.append(fraction)
        return len(fractions) < 3

    with pytest.raises(Cancelled):
        list(tiles.listening([tiles.Tile(slice(0, 1), slice(k, k + 1)) for k in range(9)], stop))
    assert fractions == [0.0] * 3
    assert len(list(tiles.listening([tiles.Tile(slice(0, 1), slice(0, 1))], None))) == 1
