"""COLMAP's text model against COLMAP."""

import numpy as np
import pytest

from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera
from ..colmap import colmap, read, seen
from .shots import CAMERAS, MATRIX, exported, shots, views

REFUSED = {"tilted": "tau_x, tau_y are not 0", "prism": "s1, s2, s3, s4 are not 0", "skewed": "skew is not 0",
           "omnidir": "", "part": "not the whole sphere"}  # fmt: skip


@pytest.mark.parametrize("name", [name for name in CAMERAS if name not in REFUSED])
def test_colmap_sees_points_where_we_do(tmp_path, name):
    moved, *others = exported("colmap", name, tmp_path)
    assert [line.split(" have ")[1] for line in others] == (
        ["no ray, but the files' formula gives them one"] if name in {"blenders_fisheye", "stereographic"} else []
    )
    assert float(moved.split()[-1]) < 1e-3  # near the poles of a panorama; elsewhere 1e-5
    cameras, images = colmap(read, str(tmp_path))
    assert len(cameras) == 1
    assert sorted(name for name, _, _ in images.values()) == [
        f"{name}_0001.png", f"{name}_0012.png", f"{name}_10000.png",
    ]  # fmt: skip
    for number, (points, pixels) in zip(sorted(images), views(name), strict=True):
        turn, shift = np.split(images[number][2], [3], axis=1)
        ahead = (points @ turn.T + shift.T)[:, 2] > 0  # beside and behind itself COLMAP sees with panoramas alone
        ahead |= name == "panorama"
        assert np.count_nonzero(ahead) > 150
        theirs = np.array(colmap(seen, str(tmp_path), number, points[ahead]))
        assert np.abs(theirs - pixels[ahead]).max() < 1e-9


def test_a_pose_that_is_a_rotation_already_is_no_remark():
    _, remarks = export_files("colmap", [Shot("still", 1, camera("PERSP", {"matrix_world": np.eye(4)}))])
    assert remarks == []


@pytest.mark.parametrize("name", REFUSED)
def test_what_colmap_cannot_say_is_refused_with_the_formats_that_can(name):
    with pytest.raises(
        InputError, match=rf"^COLMAP cannot represent the .* of camera 'Camera'.*{REFUSED[name]}.*: choose"
    ):
        export_files("colmap", shots(name))


def test_each_lens_of_each_camera_is_a_camera_of_colmaps(tmp_path):
    both = [*shots("radtan"), *shots("fisheye")]
    zooming = shots("perspective", [1, 2])
    longer = camera("PERSP", {"lens": 70.0} | MATRIX)
    files = dict(export_files("colmap", [*both, zooming[0], type(zooming[0])("perspective", 2, longer)])[0])
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    cameras, images = colmap(read, str(tmp_path))
    assert cameras == {1: "OPENCV", 2: "OPENCV_FISHEYE", 3: "PINHOLE", 4: "PINHOLE"}
    assert [images[number][1] for number in range(1, 9)] == [1, 1, 1, 2, 2, 2, 3, 4]


def test_the_whole_sphere_with_angles_as_blender_stores_them_is_exported():
    turn = {"longitude_min": -np.pi, "longitude_max": np.pi, "latitude_min": -np.pi / 2, "latitude_max": np.pi / 2}
    stored = {name: float(np.float32(angle)) for name, angle in turn.items()}
    size = {"resolution_x": 1024, "resolution_y": 512}
    (shot,) = shots("panorama", [1])
    files = dict(export_files("colmap", [type(shot)("panorama", 1, camera("EQUIRECTANGULAR", size | stored))])[0])
    assert "1 EQUIRECTANGULAR 1024 512" in files["cameras.txt"]
