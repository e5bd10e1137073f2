"""Exports of a scene: which cameras and frames, and files that appear together or not at all."""

import json

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.output import exports
from camera_ray_caster.blender.read.camera_fields import find_cameras
from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.exports.camera_json import camera_from_json
from camera_ray_caster.core.exports.stmap import perspective_of, places
from camera_ray_caster.core.records import InputError

from ...exr import read_exr


@pytest.fixture
def scene(camera_scene):
    """Two cameras, of which one moves."""
    camera_scene.camera.name = "Moving"
    for frame in (1, 11):
        camera_scene.camera.location.x = frame
        camera_scene.camera.keyframe_insert("location", frame=frame)
    bpy.ops.object.camera_add(location=(0, 0, 5), rotation=(0.1, 0.2, 0.3))
    bpy.context.object.name = "Still/one"
    camera_scene.frame_set(5)
    return camera_scene


def names(folder):
    return sorted(path.name for path in folder.iterdir()) if folder.exists() else []


def same(left, right):
    same_directions = left.rays().directions.tobytes() == right.rays().directions.tobytes()
    return same_directions and (left.pose.eye == right.pose.eye).all()


def test_cameras_at_frames_are_those_that_are_read(scene, tmp_path):
    cameras = find_cameras(scene, ["ALL"])
    remarks, paths = exports.write(scene, "json", cameras, range(1, 12, 5), tmp_path / "out")
    assert (remarks, paths, names(tmp_path / "out")) == ([], [tmp_path / "out" / "camera.json"], ["camera.json"])
    for name, camera in zip(("Moving", "Still_one"), cameras, strict=True):
        for frame in (1, 6, 11):
            assert same(camera_from_json(paths[0], frame, camera=name), read_camera(scene, camera, frame=frame))
    assert (scene.frame_current, scene.camera.name) == (5, "Moving")


def test_a_stereo_scene_has_the_eyes_of_each_camera(scene, tmp_path):
    scene.render.use_multiview = True
    scene.render.views["left"].file_suffix = "_LEFT"
    _, (path,) = exports.write(scene, "json", [scene.camera], [5], tmp_path)
    eyes = {
        side: camera_from_json(path, camera=name) for side, name in (("left", "Moving_LEFT"), ("right", "Moving_R"))
    }
    for side, eye in eyes.items():
        assert same(eye, read_camera(scene, view=side))
    assert not same(eyes["left"], eyes["right"])
    exports.write(scene, "mrcal", [scene.camera], [5], tmp_path / "mrcal")  # as renders of the eyes are called
    assert names(tmp_path / "mrcal") == ["Moving_0005_LEFT.cameramodel", "Moving_0005_R.cameramodel"]


def test_a_multi_view_scene_has_the_camera_of_each_view(scene, tmp_path):
    left = scene.camera
    left.name = "Rig_L"
    right = left.copy()
    right.name, right.data, right.location.y = "Rig_R", left.data.copy(), 3
    scene.collection.objects.link(right)
    scene.render.use_multiview, scene.render.views_format = True, "MULTIVIEW"
    _, (path,) = exports.write(scene, "json", [left], [5], tmp_path)
    for camera, name in ((left, "Rig_L_L"), (right, "Rig_L_R")):  # as the renders of Rig_L are called
        assert same(camera_from_json(path, camera=name), read_camera(scene, camera))


def test_slits_paths_and_times_come_back_from_a_file(scene, tmp_path):
    settings = scene.camera.data.camera_ray_caster
    bpy.ops.curve.primitive_bezier_curve_add(location=(1, 2, 3), rotation=(0.3, 0, 0))
    settings.model, settings.path = "STRIP", bpy.context.object
    settings.time_mode, settings.time_start, settings.time_end = "COLUMNS", 1, 11
    _, (path,) = exports.write(scene, "json", [scene.camera], [5], tmp_path)
    there, back = read_camera(scene), camera_from_json(path)
    assert same(there, back)
    assert there.rays().origins.tobytes() == back.rays().origins.tobytes()
    assert np.array_equal(there.rays().time, back.rays().time)


def test_what_cannot_be_said_or_written_leaves_nothing(scene, tmp_path):
    scene.camera.data.type = "ORTHO"
    out = tmp_path / "new" / "out"
    with pytest.raises(InputError, match="COLMAP cannot represent the Orthographic of camera 'Moving': choose one of"):
        exports.write(scene, "colmap", find_cameras(scene, ["ALL"]), [1, 2], out)
    with pytest.raises(InputError, match="unknown format 'fbx'"):
        exports.write(scene, "fbx", [scene.camera], [1], out)
    with pytest.raises(InputError, match="only maps have a target"):
        exports.write(scene, "json", [scene.camera], [1], out, scene.camera)
    scene.camera.data.type = "PERSP"
    scene.camera.scale.x = -1
    with pytest.raises(InputError, match=r"whose axes are mirrored.*choose one of"):
        exports.write(scene, "colmap", [scene.camera], [1], out)
    (tmp_path / "new").write_text("a file")
    with pytest.raises(InputError, match=r"cannot write into .*out'"):
        exports.write(scene, "json", [scene.camera], [1], out)
    assert names(tmp_path) == ["new"]


def test_two_cameras_with_one_file_name_are_refused(scene, tmp_path):
    scene.camera.name = "Still_one"
    with pytest.raises(InputError, match="would have the same name, 'Still_one': rename one"):
        exports.write(scene, "colmap", find_cameras(scene, ["ALL"]), [1], tmp_path)


@pytest.mark.parametrize("key", ["opencv", "ros"])
def test_a_camera_named_as_another_at_a_frame_is_refused(blender, scene, tmp_path, key):
    """A lens that changes has a file for each frame."""
    camera = scene.camera
    camera.data.type = "PERSP"
    for frame, lens in ((1, 30.0), (2, 60.0)):
        camera.data.lens = lens
        camera.data.keyframe_insert("lens", frame=frame)
    other = blender.data.objects.new(f"{camera.name}_0001", blender.data.cameras.new("Other"))
    scene.collection.objects.link(other)
    with pytest.raises(InputError, match=rf"two cameras would have the file '{camera.name}_0001\."):
        exports.write(scene, key, [camera, other], [1, 2], tmp_path / "out")
    assert names(tmp_path / "out") == []


@pytest.mark.parametrize("target", [None, "Still/one"])
def test_maps_are_written_as_they_are_computed(scene, tmp_path, target):
    scene.camera.data.type = "PANO"
    scene.render.resolution_y = 6
    to = bpy.data.objects[target] if target else None
    before = set(bpy.data.images)
    _, paths = exports.write(scene, "stmap", [scene.camera], [3], tmp_path, to)
    assert names(tmp_path) == ["Moving_0003_distort.exr", "Moving_0003_undistort.exr"] == [path.name for path in paths]
    assert set(bpy.data.images) == before
    source, other = (read_camera(scene, camera, frame=3) for camera in (scene.camera, to or scene.camera))
    other = other if target else perspective_of(source)
    for path, (here, there) in zip(paths, ((source, other), (other, source)), strict=True):
        channels = read_exr(path)
        assert sorted(channels) == ["B", "G", "R"]
        pixels = np.stack([channels[channel] for channel in "RGB"], axis=-1)
        assert pixels.dtype == np.float32
        assert np.array_equal(pixels, places(here, there))
        assert 0 < pixels[..., 2].mean() <= 1


@pytest.mark.parametrize("key", [export.key for export in EXPORT_FORMATS])
def test_every_format_of_a_scene_appears_whole(scene, tmp_path, key):
    frames = [1] if key == "kalibr" else [1, 2]  # a camchain is of a rig that does not change
    _, paths = exports.write(scene, key, find_cameras(scene, ["ALL"]), frames, tmp_path)
    assert names(tmp_path) == sorted(path.name for path in paths) != []
    assert all(path.stat().st_size > 0 for path in paths)
    if key in ("npz", "mrcal"):
        assert names(tmp_path) == [f"{name}_000{frame}.{paths[0].suffix[1:]}" for name in ("Moving", "Still_one")
                                   for frame in (1, 2)]  # fmt: skip


def test_a_rolling_shutter_has_blenders_poses_at_its_first_and_last_row(scene, tmp_path):
    """The shutter of half a frame about frame 5 exposes a row for a tenth of it; the rows are read within the rest. The
    times are those of the middle of their exposure.
    """
    first, last = (-0.25 + 0.5 * (0.05 + 0.9 * row / 60) for row in (1, 60))
    scene.camera.data.camera_ray_caster.time_mode = "ROLLING_SHUTTER"
    scene.render.motion_blur_shutter = 0.5
    scene.render.resolution_x, scene.render.resolution_y = 80, 60
    _, (path,) = exports.write(scene, "nerfstudio", [scene.camera], [5], tmp_path)
    (frame,) = json.loads(path.read_text())["frames"]
    assert frame["rolling_shutter"] == "ROLLING_TOP_TO_BOTTOM"
    np.testing.assert_allclose(np.array(frame["rolling_shutter_offsets"]) * 24, (first, last), atol=1e-7)
    for name, time in (("transform_matrix", 5 + first), ("transform_matrix_rs", 5 + last)):
        scene.frame_set(int(time), subframe=time % 1)
        location = scene.camera.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation
        assert np.array(frame[name])[:3, 3] == pytest.approx(np.array(location), abs=1e-5)
    with pytest.raises(InputError, match=r"own time: choose one of nerfstudio, npz, json$"):
        exports.write(scene, "colmap", [scene.camera], [5], tmp_path / "colmap")
