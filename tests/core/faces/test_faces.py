"""The faces that hold a camera's picture: which, how large, and how fine, by hand geometry and by the rays."""

from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.faces.faces import chosen, faces_of, refusal, turn_of
from camera_ray_caster.core.records import Pose
from camera_ray_caster.core.web.page import example, page_models

CENTRAL = [model for model in page_models() if not refusal(example(model))]
RIGHT, UP, BACK = np.eye(3)


@pytest.mark.parametrize("model", CENTRAL, ids=lambda model: model.key)
def test_every_ray_meets_its_face_within_the_texels(model):
    camera = example(model)
    faces, rays = faces_of(camera), camera.rays()
    assert 1 <= len(faces) <= 6
    directions = rays.directions[rays.valid] @ turn_of(camera)
    which = chosen(faces, directions)
    for number, face in enumerate(faces):
        assert max(face.angles) <= 100.001
        at = face.places(directions[which == number])
        assert (at >= 1).all()  # a texel's rim is left for the filter
        assert (at <= np.array(face.size) - 1).all()


@pytest.mark.parametrize(("settings", "ahead"), [
    ({"model": "PERSP", "lens": 18.0}, [-BACK]),
    ({"model": "FISHEYE_EQUIDISTANT", "fisheye_fov": np.pi}, [-BACK, RIGHT, -RIGHT, UP, -UP]),
    ({"model": "EQUIRECTANGULAR"}, [-BACK, RIGHT, -RIGHT, UP, -UP, BACK]),
    ({"model": "DOME_MASTER"}, [-BACK, RIGHT, -RIGHT, UP, BACK]),
], ids=lambda case: str(case))  # fmt: skip
def test_only_faces_that_are_looked_into(settings, ahead):
    faces = faces_of(crc.camera(size=(400, 400), **settings))
    assert [list(-face.axes[2]) for face in faces] == [list(axis) for axis in ahead]


def test_a_pinhole_s_face_is_its_picture():
    (face,) = faces_of(crc.camera("OPENCV_PINHOLE", (640, 480), fx=400.0, fy=400.0, cx=319.5, cy=239.5))
    margin = 660 / 640, 500 / 480  # two texels, and what may lie between the rays that were looked at
    assert np.all(np.array(face.window)[[0, 1]] * (-1, 1) >= 0.8)
    assert np.all(np.array(face.window)[[1, 3]] <= (0.8 * margin[0] * 1.05, 0.6 * margin[1] * 1.05))
    left, right, bottom, top = face.window
    assert (right - left) / face.size[0] == pytest.approx(1 / 400, rel=0.01)  # a texel is a pixel
    assert (top - bottom) / face.size[1] == pytest.approx(1 / 400, rel=0.01)


def test_a_fisheye_s_texels_are_as_small_as_the_pixels_need():
    camera = crc.camera("FISHEYE_EQUIDISTANT", (1000, 1000), fisheye_fov=np.pi)
    texels = [(face.window[1] - face.window[0]) / face.size[0] for face in faces_of(camera)]
    # ahead a pixel is pi / 1000 of an angle. At the side of the picture its angle across the radius is the arc's, less
    # by sin(a) / a: 2 / 1000 radians.
    # Two of a hundred pixels may be finer than texels, which are those at the rim.
    assert texels == pytest.approx([np.pi / 1000, *[2.06 / 1000] * 4], rel=0.03)
    coarse = faces_of(camera, pixel=2.0)
    assert (coarse[0].window[1] - coarse[0].window[0]) / coarse[0].size[0] == pytest.approx(np.pi / 500, rel=0.05)
    assert max(max(face.size) for face in faces_of(camera, largest=100)) == 100


def test_of_a_part_of_the_picture_only_its_faces():
    camera = crc.camera("EQUIRECTANGULAR", (400, 200))
    (face,) = faces_of(camera, region=(180.0, 90.0, 220.0, 110.0))
    assert list(-face.axes[2]) == list(-BACK)
    assert face.size[0] < 60


def test_a_turned_and_sheared_camera_s_rays_meet_the_faces():
    basis = np.array([[1.0, 0.5, 0.2], [0.0, 1.0, -0.3], [0.0, 0.0, 1.0]])
    camera = replace(crc.camera("FISHEYE_EQUISOLID", (120, 80)), pose=Pose(np.array([1.0, 2.0, 3.0]), basis))
    rays, faces, turn = camera.rays(), faces_of(camera), turn_of(camera)
    assert turn.T @ turn == pytest.approx(np.eye(3), abs=1e-15)
    directions = rays.directions[rays.valid] @ turn
    which = chosen(faces, directions)
    for number, face in enumerate(faces):
        at = face.places(directions[which == number])
        assert ((at >= 0) & (at <= face.size)).all()


@pytest.mark.parametrize(("camera", "why"), [
    (crc.camera("ORTHO", (40, 30)), "no single viewpoint"), (crc.camera("SCANNER", (64, 16)), "single beams"),
])  # fmt: skip
def test_what_is_no_warp_says_why(camera, why):
    assert why in refusal(camera)
    with pytest.raises(crc.InputError, match=why):
        faces_of(camera)
