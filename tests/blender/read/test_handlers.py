"""Cameras that are read within Blender's handlers, which a reading itself calls."""

import bpy
import pytest

from camera_ray_caster.blender.read import read_camera, read_scene, read_shapes
from camera_ray_caster.blender.read.camera_fields import is_removed
from camera_ray_caster.core.records import InputError

from .scene_parts import ball, new_object


@pytest.fixture
def scene():
    scene = bpy.context.scene
    scene.camera = new_object("Camera", bpy.data.cameras.new("Camera"))
    ball()
    return scene


@pytest.fixture
def handled(request):
    """A function that lets another one be called by a handler, until the test is over."""
    added = []

    def add(name, function):
        handlers = getattr(bpy.app.handlers, name)
        handlers.append(function)
        added.append((handlers, function))

    yield add
    for handlers, function in added:
        handlers.remove(function)


@pytest.mark.parametrize("name", ["depsgraph_update_post", "frame_change_post"])
def test_a_handler_may_read_the_active_camera(scene, handled, name):
    seen = []
    handled(name, lambda *_: seen.append((read_camera(scene).pose.eye[0], len(read_shapes(scene)))))
    scene.camera.location.x = 2.5
    assert read_camera(scene).pose.eye[0] == 2.5
    assert read_camera(scene, frame=7).pose.eye[0] == 2.5
    assert 1 <= len(seen) <= 8
    assert seen[-1] == (2.5, 1)
    scene.camera.location.x = 3.5
    bpy.context.view_layer.update()  # outside of any reading
    assert read_camera(scene).pose.eye[0] == 3.5


@pytest.mark.parametrize("mode", ["NONE", "ROWS"])
def test_a_handler_cannot_set_frames_while_another_reading_does(scene, handled, mode):
    scene.camera.data.camera_ray_caster.time_mode = mode
    errors = []

    def read(*_):
        try:
            read_camera(scene, frame=3 if mode == "NONE" else None)
        except InputError as error:
            errors.append(str(error))

    handled("frame_change_post", read)
    read_camera(scene, frame=7)
    assert errors
    assert all("a handler reads a camera while another reading evaluates the scene" in line for line in errors)


@pytest.mark.parametrize("frame", [1e9, -1e9, float("nan"), float("inf")])
def test_a_frame_that_blender_does_not_have_is_refused(scene, frame):
    with pytest.raises(InputError, match=r"frame is .*: it must be a number from -1048574 to 1048574"):
        read_camera(scene, frame=frame)


@pytest.mark.parametrize("name", ["frame_change_post", "depsgraph_update_post"])
@pytest.mark.parametrize("is_other", [False, True])
def test_a_camera_that_a_handler_deletes_in_a_reading_is_refused_in_one_line(scene, handled, name, is_other):
    active, other = scene.camera, scene.camera.copy()
    scene.collection.objects.link(other)

    def delete(scene, *_):
        if scene.camera is not None:
            bpy.data.objects.remove(scene.camera)

    handled(name, delete)

    def read():
        for frame in (2, 3):
            read_scene(scene, frame=frame, camera_object=other if is_other else None, passes=("flow_forward",))

    with pytest.raises(InputError, match=r"has no active camera|removed what is read|has been removed") as refusal:
        read()
    assert "\n" not in str(refusal.value)
    assert is_other or is_removed(active)
