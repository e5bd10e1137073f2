"""Calibration files of several cameras, of which one is chosen by its name, and several files one after the other."""

import json

import pytest

from camera_ray_caster.core.camera.calibration_file import chosen_lens, has_size
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

from ..colmap import colmap, write
from .test_formats import GOOD, NUMBERS, PAIR, aria, mrcal, of_file


@pytest.mark.parametrize(("name", "fx", "k1"), [("1", 300, -0.1), ("2", 400, -0.3)])
def test_a_stereo_pair_of_opencv_has_two_cameras(tmp_path, name, fx, k1):
    settings = of_file(tmp_path / "pair.yml", PAIR, "OPENCV_PINHOLE", calibration_camera=name).settings
    assert (settings["fx"], settings["k1"], settings["k2"]) == (fx, k1, 0.02)


def test_a_camera_that_cannot_be_read_does_not_hide_the_others(tmp_path):
    chain = GOOD + GOOD.replace("cam0:", "cam1:").replace("radtan", "spline")
    assert of_file(tmp_path / "camchain.yaml", chain, "OPENCV_PINHOLE", calibration_camera="cam0").settings["fx"] == 300
    with pytest.raises(InputError, match="distortion_model of cam1, pinhole, is 'spline'"):
        of_file(tmp_path / "camchain.yaml", chain, "OPENCV_PINHOLE", calibration_camera="cam1")


def test_a_camera_that_is_not_in_the_file_is_refused_with_those_that_are(tmp_path):
    with pytest.raises(
        InputError, match=r"no camera 'cam7': set Camera in File \(--calibration-camera, in Python camera=\) to .*cam0"
    ):
        of_file(tmp_path / "camchain.yaml", GOOD, "OPENCV_PINHOLE", calibration_camera="cam7")


def test_of_a_file_whose_camera_has_no_name_none_is_chosen(tmp_path):
    with pytest.raises(
        InputError, match=r"no camera 'cam7': leave Camera in File \(--calibration-camera, in Python camera=\) empty$"
    ):
        of_file(tmp_path / "lens", mrcal("PINHOLE", NUMBERS), "OPENCV_PINHOLE", calibration_camera="cam7")


def test_a_center_outside_the_frame_belongs_to_a_picture_of_another_size(tmp_path):
    """A file of Project Aria does not tell the size of its pictures."""
    text = aria("Linear", [300.0, 300.0, 320.5, 239.25])
    of_file(tmp_path / "aria.json", text, "OPENCV_PINHOLE")
    with pytest.raises(InputError, match=r"which has no size, are 320\.5 and 239.25, outside the frame of 320 x 240"):
        of_file(tmp_path / "aria.json", text, "OPENCV_PINHOLE", resolution_x=320, resolution_y=240)


def test_cameras_bin_says_what_cameras_txt_says(tmp_path):
    colmap(write, str(tmp_path), ("OPENCV", "FOV", "EUCM", "EQUIRECTANGULAR", "RAD_TAN_THIN_PRISM_FISHEYE"))
    binary, text = (lenses_of(str(tmp_path / f"cameras.{kind}")) for kind in ("bin", "txt"))
    assert sorted(binary) == sorted(text)
    assert {lens.model for lens in binary} == {"OPENCV_PINHOLE", "FOV", "EUCM", "EQUIRECTANGULAR", "FISHEYE624"}
    content = (tmp_path / "cameras.bin").read_bytes()
    for damaged in (content[:-3], content + b"\0", b"\xff" * 8 + content[8:]):
        (tmp_path / "cameras.bin").write_bytes(damaged)
        with pytest.raises(InputError, match=r"not a text file, and of no binary format that is read"):
            lenses_of(str(tmp_path / "cameras.bin"))


def test_a_file_without_a_size_leaves_nothing_to_the_next(tmp_path):
    (tmp_path / "first").write_text('{"camera_angle_x": 0.7, "frames": []}')
    (tmp_path / "second").write_text("fx: 300.\nfy: 301.\ncx: 32.\ncy: 24.\n")
    chosen_lens(str(tmp_path / "first"), picture_size=(64, 48))
    lens = chosen_lens(str(tmp_path / "second"), "OPENCV_PINHOLE")
    assert not has_size(lens)
    assert lens.settings["fx"] == 300


@pytest.mark.parametrize("wrap", [json.dumps, lambda two: json.dumps(list(two.values()))])
def test_cameras_beside_each_other_are_no_distortion_of_one_another(tmp_path, wrap):
    two = {f"cam{k}": {"width": 640, "height": 480, "fx": 300 + k, "fy": 300, "cx": 320, "cy": 240, "k1": -0.1,
              "k2": 0.0,
              "p1": 0.001, "p2": 0.0} for k in (0, 1)}  # fmt: skip
    (tmp_path / "two.json").write_text(wrap(two))
    lenses = lenses_of(str(tmp_path / "two.json"))
    assert [(lens.settings["fx"], lens.settings["k1"]) for lens in lenses] == [(300, -0.1), (301, -0.1)]
