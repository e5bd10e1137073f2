"""Cameras by key and settings: those of a record with the same numbers, and refusals in one line."""

from pathlib import Path

import cv2
import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.parts.settings import RECORD_FIELDS, Line
from camera_ray_caster.core.records import BlenderCamera

from ..cameras.table_examples import pinhole

SIZE = 96, 54
LINES = {
    "slit_1": [(-1.0, 0.2, -3.0), (1.0, 0.3, 0.1)],
    "slit_2": [(0.0, -1.0, -6.0), (0.1, 1.0, 0.2)],
    "path": [(-1.0, 0.0, -3.0), (0.0, 0.1, -3.2), (1.0, 0.0, -3.0)],
}


def lines_of(model):
    return {setting.name: LINES[setting.name] for setting in model.SETTINGS if isinstance(setting, Line)}


def tables_of(model):
    return {"ray_directions": pinhole()} if model.key == "RAY_TABLE" else {}


@pytest.mark.one_for_each("model")
@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_a_model_by_its_key_is_that_of_its_declared_defaults(model):
    cam = crc.camera(model.key, SIZE, **lines_of(model), **tables_of(model))
    declared = [setting for setting in model.SETTINGS if setting.name not in RECORD_FIELDS]
    settings = {setting.name: setting.default for setting in declared} | tables_of(model)
    for name, line in lines_of(model).items():
        points = np.array(line) if name == "path" else np.array((line[0], np.add(*line)))
        settings[name] = points, np.eye(4), [(k, k + 1) for k in range(len(points) - 1)]
    raw = BlenderCamera("Camera", "PERSP", np.eye(4), resolution_x=96, resolution_y=54, model=model.key,
                        settings=settings, **model.following({}))  # fmt: skip
    expected = camera_from(raw).rays()
    np.testing.assert_array_equal(cam.rays().directions, expected.directions)
    np.testing.assert_array_equal(cam.rays().origins, expected.origins)
    assert cam == cam
    assert cam == crc.camera(model.key, SIZE, **lines_of(model), **tables_of(model))
    assert len({cam, cam}) == 1


def test_numbers_in_pixels_are_those_of_the_picture():
    K, terms = np.array([[301.5, 0, 322.25], [0, 299.0, 238.5], [0, 0, 1]]), [0.05, -0.01, 0.002, 1e-4]
    k1, k2, k3, k4 = terms
    cam = crc.camera(
        "OPENCV_FISHEYE", (640, 480), fx=301.5, fy=299.0, cx=322.25, cy=238.5, k1=k1, k2=k2, k3=k3, k4=k4
    )
    points = np.random.default_rng(1).normal(size=(50, 3)) * (1, 1, 0.1) - (0, 0, 2)
    theirs, _ = cv2.fisheye.projectPoints((points * (1, -1, -1))[:, None], np.zeros(3), np.zeros(3), K, np.array(terms))
    np.testing.assert_allclose(cam.project(points) * (1, -1) + (-0.5, 479.5), theirs[:, 0], rtol=0, atol=1e-9)
    np.testing.assert_array_equal(cam.K, K)


def test_what_is_left_out_of_a_calibration_belongs_to_the_picture():
    cam = crc.camera("OPENCV_PINHOLE", (640, 480), fx=500.0, fy=500.0)
    np.testing.assert_array_equal(cam.K, [[500, 0, 319.5], [0, 500, 239.5], [0, 0, 1]])
    scaled = crc.camera("OPENCV_PINHOLE", (960, 540), fx=500.0, calibration_width=1920, calibration_height=1080)
    assert scaled.K[0, 0] == 250


@pytest.mark.parametrize("number", [np.float32(35), np.float64(35), np.int64(35), np.array(35.0), 35])
def test_numbers_of_numpy_are_numbers(number):
    assert crc.camera("PERSP", np.array(SIZE), lens=number).K[0, 0] == crc.camera("PERSP", SIZE, lens=35.0).K[0, 0]


def test_words_flags_lists_and_images():
    ftheta = crc.camera(
        "FTHETA", SIZE, ftheta_radius_to_angle=np.array([0.0, 0.02]), ftheta_reference="RADIUS_TO_ANGLE"
    )
    text = crc.camera("FTHETA", SIZE, ftheta_radius_to_angle="0 0.02", ftheta_reference="RADIUS_TO_ANGLE")
    np.testing.assert_array_equal(ftheta.rays().directions, text.rays().directions)
    timed = crc.camera("PERSP", SIZE, time_mode="IMAGE", time_image=[[0.0, 1.0]], time_start=1, time_end=9)
    assert np.unique(timed.rays().time).tolist() == [1, 9]
    rolling = crc.camera("PERSP", SIZE, time_mode="ROLLING_SHUTTER", frame=10, motion_blur_shutter=1.0)
    assert rolling.rays().time[0, 0] - rolling.rays().time[-1, 0] == pytest.approx(53 / 54)
    lens = crc.camera("PERSP", SIZE, use_dof=True, aperture_fstop=2.0, focus_distance=3.0)
    assert (lens.aperture.radius, lens.aperture.focus) == (0.0125, 3.0)
    border = crc.camera("PERSP", SIZE, use_border=True, border_max_x=0.5)
    assert border.rays().valid.shape == (54, 48)


def test_a_closed_path_is_closed():
    ring = [(np.sin(a), 0.0, -3 - np.cos(a)) for a in np.linspace(0, 2 * np.pi, 9)]
    ring[-1] = ring[0]
    rays = crc.camera("STRIP", SIZE, path=ring, follow_path=True).rays()
    np.testing.assert_allclose(rays.directions[0, 0], rays.directions[0, -1], atol=0.1)


@pytest.mark.parametrize(
    ("words", "settings", "message"),
    [
        (("OPENCV_FISHEY", SIZE), {}, "did you mean OPENCV_FISHEYE"),
        (("KB4", SIZE), {}, "did you mean OPENCV_FISHEYE"),
        ((None, SIZE), {}, "unknown model None"),
        (("PERSP", SIZE), {"lense": 35}, "did you mean lens"),
        (("PERSP", SIZE), {"fx": 35}, "unknown setting of PERSP 'fx'"),
        (("PERSP", SIZE), {"lens": np.nan}, "lens of camera 'Camera' is nan"),
        (("PERSP", SIZE), {"lens": "long"}, "lens is 'long': it must be a number"),
        (("PERSP", SIZE), {"lens": [35, 36]}, "lens is"),
        (("PERSP", SIZE), {"clip_end": np.nan}, "clip_end"),
        (("PERSP", SIZE), {"use_border": "yes"}, "use_border"),
        (("PERSP", SIZE), {"border_max_x": 2.0}, "border_max_x"),
        (("PERSP", SIZE), {"use_dof": True, "focus_distance": np.nan}, "focus_distance"),
        (("PERSP", SIZE), {"time_mode": "COLUMN"}, "did you mean COLUMNS"),
        (("PERSP", SIZE), {"time_start": 3}, "unknown setting"),
        (("PERSP", SIZE), {"sensor_fit": "automatic"}, "AUTO"),
        (("PERSP", SIZE), {"name": 3}, "name"),
        (("PERSP", SIZE), {"name": "\ud800"}, "without halves of characters"),
        (("PERSP", SIZE), {"lens": 10**400}, "lens is 10.*: it must be a number up to"),
        (("PERSP", SIZE), {"clip_end": 10**400}, "clip_end is 10.*: it must be a number from"),
        (("PERSP", SIZE), {"time_mode": []}, r"unknown time_mode \[\]"),
        (("PERSP", 96), {}, "size is 96"),
        (("PERSP", (96, 0)), {}, "height is 0"),
        (("PERSP", (96.5, 10)), {}, "width is 96.5"),
        (("PERSP", (10**9, 10)), {}, "65536"),
        (("PERSP", SIZE, np.eye(3)), {}, r"pose is of shape \(3, 3\)"),
        (("PERSP", SIZE, np.full((4, 4), np.nan)), {}, "pose"),
        (("PERSP", SIZE, np.zeros((4, 4))), {}, "scale of zero"),
        (("PUSHBROOM", SIZE), {}, "PUSHBROOM needs slit_1: a point and a direction"),
        (("PUSHBROOM", SIZE), {"slit_1": [1, 2, 3]}, r"slit_1 is of shape \(3,\)"),
        (("PUSHBROOM", SIZE), {"slit_1": [(0, 0, np.nan), (1, 0, 0)]}, r"slit_1 is of shape \(2, 3\), with NaN"),
        (("PERSP", SIZE), {"frame": np.nan}, "frame is nan: it must be a number from"),
        (("PERSP", SIZE), {"frame": 1e300}, "frame is 1e\\+300: it must be a number from"),
        (("RAY_TABLE", SIZE), {"ray_directions": [[["a"] * 9] * 9] * 9}, r"ray_directions is .{197}\.\.\.: it must be"),
        (("STRIP", SIZE), {"path": [(0, 0, 0)]}, "path of camera 'Camera' has no length"),
        (("GENERAL_LINEAR", SIZE), {"ray_1": (1, 2)}, "ray_1"),
        (
            ("FTHETA", SIZE),
            {"ftheta_radius_to_angle": "a b", "ftheta_reference": "RADIUS_TO_ANGLE"},
            "ftheta_radius_to_angle",
        ),
        (("OPENCV_PINHOLE", SIZE), {"calibration_width": 3.5}, "whole number"),
        (("OPENCV_PINHOLE", SIZE), {"calibration_file": "/no/file.yml"}, "/no/file.yml"),
    ],
)
def test_what_no_camera_can_be_is_one_line(words, settings, message):
    with pytest.raises(crc.InputError, match=message) as caught:
        crc.camera(*words, **settings)
    assert "\n" not in str(caught.value)


def test_a_calibration_file_is_a_camera_of_its_size(tmp_path):
    camera = crc.camera("OPENCV_FISHEYE", (640, 480), name="left", fx=301.5, fy=299.0, cx=322.25, cy=238.5, k1=0.05)
    (path,) = crc.export(camera, tmp_path, "opencv").paths
    pose = crc.look_at((1, 2, 3), (0, 0, 0))
    loaded = crc.load_calibration(path, pose=pose)
    np.testing.assert_array_equal(loaded.K, camera.K)
    np.testing.assert_array_equal(loaded.pose.eye, (1, 2, 3))
    assert loaded.model.key == "OPENCV_FISHEYE"
    assert crc.load_calibration(Path(path), size=(320, 240)).K[0, 0] == camera.K[0, 0] / 2
    for words, message in (
        (("/no/such.yml",), "No such file"),
        ((3,), "path is 3"),
        ((path, "right"), "no camera 'right'"),
        ((path,), "of another shape"),
    ):
        with pytest.raises(crc.InputError, match=message):
            crc.load_calibration(*words, size=(640, 640) if "shape" in message else None)


def test_poses_of_opencv_and_of_two_points():
    pose = crc.look_at((3, -4, 2), (0.5, 0, 1))
    camera = crc.camera("PERSP", SIZE, pose)
    np.testing.assert_allclose(camera.project([0.5, 0, 1]), (48, 27), atol=1e-12)
    np.testing.assert_allclose(crc.pose_from_opencv(camera.opencv_from_world), pose, atol=1e-15)
    assert np.linalg.det(pose[:3, :3]) == pytest.approx(1)
    assert (pose[:3, :3] @ (0, 1, 0))[2] > 0
    for target, said in ((0, 0, 0), "same point: give another target"), ((0, 0, 5), "one line: give another up"):
        with pytest.raises(crc.InputError, match=said):
            crc.look_at((0, 0, 0), target)


def test_the_size_of_a_camera_does_not_change_alone():
    from dataclasses import replace

    camera = crc.camera("PERSP", SIZE)
    with pytest.raises(crc.InputError, match="of another size anew"):
        replace(camera, raster=replace(camera.raster, width=20, x1=20))


def test_the_list_of_models_is_a_table():
    table = crc.models()
    assert list(table) == [model.key for model in MODELS]
    assert "PUSHBROOM" in repr(table)
    with pytest.raises(KeyError, match="unknown model 'PUSBROOM': did you mean PUSHBROOM"):
        table["PUSBROOM"]
    assert "slit_1" in next(line for line in repr(table).splitlines() if line.startswith("PUSHBROOM"))
