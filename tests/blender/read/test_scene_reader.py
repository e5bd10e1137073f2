"""Reading a scene: camera and shapes from one evaluation, and what each door leaves unread."""

import numpy as np
import pytest

from camera_ray_caster.blender.read import evaluated, read_camera, read_scene, read_shapes
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import InputError

from .scene_parts import new_object
from .time_scene import PASSES, coordinates, disc, key, same


@pytest.fixture
def counted(monkeypatch):
    """The frames at which shapes are read, in order."""
    frames, read = [], evaluated.shapes_record

    def record(depsgraph, *words):
        frames.append(depsgraph.scene.frame_current)
        return read(depsgraph, *words)

    monkeypatch.setattr(evaluated, "shapes_record", record)
    return frames


def test_camera_and_shapes_are_what_the_doors_give(scene, sphere):
    scene.camera.data.camera_ray_caster.time_mode = "NONE"
    key(scene.camera, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7)
    for arguments in ({}, {"frame": 12.5}, {"camera_object": scene.camera, "frame": 3}):
        read = read_scene(scene, **arguments)
        camera, shapes = read_camera(scene, **arguments), read_shapes(scene, **arguments)
        np.testing.assert_array_equal(read.camera.rays().origins, camera.rays().origins)
        np.testing.assert_array_equal(read.shapes.center, shapes.center)
        assert read.camera.name == camera.name == "Camera"
        assert (read.shapes.motion, camera.motion, shapes.motion) == (None, None, None)


@pytest.mark.parametrize("read", [read_scene, read_shapes])
def test_arguments_by_place_are_read_with_a_warning(scene, sphere, read):
    """The frame came second before; now the camera does, as in read_camera."""
    scene.camera.data.camera_ray_caster.time_mode = "NONE"
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    places = (7,), (np.int64(7),), (None, scene.camera), (7, scene.camera), (scene.camera, 7), (7, scene.camera, "")
    for arguments in places:
        with pytest.warns(DeprecationWarning, match="as keywords: frame="):
            result = read(scene, *arguments)
        center = getattr(result, "shapes", result).center
        frame = None if arguments[0] is None else 7
        np.testing.assert_array_equal(center, read_shapes(scene, frame=frame).center)
    with pytest.raises(InputError, match="7 is not an object"):  # by its name it is no old form: no warning
        read(scene, camera_object=7)


def test_motion_is_evaluated_once_for_camera_and_shapes(scene, sphere, counted):
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7)
    read = read_scene(scene)
    assert read.camera.motion is read.shapes.motion is read.motion is not None
    once = len(counted)
    assert once == len(read.motion.states) + 4 + 1  # beside: the checks, and the frame itself
    read_camera(scene), read_shapes(scene)
    assert len(counted) == 3 * once - 1  # a camera alone needs no shapes at the frame itself
    x, y, frame = coordinates()
    same(cast(read.camera, read.shapes, passes=PASSES)["shape_index"] == 0, *disc(x, y, (frame - 13) / 4))


def test_a_camera_of_one_time_is_read_without_shapes(scene, sphere, counted):
    scene.camera.data.camera_ray_caster.time_mode = "NONE"
    read_camera(scene)
    assert counted == []


def test_shapes_move_for_a_camera_that_is_not_the_active_one(blender, scene, sphere):
    """The slit scan of the camera that is asked for; the active one has one time."""
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7)
    scanning, scene.camera = scene.camera, new_object("Other", blender.data.cameras.new("Other"))
    assert read_shapes(scene).motion is None
    camera, shapes = read_camera(scene, scanning), read_shapes(scene, camera_object=scanning)
    x, y, frame = coordinates()
    same(cast(camera, shapes, passes=PASSES)["shape_index"] == 0, *disc(x, y, (frame - 13) / 4))
    assert scene.camera.name == "Other"
    assert scene.frame_current == 7


def test_shapes_are_read_where_there_is_no_camera_or_one_that_cannot_be_cast(blender, scene, sphere):
    data = scene.camera.data
    data.camera_ray_caster.time_mode = "NONE"
    data.clip_end = data.clip_start / 2
    assert len(read_shapes(scene)) == 1
    for camera in (None, sphere):
        scene.camera = camera
        assert len(read_shapes(scene)) == 1
        with pytest.raises(InputError, match="camera"):
            read_scene(scene)


@pytest.mark.full
def test_the_shapes_of_an_eye_are_read_for_that_eye(scene, sphere):
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    scene.render.use_multiview = True
    read = read_scene(scene, view="right")
    np.testing.assert_array_equal(read.camera.pose.eye, read_camera(scene, view="right").pose.eye)
    motion = read_shapes(scene, view="right").motion
    assert motion.camera_at(3.0).pose.eye[0] == read.camera.at(3.0).pose.eye[0]
    assert read.camera.pose.eye[0] != read_camera(scene).pose.eye[0]
    with pytest.raises(InputError, match="'middle' is not an eye"):
        read_shapes(scene, view="middle")
