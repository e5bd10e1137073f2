"""Distortion and size under the names that people give them: read, or refused by their names."""

import json

import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

K = [[400, 0, 330.0], [0, 410, 250.0], [0, 0, 1]]
SIZE = {"image_width": 640, "image_height": 480}


def lens(tmp_path, entries):
    """The lens of a file with a camera matrix and these entries."""
    file = tmp_path / "lens.json"
    file.write_text(json.dumps({"camera_matrix": K, **SIZE, **entries}))
    return lenses_of(str(file))[0]


@pytest.mark.parametrize(
    "entries",
    [
        {"kc": [-0.3, 0.05, 0, 0, 0]},
        {"d0": -0.3, "d1": 0.05, "d2": 0, "d3": 0},
        {"distortion_k1": -0.3, "distortion_k2": 0.05},
        {"radial": [-0.3, 0.05], "tangential": [0, 0]},
        {"distortion": {"radial": {"k1": -0.3, "k2": 0.05}, "tangential": {"p1": 0, "p2": 0}}},
        {"distortion": {"type": "radtan", "params": [-0.3, 0.05, 0, 0]}},
        {"type": "pinhole", "distortion": {"type": "radtan", "values": [-0.3, 0.05, 0, 0]}},
        {"distortion": [0, 0, 0, 0, 0], "k1": -0.3, "k2": 0.05},
        {"distortion": {"type": "radtan", "parameters": {"k1": -0.3, "k2": 0.05, "p1": 0, "p2": 0}}},
        {"distortion": None, "kc": [-0.3, 0.05, 0, 0, 0]},
    ],
    ids=repr,
)
def test_a_distortion_under_another_name_is_read(entries, tmp_path):
    read_lens = lens(tmp_path, entries)
    assert read_lens.model == "OPENCV_PINHOLE"
    assert read_lens.values(("k1", "k2", "p1", "p2", "k3")) == [-0.3, 0.05, 0, 0, 0]


def test_photon_vision_called_its_distortion_extrinsics(tmp_path):
    content = {"cameraIntrinsics": {"rows": 3, "cols": 3, "data": [*K[0], *K[1], *K[2]]},
             "resolution": {"width": 640, "height": 480},
             "cameraExtrinsics": {"rows": 1, "cols": 5, "data": [-0.3, 0.05, 0, 0, 0.25]}}  # fmt: skip
    (tmp_path / "a.json").write_text(json.dumps(content))
    (lens,) = lenses_of(str(tmp_path / "a.json"))
    assert lens.values(("fx", "k1", "k2", "p1", "p2", "k3")) == [400, -0.3, 0.05, 0, 0, 0.25]


@pytest.mark.parametrize(
    "entries",
    [
        {"kappa": [-0.3, 0.05]}, {"dc": [-0.3, 0.05, 0, 0]}, {"lens": {"k1": -0.3, "k2": 0.05}}, {"kappa1": -0.3},
        {"lens_coeffs": [-0.3, 0.05, 0, 0]}, {"params": [-0.3, 0.05, 0, 0]}, {"curve": {"a": 1, "k1": -0.3}},
        {"radial_distortion_map": {"a": [-0.3]}}, {"k7": 0.5}, {"lens": {"distortion": [-0.3, 0.05]}},
        {"lens_model": {"coefficients": [-0.3, 0.05]}}, {"type_params": [-0.3, 0.05]}, {"values": [-0.3, 0.05]},
        {"fov_distortion": 0.5}, {"radial_distortion_1": -0.3}, {"alpha": 0.5, "beta": 0.05}, {"polynomial": [0.5]},
        {"distortion_value": 0.5}, {"barrel": 0.5}, {"lens_warp": 0.5},
    ],
    ids=repr,
)  # fmt: skip
def test_what_may_be_a_distortion_is_refused_by_its_name(entries, tmp_path):
    with pytest.raises(InputError, match=f"{next(iter(entries))} may be its distortion"):
        lens(tmp_path, entries)
    same = json.loads(json.dumps(entries).replace("0.3", "0").replace("0.05", "0").replace("0.5", "0"))
    assert not any(lens(tmp_path, same).values(("k1", "k2")))


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"distortion": {"0": -0.3}}, "0"), ({"distortion": {"a": [-0.3]}}, "a"),
        ({"dist": {"polynomial": {"k1": -0.3}}}, "polynomial"),
    ],
    ids=repr,
)  # fmt: skip
def test_so_is_what_a_mapping_of_a_distortion_has(entries, message, tmp_path):
    with pytest.raises(InputError, match=f"{message} may be its distortion"):
        lens(tmp_path, entries)


def test_a_distortion_beside_the_mapping_of_a_matrix_is_refused(tmp_path):
    file = tmp_path / "lens.json"
    file.write_text(json.dumps({"cam": {"matrix": {"fx": 400, "fy": 400, "cx": 320, "cy": 240}, "bent": {"k1": 0.1}}}))
    with pytest.raises(InputError, match="bent beside matrix may be its distortion"):
        crc.load_calibration(file, size=(640, 480))


@pytest.mark.parametrize(
    "size",
    [
        {"resolution": {"width": 640, "height": 480}}, {"resolution": {"rows": 480, "cols": 640}}, {"DIM": [640, 480]},
        {"size": [640, 480]}, {"resolution": "640x480"}, {"image_shape": [480, 640, 3]}, {"frame_size": "640, 480"},
    ],
    ids=repr,
)  # fmt: skip
def test_a_size_is_a_mapping_or_two_numbers(size, tmp_path):
    file = tmp_path / "lens.json"
    file.write_text(json.dumps({"camera_matrix": K, "dist_coeffs": [0.01, 0, 0, 0, 0], **size}))
    assert lenses_of(str(file))[0].size == (640, 480)


@pytest.mark.parametrize("entries", [{"camera_matrix": K, "imageSize": [480, 640]}, {"cam0": {
    "camera_model": "pinhole", "intrinsics": [400, 410, 330, 250], "resolution": [480, 640]}}])  # fmt: skip
def test_rows_before_columns_are_refused(entries, tmp_path):
    file = tmp_path / "lens.json"
    file.write_text(json.dumps(entries))
    with pytest.raises(InputError, match="its image size is 480 x 640, but its center, 330, 250, is near"):
        crc.load_calibration(file)


@pytest.mark.parametrize("names", [("left", "right"), ("22031701", "0002")])
def test_equal_cameras_keep_their_names(names, tmp_path):
    camera, file = {"K": K, "distortion": [0] * 5, **SIZE}, tmp_path / "rig.json"
    rigs = [dict.fromkeys(names, camera), [{"name": name, **camera} for name in names]]
    for entries in rigs if names[0] == "left" else rigs[:1]:
        file.write_text(json.dumps(entries))
        assert [lens.name for lens in lenses_of(str(file))] == [*names]
        assert crc.load_calibration(file, camera=names[1]).settings["fx"] == 400
        with pytest.raises(InputError, match=rf"has 2 cameras: set .* to one of {', '.join(names)}"):
            crc.load_calibration(file)


def test_equal_frames_are_one_camera(tmp_path):
    file = tmp_path / "frames.json"
    file.write_text(json.dumps({str(frame): {"K": K, "distortion": [0] * 5, **SIZE} for frame in range(3)}))
    assert [lens.name for lens in lenses_of(str(file))] == [""]


@pytest.mark.parametrize(("entries", "skew"), [({"skew": 2.5}, 2.5), ({"alpha_c": 0.01}, 4.0)])
def test_a_skew_beside_the_matrix_is_read(entries, skew, tmp_path):
    assert lens(tmp_path, entries).settings["skew"] == skew


@pytest.mark.parametrize("entries", [{"k": 0.5, "p": 1.0, "d": 0.1}, {"rig": {"sensors": {"a": {"gain": 1}}}}])
def test_a_letter_is_no_camera_matrix(entries, tmp_path):
    file = tmp_path / "other.json"
    file.write_text(json.dumps(entries))
    with pytest.raises(InputError, match="it is of no format that is read"):
        lenses_of(str(file))
