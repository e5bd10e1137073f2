"""Cameras from files in Blender: lenses, places, keyframes and sizes, and casts that leave the .blend as it is."""

import json
from time import sleep

import numpy as np
import pytest

from camera_ray_caster.blender.output import exports
from camera_ray_caster.blender.read.frames import go_to
from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.blender.rig import add_rig, contents, frames_of
from camera_ray_caster.blender.terminal import commands
from camera_ray_caster.blender.ui import chosen_frames, in_process
from camera_ray_caster.core.records import InputError

CHAIN = """cam0:
  camera_model: pinhole
  distortion_model: equidistant
  distortion_coeffs: [0.01, 0.002, 0.0, 0.0]
  intrinsics: [30.1, 30.2, 39.5, 29.5]
  resolution: [80, 60]
cam1:
  camera_model: ds
  distortion_model: none
  intrinsics: [-0.2, 0.6, 20.0, 20.0, 24.5, 24.5]
  resolution: [50, 50]
  T_cn_cnm1:
    [[1.0, 0.0, 0.0, -0.1],
     [0.0, 1.0, 0.0, 0.0],
     [0.0, 0.0, 1.0, 0.0]]
"""
TUM = "0.0 0 0 0 0 0 0 1\n0.5 1 2 3 0 0 0.7071067811865476 0.7071067811865476\n"


@pytest.fixture
def chain(tmp_path):
    (tmp_path / "chain.yaml").write_text(CHAIN)
    return str(tmp_path / "chain.yaml")


def transforms(folder, **more):
    frames = []
    for i in (1, 3):
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = ((0, -1, 0), (1, 0, 0), (0, 0, 1)), (i, 2, 3.3)
        frames.append({"file_path": f"pano_{i:04}.png", "w": 32, "h": 16, "transform_matrix": pose.tolist(), **more})
        more = {name: value + 1 for name, value in more.items()}
    kind = {} if more else {"camera_model": "EQUIRECTANGULAR"}
    (folder / "transforms.json").write_text(json.dumps(kind | {"frames": frames}))
    return str(folder / "transforms.json")


def test_a_rig_stands_below_an_empty_and_a_trajectory_moves_it(blender, camera_scene, chain, tmp_path):
    (tmp_path / "path.txt").write_text(TUM)
    left, right = add_rig(camera_scene, [chain, str(tmp_path / "path.txt")])
    assert left.parent == right.parent
    assert left.parent.name == "chain"
    assert left.data.camera_ray_caster.calibration_file == chain
    assert frames_of([left]) == [1, 13]
    go_to(camera_scene, 13)
    matrix = np.array(right.matrix_world)
    assert np.allclose(matrix[:3, 3], (1, 2.1, 3), atol=1e-6)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = right["resolution"]
    cam = read_camera(camera_scene, right)
    assert cam.model.key == "DOUBLE_SPHERE"
    assert cam.settings["unified_xi"] == -0.2  # all digits: from the file, not Blender's float32
    with pytest.raises(InputError, match="the files have two movements"):
        add_rig(camera_scene, [transforms(tmp_path), str(tmp_path / "path.txt")])


def test_a_file_dialog_lists_the_cameras_before_they_are_added(blender, camera_scene, chain, tmp_path):
    assert contents(camera_scene, chain) == ["2 cameras", "cam0: OpenCV Fisheye, 1 pose", "cam1: Double Sphere, 1 pose"]
    (tmp_path / "path.txt").write_text(TUM)
    assert contents(camera_scene, str(tmp_path / "path.txt")) == ["1 camera", "path: no lens, 2 poses"]
    (tmp_path / "chain.yaml").write_text("nothing: 1")
    with pytest.raises(InputError):
        contents(camera_scene, chain)
    assert [item.type for item in camera_scene.objects].count("CAMERA") == 1


@pytest.mark.parametrize("key", ["tum", "bop"])
def test_a_rig_in_meters_stands_where_it_was_exported_from(blender, camera_scene, tmp_path, key):
    camera_scene.unit_settings.scale_length = 0.01
    camera_scene.camera.location = 1, 2, 3
    _, (path,) = exports.write(camera_scene, key, [camera_scene.camera], [1, 2], tmp_path)
    (item,) = add_rig(camera_scene, [str(path)])
    assert np.allclose(item.location, (1, 2, 3), atol=1e-6)
    camera_scene.unit_settings.system = "NONE"  # Blender then ignores the scale
    (item,) = add_rig(camera_scene, [str(path)])
    assert np.allclose(item.location, (0.01, 0.02, 0.03), atol=1e-6)


def test_what_was_exported_is_read_into_blender_again(blender, camera_scene, tmp_path):
    camera_scene.camera.location, camera_scene.camera.rotation_euler = (1, 2, 3), (0.3, -0.4, 0.5)
    before = read_camera(camera_scene)
    exports.write(camera_scene, "colmap", [camera_scene.camera], [4], tmp_path)
    (item,) = add_rig(camera_scene, [str(tmp_path)])
    go_to(camera_scene, 4)
    after = read_camera(camera_scene, item)
    assert np.abs(after.pose.eye - before.pose.eye).max() < 1e-6
    assert np.abs(after.pose.basis - before.pose.basis).max() < 3e-7
    assert np.allclose(after.K, before.K, rtol=1e-14)


def test_a_folder_of_pictures_is_one_camera_with_keyframes(blender, camera_scene, tmp_path):
    """Of Polycam: the files' numbers are times; equal lenses stay linked to the first file."""
    matrix = {f"t_{i}{j}": float(i == j) for i in range(3) for j in range(4)}
    for time, x in ((500, 1.5), (90, 0.5)):
        lens = {"fx": 30.0, "fy": 30.0, "cx": 15.5, "cy": 7.5, "width": 32, "height": 16}
        (tmp_path / f"{time}.json").write_text(json.dumps(lens | matrix | {"t_03": x}))
    (item,) = add_rig(camera_scene, [str(tmp_path)])
    assert item.data.camera_ray_caster.calibration_file == str(tmp_path / "90.json")
    assert frames_of([item]) == [1, 2]
    for frame, x in ((1, 0.5), (2, 1.5)):
        go_to(camera_scene, frame)
        assert np.allclose(np.array(item.matrix_world)[:3, 3], (x, 0, 0), atol=1e-7)


def test_a_zoom_is_keyed(blender, camera_scene, tmp_path):
    (item,) = add_rig(camera_scene, [transforms(tmp_path, fl_x=30.0)])
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 32, 16
    for frame, fx in ((1, 30), (2, 30.5), (3, 31)):
        go_to(camera_scene, frame)
        assert read_camera(camera_scene, item).K[0, 0] == pytest.approx(fx, rel=1e-6)
        assert item.matrix_world.translation.x == pytest.approx(frame, abs=1e-6)


@pytest.mark.full
@pytest.mark.parametrize("numbered", [False, True])
def test_images_with_cameras_of_their_own_are_marked_cast_and_exported_once(blender, camera_scene, tmp_path, numbered):
    model = tmp_path / "model"
    model.mkdir()
    (model / "cameras.txt").write_text("1 PINHOLE 8 6 9 9 4 3\n2 OPENCV_FISHEYE 6 6 3 3 3 3 0 0 0 0\n")
    names = ("x_0001.png", "x_0002.png") if numbered else ("b.png", "a.png")
    lines = (f"{k} 1 0 0 0 {-k} 0 0 {k} {name}\n\n" for k, name in enumerate(names, 1))
    (model / "images.txt").write_text("".join(lines))
    file, out = tmp_path / "file.blend", tmp_path / "out"
    blender.ops.wm.save_as_mainfile(filepath=str(file))
    cameras = ("x-1", "x-2") if numbered else ("b", "a")
    rig = ["--rig", str(model)]
    assert commands.main("cast", [str(file), *rig, "--format", "NPZ", "--passes", "ray_origin", "--output", str(out)],
                         "it") == 0  # fmt: skip
    eyes = {path.stem: np.load(path)["ray_origin"] for path in out.glob("*.npz")}
    assert {name: (*eye[0, 0], eye.shape) for name, eye in eyes.items()} == {
        f"{cameras[0]}_0001": (1, 0, 0, (6, 8, 3)),
        f"{cameras[1]}_0002": (2, 0, 0, (6, 6, 3)),
    }
    assert commands.main("export", [str(file), *rig, "--format", "colmap", "--output", str(tmp_path / "c")], "it") == 0
    images = (tmp_path / "c" / "images.txt").read_text()
    assert images.count(".png") == 2
    scene = blender.context.scene
    add_rig(scene, [str(model)])
    seen = []
    for frame in (1, 2):
        go_to(scene, frame)
        scene.frame_set(frame)
        seen.append((scene.camera.name.rpartition(".")[0] or scene.camera.name, scene.camera.matrix_world[0][3]))
    assert seen == [(cameras[0], 1), (cameras[1], 2)]


def test_cast_all_and_exports_take_each_camera_in_the_frames_of_its_poses(blender, camera_scene, tmp_path):
    model = tmp_path / "model"
    model.mkdir()
    (model / "cameras.txt").write_text("1 PINHOLE 8 6 9 9 4 3\n2 OPENCV_FISHEYE 6 6 3 3 3 3 0 0 0 0\n")
    (model / "images.txt").write_text("".join(f"{k} 1 0 0 0 {-k} 0 0 {k} x_000{k}.png\n\n" for k in (1, 2)))
    scene = blender.context.scene
    blender.data.objects.remove(scene.camera)
    scene.frame_set(7)
    cast, export = blender.ops.camera_ray_caster.cast_all, blender.ops.camera_ray_caster.export
    add_rig(scene, [model])
    assert chosen_frames.usual(scene) == "POSES"
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "rig.blend"), copy=True)
    words = [str(tmp_path / "rig.blend"), "--camera", "x-2", "--poses", "--format", "NPZ", "--passes", "depth"]
    assert commands.main("cast", [*words, "--output", str(tmp_path / "of_one")], "it") == 0
    assert {path.stem for path in (tmp_path / "of_one").glob("*.npz")} == {"x-2_0002"}
    blender.ops.wm.open_mainfile(filepath=str(tmp_path / "rig.blend"))
    scene = blender.context.scene
    scene.frame_set(7)
    assert cast(directory=str(tmp_path / "all"), frames="POSES", format="NPZ") == {"FINISHED"}
    while in_process.tick() is not None:
        sleep(0.05)
    assert {path.stem for path in (tmp_path / "all").glob("*.npz")} == {"x-1_0001", "x-2_0002"}
    assert export(filepath=str(tmp_path / "e"), format="colmap", cameras="ALL", frames="POSES") == {"FINISHED"}
    assert (tmp_path / "e" / "images.txt").read_text().count(".png") == 2
    assert scene.frame_current == 7
    for item in scene.objects:
        item.pop("frames_of_poses", None)
    assert chosen_frames.usual(scene) == "RANGE"
    with pytest.raises(RuntimeError, match="No camera has poses from a file: choose Range or Current"):
        cast(directory=str(tmp_path / "none"), frames="POSES")


def test_a_rig_below_a_camera_sees_what_it_sees(blender, camera_scene, chain):
    camera_scene.camera.location = (1, 2, 3)
    left, _ = add_rig(camera_scene, [chain], camera_scene.camera)
    go_to(camera_scene, 1)
    assert np.allclose(left.matrix_world, camera_scene.camera.matrix_world, atol=1e-6)


def test_cameras_of_different_sizes_are_cast_into_one_folder(blender, camera_scene, chain, tmp_path, capfd):
    file, out = tmp_path / "file.blend", tmp_path / "out"
    blender.ops.wm.save_as_mainfile(filepath=str(file))
    content = file.read_bytes()
    words = [str(file), "--rig", chain, transforms(tmp_path), "--passes", "depth", "--format", "NPZ"]
    assert commands.main("cast", [*words, "--annotations", "--output", str(out)], "it") == 0
    assert file.read_bytes() == content
    sizes = {path.stem: np.load(path)["depth"].shape for path in out.glob("*.npz")}
    expected = {"cam0": (60, 80), "cam1": (50, 50), "pano": (16, 32)}
    assert sizes == {f"{name}_{frame:04}": size for name, size in expected.items() for frame in (1, 3)}
    images = json.loads((out / "annotations.json").read_text())["images"]
    assert {(image["width"], image["height"]) for image in images} == {(80, 60), (50, 50), (32, 16)}
    assert commands.main("export", [*words[:4], "--format", "json", "--output", str(tmp_path / "j")], "it") == 0
    cameras = json.loads((tmp_path / "j" / "camera.json").read_text())["cameras"]
    assert [camera["all_frames"]["record"]["resolution_x"] for camera in cameras] == [80, 50, 32]
    for key in ("json", "masks", "preview", "nerf"):
        assert commands.main("export", [str(out), "--format", key, "--output", str(tmp_path / key)], "it") == 2 * (
            key == "nerf"
        )
    exported = json.loads((tmp_path / "json" / "camera.json").read_text())["cameras"]
    assert {camera["all_frames"]["record"]["resolution_x"] for camera in exported} == {80, 50, 32}
    assert "NeRF cannot represent" in capfd.readouterr().err
    assert commands.main("export", [str(out), "--format", "json", "--resolution", "8x6"], "it") == 2
    assert "--resolution does not apply to a finished data set" in capfd.readouterr().err
    assert commands.main("export", [str(out), "--format", "json", "--poses"], "it") == 2
    assert "--poses does not apply to a finished data set" in capfd.readouterr().err
    assert commands.main("export", [str(file), "--format", "yolo"], "it") == 2
    wanted = f"--format yolo needs a finished data set: give its folder in place of {str(file)!r}"
    assert wanted in capfd.readouterr().err
    assert commands.main("cast", [str(file), "--rig", chain, "--camera", "Camera"], "it") == 2
    assert "--rig reads cameras and lenses" in capfd.readouterr().err


def test_the_operator_adds_the_cameras_and_refuses_what_is_none(blender, camera_scene, chain, tmp_path):
    assert blender.ops.camera_ray_caster.add_cameras(filepath=chain) == {"FINISHED"}
    assert {"cam0", "cam1"} <= set(camera_scene.objects.keys())
    before = len(camera_scene.objects)
    (tmp_path / "lens.json").write_text('{"K": [[500, 0, 320], [0, 500, 240], [0, 0, 1]]}')
    with pytest.raises(RuntimeError, match="it has no poses that are read"):
        blender.ops.camera_ray_caster.add_cameras(filepath=str(tmp_path / "lens.json"))
    assert len(camera_scene.objects) == before


def test_a_rolling_shutter_of_a_file_is_that_of_the_scene(blender, camera_scene, tmp_path):
    """It is written again as it was read, up to Blender's float32."""
    path = transforms(tmp_path, fl_x=20.0, fl_y=20.0)
    text = json.loads((tmp_path / "transforms.json").read_text())
    for frame in text["frames"]:
        last = np.array(frame["transform_matrix"])
        last[:3, 3] += 0.5, 0, 1
        frame |= {"fl_x": 20.0, "fl_y": 20.0, "transform_matrix_rs": last.tolist(),
                  "rolling_shutter": "ROLLING_LEFT_TO_RIGHT"}  # fmt: skip
        frame["rolling_shutter_offsets"] = [(-0.25 + 0.5 / 32) / 24, 0.25 / 24]
    (tmp_path / "transforms.json").write_text(json.dumps(text))
    notes = []
    (item,) = add_rig(camera_scene, [path], say=notes.append)
    assert notes == []
    assert item.data.camera_ray_caster.time_mode == "ROLLING_SHUTTER"
    assert camera_scene.render.motion_blur_shutter == pytest.approx(0.5, rel=1e-6)
    assert frames_of([item]) == [1, 3]
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 32, 16
    camera_scene.camera = item
    _, (again,) = exports.write(camera_scene, "nerfstudio", [item], [1, 3], tmp_path / "again")
    for entry, other in zip(text["frames"], json.loads(again.read_text())["frames"], strict=True):
        for name in ("transform_matrix", "transform_matrix_rs", "rolling_shutter_offsets"):
            np.testing.assert_allclose(other[name], entry[name], rtol=0, atol=1e-5)
