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


@pytest.mark.parametrize("case", CASTS)
def test_a_stop_is_heard_within_the_steps_of_a_cast(case, monkeypatch):
    size, count, request = CASTS[case]
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
        cast(camera_at(resolution_x=size, resolution_y=size), many_spheres(count), threads=2, **request)
    assert max(steps) + tiles.LISTEN < HEARD, max(steps)
