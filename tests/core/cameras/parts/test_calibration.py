"""Calibration files as OpenCV writes them, and what is wrong with those that cannot be used."""

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.records import InputError

from ..model_examples import camera

K = np.array([[612.3456789012345, 0, 320.123456789], [0, 611.1, 239.25], [0, 0, 1]])
D = np.array([[-0.28, 1.25e-5, 1.5e-3, -2e-4, 0.02]])
FRAME = {"resolution_x": 640, "resolution_y": 480}
VALUES = {"fx": K[0, 0], "fy": K[1, 1], "cx": K[0, 2], "cy": K[1, 2]}


def written(path, names=("camera_matrix", "distortion_coefficients"), matrix=K, distortion=D, **more):
    """Write a calibration with OpenCV itself, among other things that its samples write."""
    file = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    file.write("calibration_time", "Thu 1 Jan 1970: noon")
    for name, value in ({"image_width": 640, "image_height": 480} | more).items():
        file.write(name, value)
    file.writeComment("flags: +fix_aspect_ratio", 0)
    file.write("extrinsic_parameters", np.arange(12.0).reshape(2, 6))
    file.write(names[0], matrix)
    file.startWriteStruct("grid", cv2.FileNode_MAP)
    file.write("K", 3)
    file.endWriteStruct()
    file.write(names[1], distortion)
    file.write("avg_reprojection_error", float("nan"))
    file.write("image_points", np.zeros((2, 3, 2), np.float32))
    file.release()
    return {"calibration_file": str(path)}


@pytest.mark.parametrize("kind", ["xml", "yml.gz", "json", "xml.gz", "json.gz", "yml", "yaml"])
@pytest.mark.parametrize(
    "names", [("camera_matrix", "distortion_coefficients"), ("cameraMatrix", "dist_coeffs"), ("K", "D"), ("M1", "D1"),
     ("mtx", "dist"), ("intrinsic", "dist_coeff"), ("K1", "D1")],
)
def test_a_file_of_opencv_gives_the_camera_of_its_numbers(tmp_path, kind, names):
    model = camera("OPENCV_PINHOLE", FRAME | written(tmp_path / f"lens.{kind}", names)).model
    coefficients = dict(zip(("k1", "k2", "p1", "p2", "k3"), D[0], strict=True))
    assert model == camera("OPENCV_PINHOLE", FRAME | VALUES | coefficients).model


def test_a_file_with_a_pinhole_s_number_of_coefficients_is_no_fisheye_s(tmp_path):
    with pytest.raises(InputError, match="for OpenCV Pinhole, not OpenCV Fisheye: choose that model"):
        camera("OPENCV_FISHEYE", FRAME | written(tmp_path / "lens.yml"))


@pytest.mark.parametrize("kind", ["yml", "json", "xml"])
@pytest.mark.parametrize("flag", [{"fisheye_model": 1}, {"distortion_model": "equidistant"}, {}])
def test_a_fisheye_s_file(tmp_path, kind, flag):
    setting = written(tmp_path / f"lens.{kind}", ("K", "D"), distortion=np.array([0.1, -0.02, 3e-3, 0]), **flag)
    expected = camera("OPENCV_FISHEYE", FRAME | VALUES | {"k1": 0.1, "k2": -0.02, "k3": 3e-3}).model
    assert camera("OPENCV_FISHEYE", FRAME | setting).model == expected


def test_matrices_as_nested_lists_in_json(tmp_path):
    matrices = '"K": [[9, 0, 4], [0, 8, 3], [0, 0, 1]], "D": [[0.1, 0, 0, 0]]'
    (tmp_path / "lens.json").write_text(f'{{{matrices}, "width": 96, "height": 54}}')
    model = camera("OPENCV_PINHOLE", {"calibration_file": str(tmp_path / "lens.json")}).model
    assert model == camera("OPENCV_PINHOLE", {"fx": 9.0, "fy": 8.0, "cx": 4.0, "cy": 3.0, "k1": 0.1}).model


GOOD = """%YAML:1.0
---
image_width: 640
image_height: 480
K: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 600., 0., 320., 0., 600., 240., 0.,
       0., 1. ]
"""


def of_distortion(coefficients):
    """The entry of a file for these."""
    return f"D: !!opencv-matrix\n   rows: 1\n   cols: {len(coefficients)}\n   dt: d\n   data: {coefficients}\n"


D5 = of_distortion([-0.1, 0.0, 0.0, 0.0, 0.0])
GOOD += D5


def test_the_text_that_the_refusals_start_from_is_good(tmp_path):
    (tmp_path / "lens.yml").write_text(GOOD)
    cam = camera("OPENCV_PINHOLE", FRAME | {"calibration_file": str(tmp_path / "lens.yml")})
    assert cam.model.distortion.k1 == -0.1


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("K:", "Q:"), "has no cameramatrix .*k, m, intrinsicmatrix"),
        (("D:", "my_dist:"), "my_dist may be its distortion: name it distortion_coefficients"),
        (("image_width: 640", ""), "has no imagewidth"),
        (("image_width: 640", "image_width: 0"), "image size is 0 x 480: .* whole numbers above 0"),
        (("image_height: 480", "image_height: tall"), "image_height .* 'tall': it must be of finite numbers"),
        (("-0.1, 0.0", "-0.1, 1e308"), "D .*finite numbers, up to 1e.30"),
        (("600., 0., 320.", "1e-300, 0., 320."), "fx and fy above 0"),
        (("-0.1, 0.0", "-0.1, zero"), "D .* 'zero'.*must be of finite numbers"),
        (("-0.1, 0.0", "-0.1, .Nan"), "D .* '.Nan'.*must be of finite numbers"),
        (("600., 0., 320.", "600., 0., inf"), "K .* 'inf'.*finite"),
        (("600., 0., 320.", "-600., 0., 320."), "fx and fy above 0"),
        (("600., 0., 320.", "600., 320."), "K .* has 8 numbers for 3 rows x 3 columns"),
        (("600., 0., 320.", "600,0, 0,0, 320."), "K .* has 11 numbers for 3 rows x 3 columns"),
        (("320., 0., 600.", "320., 2., 600."), "fx skew cx, 0 fy cy"),
        ((D5, of_distortion(14 * [0.0] + [0.01])), "15 distortion coefficients: give 4 or 5 or 8 or 12 or 14"),
        ((D5, of_distortion([-0.2, 0.1, 0.05])), "3 distortion coefficients"),
        ((D5, of_distortion(12 * [0.0] + [1.5, 0.0])), r"tau_x .* 85.9437 degrees \(1.5 radians\): .* from -80"),
        ((D5, "fisheye_model: 1\n" + of_distortion([-0.1, 0, 0, 0])), "for OpenCV Fisheye, not OpenCV Pinhole"),
        ((D5, "distortion_model: kannala_brandt4\n" + of_distortion([0.1, 0, 0, 0])), "for OpenCV Fisheye, not"),
        (("K:", "distortion_model: fov\nK:"), "distortion_model .* 'fov': it must be one of plumb_bob"),
        (("K:", "camera_matrix: [600]\nK:"), "camera_matrix and K differ: leave one out"),
        (("D:", "K: [1]\nD:"), "line 11 repeats 'K'"),
        ((GOOD, f"{GOOD}---\n{GOOD}"), "begins a second document"),
        ((D5, "D: [-0.2, 0.1, 0, 0], 0.5]"), "text after a closing bracket"),
        ((D5, "D: [-0.2, , 0.1, 0, 0]"), "a comma without a value"),
        ((D5, "D: [5_0, 0, 0, 0]"), "D .*finite numbers"),
        ((GOOD, '{"K": [1], "K": [2]}'), "has 'K' twice"),
        ((GOOD, '{"K": [[true, 0, 0], [0, 1, 0], [0, 0, 1]]}'), "K .*finite numbers"),
        ((GOOD, "just some words"), "neither YAML nor JSON"),
        ((GOOD, '{"K": [1, '), "is not JSON"),
        ((GOOD, '{"K": [[1, "wide"]]}'), "K .*'wide'.* numbers"),
    ],
)
def test_a_file_without_meaning_is_refused_by_name(tmp_path, change, says):
    (tmp_path / "lens.yml").write_text(GOOD.replace(*change))
    with pytest.raises(InputError, match=says) as refusal:
        camera("OPENCV_PINHOLE", FRAME | {"calibration_file": str(tmp_path / "lens.yml")})
    assert "\n" not in str(refusal.value)
    assert "lens.yml" in str(refusal.value)


def test_a_file_that_cannot_be_read_is_refused_by_its_path(tmp_path):
    (tmp_path / "lens.png").write_bytes(b"\x89PNG\xff\xfe")
    for name, says in (("lens.png", "not a text file"), ("none.yml", "No such file"), (".", "directory")):
        with pytest.raises(InputError, match=says):
            camera("OPENCV_FISHEYE", {"calibration_file": str(tmp_path / name)})
