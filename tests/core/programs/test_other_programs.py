"""Calibrations of robots, phones, simulators and data sets: the lens of their numbers, and those without a size."""

import json
from math import radians, tan

import numpy as np
import pytest

from camera_ray_caster.core.camera.calibration_file import chosen_lens, has_size
from camera_ray_caster.core.exports.camera_json import camera_to_json
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera

SIZE = {"calibration_width": 640.0, "calibration_height": 480.0}
NO_SIZE = {"calibration_width": 0.0, "calibration_height": 0.0}
K = {"fx": 300.0, "fy": 301.0, "cx": 320.5, "cy": 239.25}
RADTAN = {"k1": -0.1, "k2": 0.02, "p1": 1e-3, "p2": -2e-3}
EQUIDISTANT = {"k1": -0.1, "k2": 0.02, "k3": 1e-3, "k4": -2e-3}
PINHOLE, FISHEYE = "OPENCV_PINHOLE", "OPENCV_FISHEYE"


def yaml_of(entries, indent="", first="%YAML:1.0\n---\n"):
    """Nested mappings as camodocal writes them."""
    lines = first
    for name, value in entries.items():
        inside = yaml_of(value, f"{indent}   ", "\n") if isinstance(value, dict) else f" {value}\n"
        lines += f"{indent}{name}:{inside}"
    return lines


def vins(kind, projection, distortion, **more):
    named = {"model_type": kind, "camera_name": "image_02", "image_width": 640, "image_height": 480}
    return yaml_of(named | more | {"distortion_parameters": distortion, "projection_parameters": projection})


def orb_slam(**settings):
    lens = {f"Camera.{name}": value for name, value in (K | settings).items()}
    return yaml_of(lens | {"Camera.fps": 30.0, "ORBextractor.nFeatures": 1000, "Viewer.PointSize": 2})


def basalt(kind, **more):
    intrinsics = {"camera_type": kind, "intrinsics": K | more}
    pose = {"px": 0, "py": 0, "pz": 0, "qx": 0, "qy": 0, "qz": 0, "qw": 1}
    return json.dumps({"value0": {"T_imu_cam": [pose, pose], "intrinsics": [intrinsics], "resolution": [[640, 480]]}})


def sensor(distortion, numbers, model="pinhole"):
    """EuRoC's sensor.yaml, with the pose under its key as people's tools write it."""
    return f"""# General sensor definitions.
sensor_type: camera
T_BS:
  cols: 4
  rows: 4
  data:
    [1.0, 0.0, 0.0, 0.1,
     0.0, 1.0, 0.0, 0.2,
     0.0, 0.0, 1.0, 0.3,
     0.0, 0.0, 0.0, 1.0]
rate_hz: 20
resolution: [640, 480]
camera_model: {model}
intrinsics: [300.0, 301.0, 320.5, 239.25] #fu, fv, cu, cv
distortion_model: {distortion}
distortion_coefficients: {numbers}
"""


OKVIS = """%YAML:1.0
cameras:
     - {T_SC:
        [1, 0, 0, 0,
         0, 1, 0, 0],
        image_dimension: [640, 480],
        distortion_coefficients: [-0.1, 0.02, 0.001, -0.002],
        distortion_type: KIND,
        focal_length: [300.0, 301.0],
        principal_point: [320.5, 239.25]}
imu_params:
    rate: 200
"""
MATRIX = [[300.0, 0, 320.5], [0, 301.0, 239.25], [0, 0, 1]]
BY_ROWS, BY_COLUMNS = np.ravel(MATRIX).tolist(), np.ravel(MATRIX, "F").tolist()
ISAAC = {
    "cameraAperture": [20.0, 15.0], "cameraFisheyeMaxFOV": 200.0, "cameraFisheyeNominalHeight": 480,
    "cameraFisheyeNominalWidth": 640, "cameraFisheyeOpticalCentre": [320, 240],
    "cameraFisheyePolynomial": [0, 0.0033, 0, 0, 0], "cameraFocalLength": 10.0, "renderProductResolution": [640, 480],
}  # fmt: skip
EGO = {"name": "cam", "size": [640, 480], "image_center": [321.25, 238.5], "polynomialC2W": [-231.5, 0, 1.7e-3],
       "polynomialW2C": [271.5, 73.2], "affine": [0.9991, 3e-4, -4e-4]}  # fmt: skip
ARIA_TERMS = ("k1", "k2", "k3", "k4", "k5", "k6", "p2", "p1", "s1", "s2", "s3", "s4")
TERMS_624 = dict(zip(ARIA_TERMS, np.round(np.linspace(-1e-3, 2e-3, 12), 6).tolist(), strict=True))
PARALLEL = {"fl_x": 40.0, "fl_y": 40.0, "cx": 330.0, "cy": 230.0, "w": 640, "h": 480}


def frames(kind, lens, **more):
    return json.dumps({"camera_model": kind, "frames": [{"file_path": "a.png", **lens}], **more})


def flat(**entries):
    return json.dumps({"width": 640, "height": 480} | entries)


FILES = {
    "VINS": (vins("PINHOLE", K, RADTAN), PINHOLE, SIZE | K | RADTAN),
    "KITTI-360": (
        vins("MEI", dict(zip(("gamma1", "gamma2", "u0", "v0"), K.values(), strict=True)), RADTAN,
             mirror_parameters={"xi": 2.2}),
        "UCM", SIZE | K | RADTAN | {"unified_xi": 2.2},
    ),
    "VINS, fisheye": (
        vins("KANNALA_BRANDT", {**dict(zip(("k2", "k3", "k4", "k5"), EQUIDISTANT.values(), strict=True)),
                                **dict(zip(("mu", "mv", "u0", "v0"), K.values(), strict=True))}, {}),
        FISHEYE, SIZE | K | EQUIDISTANT,
    ),
    "ORB-SLAM2": (orb_slam(**RADTAN), PINHOLE, NO_SIZE | K | RADTAN),
    "ORB-SLAM3": (
        orb_slam(type='"KannalaBrandt8"', **EQUIDISTANT, width=640, height=480), FISHEYE, SIZE | K | EQUIDISTANT
    ),
    "stella_vslam": (
        yaml_of({"Camera": {"name": '"a"', "model": '"fisheye"', **K, **EQUIDISTANT, "cols": 640, "rows": 480}}, "",
                ""), FISHEYE, SIZE | K | EQUIDISTANT,
    ),
    "Basalt": (
        basalt("ds", xi=-0.2, alpha=0.6), "DOUBLE_SPHERE", SIZE | K | {"unified_xi": -0.2, "unified_alpha": 0.6}
    ),
    "Basalt, kb4": (basalt("kb4", **EQUIDISTANT), FISHEYE, SIZE | K | EQUIDISTANT),
    "Basalt, eucm": (
        basalt("eucm", alpha=0.6, beta=1.1), "EUCM", SIZE | K | {"unified_alpha": 0.6, "unified_beta": 1.1}
    ),
    "Basalt, ucm": (basalt("ucm", alpha=0.6), "EUCM", SIZE | K | {"unified_alpha": 0.6, "unified_beta": 1.0}),
    "Basalt, radtan8": (basalt("pinhole-radtan8", **RADTAN, k3=1e-3, k4=2e-3, k5=3e-3, k6=4e-3, rpmax=2.0), PINHOLE,
                        SIZE | K | RADTAN | {"k3": 1e-3, "k4": 2e-3, "k5": 3e-3, "k6": 4e-3}),
    "EuRoC": (sensor("radial-tangential", [*RADTAN.values()]), PINHOLE, SIZE | K | RADTAN),
    "Kimera": (sensor("equidistant", [*EQUIDISTANT.values()]), FISHEYE, SIZE | K | EQUIDISTANT),
    "Kimera, five": (sensor("radtan", [*RADTAN.values(), 0.5]), PINHOLE, SIZE | K | RADTAN | {"k3": 0.5}),
    "OKVIS": (OKVIS.replace("KIND", "equidistant"), FISHEYE, SIZE | K | EQUIDISTANT),
    "OKVIS, radtan": (OKVIS.replace("KIND", "radialtangential"), PINHOLE, SIZE | K | RADTAN),
    "plain keys": (flat(**K, **RADTAN), PINHOLE, SIZE | K | RADTAN),
    "plain keys, prefixed": (
        json.dumps({f"left_{name}": value for name, value in (K | RADTAN).items()}), PINHOLE, NO_SIZE | K | RADTAN
    ),
    "NICE-SLAM": (yaml_of({"dataset": "x", "cam": {"H": 480, "W": 640, **K}}, "", ""), PINHOLE, SIZE | K),
    "BOP": (flat(**K, depth_scale=0.1), PINHOLE, SIZE | K),
    "BOP, a scene": (
        json.dumps({f"{i}": {"cam_K": BY_ROWS, "depth_scale": 1.0, "cam_R_w2c": [], "cam_t_w2c": []} for i in (3, 4)}),
        PINHOLE, NO_SIZE | K,
    ),
    "RealSense": (flat(fx=300.0, fy=301.0, ppx=320.5, ppy=239.25, model="distortion.brown_conrady",
                       coeffs=[*RADTAN.values(), 0.0]), PINHOLE, SIZE | K | RADTAN),
    "RealSense, inverse": (flat(fx=300.0, fy=301.0, ppx=320.5, ppy=239.25, model="Inverse Brown Conrady",
                                coeffs=[0.0] * 5), PINHOLE, SIZE | K),
    "Open3D": (flat(intrinsic_matrix=BY_COLUMNS), PINHOLE, SIZE | K),
    "Open3D, with a pose": (
        json.dumps({"class_name": "PinholeCameraParameters", "extrinsic": np.eye(4).ravel().tolist(),
                    "intrinsic": {"width": 640, "height": 480, "intrinsic_matrix": BY_COLUMNS}}), PINHOLE, SIZE | K,
    ),
    "a matrix alone, in a list": (json.dumps([{"K": MATRIX}]), PINHOLE, NO_SIZE | K),
    "no distortion of a simulator": (flat(K=MATRIX, D=[], distortion_model=""), PINHOLE, SIZE | K),
    "a rational lens": (flat(K=MATRIX, D=[0.1, 0.1, 0, 0, 0, 0.1] + [0] * 8, distortion_model="rational_polynomial"),
                        PINHOLE, SIZE | K | {"k1": 0.1, "k2": 0.1, "k4": 0.1}),
    "echoed by ROS 2": (
        "header:\n  stamp:\n    sec: 1\n  frame_id: cam\nheight: 480\nwidth: 640\ndistortion_model: plumb_bob\nd:\n"
        "- -0.1\n- 0.02\n- 0.001\n- -0.002\n- 0.0\nk:\n" + "".join(f"- {number}\n" for number in BY_ROWS)
        + "roi:\n  x_offset: 0\n  width: 0\n  do_rectify: false\n---\n", PINHOLE, SIZE | K | RADTAN,
    ),
    "Aria, line by line": (
        "\n".join(json.dumps({"tracking_timestamp_us": time, "CameraCalibrations": [
            {"Label": "slam", "Projection": {"Name": "KannalaBrandtK3", "Params": [*K.values(), *EQUIDISTANT.values()]}}
        ]}) for time in (1, 2)), FISHEYE, NO_SIZE | K | EQUIDISTANT,
    ),
    "nerfstudio, FISHEYE624": (
        frames("FISHEYE624", {"fl_x": 300.0, "fl_y": 301.0, "cx": 321.0, "cy": 239.75, "w": 640, "h": 480,
                              "distortion_params": [*TERMS_624.values()]}), "FISHEYE624", SIZE | K | TERMS_624,
    ),
    "nerfstudio, panorama": (frames("EQUIRECTANGULAR", {"w": 640, "h": 480}), "EQUIRECTANGULAR", SIZE),
    "Isaac": (json.dumps(ISAAC | {"cameraModel": "pinhole"}), PINHOLE,
              SIZE | {"fx": 320.0, "fy": 320.0, "cx": 319.5, "cy": 239.5}),
    "Isaac, fisheye": (json.dumps(ISAAC | {"cameraModel": "fisheyePolynomial"}), "FTHETA",
                       SIZE | {"cx": 319.5, "cy": 239.5, "ftheta_reference": "RADIUS_TO_ANGLE",
                               "ftheta_radius_to_angle": "0.0 0.0033 0.0 0.0 0.0",
                               "ftheta_max_angle": radians(100)}),
    "WoodScape": (
        json.dumps({"name": "FV", "extrinsic": {}, "intrinsic": {
            "model": "radial_poly", "poly_order": 4, "width": 640, "height": 480, "aspect_ratio": 2.0,
            "cx_offset": 1.5, "cy_offset": -2.5, "k1": 100.0, "k2": -8.0, "k3": 12.0, "k4": -2.0}}), "FTHETA",
        SIZE | {"cx": 321.0, "cy": 237.0, "ftheta_reference": "ANGLE_TO_RADIUS", "ftheta_c": 0.5,
                "ftheta_angle_to_radius": "0.0 200.0 -16.0 24.0 -4.0"},
    ),
    "OpenSfM": (
        json.dumps({"v2 a": {"projection_type": "brown", "width": 640, "height": 480, "focal_x": 0.5, "focal_y": 0.6,
                             "c_x": 0.01, "c_y": -0.02, **RADTAN, "k3": 0.25}}), PINHOLE,
        SIZE | {"fx": 320.0, "fy": 384.0, "cx": 325.9, "cy": 226.7} | RADTAN | {"k3": 0.25},
    ),
    "OpenSfM, fisheye": (
        json.dumps({"v2 b": {"projection_type": "fisheye", "width": 640, "height": 480, "focal": 0.5, "k1": 0.1,
                             "k2": 0.2}}), FISHEYE,
        SIZE | {"fx": 320.0, "fy": 320.0, "cx": 319.5, "cy": 239.5, "k1": 0.1, "k2": 0.2},
    ),
    "OCam as JSON": (json.dumps(EGO), "OCAM",
                     SIZE | {"cx": 321.25, "cy": 238.5, "ocam_polynomial": "-231.5 0.0 0.0017", "ocam_c": 0.9991,
                             "ocam_d": 3e-4, "ocam_e": -4e-4}),
}  # fmt: skip


def lens_of(folder, text, key="", frame=None, name=""):
    (folder / "lens").write_text(text)
    return chosen_lens(str(folder / "lens"), key, name, frame)


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_the_lens_of_its_numbers(tmp_path, name):
    text, key, settings = FILES[name]
    lens = lens_of(tmp_path, text)
    assert lens.model == key
    read = {setting: value for setting, value in lens.settings.items() if setting in settings or value}
    assert read == pytest.approx(settings, rel=1e-15) if key not in ("FTHETA", "OCAM") else read == settings
    assert has_size(lens) == bool(settings["calibration_width"])


def test_the_rays_of_an_orthophoto_are_parallel_where_nerfstudio_has_them(tmp_path):
    lens = lens_of(tmp_path, frames("ORTHOPHOTO", PARALLEL))
    assert lens.model == "ORTHO"
    settings = {name: value for name, value in lens.settings.items() if not name.startswith("calibration")}
    rays = camera("ORTHO", {"resolution_x": 640, "resolution_y": 480, **settings}).rays_at(100.5, 480 - 70.5)
    assert rays.origins == pytest.approx([(100.5 - 330) / 40, -(70.5 - 230) / 40, 0], abs=1e-12)
    assert rays.directions == pytest.approx([0, 0, -1])


def test_the_panorama_of_mrcal_is_where_mrcal_has_it(tmp_path):
    """lonlat: x = fx lon + cx, y = fy lat + cy with y down, and (0, 0) the center of the first pixel."""
    text = ("{'lensmodel': 'LENSMODEL_LONLAT', 'intrinsics': [100., 200., 300., 200.], 'extrinsics': [0,0,0,0,0,0], "
            "'imagersize': [640, 480]}")  # fmt: skip
    lens = lens_of(tmp_path, text)
    settings = {name: value for name, value in lens.settings.items() if not name.startswith("calibration")}
    cam = camera("EQUIRECTANGULAR", {"resolution_x": 640, "resolution_y": 480, **settings})
    point = (np.sin(0.4) * np.cos(0.3), -np.sin(0.3), -np.cos(0.4) * np.cos(0.3))  # 0.3 down
    assert cam.project([point])[0] == pytest.approx((340 + 0.5, 480 - (260 + 0.5)), abs=1e-9)


def test_nerfs_angle_alone_is_a_pinhole_of_the_frame(tmp_path):
    text = json.dumps({"camera_angle_x": 0.7, "frames": [{"file_path": "./train/r_0", "transform_matrix": []}]})
    (tmp_path / "transforms.json").write_text(text)
    cam = camera(PINHOLE, {"resolution_x": 800, "resolution_y": 600,
                           "calibration_file": str(tmp_path / "transforms.json")})  # fmt: skip
    focal = 400 / tan(0.35)
    assert np.allclose(cam.K, [[focal, 0, 399.5], [0, focal, 299.5], [0, 0, 1]], rtol=1e-15)


def test_both_cameras_of_orb_slam3s_stereo_are_there(tmp_path):
    common = {"Camera.type": '"PinHole"', "Camera.width": 640, "Camera.height": 480}
    first, two = ({f"Camera{i}.{name}": value + i for name, value in K.items()} for i in (1, 2))
    for i in (1, 2):
        lens = lens_of(tmp_path, yaml_of(common | first | two), name=f"Camera{i}")
        assert lens.settings["fx"] == 300 + i
        assert has_size(lens)


def test_cameras_by_name_and_in_lists_are_there(tmp_path):
    text = json.dumps({"cameras": [{"K": MATRIX}, {"K": [[400, 0, 320], [0, 400, 240], [0, 0, 1]]}]})
    assert lens_of(tmp_path, text, name="cameras.1").settings["fx"] == 400
    with pytest.raises(InputError, match=r"2 cameras: set .* to one of cameras.0, cameras.1"):
        lens_of(tmp_path, text)


def test_four_coefficients_without_a_name_are_of_the_chosen_model(tmp_path):
    text = flat(K=MATRIX, D=[[-0.1], [0.02], [-0.01], [0.003]])
    assert lens_of(tmp_path, text, FISHEYE).settings["k4"] == 0.003
    assert lens_of(tmp_path, text, PINHOLE).settings["p2"] == 0.003
    for key in ("", "FOV"):
        with pytest.raises(InputError, match=r"4 coefficients may be of .* choose the model .* first .--model."):
            lens_of(tmp_path, text, key)


def test_every_lens_of_this_program_is_read_from_its_own_json(tmp_path):
    for key in ("EUCM", "FISHEYE_EQUISOLID", "PERSP", "OPENCV_PINHOLE"):
        cam = camera(key)
        lens = lens_of(tmp_path, camera_to_json(cam))
        assert lens.model == key
        assert {name: cam.settings[name] for name in lens.settings} == pytest.approx(lens.settings)


def test_a_file_of_many_frames_is_read(tmp_path):
    pose = np.eye(4).tolist()
    some = [{"file_path": f"images/{i:06}.png", "transform_matrix": pose} for i in range(20_000)]
    text = json.dumps({"fl_x": 300.0, "cx": 320.0, "cy": 240.0, "w": 640, "h": 480, "frames": some})
    assert len(text) > 2 << 20
    assert lens_of(tmp_path, text).settings["fx"] == 300


@pytest.mark.parametrize("axis", [0, 1])
def test_woodscapes_aspect_ratio_stretches_the_picture_along_y(tmp_path, axis):
    """A point 0.5 rad off the axis: the polynomial's radius from the center, twice as far along y."""
    (tmp_path / "lens").write_text(FILES["WoodScape"][0])
    cam = camera("FTHETA", {"resolution_x": 640, "resolution_y": 480, "calibration_file": str(tmp_path / "lens")})
    direction = np.array((0.0, 0.0, -np.cos(0.5)))
    direction[axis] = np.sin(0.5)
    radius = 100 * 0.5 - 8 * 0.5**2 + 12 * 0.5**3 - 2 * 0.5**4
    expected = (321.5 + radius, 242.5) if axis == 0 else (321.5, 242.5 + 2 * radius)
    assert cam.project([direction])[0] == pytest.approx(expected, abs=1e-9)
