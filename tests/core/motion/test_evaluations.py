"""The choice of evaluations by what surfaces look like: colors that change, indices that jump, events between keys."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.cameras.parts.aperture import Aperture
from camera_ray_caster.core.motion.evaluations import APPEARANCE, SHORTEST, measured, resolve
from camera_ray_caster.core.records import PLANE, SPHERE, Lights

from ..camera.test_pixel_time import turn
from ..cameras.model_examples import camera
from ..errors.extreme_cases import shapes_of
from ..shapes.meshes import grid
from ..shapes.meshes import shapes_of as meshes

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
    assert "colors, lights, maps, clipping and focus off by" in motion.in_words()[1]


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


def shaken(frame):
    """A number between -1 and 1 that no polynomial of degree 3 follows for long."""
    return np.sin(5 * frame)


def off_by(evaluate, point, **most):
    """The largest distance in pixels between where a point of the scene, given by a function of shapes, is seen in the
    interpolated and in the true scene; and the motion.
    """
    motion = measured(resolve(evaluate, FIRST, FIRST + 2, 0.1, 1000), evaluate, AT[:0])
    assert not motion.unresolved
    both = [[cam.project(point(true)) for cam, true in (motion.at(f), evaluate(f))] for f in np.linspace(FIRST, 3, 60)]
    return np.hypot(*np.diff(both, axis=1)[:, 0].reshape(-1, 2).T).max(), motion


@pytest.mark.parametrize("scale", [1.0, 0.01, 100.0])
def test_a_mesh_is_followed_at_its_ends_whatever_its_object_is_scaled_by(scale):
    """A blade whose object's axes are much shorter, or longer, than it is itself."""
    blade = grid(1, 1, lambda u, v: ((6 * u - 3) / scale, (0.8 * v - 0.4) / scale, 0 * u))
    evaluate = lambda frame: (camera("PERSP"), meshes((blade, (0, 0, -9), scale * turn(0.4 * shaken(frame)))))  # noqa: E731
    error, motion = off_by(evaluate, lambda shapes: (shapes.center + shapes.axes @ (3.0 / scale, 0.4 / scale, 0)))
    assert error < 0.2
    assert 20 < len(motion.states) < 200


@pytest.mark.parametrize("floor", [[], [(PLANE, (3000, 0, -50), 1e4)]])
def test_the_camera_is_followed_where_no_shape_begins_or_ends_in_view(floor):
    """Nothing at all, or a plane that fills the picture."""

    def evaluate(frame):
        still = camera("PERSP")
        return replace(still, pose=replace(still.pose, basis=turn(0.03 * shaken(frame), 0))), shapes_of(floor)

    error, motion = off_by(evaluate, lambda shapes: np.array([[0.0, 0.0, -50.0]]))
    assert error < 0.2
    assert 20 < len(motion.states) < 200


def test_a_shape_larger_than_the_view_is_followed_where_it_is_seen():
    tilted = lambda frame: shapes_of([(PLANE, (3000, 0, -50), 1e4 * turn(0.002 * shaken(frame), 1))])  # noqa: E731

    def seen(shapes):  # the point of the plane that is 3000 from its middle, along its first axis
        return shapes.center + shapes.axes @ (-0.3, 0.0, 0.0)

    error, motion = off_by(lambda frame: (camera("PERSP"), tilted(frame)), seen)
    assert error < 0.2
    assert 20 < len(motion.states) < 200


def test_clipping_and_focus_are_interpolated():
    def evaluate(frame):
        lens = Aperture(radius=0.1, focus=5 + shaken(frame))
        return replace(camera("PERSP"), clip_start=0.1 * frame, clip_end=100 * frame, aperture=lens), shapes_of([])

    motion = resolve(evaluate, FIRST, LAST, 0.1, 1000)
    assert not motion.unresolved
    for frame in AT:
        between, truth = motion.camera_at(frame), evaluate(frame)[0]
        assert between.clip_start == pytest.approx(truth.clip_start, rel=1e-9)
        assert between.clip_end == pytest.approx(truth.clip_end, rel=1e-9)
        assert between.aperture.focus == pytest.approx(truth.aperture.focus, rel=2 * APPEARANCE)


def test_the_moment_at_which_an_aperture_opens_is_found():
    moment, wide = 4.3, Aperture(radius=0.1, focus=5.0)
    evaluate = lambda frame: (replace(camera("PERSP"), aperture=wide if frame >= moment else None), shapes_of([]))  # noqa: E731
    motion = resolve(evaluate, FIRST, LAST, 0.1, 200)
    for frame in (FIRST, moment - 2 * SHORTEST, moment + 2 * SHORTEST, LAST):
        assert (motion.camera_at(frame).aperture is not None) == (frame >= moment), frame


def test_a_lamp_is_followed_by_what_it_lights_however_far_the_eye_is():
    def evaluate(frame):
        far = replace(camera("PERSP"), pose=replace(camera("PERSP").pose, eye=np.array([0.0, 0.0, 5000.0])))
        return far, replace(shapes_of([(SPHERE, (0, 0, -5), 1.0)]), **lamp(500.0, 3 * shaken(frame)))

    motion = resolve(evaluate, FIRST, LAST, 0.1, 1000)
    places = np.array([(motion.shapes_at(f).lights.position - evaluate(f)[1].lights.position)[0, 0] for f in AT])
    assert np.abs(places).max() < 0.05
    assert len(motion.states) > 60


@pytest.mark.parametrize("last", [10.0, 300.0])
def test_keys_are_evaluated_beside_whole_frames_and_spread_if_they_are_too_many(last):
    """Hidden between two keys within a frame; and a key on every frame of 300, of which some are within the event."""
    keys = [9.4, 9.6] if last == 10 else np.arange(1.0, 301).tolist()
    from_, to = (9.4, 9.6) if last == 10 else (120.0, 180.0)
    evaluate = lambda frame: scene(frame, object_index=np.array([from_ <= frame < to], np.int32))  # noqa: E731
    motion = resolve(evaluate, 9.0 if last == 10 else 1.0, last, 0.1, 256, keys)
    for frame in (from_ + 0.01, (from_ + to) / 2, to - 0.01, to + 0.01):
        assert motion.shapes_at(frame).object_index == (from_ <= frame < to), frame
