"""Files of other programs that cannot be read: the one line that says why."""

import json

import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.records import InputError

from .test_other_programs import EGO, ISAAC, MATRIX, OKVIS, K, basalt, flat, lens_of, sensor, vins


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('{"weights": [1, 2], "epoch": 3}', "of no format that is read: these are OpenCV.* or ray tables$"),
        ('{"rig_of": {"sensors": 1, "properties": "ftheta", "polynomial": 2}}', "the nearest is NVIDIA .*has no"),
        (vins("SPLINE", {}, {}), "model_type is 'SPLINE': it must be one of PINHOLE"),
        (basalt("spline"), "camera_type of cam0 is 'spline': it must be one of ds"),
        (basalt("ds", xi=0.1), "it has no alpha"),
        (OKVIS.replace("KIND", "spline"), "distortion_type of cam0, pinhole, is 'spline'"),
        (sensor("radtan", [0.1, 0.2]), "distortion_coefficients is .*4 finite numbers"),
        (flat(K=MATRIX, D=[0.1, 0.1], distortion_model="plumb_bob"), "2 distortion coefficients: give 4 or 5"),
        (flat(fx=1.0, fy=1.0, ppx=2, ppy=2, model="inverse_brown_conrady", coeffs=[0.1] * 5), "model in .* must be"),
        (flat(**K, height_=3, image_height=480), "it has height and height_: leave one out"),
        (flat(**K, cols=600), "width and cols differ: leave one out"),
        (json.dumps(K | {"width": 640}), "has no imageheight"),
        (flat(**K, intrinsics={"fx": 3.0}), "it has fx twice, once in intrinsics: leave one out"),
        (json.dumps(ISAAC | {"cameraModel": "mirror"}), "cameraModel is 'mirror': it must be one of pinhole"),
        (json.dumps({key: value for key, value in EGO.items() if key != "image_center"}), "it has no image_center"),
        ("{'lensmodel': 'LENSMODEL_PINHOLE', 'lensmodel': 'LENSMODEL_LONLAT'}", "it has 'lensmodel' twice"),
        ("<html><body>Not found</body></html>", "of no format that is read"),
        ("# Notes\n\nThe lens was lent: see below.\n", "of no format that is read: .* or ray tables$"),
        ("[general]\nfps = 30\nname = a\n", "of no format that is read: .* or ray tables$"),
        ('{"rig_of": {"sensors": 1, "properties": "ftheta"}}', "of no format that is read: .* or ray tables$"),
        ("camera_matrix: [1\ndistortion_coefficients: 2\nimage_width: 5 5\nimage_height: 2", "not closed"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(tmp_path, text, says):
    with pytest.raises(InputError, match=says) as refusal:
        lens_of(tmp_path, text)
    assert "\n" not in str(refusal.value)
    assert str(tmp_path / "lens") in str(refusal.value)


OBJ = "v 0 0 0\nv 1 0 0\nvt 0 0\nvn 0 0 1\nf 1/1/1\n"


@pytest.mark.cases(2)
@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.npy", b"\x93NUM", "by its name it is an array of numpy, but it does not begin as one: it is damaged"),
        ("a.npz", b"XK\x03\x04" + bytes(90), "by its name it is a file of numpy's arrays, but"),
        ("a.exr", b"hello world", "by its name it is an EXR image, but it does not begin as one"),
        ("a.obj", OBJ.replace("vn ", "vx ").encode(), "it is no mesh of rays: it has no lines vn"),
        ("a.csv", b"day,price\n1,2\n", "it is of no format that is read: .* or ray tables$"),
        ("b.csv", b"channel,elevation\n1,2\n", "it is of no format .*; the nearest is Hesai, but it has no azimuth"),
        ("a.txt", b"Camera\n======\nmodel equirectangular, cols and rows", "stella_vslam, but its entries cannot"),
        ("twice.xml", b"<opencv_storage><K>1</K><K>2</K></opencv_storage>", "line 1 repeats 'K'"),
        ("cut.xml", b"<opencv_storage><K>1</opencv_storage>", "is not XML as OpenCV writes it: mismatched tag"),
        ("type.xml", b"<!DOCTYPE a [<!ENTITY b 'c'>]><opencv_storage><K>&b;</K></opencv_storage>", "a document type"),
        ("deep.xml", b"<opencv_storage>" + 40 * b"<a>" + 40 * b"</a>" + b"</opencv_storage>", "nested deeper than 32"),
        ("b.csv", b"x,y,dx,dy,dz\n0,0,1,1\n", "line 2"),
        ("b.npy", b" ", "is empty"),
        ("a.pincam", b"256 192 200 200 128", "it must be one line of six numbers: width, height, fx, fy, cx and cy"),
        ("b.pincam", b"256.5 192 200 200 128 96", "its image size is 256.5 x 192"),
        ("images.txt", b"1 1 0 0 0 1 2 3 1 a.png\n\n", "COLMAP's poses: the lenses are in the file cameras beside it"),
        ("two.json", b'{"K": [[30, 0, 32], [0, 30, 24], [0, 0, 1]], "fx": 40}', "its fx is 40, and 30 in the camera"),
        ("parts.json", b'{"fx": 0.5, "fy": 0.7, "cx": 0.5, "cy": 0.5}', "which are not pixels: if they are parts"),
    ],
)  # fmt: skip
def test_a_damaged_file_is_called_what_its_name_says(tmp_path, name, content, words):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=words) as caught:
        crc.load_calibration(tmp_path / name, size=(64, 48))
    assert "\n" not in str(caught.value)


def test_entries_are_read_whatever_the_name(tmp_path):
    (tmp_path / "a.obj").write_text('{"fx": 30, "fy": 30, "cx": 31.5, "cy": 23.5}')
    assert crc.load_calibration(tmp_path / "a.obj", size=(64, 48)).K[0, 0] == 30
