"""The choice of evaluations by what surfaces look like: colors that change, indices that jump, events between keys."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.motion.evaluations import APPEARANCE, SHORTEST, measured, resolve
from camera_ray_caster.core.records import SPHERE, Lights

from ..cameras.model_examples import camera
from ..errors.extreme_cases import shapes_of

FIRST, LAST = 1.0, 9.0
AT = np.random.default_rng(4).uniform(FIRST, LAST, 40)


def scene(frame, **looks):
    """A ball that stands still before a camera that does, too."""
    return camera("PERSP"), replace(shapes_of([(SPHERE, (0, 0, -5), 1.0)]), **looks)


def gray(value):
    return {"color": np.full((1, 4), value, np.float32)}


def lamp(strength, x):
    return {"lights": Lights(np.array([[x, 3.0, 0.0]]), np.array([False]), np.full((1, 3), strength))}


@pytest.mark.parametrize(
    "look",
    [
        lambda frame: gray(0.5 + 0.5 * np.sin(frame)),
        lambda frame: {"world_color": (0.5 + 0.5 * np.sin(2 * frame), 0.0, 0.0, 1.0)},
        lambda frame: lamp(500 + 400 * np.sin(frame), 3.0),
        lambda frame: lamp(500.0, 3 * np.cos(frame)),
    ],
)
def test_what_changes_color_is_evaluated_until_a_step_of_eight_bits_holds(look):
    evaluate = lambda frame: scene(frame, **look(frame))  # noqa: E731
    motion = measured(resolve(evaluate, FIRST, LAST, 0.1, 1000), evaluate, AT)
    assert not motion.unresolved
    assert motion.estimated == motion.measured == 0
    estimated, off = motion.appearance
    assert 0 < estimated <= APPEARANCE
    assert 0 < off <= 1.5 * APPEARANCE
    assert 12 < len(motion.states) < 200
    assert "colors, lights and maps off by" in motion.in_words()[1]


@pytest.mark.parametrize("look", [gray, lambda value: {"object_index": np.array([value], np.int32)}])
def test_the_moment_of_a_step_is_found(look):
    """A color or an index that jumps between two frames, as a driver may make it; it is known on both sides."""
    moment = 4.3
    evaluate = lambda frame: scene(frame, **look(frame >= moment))  # noqa: E731
    motion = resolve(evaluate, FIRST, LAST, 0.1, 200)
    assert not motion.unresolved
    (name,) = look(0)
    for frame in (FIRST, 4.0, moment - 2 * SHORTEST, moment + 2 * SHORTEST, 4.9, LAST):
        assert (getattr(motion.shapes_at(frame), name) == (frame >= moment)).all(), frame


def test_a_still_scene_says_nothing_of_colors():
    motion = measured(resolve(scene, FIRST, LAST, 0.1, 100), scene, AT)
    assert motion.appearance == (0.0, 0.0)
    assert len(motion.in_words()) == 1


def test_of_a_long_range_the_frames_with_keys_are_evaluated():
    """An index that has another value for 14 of 100 frames, which the first probes miss, and keys where it changes."""
    evaluate = lambda frame: scene(frame, object_index=np.array([42 <= frame < 56], np.int32))  # noqa: E731
    motion = resolve(evaluate, 1.0, 100.0, 0.1, 256, keys=[42.0, 56.0, 56.0, 1000.0])
    assert not motion.unresolved
    for frame in (41.9, 42.0, 50.0, 55.9, 56.1):
        assert motion.shapes_at(frame).object_index == (42 <= frame < 56), frame
