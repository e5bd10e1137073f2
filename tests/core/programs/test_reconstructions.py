"""Cameras of reconstructions: the lens, the place and the axes of each, from numbers that are seen in the files."""

import json
from pathlib import Path

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.programs.parts.placed import FROM_BLENDER
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.records import InputError

SAMPLES = Path(__file__).parent / "samples"
SIZE = (800, 600)
PINHOLE = "fx", "fy", "cx", "cy", "k1", "k2"
BY_Z = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
UPRIGHT = np.eye(3)
"""Axes of a camera, x right, y down, z ahead, by columns."""


def cameras(path):
    """The name of the camera, the frame, the lens, and the matrix of right, down, ahead and place of each pose."""
    return [(rig.name, frame, lens, pose @ FROM_BLENDER) for rig in mounted(str(path), "", SIZE, 10.0)
            for frame, lens, pose in zip(rig.frames, rig.lenses or [None] * 9, rig.poses, strict=False)]  # fmt: skip


def check(camera, numbers, axes, position):
    """Check the numbers of a lens, and a pose."""
    np.testing.assert_allclose(camera[2].values(PINHOLE), numbers, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(camera[3][:3], np.c_[axes, position], rtol=0, atol=1e-12)


def test_realitycapture():
    """Its frame is 800 pixels wide, and the picture's longer side 36 mm."""
    lens = [600, 600, 399.5 + 10, 299.5 - 20, -0.125, 0.0625]
    (camera,) = cameras(SAMPLES / "realitycapture.xmp")
    check(camera, lens, [[0, 0, -1], [1, 0, 0], [0, -1, 0]], (4, 5, 6))
    level, rolled = cameras(SAMPLES / "realitycapture.cameras.csv")
    check(level, lens, [[0, 0, 1], [-1, 0, 0], [0, -1, 0]], (4, 5, 6))  # to the east
    check(rolled, lens, [[0, 0, -1], [0, -1, 0], [-1, 0, 0]], (4, 5, 7))
    assert (level[1], rolled[1]) == (1, 2)


def test_a_folder_of_xmp_is_a_camera_with_frames(tmp_path):
    text = (SAMPLES / "realitycapture.xmp").read_text()
    for number in (7, 8):
        (tmp_path / f"IMG_{number}.xmp").write_text(text.replace(">4 5 6<", f">4 5 {number}<"))
    assert [(frame, pose[2, 3]) for _, frame, _, pose in cameras(tmp_path)] == [(1, 7), (2, 8)]


def test_bundler_and_nvm():
    first, third = cameras(SAMPLES / "bundler.out")
    check(first, [480, 480, 399.5, 299.5, -0.125, 0.0625], [[1, 0, 0], [0, 0, 1], [0, -1, 0]], (-1, 3, -2))
    check(third, [500, 500, 399.5, 299.5, 0, 0], np.diag((1, -1, -1)), (-1, -2, -3))
    assert (first[1], third[1]) == (1, 3)
    left, right = cameras(SAMPLES / "nvm.nvm")
    check(left, [480, 480, 399.5, 299.5, 0, 0], np.transpose(BY_Z), (4, 5, 6))
    check(right, [500, 500, 399.5, 299.5, 0, 0], UPRIGHT, (4, 5, 7))


@pytest.mark.parametrize("k", [-0.3, 0.05])
def test_the_radial_coefficient_of_nvm_leads_from_the_picture(k, tmp_path):
    (tmp_path / "a.nvm").write_text(f"NVM_V3\n\n1\na.jpg 500 1 0 0 0 0 0 0 {k} 0\n")
    camera = crc.load_calibration(tmp_path / "a.nvm", size=SIZE)
    x, y = np.array([1.5, 700.5, 400.5]), np.array([2.5, 100.5, 300.5])
    u, v = (x - 400) / 500, (y - 300) / 500
    undistorted = np.stack((u, v), axis=1) * (1 + k * (u * u + v * v))[:, None]
    directions = camera.rays_at(x, SIZE[1] - y).directions  # in the world of the file; y from the bottom
    np.testing.assert_allclose(directions[:, :2] / directions[:, 2:], undistorted, rtol=0, atol=1e-6)


def test_gaussian_splatting_and_llff():
    left, right = cameras(SAMPLES / "gaussian_splatting.json")
    assert [camera[:2] for camera in (left, right)] == [("Camera", 1), ("Camera", 2)]
    check(left, [510, 500, 319.5, 239.5, 0, 0], BY_Z, (4, 5, 6))
    check(right, [520, 500, 319.5, 239.5, 0, 0], UPRIGHT, (4, 5, 7))
    first, second = cameras(SAMPLES / "llff.npy")
    check(first, [500, 500, 319.5, 239.5, 0, 0], BY_Z, (4, 5, 6))
    check(second, [500, 500, 319.5, 239.5, 0, 0], UPRIGHT, (4, 5, 7))


def test_camera_path():
    first, second = cameras(SAMPLES / "camera_path.json")
    check(first, [240, 240, 319.5, 239.5, 0, 0], BY_Z @ np.diag((1, -1, -1)), (4, 5, 6))
    check(second, [240, 240, 319.5, 239.5, 0, 0], np.diag((1, -1, -1)), (4, 5, 7))


def test_open3d():
    first, second = cameras(SAMPLES / "open3d.json")
    check(first, [500, 510, 319.5, 239.5, 0, 0], BY_Z, (5, -4, -6))
    check(second, [500, 510, 319.5, 239.5, 0, 0], UPRIGHT, (-4, -5, -6))
    (log,) = mounted(str(SAMPLES / "open3d.log"), "", SIZE, 10.0)
    assert log.frames == [1, 2]
    np.testing.assert_array_equal(log.poses[0], [[0, -1, 0, 4], [1, 0, 0, 5], [0, 0, 1, 6], [0, 0, 0, 1]])


def test_openmvg():
    left, right = cameras(SAMPLES / "openmvg.json")
    check(left, [500, 500, 321, 238, -0.125, 0.0625], BY_Z, (4, 5, 6))
    check(right, [510, 510, 320, 240, 0.25, 0], UPRIGHT, (4, 5, 7))
    assert left[2].values(("p1", "p2")) == [0.001, -0.002]
    assert [camera[0] for camera in (left, right)] == ["left", "right"]


def test_opensfm():
    left, right = cameras(SAMPLES / "opensfm.reconstruction.json")
    check(left, [480, 480, 319.5, 239.5, -0.125, 0], np.transpose(BY_Z), (-5, 4, -6))
    assert right[2].model == "EQUIRECTANGULAR"
    np.testing.assert_array_equal(right[3][:3], np.c_[UPRIGHT, (-4, -5, -6)])


def test_the_largest_reconstruction_of_opensfm_is_read(tmp_path):
    (first,) = json.loads((SAMPLES / "opensfm.reconstruction.json").read_text())
    other = {"cameras": first["cameras"], "shots": {"lost_1.jpg": first["shots"]["left_0001.jpg"]}}
    file = tmp_path / "reconstruction.json"
    file.write_text(json.dumps([other, first]))
    assert [camera[0] for camera in cameras(file)] == ["left", "right"]
    with pytest.warns(UserWarning, match="of 2 reconstructions, .*; 1 of 3 shots are left out"):
        assert len(crc.load_rig(str(file))) == 2


def test_four_radial_coefficients_of_realitycapture(tmp_path):
    text = (SAMPLES / "realitycapture.xmp").read_text()
    (tmp_path / "a.xmp").write_text(text.replace("brown3", "brown4").replace("0.0625 0 0 0 0", "0.0625 0 0.5 0 0"))
    lens = crc.load_calibration(str(tmp_path / "a.xmp"), size=SIZE, pose=np.eye(4))
    radius = 0.5 * (1 - 0.125 / 4 + 0.0625 / 16 + 0.5 / 256)
    np.testing.assert_allclose(lens.project((0.5, 0, -1)), (410 + 600 * radius, 320), rtol=0, atol=1e-9)


def test_a_project_of_fspy(tmp_path):
    parameters = (SAMPLES / "fspy.json").read_bytes()
    state = b'{"cameraParameters": %s}' % parameters
    head = np.array((1, len(state), 3), "<u4").tobytes()
    (tmp_path / "a.fspy").write_bytes(b"fspy" + head + state + b"\x89P\0")
    ((_, _, lens, pose),) = cameras(tmp_path / "a.fspy")
    ((_, _, same, other_pose),) = cameras(SAMPLES / "fspy.json")
    assert lens == same
    np.testing.assert_array_equal(pose, other_pose)
    unsolved = b'{"cameraParameters": null}'
    for data in (b"fspy", b"fspy" + head[:9] + b"\xff", b"fspy" + head + unsolved, b"fspy\2\0\0\0" + head[4:] + state):
        (tmp_path / "b.fspy").write_bytes(data)
        with pytest.raises(InputError, match="calibration file"):
            lenses_of(str(tmp_path / "b.fspy"))


def test_opencv_stereo_and_its_patterns(tmp_path):
    first, second = cameras(SAMPLES / "opencv.stereo.yml")
    check(first, [500, 510, 320, 240, -0.125, 0.0625], UPRIGHT, (0, 0, 0))
    check(second, [520, 530, 320, 240, -0.25, 0.0625], UPRIGHT, (0.125, 0, 0))
    rows = [[0, 0, np.pi / 2, 1, 2, 3], [0, 0, 0, 1, 2, 4]]
    file = tmp_path / "lens.json"
    file.write_text(json.dumps({"camera_matrix": [[9, 0, 4], [0, 9, 4], [0, 0, 1]], "extrinsic_parameters": rows}))
    turned, upright = cameras(file)
    check(turned, [9, 9, 4, 4, 0, 0], np.transpose(BY_Z), (-2, 1, -3))
    assert (turned[1], upright[1]) == (1, 2)


def test_a_stereo_pair_may_have_a_mapping_for_each_camera(tmp_path):
    matrix = {"camera_matrix": [[9, 0, 4], [0, 9, 4], [0, 0, 1]], "dist_coeffs": [0, 0, 0, 0, 0]}
    file = tmp_path / "stereo.json"
    file.write_text(json.dumps({"one": matrix, "two": matrix, "R": [0, 0, np.pi / 2], "T": [[1], [2], [3]]}))
    first, second = cameras(file)
    check(first, [9, 9, 4, 4, 0, 0], UPRIGHT, (0, 0, 0))
    check(second, [9, 9, 4, 4, 0, 0], np.transpose(BY_Z), (-2, 1, -3))
    assert (first[0], second[0]) == ("one", "two")


def test_surround360_and_fspy():
    fisheye, pinhole = cameras(SAMPLES / "surround360.json")
    check(fisheye, [240, 240, 321.5, 238.5, -0.125, 0.0625], [[0, 0, 1], [-1, 0, 0], [0, -1, 0]], (4, 5, 6))
    check(pinhole, [500, 500, 319.5, 239.5, 0, 0], np.diag((1, -1, -1)), (4, 5, 7))
    assert (fisheye[0], fisheye[1], fisheye[2].model) == ("cam0", None, "OPENCV_FISHEYE")
    (matched,) = cameras(SAMPLES / "fspy.json")
    check(matched, [320, 320, 323.5, 247.5, 0, 0], BY_Z @ np.diag((1, -1, -1)), (4, 5, 6))


def test_newer_files_of_mrcal_call_their_pose_rt_cam_ref(tmp_path):
    text = (SAMPLES / "mrcal.cameramodel").read_text()
    (tmp_path / "new.cameramodel").write_text(text.replace("extrinsics", "rt_cam_ref"))
    (old,), (new,) = cameras(SAMPLES / "mrcal.cameramodel"), cameras(tmp_path / "new.cameramodel")
    np.testing.assert_array_equal(new[3], old[3])


def test_a_radial_division_of_stella_vslam(tmp_path):
    """Its point at 0.5 focal lengths is at 0.5 / (1 - 0.2 / 4) when undistorted."""
    entries = {"model": "radial_division", "fx": 200, "fy": 200, "cx": 320, "cy": 240, "distortion": -0.2}
    (tmp_path / "a.json").write_text(json.dumps({"Camera": {"name": "a", "cols": 640, "rows": 480, **entries}}))
    camera = crc.load_calibration(tmp_path / "a.json")
    np.testing.assert_allclose(camera.project([(0.5 / 0.95, 0, -1)]), [(420.5, 239.5)], rtol=0, atol=1e-9)


def test_a_panorama_of_hugin(tmp_path):
    line = 'i w4000 h1500 f4 v360 r0 p0 y90 a{} b0 c0 d0 e0 n"pano.jpg"\n'
    file = tmp_path / "a.pto"
    file.write_text(line.format(0))
    camera = crc.load_rig(file)["Camera"]
    rays = camera.rays()
    np.testing.assert_allclose(rays.directions[750, 2000], (1, 0, 0), atol=2e-3)  # the middle, to the right
    np.testing.assert_allclose(rays.directions[0, :, 2], -np.sin(0.375 * np.pi * 1499 / 1500), rtol=0, atol=1e-12)
    file.write_text(line.format(0.01))
    with pytest.raises(InputError, match="is a panorama of more than the sphere, or corrected"):
        crc.load_rig(file)


def test_mrcal():
    (camera,) = cameras(SAMPLES / "mrcal.cameramodel")
    np.testing.assert_array_equal(camera[3][:3], np.c_[UPRIGHT, (-1, -2, -3)])


def test_a_sphere_of_metashape(tmp_path):
    (tmp_path / "a.xml").write_text(
        '<document><chunk><sensors><sensor id="0" label="ball" type="spherical"><resolution width="640" height="320"/>'
        '</sensor></sensors><cameras><camera id="0" sensor_id="0" label="a"><transform>'
        "1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1</transform></camera></cameras></chunk></document>"
    )
    ((_, _, lens, pose),) = cameras(tmp_path / "a.xml")
    assert (lens.model, lens.size) == ("EQUIRECTANGULAR", (640, 320))
    np.testing.assert_array_equal(pose[:3], np.c_[UPRIGHT, (4, 5, 6)])


@pytest.mark.parametrize(
    ("version", "changes", "model", "focal"),
    [
        ([1, 2, 12], {"pixelRatio": "2", "distortionType": "radialk3"}, "OPENCV_PINHOLE", [500, 1000]),
        ([1, 2, 4], {"pixelRatio": "2", "distortionType": "none"}, "OPENCV_PINHOLE", [500, 250]),
        ([1, 2, 12], {"type": "equidistant", "distortionType": "none"}, "OPENCV_FISHEYE", [500, 500]),
        ([1, 2, 12], {"distortionType": "3deradial4", "distortionParams": ["0"] * 6}, "OPENCV_PINHOLE", [500, 500]),
    ],
)
def test_lenses_of_meshroom(version, changes, model, focal, tmp_path):
    lens = {"intrinsicId": "7", "width": "640", "height": "480", "sensorWidth": "32", "focalLength": "25",
            "type": "pinhole", "principalPoint": ["2", "-3"], "distortionParams": []}  # fmt: skip
    (tmp_path / "a.sfm").write_text(json.dumps({"version": version, "intrinsics": [lens | changes]}))
    (read_lens,) = lenses_of(str(tmp_path / "a.sfm"))
    assert read_lens.model == model
    assert read_lens.values(PINHOLE)[:4] == [*focal, 322, 237]


def test_a_lens_of_3de_in_meshroom(tmp_path):
    """Its formula, at a point, by hand; with the further terms, and with an undistortion, it is no model of ours."""
    lens = {"intrinsicId": "7", "width": "640", "height": "480", "sensorWidth": "32", "focalLength": "25",
            "type": "pinhole", "distortionType": "3deradial4", "principalPoint": ["0", "0"],
            "distortionParams": ["-0.1", "0.02", "0.003", "-0.004", "0", "0"]}  # fmt: skip
    (tmp_path / "a.sfm").write_text(json.dumps({"version": [1, 2, 12], "intrinsics": [lens]}))
    x, y = 0.4, 0.3
    radial = 1 - 0.1 * 0.25 + 0.02 * 0.0625
    seen = (x * radial + (0.25 + 2 * x * x) * 0.003 + 2 * x * y * -0.004,
            y * radial + (0.25 + 2 * y * y) * -0.004 + 2 * x * y * 0.003)  # fmt: skip
    column, row = crc.load_calibration(tmp_path / "a.sfm").project((x, -y, -1))
    expected = 320 + 500 * seen[0], 240 + 500 * seen[1]
    np.testing.assert_allclose((column - 0.5, 479.5 - row), expected, rtol=0, atol=1e-9)
    for change, says in (({"distortionParams": ["0"] * 5 + ["0.1"]}, "no model has them"),
                         ({"undistortionType": "3declassicld", "undistortionParams": ["0.1"]}, "not read")):
        (tmp_path / "b.sfm").write_text(json.dumps({"version": [1, 2, 12], "intrinsics": [lens | change]}))
        with pytest.raises(InputError, match=says):
            crc.load_calibration(tmp_path / "b.sfm")


@pytest.mark.parametrize(
    ("name", "change", "says"),
    [
        ("realitycapture.xmp", ("0.0625 0 0 0 0", "0.0625 0 0.1 0.001 0"), "brown3, but its k4 is not 0"),
        ("nvm.nvm", ("6\t0 0", "6\t0.7 0"), "the radial distortion of left.jpg is 0.7, with focal lengths 480 and 480"),
        ("openmvg.json", ("pinhole_brown_t2", "pinhole_other"), "polymorphic_name of intrinsic 0 is 'pinhole_other'"),
    ],
)  # fmt: skip
def test_what_is_not_read_is_refused_in_one_line(name, change, says, tmp_path):
    text = (SAMPLES / name).read_text()
    assert change[0] in text
    (tmp_path / name).write_text(text.replace(*change))
    with pytest.raises(InputError, match=says):
        cameras(tmp_path / name)
