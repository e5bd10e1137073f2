"""Calibration files of each format: the camera that they make, against the format's own reader where there is one."""

import json
from math import atan

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.programs.colmap import CAMERA_MODELS as COLMAP
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera
from ..colmap import colmap, project

FRAME = {"resolution_x": 640, "resolution_y": 480}
PARAMETERS = {
    "f": 301.25, "fx": 301.25, "fy": 299.5, "cx": 322.125, "cy": 238.75,
    "k1": -0.03, "k2": 0.004, "k3": -1e-3, "k4": 2e-4, "k5": 1e-4, "k6": -1e-5, "p1": 1e-3, "p2": -2e-3,
    "s1": 3e-3, "s2": -1e-3, "s3": -2e-3, "s4": 5e-4,
    "fov_omega": 0.9, "division_lambda": -0.2, "unified_alpha": 0.6, "unified_beta": 1.1,
}  # fmt: skip
KEYS = [model.key for model in MODELS]


def of_file(path, text, key, **settings):
    path.write_text(text)
    return camera(key, FRAME | {"calibration_file": str(path)} | settings)


@pytest.mark.parametrize("kind", [kind for kind in COLMAP if kind != "EQUIRECTANGULAR"])
def test_cameras_txt_projects_as_colmap_does(tmp_path, kind):
    key, names = COLMAP[kind]
    values = [PARAMETERS[name] for name in names]
    (tmp_path / "cameras.txt").write_text(
        "# Camera list with one line of data per camera:\n"
        f"7 PINHOLE 640 480 500 500 320 240\n12 {kind} 640 480 {' '.join(map(repr, values))}\n"
    )
    named = {"calibration_file": str(tmp_path / "cameras.txt"), "calibration_camera": "12"}
    cam = camera(key, FRAME | named)
    points = np.random.default_rng(3).uniform((-1, -1, -3), (1, 1, -1), (10_000, 3))
    if kind == "FOV":  # near the axis COLMAP takes a series that is right to 1e-5 pixels
        points = points[np.hypot(points[:, 0], points[:, 1]) > 0.03 * -points[:, 2]]
    expected = colmap(project, kind, 640, 480, values, points * (1, -1, -1))
    assert np.abs(cam.project(points) - np.stack((expected[:, 0], 480 - expected[:, 1]), axis=1)).max() < 1e-9
    assert cam.settings["fy"] == values[names.index("f" if names[0] == "f" else "fy")]


SIZE = {"calibration_width": 640.0, "calibration_height": 480.0}
K = {"fx": 300.0, "fy": 301.0, "cx": 320.5, "cy": 239.25}
NUMBERS = "300.0, 301.0, 320.5, 239.25"
RADTAN = {"k1": -0.1, "k2": 0.02, "p1": 1e-3, "p2": -2e-3}
EQUIDISTANT = {"k1": -0.1, "k2": 0.02, "k3": 1e-3, "k4": -2e-3}
FOUR = "-0.1, 0.02, 0.001, -0.002"
LIST = [-0.1, 0.02, 0, 0, 1e-3, -2e-3]
"""RADTAN as nerfstudio's distortion_params: k1, k2, k3, k4, p1, p2."""


def camchain(model, intrinsics, bend, coefficients):
    return (
        f"cam0:\n  cam_overlaps: [1]\n  camera_model: {model}\n  distortion_coeffs: [{coefficients}]\n"
        f"  distortion_model: {bend}\n  intrinsics: [{intrinsics}]\n  resolution: [640, 480]\n"
        "  rostopic: /cam0/image_raw\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, 0.0]\n  - [0.0, 1.0, 0.0, 0.0]\n"
    )


def mrcal(model, intrinsics):
    return (
        f"# made by a test\n{{\n  'lensmodel':  'LENSMODEL_{model}',\n\n  'intrinsics': [ {intrinsics},],\n"
        "  'extrinsics': [ 0, 0, 0, 0, 0, 0,],\n  'imagersize': [ 640, 480,]\n}\n"
    )


def aria(kind, parameters):
    projection = {"Description": "", "Name": kind, "Params": parameters}
    return json.dumps(
        {"CameraCalibrations": [{"Label": "camera-rgb", "Projection": projection}], "ImuCalibrations": []}
    )


def transforms(**entries):
    frames = [{"file_path": f"images/{i}.png", "transform_matrix": np.eye(4).tolist()} for i in range(2)]
    return json.dumps({"w": 640, "h": 480, "cx": 321.0, "cy": 239.75, "frames": frames} | entries)


ROS = """image_width: 640
image_height: 480
camera_name: narrow
camera_matrix:
  rows: 3
  cols: 3
  data: [300, 0, 320.5, 0, 301, 239.25, 0, 0, 1]
distortion_model: {}
distortion_coefficients:
  rows: 1
  cols: {}
  data: [{}]
projection_matrix:
  rows: 3
  cols: 4
  data: [300, 0, 320.5, 0, 0, 301, 239.25, 0, 0, 0, 1, 0]
"""
TOPIC = """height: 480
width: 640
distortion_model: plumb_bob
D: []
K: [300, 0, 320.5, 0, 301, 239.25, 0, 0, 1]
"""
PAIR = """image_width: 640
image_height: 480
M1: [300, 0, 320.5, 0, 301, 239.25, 0, 0, 1]
D1: [-0.1, 0.02, 0.001, -0.002]
M2: [400, 0, 320.5, 0, 301, 239.25, 0, 0, 1]
D2: [-0.3, 0.02, 0.001, -0.002]
"""
OMNIDIR = """%YAML:1.0
---
image_width: 640
image_height: 480
K: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 300., 1.5, 320.5, 0., 301., 239.25, 0., 0., 1. ]
D: !!opencv-matrix
   rows: 1
   cols: 4
   dt: d
   data: [ -0.1, 0.02, 0.001, -0.002 ]
xi: 1.25
"""
K_TERMS, S_TERMS = dict(zip(("k1", "k2", "k3", "k4", "k5", "k6"), (1e-2, 2e-2, 3e-3, 4e-4, 5e-5, 6e-6), strict=True)), {
    "s1": 3e-3, "s2": -1e-3, "s3": -2e-3, "s4": 5e-4,
}  # fmt: skip
SAID = [
    ("camchain.yaml", camchain("pinhole", NUMBERS, "radtan", FOUR), "OPENCV_PINHOLE", RADTAN),
    ("camchain.yaml", camchain("pinhole", NUMBERS, "equidistant", FOUR), "OPENCV_FISHEYE", EQUIDISTANT),
    ("camchain.yaml", camchain("pinhole", NUMBERS, "fov", "0.9"), "FOV", {"fov_omega": 0.9}),
    ("camchain.yaml", camchain("omni", f"1.25, {NUMBERS}", "radtan", FOUR), "UCM", RADTAN | {"unified_xi": 1.25}),
    ("camchain.yaml", camchain("eucm", f"0.6, 1.1, {NUMBERS}", "none", ""), "EUCM",
     {"unified_alpha": 0.6, "unified_beta": 1.1}),
    ("camchain.yaml", camchain("ds", f"-0.2, 0.6, {NUMBERS}", "none", ""), "DOUBLE_SPHERE",
     {"unified_xi": -0.2, "unified_alpha": 0.6}),
    ("a.cameramodel", mrcal("OPENCV4", f"{NUMBERS}, {FOUR}"), "OPENCV_PINHOLE", RADTAN),
    ("a.cameramodel", mrcal("OPENCV12", f"{NUMBERS}, {FOUR}, 3e-3, 4e-4, 5e-5, 6e-6, 3e-3, -1e-3, -2e-3, 5e-4"),
     "OPENCV_PINHOLE", RADTAN | S_TERMS | {"k3": 3e-3, "k4": 4e-4, "k5": 5e-5, "k6": 6e-6}),
    # 2 tan(theta / 2) in focal lengths
    ("a.cameramodel", mrcal("STEREOGRAPHIC", NUMBERS), "UCM", {"fx": 600.0, "fy": 602.0, "unified_xi": 1.0}),
    ("aria.json",
     aria("FisheyeRadTanThinPrism", [300.0, 320.5, 239.25, *K_TERMS.values(), -2e-3, 1e-3, *S_TERMS.values()]),
     "FISHEYE624", {**K_TERMS, **S_TERMS, "p1": 1e-3, "p2": -2e-3, "fy": 300.0,
                    "calibration_width": 0.0, "calibration_height": 0.0}),
    ("aria.json", aria("KannalaBrandtK3", [300.0, 301.0, 320.5, 239.25, *EQUIDISTANT.values()]), "OPENCV_FISHEYE",
     EQUIDISTANT | {"calibration_width": 0.0, "calibration_height": 0.0}),
    ("transforms.json", transforms(fl_x=300, fl_y=301, camera_model="OPENCV", **RADTAN), "OPENCV_PINHOLE", RADTAN),
    ("transforms.json", transforms(fl_x=300, fl_y=301, camera_model="OPENCV_FISHEYE", **EQUIDISTANT), "OPENCV_FISHEYE",
     EQUIDISTANT),
    ("transforms.json", transforms(camera_angle_x=2 * atan(320 / 300), fl_y=301), "OPENCV_PINHOLE", {}),
    # nerfstudio distorts a PINHOLE, too; an entry at the top counts for all frames, then those of the frame do
    ("transforms.json", transforms(fl_x=300, fl_y=301, camera_model="PINHOLE", **RADTAN), "OPENCV_PINHOLE", RADTAN),
    ("transforms.json", transforms(fl_x=300, fl_y=301, frames=[{"fl_x": 9, **RADTAN}]), "OPENCV_PINHOLE", RADTAN),
    # the list stands for all coefficients, and one of the whole file takes those of the frames away
    ("transforms.json", transforms(fl_x=300, fl_y=301, distortion_params=LIST, k1=9.0), "OPENCV_PINHOLE", RADTAN),
    ("transforms.json", transforms(fl_x=300, fl_y=301, frames=[{"distortion_params": LIST}]), "OPENCV_PINHOLE", RADTAN),
    ("transforms.json", transforms(fl_x=300, fl_y=301, is_fisheye=True,
                                   distortion_params=[*EQUIDISTANT.values(), 0, 0]), "OPENCV_FISHEYE", EQUIDISTANT),
    ("transforms.json", transforms(fl_x=300, fl_y=301, frames=[{"k2": 0.3}], **RADTAN | {"k2": 0.0}), "OPENCV_PINHOLE",
     RADTAN | {"k2": 0.0}),
    ("transforms.json", transforms(fl_x=300, camera_angle_y=2 * atan(240 / 301)), "OPENCV_PINHOLE", {}),
    ("ros.yaml", ROS.format("plumb_bob", 5, FOUR + ", 0.003"), "OPENCV_PINHOLE", RADTAN | {"k3": 0.003}),
    ("ros.yaml", ROS.format("equidistant", 4, FOUR), "OPENCV_FISHEYE", EQUIDISTANT),
    ("topic.yaml", TOPIC, "OPENCV_PINHOLE", {}),
    ("plain.yml", "width: 640\nheight: 480\nK:\n- - 300.0\n  - 0.0\n  - 320.5\n- - 0.0\n  - 301.0\n  - 239.25\n"
     "- - 0.0\n  - 0.0\n  - 1.0\nD:\n- 0.0\n", "OPENCV_PINHOLE", {}),
    ("omnidir.yml", OMNIDIR, "UCM", RADTAN | {"unified_xi": 1.25, "skew": 1.5}),
    ("omnidir.yml", OMNIDIR.replace("cols: 4", "cols: 5").replace("-0.002 ]", "-0.002, 0. ]"), "UCM",
     RADTAN | {"unified_xi": 1.25, "skew": 1.5}),
]  # fmt: skip


@pytest.mark.parametrize(("name", "text", "key", "settings"), SAID)
def test_a_file_is_the_camera_of_its_numbers(tmp_path, name, text, key, settings):
    lens = of_file(tmp_path / name, text, key)
    expected = camera(key, FRAME | SIZE | K | settings)
    for setting, value in expected.settings.items():
        assert isinstance(value, str) or lens.settings[setting] == pytest.approx(value, rel=1e-15), setting
    assert lens.model == expected.model or "camera_angle" in text
    wrong = "FOV" if key != "FOV" else "EUCM"
    with pytest.raises(InputError, match=f"{name}.* is a calibration for .*: choose that model"):
        of_file(tmp_path / name, text, wrong)


GOOD = camchain("pinhole", NUMBERS, "radtan", FOUR)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (GOOD + GOOD.replace("cam0:", "cam1:"), "2 cameras: set Camera in File .* to one of cam0, cam1"),
        (
            GOOD.replace("radtan", "spline"),
            "distortion_model of cam0, pinhole, is 'spline'.* none, radtan, radialtangential8, equidistant, fov",
        ),
        (GOOD.replace(": pinhole", ": periscope"), "camera_model of cam0 is 'periscope'"),
        (GOOD.replace("[640, 480]", "[640]"), "resolution of cam0 is .* 2 finite numbers"),
        (GOOD.replace("320.5", ".nan"), "intrinsics of cam0 .* finite numbers"),
        (GOOD.replace("300.0", "-300.0"), "fx of camera .* is -300: .*; calibration file .*lens"),
        (mrcal("OPENCV4", NUMBERS), "intrinsics .* 8 finite numbers"),
        (mrcal("SPLINED", NUMBERS), "lensmodel is 'LENSMODEL_SPLINED'"),
        (mrcal("OPENCV4", NUMBERS)[:-3], "is not a cameramodel file of mrcal"),
        ("1 PINHOLE 640 480 500 500 320\n", "camera 1 .* 6 finite numbers"),
        ("1 PERISCOPE 640 480 500 500 320 240\n", "'PERISCOPE': it must be one of SIMPLE_PINHOLE"),
        (aria("Spherical", [1.0]), "Projection of 'camera-rgb' is 'Spherical'"),
        (aria("Linear", [1.0]), "Params of camera-rgb .* 4 finite numbers"),
        (transforms(fl_x=300, camera_model="VR180_L"), "camera_model is 'VR180_L'"),
        (transforms(fl_x=300, k4=0.1), "k4 is not 0, but OpenCV's pinhole has no"),
        (transforms(fl_x=300, distortion_params=[0, 0, 0, 0.1, 0, 0]), "k4 is not 0"),
        (transforms(fl_x=300, distortion_params=[0.1, 0]), "distortion_params is .* 6 finite numbers"),
        (transforms(fl_x=300, is_fisheye=True, p2=0.1), "p2 is not 0, but OpenCV's fisheye has no"),
        (transforms(fl_x=300, latlong=True), "its entry latlong of instant-ngp is not read"),
        (transforms(fl_x="wide"), "fl_x is .*'wide'.* finite number"),
        (transforms(fl_x=300, camera_model=["OPENCV"]), "camera_model is .'OPENCV'.: it must be one of"),
        (transforms(camera_angle_x=0), "camera_angle_x is 0: it must be above 0 and below pi"),
        (transforms(fl_x=300, ftheta_p0=0.0), "f-theta lens of instant-ngp"),
        (transforms(fl_x=300, frames=[{"k1": 0.1}, {"k1": 0.2, "file_path": "b"}]), "2 cameras: .* to one of 0, b"),
        (aria(["Linear"], [1.0]), "Name of camera-rgb is .'Linear'.: it must be one word"),
        ('{"CameraCalibrations": []}', "has no camera"),
        (mrcal("PINHOLE", NUMBERS).replace("'LENSMODEL_PINHOLE'", "['LENSMODEL_PINHOLE']"), "lensmodel is .'LENSMODEL"),
        ("{['LENSMODEL_PINHOLE']: 1}", "not a cameramodel file"),
        (mrcal("PINHOLE", NUMBERS).replace("640", "9" * 400), "imagersize is .* 2 finite numbers"),
        (GOOD.replace("distortion_model: radtan", ""), "cam0 has distortion_coeffs and no distortion_model"),
        (GOOD.replace("[640,", "[640.4,"), "its image size is 640.4 x 480: .* whole numbers above 0"),
        ("1 PINHOLE 0 0 500 500 320 240\n", "its image size is 0 x 0"),
        ("1 PINHOLE -640 480 500 500 320 240\n", "its image size is -640 x 480"),
        (TOPIC + "camera_matrix: [600, 0, 320.5, 0, 301, 239.25, 0, 0, 1]\n", "camera_matrix and K differ"),
        (TOPIC + "image_width: 1280\n", "image_width and width differ: leave one out"),
        *(
            (TOPIC.replace("plumb_bob", word) + more, rf"{more.split(':')[0]} is .* contradict each other")
            for word, more in [("equidistant", "fisheye: 0\n"), ("radtan", "fisheye: 1\n"), ("radtan", "type: KB4\n")]
        ),
        (TOPIC.replace("plumb_bob", "none").replace("[]", "[0.1, 0, 0, 0]"), "distortion_model none: say which it is"),
        (PAIR, "2 cameras: set Camera in File .* to one of 1, 2"),
        (TOPIC + "roi: {x_offset: 1, width: 640}\n", "roi reaches beyond the picture of 640 x 480"),
        (TOPIC + "roi: {x_offset: left}\n", "x_offset of roi is 'left'.* finite number"),
        (2 * "1 PINHOLE 640 480 500 500 320 240\n", "two cameras of one name: give each its own"),
    ],
)
def test_a_file_without_meaning_is_refused_by_its_field(tmp_path, text, says):
    with pytest.raises(InputError, match=says) as refusal:
        of_file(tmp_path / "lens", text, "OPENCV_PINHOLE")
    assert "\n" not in str(refusal.value)
    assert "lens" in str(refusal.value)


@pytest.mark.parametrize("key", ["OPENCV_PINHOLE", "OPENCV_FISHEYE"])
def test_a_pinhole_with_an_equidistant_distortion_is_a_fisheye_whatever_is_chosen(tmp_path, key):
    (tmp_path / "lens").write_text("camera_model: pinhole\n" + TOPIC.replace("plumb_bob", "equidistant"))
    assert [lens.model for lens in lenses_of(str(tmp_path / "lens"), key)] == ["OPENCV_FISHEYE"]


def test_a_region_of_interest_is_the_picture(tmp_path):
    """As ROS's image_geometry crops the camera matrix of the whole sensor."""
    region = "roi:\n  x_offset: 160\n  y_offset: 120\n  height: 240\n  width: 320\n"
    frame = {"resolution_x": 320, "resolution_y": 240}
    cropped = of_file(tmp_path / "region.yaml", TOPIC + region, "OPENCV_PINHOLE", **frame)
    whole = of_file(tmp_path / "whole.yaml", TOPIC + "roi: {width: 0, height: 0}\n", "OPENCV_PINHOLE")
    points = np.array([(0.1, 0.2, -1.0), (-0.3, 0.1, -1.0), (0.0, 0.0, -1.0)])
    np.testing.assert_allclose(cropped.project(points), whole.project(points) - [(160, 120)], rtol=1e-13)


@pytest.mark.parametrize(
    "frame",
    [
        {"resolution_x": 1920, "resolution_y": 1440},
        {"resolution_x": 640, "resolution_y": 480, "resolution_percentage": 33},  # 211 x 158
        {"resolution_x": 320, "resolution_y": 480, "pixel_aspect_x": 2.0},
        {"resolution_x": 640, "resolution_y": 480, "pixel_aspect_x": 2.0},
    ],
)
def test_a_frame_of_the_picture_s_shape_is_that_picture_scaled(tmp_path, frame):
    model = of_file(tmp_path / "camchain.yaml", GOOD, "OPENCV_PINHOLE", **frame).model
    across, up = model.size[0] / 640, model.size[1] / 480
    expected = [[300 * across, 0, 321 * across - 0.5], [0, 301 * up, 239.75 * up - 0.5], [0, 0, 1]]
    np.testing.assert_allclose(model.K, expected, rtol=1e-14)


@pytest.mark.parametrize("frame", [{"resolution_x": 1920, "resolution_y": 1080}, {"resolution_y": 482}])
def test_a_frame_of_another_shape_is_refused_with_both_sizes(tmp_path, frame):
    size = f"{frame.get('resolution_x', 640)} x {frame['resolution_y']}"
    says = f"calibration_width and calibration_height of .*yaml' are 640 x 480, and the frame is {size}"
    with pytest.raises(InputError, match=says) as refusal:
        of_file(tmp_path / "camchain.yaml", GOOD, "OPENCV_PINHOLE", **frame)
    assert "\n" not in str(refusal.value)
