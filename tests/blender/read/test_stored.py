"""What a file has stored, read without registration as a script does that only imports the package."""

import bpy
import numpy as np
import pytest

import camera_ray_caster as crc

from .scene_parts import ball, new_object
from .test_camera_fields import key


@pytest.fixture
def scene(blender):
    """A camera and a ball; everything is registered until ``reopened``."""
    scene = blender.context.scene
    scene.camera = new_object("Camera", blender.data.cameras.new("Camera"))
    ball("Ball")
    return scene


@pytest.fixture
def reopened(blender, unregister, tmp_path):
    """A function that saves the file, takes the add-on away, opens the file again and returns its scene."""

    def reopen():
        path = str(tmp_path / "stored.blend")
        blender.ops.wm.save_as_mainfile(filepath=path)
        unregister()
        blender.ops.wm.open_mainfile(filepath=path)
        assert not hasattr(blender.context.scene.camera.data, "camera_ray_caster")
        return blender.context.scene

    return reopen


def both_cameras(scene, reopened):
    """The camera of a scene, read with the add-on registered and without."""
    return crc.read_camera(scene), crc.read_camera(reopened())


@pytest.mark.parametrize("model", ["OMNIMAX", "GENERAL_LINEAR", "STEREOGRAPHIC_PANORAMA", "OMNIDIRECTIONAL_STEREO"])
def test_settings_that_were_never_touched_have_the_same_defaults(scene, reopened, model):
    """To the last bit: Blender's properties round them to float32."""
    scene.camera.data.camera_ray_caster.model = model
    registered, stored = both_cameras(scene, reopened)
    assert stored.model.key == model
    assert stored.settings == registered.settings


def test_every_kind_of_setting_is_as_it_was_stored(blender, scene, reopened):
    settings = scene.camera.data.camera_ray_caster
    settings.model, settings.tilt = "OMNIMAX", 0.25
    assert [camera.settings["tilt"] for camera in both_cameras(scene, reopened)] == [0.25, 0.25]
    crc.register()
    settings = blender.context.scene.camera.data.camera_ray_caster
    settings.model, settings.ray_1, settings.eye = "GENERAL_LINEAR", (0.5, 0.25, -1.0, -0.5), "SIDE_BY_SIDE"
    registered, stored = both_cameras(blender.context.scene, reopened)
    assert stored.settings == registered.settings
    assert stored.settings["ray_1"] == [0.5, 0.25, -1.0, -0.5]
    crc.register()
    blender.context.scene.camera.data.camera_ray_caster.model = "OMNIDIRECTIONAL_STEREO"
    assert crc.read_camera(reopened()).settings["eye"] == "SIDE_BY_SIDE"


def test_a_path_and_its_flag_are_as_they_were_stored(blender, scene, reopened):
    curve = blender.data.curves.new("Path", "CURVE")
    curve.splines.new("POLY").points.add(1)
    curve.splines[0].points[1].co = 4, 0, 0, 1
    settings = scene.camera.data.camera_ray_caster
    settings.model, settings.path, settings.follow_path = "STRIP", new_object("Path", curve), True
    registered, stored = both_cameras(scene, reopened)
    assert stored.settings == registered.settings
    assert stored.settings["path"] == [[0, 0, 0], [4, 0, 0]]
    assert stored.settings["follow_path"] is True
    np.testing.assert_array_equal(stored.rays().origins, registered.rays().origins)


def test_what_is_stored_as_an_image_and_is_none_is_refused(scene):
    data = scene.camera.data
    data.camera_ray_caster.time_mode = "IMAGE"
    properties = data.bl_system_properties_get() if bpy.app.version >= (5, 0, 0) else data
    properties["camera_ray_caster"]["time_image"] = scene.camera
    with pytest.raises(crc.InputError, match="has no image: choose a grayscale image"):
        crc.read_camera(scene)


def test_a_vector_that_is_stored_as_one_number_is_refused(scene, reopened):
    """Blender reads four numbers from the memory of one."""
    data = scene.camera.data
    settings = data.camera_ray_caster
    settings.model = "GENERAL_LINEAR"
    properties = data.bl_system_properties_get() if bpy.app.version >= (5, 0, 0) else data
    properties["camera_ray_caster"]["ray_1"] = 1.0
    refused = "ray_1 of 'Camera' is stored as one number, not as 4: reset it to its default, then set it again"
    with pytest.raises(crc.InputError, match=refused):
        crc.read_camera(scene)
    with pytest.raises(crc.InputError, match=refused):
        crc.read_camera(reopened())
    data = bpy.context.scene.camera.data
    crc.register()
    settings = data.camera_ray_caster
    settings.property_unset("ray_1")
    settings.ray_1 = 0.5, 0.25, -1.0, -0.5
    assert crc.read_camera(bpy.context.scene).settings["ray_1"] == [0.5, 0.25, -1.0, -0.5]


def test_the_times_of_pixels_and_their_image_are_as_they_were_stored(blender, scene, reopened):
    image = blender.data.images.new("Gray", 2, 1, float_buffer=True)
    image.pixels[:] = [0, 0, 0, 1, 1, 1, 1, 1]
    image.pack()
    settings = scene.camera.data.camera_ray_caster
    settings.time_mode, settings.time_image, settings.time_end = "IMAGE", image, 9.0
    scene.render.resolution_x, scene.render.resolution_y = 8, 4
    registered, stored = both_cameras(scene, reopened)
    np.testing.assert_array_equal(stored.rays().time, np.repeat([[1.0] * 4 + [9.0] * 4], 4, axis=0))
    np.testing.assert_array_equal(stored.rays().time, registered.rays().time)


@pytest.mark.parametrize(("primitive", "count"), [("INFINITE_PLANE", 1), ("IGNORE", 0), ("AUTOMATIC", 1)])
def test_what_an_object_stands_for_is_as_it_was_stored(blender, scene, reopened, primitive, count):
    scene.objects["Ball"].camera_ray_caster.primitive = primitive
    registered, stored = crc.read_shapes(scene), crc.read_shapes(reopened())
    assert len(stored) == count
    assert stored.kind.tolist() == registered.kind.tolist() == [2 if primitive == "INFINITE_PLANE" else 0][:count]
    assert stored.left_out == registered.left_out


@pytest.mark.parametrize("animation", ["keys", "driver", "strip"])
def test_what_is_animated_is_refused_in_one_line(blender, scene, reopened, animation):
    data = scene.camera.data
    settings = data.camera_ray_caster
    settings.model = "OMNIMAX"
    if animation == "driver":
        data.driver_add("camera_ray_caster.tilt").driver.expression = "frame / 16"
    else:
        for frame, tilt in ((0, 0.0), (16, 1.0)):
            settings.tilt = tilt
            data.keyframe_insert("camera_ray_caster.tilt", frame=frame)
        for point in data.animation_data.action.layers[0].strips[0].channelbags[0].fcurves[0].keyframe_points:
            point.interpolation = "LINEAR"
    if animation == "strip":
        action, slot = data.animation_data.action, data.animation_data.action_slot
        data.animation_data.action = None
        strip = data.animation_data.nla_tracks.new().strips.new("Tilt", 0, action)
        strip.action_slot = slot
    assert crc.read_camera(scene, frame=8).settings["tilt"] == pytest.approx(0.5)
    again = reopened()
    with pytest.raises(crc.InputError, match=r"^tilt of 'Camera' is animated.*camera_ray_caster\.register\(\).*$"):
        crc.read_camera(again)
    crc.register()
    blender.ops.wm.open_mainfile(filepath=blender.data.filepath)
    assert crc.read_camera(blender.context.scene, frame=8).settings["tilt"] == pytest.approx(0.5)


def test_what_is_animated_but_not_read_is_no_matter(scene, reopened):
    """Nor is what Blender evaluates itself, a lens or the camera's place."""
    data = scene.camera.data
    data.keyframe_insert("camera_ray_caster.tilt", frame=1)
    key(scene.camera, "location", (1, (0, 0, 0)), (11, (10, 0, 0)))
    key(data, "lens", (1, 20.0), (11, 30.0))
    again = reopened()
    camera = crc.read_camera(again, frame=6)
    assert camera.pose.eye[0] == pytest.approx(5)
    assert camera.settings["lens"] == pytest.approx(25)


def test_a_file_that_never_had_the_add_on_has_blenders_cameras(blender, unregister):
    unregister()
    blender.ops.wm.read_factory_settings(use_empty=True)
    scene = blender.context.scene
    scene.camera = new_object("Camera", blender.data.cameras.new("Camera"))
    ball("Ball")
    read = crc.read_scene(scene)
    assert read.camera.model.key == "PERSP"
    assert len(read.shapes) == 1
    scene.camera.data.type = "PANO"
    assert crc.read_camera(scene).model.key == scene.camera.data.panorama_type


def test_a_model_of_a_newer_version_is_never_another_one(blender, scene, reopened):
    """Nor is what an object stands for: registered or not, the number that is stored is told."""
    data, thing = scene.camera.data, scene.objects["Ball"]
    data.camera_ray_caster.model, thing.camera_ray_caster.primitive = "OMNIMAX", "PLANE"
    for owner, name in ((data, "model"), (thing, "primitive")):
        stored = owner.bl_system_properties_get() if blender.app.version >= (5, 0, 0) else owner
        stored["camera_ray_caster"][name] = 99
    unknown = "model of camera 'Camera' is '99': it must be one of BLENDER, OPENCV_PINHOLE"
    with pytest.raises(crc.InputError, match=unknown):
        crc.read_camera(scene)
    assert [reason for _, reason in crc.read_shapes(scene).left_out] == [LEFT_OUT]
    again = reopened()
    with pytest.raises(crc.InputError, match=unknown):
        crc.read_camera(again)
    assert [reason for _, reason in crc.read_shapes(again).left_out] == [LEFT_OUT]


LEFT_OUT = "its Cast As is 99, which this version does not know: choose another shape"


def test_a_calibration_file_beside_the_file_is_found(blender, scene, reopened, tmp_path):
    (tmp_path / "lens.json").write_text(
        '{"camera_matrix": [10, 0, 4, 0, 10, 3, 0, 0, 1], "distortion": [0], "width": 8, "height": 6}'
    )
    settings = scene.camera.data.camera_ray_caster
    settings.model, settings.calibration_file = "OPENCV_PINHOLE", "//lens.json"
    scene.render.resolution_x, scene.render.resolution_y = 8, 6
    camera = crc.read_camera(reopened())
    np.testing.assert_allclose(camera.K, [[10, 0, 4], [0, 10, 3], [0, 0, 1]], atol=1e-14)
    assert camera.settings["fx"] == 10  # what counts, not what stands in the panel
