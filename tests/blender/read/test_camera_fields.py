"""The camera that is read against what was set up by hand: poses from plain geometry, settings by their names."""

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from camera_ray_caster.blender.read.camera_fields import camera_record, check_markers, find_camera
from camera_ray_caster.blender.read.scene_reader import evaluated, read_camera
from camera_ray_caster.core.records import InputError

ULP = float(np.finfo(np.float32).eps)


@pytest.fixture
def scene():
    scene = bpy.context.scene
    scene.camera = new_camera("Camera")
    return scene


def new_object(name, data=None):
    item = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(item)
    return item


def new_camera(name):
    return new_object(name, bpy.data.cameras.new(name))


def raw(scene, frame=None, camera=None):
    with evaluated(scene, frame, camera) as depsgraph:
        return camera_record(scene.camera, depsgraph)


def key(item, path, *values):
    """Animate a property linearly through (frame, value) pairs."""
    for frame, value in values:
        setattr(item, path, value)
        item.keyframe_insert(path, frame=frame)
    for curve in item.animation_data.action.layers[0].strips[0].channelbags[0].fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def test_a_parent_carries_the_camera_along(scene):
    parent = new_object("Parent")
    parent.matrix_world = Matrix(((0, -2, 0, 5), (2, 0, 0, 0), (0, 0, 2, 0), (0, 0, 0, 1)))  # a quarter turn, twice
    scene.camera.parent = parent
    scene.camera.location = 1, 0, 3
    expected = [[0, -2, 0, 5], [2, 0, 0, 2], [0, 0, 2, 6], [0, 0, 0, 1]]
    np.testing.assert_allclose(raw(scene).matrix_world, expected, atol=8 * ULP)
    pose = read_camera(scene).pose
    np.testing.assert_allclose(pose.eye, (5, 2, 6), atol=8 * ULP)
    np.testing.assert_allclose(pose.basis, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=8 * ULP)


def test_a_constraint_moves_the_camera(scene):
    target = new_object("Target")
    target.location = 1, 2, 3
    scene.camera.constraints.new("COPY_LOCATION").target = target
    np.testing.assert_array_equal(raw(scene).matrix_world[:3, 3], (1, 2, 3))


@pytest.mark.parametrize("scale", [(-1, 1, 1), (2, 3, 0.5), (1, -2, -3)])
def test_scale_stays_in_the_matrix_that_is_read(scene, scale):
    scene.camera.scale = scale
    np.testing.assert_array_equal(raw(scene).matrix_world, np.diag([*scale, 1]))


def test_shear_stays_in_the_matrix_that_is_read(scene):
    parent = new_object("Parent")
    parent.scale = 1, 2, 1
    scene.camera.parent = parent
    scene.camera.rotation_euler = 0, 0, np.pi / 4
    half = np.sqrt(0.5)
    expected = [[half, -half, 0, 0], [2 * half, 2 * half, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    np.testing.assert_allclose(raw(scene).matrix_world, expected, atol=4 * ULP)


def test_drivers_and_animation_are_evaluated_at_any_frame_and_subframe(scene):
    key(scene.camera, "location", (1, (0, 0, 0)), (11, (10, 0, 0)))
    data = scene.camera.data
    driver = data.driver_add("lens").driver
    driver.expression = "frame + 20"
    for frame, x in ((1, 0), (3.5, 2.5), (7.25, 6.25), (-4, 0), (400, 10)):
        record = raw(scene, frame)
        assert record.matrix_world[0, 3] == pytest.approx(x, abs=1e-5)
        assert record.lens == pytest.approx(frame + 20)


def test_the_frame_and_the_camera_are_put_back(scene):
    other = new_camera("Other")
    scene.frame_set(5, subframe=0.25)
    read_camera(scene, other, frame=17.5)
    assert (scene.frame_current, scene.frame_subframe, scene.camera.name) == (5, 0.25, "Camera")
    other.data.clip_end = other.data.clip_start / 2
    with pytest.raises(InputError):
        read_camera(scene, other, frame=17.5)
    assert (scene.frame_current, scene.frame_subframe, scene.camera.name) == (5, 0.25, "Camera")


def test_a_marker_chooses_the_camera_of_its_frame(scene):
    late = new_camera("Late")
    for name, frame, camera in (("a", 1, scene.camera), ("b", 10, late)):
        scene.timeline_markers.new(name, frame=frame).camera = camera
    scene.frame_set(1)
    assert [read_camera(scene, frame=frame).name for frame in (5, 15)] == ["Camera", "Late"]
    assert scene.camera.name == "Camera"


def test_markers_that_change_the_camera_are_refused_where_one_is_meant(scene):
    check_markers(scene)
    for frame, camera in ((1, scene.camera), (5, new_camera("Other"))):
        scene.timeline_markers.new("cut", frame=frame).camera = camera
    with pytest.raises(InputError, match=r"markers change the camera of scene 'Scene' .'Camera', 'Other'.: name cam"):
        check_markers(scene)


def test_a_hidden_camera_is_evaluated_when_it_is_asked_for(scene):
    hidden = new_camera("Hidden")
    hidden.hide_viewport = True
    key(hidden, "location", (1, (0, 0, 0)), (11, (0, 10, 0)))
    np.testing.assert_allclose(read_camera(scene, hidden, frame=6).pose.eye, (0, 5, 0), atol=1e-5)
    assert scene.camera.name == "Camera"


def test_another_scene_is_read_as_it_stands():
    scene = bpy.data.scenes.new("Second")
    camera = bpy.data.objects.new("Far", bpy.data.cameras.new("Far"))
    camera.location = 7, 8, 9
    scene.collection.objects.link(camera)
    scene.camera = camera
    np.testing.assert_array_equal(read_camera(scene).pose.eye, (7, 8, 9))


def test_every_setting_is_copied_by_its_name(scene):
    data, render = scene.camera.data, scene.render
    wanted = dict(lens=35.0, sensor_fit="VERTICAL", sensor_width=30.0, sensor_height=20.0, shift_x=0.25, shift_y=-0.5,
                  clip_start=0.5, clip_end=64.0)  # fmt: skip
    frame = dict(resolution_x=640, resolution_y=333, resolution_percentage=37, pixel_aspect_x=1.5,
                 pixel_aspect_y=2.0, use_border=True, border_min_x=0.125,
                 border_max_x=0.75, border_min_y=0.25, border_max_y=0.5)  # fmt: skip
    lens = dict(type="PANO", panorama_type="FISHEYE_LENS_POLYNOMIAL", fisheye_fov=2.0, fisheye_polynomial_k1=-0.25)
    focus = dict(use_dof=True, focus_distance=2.5, aperture_fstop=1.5, aperture_blades=5)
    stereo = dict(interocular_distance=0.125, convergence_mode="TOE", pivot="LEFT", use_spherical_stereo=True)
    for owner, values in ((data, wanted | lens), (render, frame), (data.dof, focus), (data.stereo, stereo)):
        for name, value in values.items():
            setattr(owner, name, value)
    record = raw(scene)
    assert {name: getattr(record, name) for name in wanted | frame} == wanted | frame
    assert record.type == lens.pop("type")
    assert {name: record.settings[name] for name in lens | focus | stereo} == lens | focus | stereo
    assert record.settings["focus_position"] is None


def test_a_record_has_what_its_model_and_its_time_read_and_no_more(scene):
    """Its own settings beside those that every record has."""
    data = scene.camera.data
    group = data.camera_ray_caster
    every = set(raw(scene).settings)
    for model, settings in (
        ("OMNIMAX", {"tilt"}),
        ("STRIP", {"path", "follow_path"}),
        ("OMNIDIRECTIONAL_STEREO", {"eye"}),
        ("BLENDER", set()),
    ):
        group.model = model
        assert set(raw(scene).settings) - every == settings
    group.time_mode = "ROLLING_SHUTTER"
    shutter = {"readout", "motion_blur_shutter", "motion_blur_position", "rolling_shutter_duration"}
    assert set(raw(scene).settings) - every == shutter | {"time_tolerance", "time_evaluations"}
    data.type, data.panorama_type, group.time_mode = "PANO", "FISHEYE_EQUIDISTANT", "NONE"
    assert set(raw(scene).settings) - every == {"fisheye_fov"}


def test_the_focus_object_is_read_where_it_is_in_the_world(scene):
    parent, focus = new_object("Parent"), new_object("Focus")
    parent.location, focus.location = (0, 0, 5), (1, 0, 0)
    focus.parent = parent
    scene.camera.data.dof.focus_object = focus
    np.testing.assert_array_equal(raw(scene).settings["focus_position"], (1, 0, 5))


def test_the_focus_bone_is_read_where_it_is_in_the_world(scene):
    rig = new_object("Rig", bpy.data.armatures.new("Rig"))
    rig.location = 10, 0, 0
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    bone = rig.data.edit_bones.new("Eye")
    bone.head, bone.tail = (0, 2, 0), (0, 3, 0)
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.pose.bones["Eye"].location = 0, 1, 0  # along the bone
    scene.camera.data.dof.focus_object, scene.camera.data.dof.focus_subtarget = rig, "Eye"
    np.testing.assert_allclose(raw(scene).settings["focus_position"], (10, 3, 0), atol=8 * ULP)


def test_no_camera_is_one_clear_line(scene):
    scene.camera = None
    with pytest.raises(InputError, match=r"has no active camera: add a camera, .*--camera NAME"):
        read_camera(scene)


@pytest.mark.parametrize(
    ("data", "kind"),
    [
        (lambda: None, "empty"),
        (lambda: bpy.data.meshes.new("Thing"), "mesh"),
        (lambda: bpy.data.lights.new("Thing", "SPOT"), "light"),
    ],
    ids=["empty", "mesh", "light"],
)
def test_what_is_no_camera_is_refused_by_name(scene, data, kind):
    thing = new_object("Thing", data())
    for attempt in (lambda: read_camera(scene, thing), lambda: setattr(scene, "camera", thing) or read_camera(scene)):
        with pytest.raises(InputError, match=f"'Thing' is of type {kind}, not a camera"):
            attempt()


def test_a_name_is_no_camera(scene):
    with pytest.raises(InputError, match=r"'Camera' is not an object: give an object such as scene\.objects"):
        read_camera(scene, "Camera")


def test_an_unknown_name_says_which_cameras_there_are(scene):
    new_camera("Other")
    assert find_camera(scene, "Other").name == "Other"
    with pytest.raises(InputError, match="no camera 'Nobody'; its cameras are: 'Camera', 'Other'"):
        find_camera(scene, "Nobody")
    with pytest.raises(InputError, match="none at all"):
        find_camera(bpy.data.scenes.new("Bare"), "Camera")


@pytest.mark.parametrize("frame", [float("nan"), float("inf"), 1e12])
def test_a_frame_that_is_none_is_refused(scene, frame):
    with pytest.raises(InputError, match="frame"):
        read_camera(scene, frame=frame)


def test_a_frame_beyond_the_scene_is_as_blender_has_it(scene):
    scene.frame_start, scene.frame_end = 1, 10
    key(scene.camera, "location", (1, (0, 0, 0)), (11, (10, 0, 0)))
    assert read_camera(scene, frame=-100).pose.eye[0] == 0
    assert read_camera(scene, frame=5000).pose.eye[0] == 10


def test_cameras_by_their_names_are_each_found_once(blender, camera_scene):
    from camera_ray_caster.blender.read.camera_fields import find_cameras

    camera_scene.camera.name = "Right"
    blender.ops.object.camera_add()
    blender.context.object.name = "Left"
    assert [item.name for item in find_cameras(camera_scene, ["ALL"])] == ["Left", "Right"]
    assert [item.name for item in find_cameras(camera_scene, ["Right", "Left", "Right"])] == ["Right", "Left"]
    with pytest.raises(InputError, match="no camera 'Up'; its cameras are: 'Left', 'Right'"):
        find_cameras(camera_scene, ["Left", "Up"])
    for name in ("Left", "Right"):
        blender.data.objects.remove(blender.data.objects[name])
    with pytest.raises(InputError, match="its cameras are: none at all"):
        find_cameras(camera_scene, ["ALL"])
