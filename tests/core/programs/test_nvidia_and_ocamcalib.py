"""Files of f-theta cameras in each layout of NVIDIA's, and of OCamCalib: the camera of their numbers."""

import json

import numpy as np
import pytest

from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera

FRAME = {"resolution_x": 640, "resolution_y": 480}
SIZE = {"calibration_width": 640.0, "calibration_height": 480.0, "cx": 321.25, "cy": 238.5}
FORWARD, BACKWARD = (0.0, 301.5, 2.25, -7.5, 0.125), (0.0, 0.0033, 1e-7, -2e-10)
LINEAR = {"ftheta_c": 1.0005, "ftheta_d": 2e-4, "ftheta_e": -1e-4}


def ours(numbers):
    return " ".join(map(repr, numbers))


IS_FORWARD = SIZE | LINEAR | {"ftheta_reference": "ANGLE_TO_RADIUS", "ftheta_angle_to_radius": ours(FORWARD)}
IS_BACKWARD = SIZE | LINEAR | {"ftheta_reference": "RADIUS_TO_ANGLE", "ftheta_radius_to_angle": ours(BACKWARD)}


def rig(*, name="camera:front:wide", **properties):
    """A DriveWorks rig, whose numbers are text; with a lidar, and another camera that is no f-theta one."""
    camera_properties = {
        "Model": "ftheta", "width": "640", "height": "480", "cx": "321.25", "cy": "238.5",
        "linear-c": "1.0005", "linear-d": "2e-4", "linear-e": "-1e-4", **properties,
    }  # fmt: skip
    sensors = [
        {"name": "lidar:top", "properties": {"lanes": 128}},
        {"name": name, "nominalSensor2Rig_FLU": {"t": [0, 0, 1]}, "properties": camera_properties},
        {"name": "camera:rear", "properties": {"Model": "pinhole"}},
    ]
    return json.dumps({"rig": {"sensors": sensors}, "version": 2})


def parameters(**changes):
    return {
        "resolution": [640, 480], "shutter_type": "ROLLING_TOP_TO_BOTTOM", "external_distortion_parameters": None,
        "principal_point": [321.25, 238.5], "reference_poly": "ANGLE_TO_PIXELDIST",
        "pixeldist_to_angle_poly": list(BACKWARD), "angle_to_pixeldist_poly": list(FORWARD), "max_angle": 1.25,
        "linear_cde": [1.0005, 2e-4, -1e-4], **changes,
    }  # fmt: skip


def nurec(kind="ftheta", **changes):
    model = {"type": kind, "parameters": parameters(**changes)}
    calibration = {"logical_sensor_name": "camera_front", "T_sensor_rig": np.eye(4).tolist(), "camera_model": model}
    return json.dumps({"camera_calibrations": {"camera_front@clip": calibration}})


OCAM = """#polynomial coefficients for the DIRECT mapping function (ocam_model.ss in MATLAB)

5 -2.315226e+02 0.000000e+00 1.7e-03 -2e-07 6e-09

#polynomial coefficients for the inverse mapping function (ocam_model.invpol)

3 271.591627 73.232250 -23.495515

#center: "row" and "column", starting from 0 (C convention)

238.5 321.25

#affine parameters "c", "d", "e"

0.9991 0.0003 -0.0004

#image size: "height" and "width"

480 640
"""
IS_OCAM = SIZE | {
    "ocam_polynomial": "-231.5226 0 1.7e-3 -2e-7 6e-9", "ocam_c": 0.9991, "ocam_d": 3e-4, "ocam_e": -4e-4,
}  # fmt: skip

ANGLE = {"ftheta_max_angle": 1.25}
FILES = {
    "rig, forward": (rig(polynomial=ours(FORWARD), **{"polynomial-type": "angle-to-pixeldistance"}), IS_FORWARD),
    "rig, backward": (rig(polynomial=ours(BACKWARD), **{"polynomial-type": "pixeldistance-to-angle"}), IS_BACKWARD),
    "rig, old": (rig(**{"bw-poly": ours(BACKWARD)}), IS_BACKWARD),
    "NCore": (json.dumps(parameters()), IS_FORWARD | ANGLE),
    "NCore, backward": (json.dumps(parameters(reference_poly="PIXELDIST_TO_ANGLE")), IS_BACKWARD | ANGLE),
    "NCore, a sensor": (json.dumps({"camera_model_parameters": parameters()}), IS_FORWARD | ANGLE),
    "NuRec": (nurec(), IS_FORWARD | ANGLE),
    "OCamCalib": (OCAM, IS_OCAM),
    "OCamCalib, numbers alone": ("\n".join(line for line in OCAM.splitlines() if "#" not in line), IS_OCAM),
}


def of_file(path, text, key, **settings):
    path.write_text(text)
    return camera(key, FRAME | {"calibration_file": str(path)} | settings)


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_the_camera_of_its_numbers(tmp_path, name):
    text, settings = FILES[name]
    key = "OCAM" if "ocam_c" in settings else "FTHETA"
    lens = of_file(tmp_path / "lens", text, key)
    assert lens.model == camera(key, FRAME | settings).model
    ahead = lens.project([(0.0, 0.0, -2.0)])[0]
    assert ahead == pytest.approx((321.25 + 0.5, 480 - 238.5 - 0.5), abs=1e-9)  # (0, 0): the first pixel's center
    with pytest.raises(InputError, match=r"lens.* is a calibration for .*: choose that model"):
        of_file(tmp_path / "lens", text, "FOV")


@pytest.mark.parametrize("text", [OCAM, json.dumps(parameters())])
def test_right_in_the_file_is_right_in_the_picture_and_down_is_down(tmp_path, text):
    cam = of_file(tmp_path / "lens", text, "OCAM" if text is OCAM else "FTHETA")
    ahead, right, down = cam.project([(0, 0, -1), (0.2, 0, -1), (0, -0.2, -1)])
    assert right[0] > ahead[0] + 10
    assert abs(right[1] - ahead[1]) < 1
    assert down[1] < ahead[1] - 10
    assert abs(down[0] - ahead[0]) < 1


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (rig(Model="pinhole"), "none of its sensors has properties with the Model 'ftheta'"),
        (rig(), "polynomial-type of camera:front:wide is None: it must be one of angle-to-pixeldistance"),
        (rig(**{"bw-poly": "0 x"}), "bw-poly of camera:front:wide is .*finite numbers"),
        (rig(**{"bw-poly": ours(BACKWARD)}, cx="left"), "cx of camera:front:wide is 'left'.* finite number"),
        (rig(**{"bw-poly": ours(BACKWARD)}).replace('"cy"', '"center"'), "it has no cy"),
        (rig(**{"bw-poly": "1 0.003"}), "ftheta_radius_to_angle of .* is '1.0 0.003': it must be 0, a number above 0"),
        (json.dumps(parameters(angle_to_pixeldist_poly=None)), "it has no angle_to_pixeldist_poly"),
        (json.dumps(parameters(angle_to_pixeldist_poly=[0, float("nan")])), "angle_to_pixeldist_poly is .*nan"),
        (json.dumps(parameters(reference_poly=1)), "reference_poly of the camera is '1.0': it must be one of"),
        (json.dumps(parameters(linear_cde=[1, 0])), "linear_cde is .*3 finite numbers"),
        (json.dumps(parameters(linear_cde=[1, 2, 1])), "ftheta_c of .* is 1: it must be above .*; calibration file"),
        (json.dumps(parameters(principal_point=[1])), "principal_point is .*2 finite numbers"),
        (json.dumps(parameters(max_angle=-1)), "ftheta_max_angle of .* is -57.2958 degrees"),
        (nurec(kind="opencv-pinhole"), "camera_model of camera_front is of type 'opencv-pinhole'"),
        (nurec(external_distortion_parameters={"poly": [1]}), "external_distortion_parameters, of a windshield"),
        (OCAM.replace("480 640", ""), "it has 4 lines of numbers"),
        (OCAM.replace("5 -2.3", "7 -2.3"), "its polynomial has 5 coefficients, but states 7"),
        (OCAM.replace("1.7e-03", "inf"), "its polynomial is .*finite numbers"),
        (OCAM.replace("5 -2.3", "5 2.3"), "ocam_polynomial of .* a number below 0, and more; calibration file"),
        (OCAM.replace("0.9991 0.0003", "0.9991"), "its affine parameters is .*3 finite numbers"),
        (OCAM.replace("238.5 321.25", "238.5"), "its center is .*2 finite numbers"),
        (OCAM.replace("480 640", "480 0 640"), "its image size is .*2 finite numbers"),
    ],
)
def test_a_file_without_meaning_is_refused_by_its_field(tmp_path, text, says):
    key = "OCAM" if text[0] == "#" else "FTHETA"
    with pytest.raises(InputError, match=says) as refusal:
        of_file(tmp_path / "lens", text, key)
    assert "\n" not in str(refusal.value)
    assert "lens" in str(refusal.value)
