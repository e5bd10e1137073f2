"""A scene as one record: camera and shapes, and what both refer to at other times."""

from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.motion.evaluations import Motion

CAMERA = crc.camera("ORTHO", (16, 12), ortho_scale=4.0)
SHAPES = crc.planes((0.0, 0.0, -5.0), [[1, 0], [0, 1], [0, 0]])
RIGHT = replace(SHAPES, center=SHAPES.center + np.array((0.5, 0.0, 0.0)))
UP = replace(CAMERA, pose=replace(CAMERA.pose, eye=np.array((0.0, 0.25, 0.0))))


def flow(*scene):
    images = crc.cast(*scene, passes=("flow_forward", "shape_index"), dtype=np.float64)
    return np.unique(images["flow_forward"][images["shape_index"] == 0], axis=0)


def test_the_next_frame_of_camera_and_shapes_is_another_scene():
    """One unit is 4 pixels: the shape goes right by 2, and the camera up by 1, so that the shape goes down."""
    scene = crc.Scene(CAMERA, SHAPES).with_timeline(next=crc.Scene(UP, RIGHT))
    np.testing.assert_allclose(flow(scene), [(2.0, -1.0)], rtol=0, atol=1e-12)
    np.testing.assert_array_equal(flow(scene.camera, scene.shapes), flow(scene))
    assert scene.previous is None
    assert crc.Scene(CAMERA, SHAPES).next is None


def test_camera_and_shapes_of_two_readings_have_each_their_own_next_frame():
    first = crc.Scene(CAMERA, SHAPES).with_timeline(next=crc.Scene(UP, SHAPES))
    second = crc.Scene(CAMERA, SHAPES).with_timeline(next=crc.Scene(CAMERA, RIGHT))
    np.testing.assert_allclose(flow(first.camera, second.shapes), [(2.0, -1.0)], rtol=0, atol=1e-12)
    np.testing.assert_allclose(flow(second.camera, first.shapes), [(0.0, 0.0)], rtol=0, atol=1e-12)
    for pair in ((first.camera, SHAPES), (CAMERA, second.shapes)):
        with pytest.raises(crc.InputError, match="flow_forward look into the next frame, which was not read"):
            flow(*pair)


def test_what_is_made_of_a_camera_or_of_shapes_keeps_their_other_times():
    scene = crc.Scene(CAMERA, SHAPES).with_timeline(next=crc.Scene(CAMERA, RIGHT))
    camera, shapes = replace(scene.camera, clip_end=50.0), replace(scene.shapes, color=scene.shapes.color / 2)
    np.testing.assert_array_equal(flow(camera, shapes), flow(scene))


def test_other_neighbors_leave_the_motion_as_it_is_and_camera_and_shapes_know_only_their_like():
    motion = Motion((), {}, 0.1, 0.0, ())
    scene = crc.Scene(CAMERA, SHAPES).with_timeline(motion).with_timeline(next=crc.Scene(UP, RIGHT))
    assert scene.motion is scene.camera.motion is scene.shapes.motion is motion
    assert (scene.camera.next, scene.camera.previous) == (UP, None)
    assert (scene.shapes.next, scene.shapes.previous) == (RIGHT, None)
