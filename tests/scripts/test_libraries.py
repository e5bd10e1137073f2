"""Cameras, key points and slits whose names are equal in the file and in a linked library are not mixed up."""

import json

import numpy as np
import pytest

from camera_ray_caster.blender.output import exports
from camera_ray_caster.blender.read.scene_reader import read_scene

from .running import left, refused

BOTH = "Camera", "Camera [zoo.blend]"


@pytest.fixture
def file(blender, tmp_path):
    """A file with a camera, a monkey with its eye and a slit at x = 1, and with those at x = 3 of a library."""
    bpy = blender
    bpy.ops.object.camera_add(location=(0, 0, 8))
    bpy.ops.mesh.primitive_cube_add(size=1)
    bpy.context.object.name = "Monkey"
    for name in ("Eye", "Slit"):
        bpy.ops.object.empty_add()
        bpy.context.object.name = name
    bpy.data.objects["Eye"].parent = bpy.data.objects["Monkey"]
    scene, objects = bpy.context.scene, [bpy.data.objects[name] for name in ("Camera", "Monkey", "Eye", "Slit")]
    scene.render.resolution_x, scene.render.resolution_y = 16, 12
    for x, here in ((3, False), (1, True)):
        for item in objects:
            item.location.x = 0 if item.parent else x
        bpy.context.view_layer.update()
        if not here:
            bpy.data.libraries.write(str(tmp_path / "zoo.blend"), set(objects))
    with bpy.data.libraries.load(str(tmp_path / "zoo.blend"), link=True) as (there, linked):
        linked.objects = there.objects
    for item in linked.objects:
        scene.collection.objects.link(item)
    scene.camera = bpy.data.objects["Camera", None]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    return tmp_path / "file.blend"


def eye(path):
    """Where a picture's rays begin."""
    with np.load(path) as file:
        return file["ray_origin"][0, 0].tolist()


def test_both_cameras_make_pictures(command, file, tmp_path):
    words = "--passes", "ray_origin", "--format", "npz", "--output", tmp_path / "out"
    assert command("cast", file, "--cameras", "ALL", *words).returncode == 0
    assert {name for name in left(tmp_path / "out") if "npz" in name} == {f"{name}_0001.npz" for name in BOTH}
    assert [eye(tmp_path / "out" / f"{name}_0001.npz") for name in BOTH] == [[1, 0, 8], [3, 0, 8]]
    report = json.loads((tmp_path / "out" / f"{BOTH[1]}_0001.json").read_text())
    assert report["camera"]["name"] == BOTH[1]
    for name, x in zip(BOTH, (1, 3), strict=True):
        assert command("cast", file, "--camera", name, *words).returncode == 0
        assert eye(tmp_path / "out" / "file.npz") == [x, 0, 8]
    line = refused(command("cast", file, "--camera", "Camera [no.blend]", *words))
    assert line.endswith("its cameras are: 'Camera', 'Camera [zoo.blend]'")


@pytest.mark.full
def test_exports_have_both(command, blender, file, tmp_path):
    done = command("export", file, "--format", "npz", "--cameras", "ALL", "--output", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert set(left(tmp_path / "out")) == {f"{name}_0001.npz" for name in BOTH}
    scene = blender.context.scene
    cameras = [item for item in scene.objects if item.type == "CAMERA"]
    shots = exports.shots(scene, cameras, [1])
    assert {shot.name: shot.camera.pose.eye[0] for shot in shots} == dict(zip(BOTH, (1, 3), strict=True))


@pytest.mark.full
def test_a_name_of_one_library_alone_needs_no_more(command, blender, file, tmp_path):
    blender.ops.wm.open_mainfile(filepath=str(file))
    scene = blender.context.scene
    scene.collection.objects.unlink(blender.data.objects["Camera", None])
    scene.camera = None
    blender.ops.wm.save_as_mainfile(filepath=str(file))
    words = "--passes", "ray_origin", "--format", "npz", "--output", tmp_path / "out"
    assert command("cast", file, "--camera", "Camera", *words).returncode == 0
    assert eye(tmp_path / "out" / "file.npz") == [3, 0, 8]


def test_key_points_belong_to_their_own_object(command, file, tmp_path):
    words = "--passes", "depth", "--keypoints", "ALL", "--output", tmp_path / "out"
    assert command("cast", file, *words).returncode == 0
    made = json.loads((tmp_path / "out" / "file_coco.json").read_text())
    key_points = {entry["object"]: entry["keypoints"][:2] for key in ("annotations", "hidden") for entry in made[key]}
    assert key_points.keys() == {"Monkey", "Monkey [zoo.blend]"}
    assert key_points["Monkey"] != key_points["Monkey [zoo.blend]"]


@pytest.mark.full
def test_a_slit_of_a_library_is_read(blender, file):
    blender.ops.wm.open_mainfile(filepath=str(file))
    scene = blender.context.scene
    group = scene.camera.data.camera_ray_caster
    group.model = "PUSHBROOM"
    for library, x in ((None, 1), (blender.data.libraries[0].filepath, 3)):
        group.slit_1 = blender.data.objects["Slit", library]
        _, matrix = read_scene(scene).camera.record.settings["slit_1"]
        assert matrix[0, 3] == x
