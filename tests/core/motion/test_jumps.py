"""Places that change at once, as constant interpolation between keys makes them, and very fast continuous motion."""

import numpy as np
import pytest

from camera_ray_caster.core.motion.evaluations import SHORTEST, measured, resolve

from ..camera.test_pixel_time import camera, shapes

FIRST, LAST, TOLERANCE = 1.0, 9.0, 0.1
WIDTH = 16.0
"""Pixels of the picture in a Blender unit."""


def at(x):
    """A camera at a place on the x axis, and a ball."""
    matrix = np.eye(4)
    matrix[0, 3] = x
    return camera({}, matrix), shapes(((0.2, 0.1, -5), 0.7))


def place_in(motion, frame):
    return motion.camera_at(frame).pose.eye[0]


@pytest.mark.cases(1)
@pytest.mark.parametrize("drift", [0.0, 0.02], ids=["rest", "drift"])
@pytest.mark.parametrize("keyed", [False, True])
def test_a_jump_is_found_to_its_accuracy_and_takes_few_evaluations(keyed, drift):
    jumps = np.array([2.3, 4.0, 6.7])
    true = lambda frame: 0.5 * np.searchsorted(jumps, frame, side="right") + drift * frame**2  # noqa: E731
    evaluate = lambda frame: at(true(frame))  # noqa: E731
    motion = resolve(evaluate, FIRST, LAST, TOLERANCE, 400, jumps.tolist() if keyed else ())
    assert not motion.unresolved
    assert len(motion.states) < (110 if keyed else 220)
    assert any(line.startswith("jumps: 3, the first at frame 2.") for line in motion.in_words())
    beside = [jump + step * SHORTEST for jump in jumps for step in (-1.01, 1.01)]
    for frame in (FIRST, *np.linspace(1.03, 8.97, 25), *beside, LAST):
        assert abs(place_in(motion, frame) - true(frame)) * WIDTH <= TOLERANCE, frame


def test_between_a_jump_and_its_evaluations_nothing_is_in_between():
    motion = resolve(lambda frame: at(3.0 if frame >= 4.3 else 0.0), FIRST, LAST, TOLERANCE, 200)
    for frame in np.linspace(4.3 - SHORTEST, 4.3 + SHORTEST, 41):
        assert place_in(motion, frame) in (0.0, 3.0), frame


def test_after_a_jump_at_the_end_the_last_frame_is_its_own():
    motion = resolve(lambda frame: at(1.0 if frame >= LAST else 0.0), FIRST, LAST, TOLERANCE, 200)
    assert not motion.unresolved
    assert place_in(motion, LAST) == 1
    assert place_in(motion, LAST - SHORTEST) == 0
    assert "jumps: 1" in motion.in_words()[1]


@pytest.mark.parametrize("last", [FIRST + SHORTEST / 4, FIRST + SHORTEST, FIRST + 3 * SHORTEST])
def test_fast_motion_is_followed_within_the_accuracy_of_jumps(last):
    """Back and forth by a unit within the whole range of times."""
    evaluate = lambda frame: at(np.sin(7 * (frame - FIRST) / (last - FIRST)))  # noqa: E731
    motion = resolve(evaluate, FIRST, last, TOLERANCE, 400)
    assert not motion.unresolved
    assert all(len(interval.frames) > 1 for interval in motion.intervals)
    assert measured(motion, evaluate, np.linspace(FIRST, last, 50)).measured <= 1.5 * TOLERANCE


@pytest.mark.parametrize("length", [0.05, 0.3, 0.9, 2.0, 5.0])
def test_a_fast_move_is_followed_or_said_to_be_a_jump(length):
    """From one place to another at constant speed, within some SHORTEST."""
    evaluate = lambda frame: at(np.clip((frame - 4.3) / (length * SHORTEST), 0, 1))  # noqa: E731
    motion = resolve(evaluate, FIRST, LAST, TOLERANCE, 400)
    motion = measured(motion, evaluate, np.linspace(4.3, 4.3 + length * SHORTEST, 50))
    is_reported = any(line.startswith(("jumps: ", "NOT RESOLVED: ")) for line in motion.in_words())
    assert is_reported or motion.measured <= 1.5 * TOLERANCE
    assert abs(place_in(motion, 4.3 + (length + 1) * SHORTEST) - 1) * WIDTH <= TOLERANCE
