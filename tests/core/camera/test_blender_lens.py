"""Blender's lens nearest to a calibrated one: exact where it is one, else with the error that is measured."""

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.camera.blender_lens import blender_lens
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera

SIZE = {"resolution_x": 640, "resolution_y": 480, "calibration_width": 640, "calibration_height": 480}
K = {"fx": 500.25, "fy": 500.25, "cx": 330.5, "cy": 228.0}


@pytest.mark.parametrize("fit", ["AUTO", "HORIZONTAL", "VERTICAL"])
@pytest.mark.parametrize("change", [{}, {"fy": 450.5}, {"resolution_x": 480, "resolution_y": 640}])
def test_a_pinhole_is_blenders_perspective(fit, change):
    cam = camera("OPENCV_PINHOLE", SIZE | K | {"sensor_fit": fit} | change)
    lens = blender_lens(cam)
    assert lens.camera.model.key == "PERSP"
    assert lens.worst < 1e-3  # settings of float32
    assert np.allclose(lens.camera.K, cam.K, rtol=1e-6, atol=1e-4)
    assert "EEVEE and Workbench render it" in lens.message


def test_a_bent_pinhole_has_the_error_that_the_pixels_show():
    cam = camera("OPENCV_PINHOLE", SIZE | K | {"k1": -0.02})
    lens = blender_lens(cam)
    assert lens.camera.model.key == "PERSP" or lens.worst < 1
    rays = cam.rays()
    seen = lens.camera.project(rays.origins + rays.directions)
    x, y = np.meshgrid(np.arange(640) + 0.5, np.arange(480) + 0.5)
    apart = np.hypot(seen[..., 0] - x, seen[..., 1] - y)
    assert apart.max() == pytest.approx(lens.worst, rel=1e-6)
    assert apart.mean() == pytest.approx(lens.mean, rel=0.05)


def test_a_fisheye_is_nearly_a_polynomial_of_blenders_by_opencv_s_projection():
    cam = camera("OPENCV_FISHEYE", SIZE | {"fx": 300.0, "fy": 300.0, "cx": 322.0, "cy": 236.5, "k1": -0.02, "k2": 3e-3})
    lens = blender_lens(cam)
    assert lens.camera.model.key == "FISHEYE_LENS_POLYNOMIAL"
    assert lens.worst < 0.5
    rays = lens.camera.rays()
    ahead = (rays.directions[rays.valid] * (1, -1, -1))[:, None]
    K_ = np.array([[300.0, 0, 322], [0, 300.0, 236.5], [0, 0, 1]])
    seen, _ = cv2.fisheye.projectPoints(ahead, np.zeros(3), np.zeros(3), K_, np.array((-0.02, 3e-3, 0, 0)))
    x, y = np.meshgrid(np.arange(640.0), np.arange(480.0)[::-1])
    apart = np.hypot(seen[:, 0, 0] - x[rays.valid], seen[:, 0, 1] - y[rays.valid])
    assert apart.max() == pytest.approx(lens.worst, rel=0.05)
    assert apart.mean() == pytest.approx(lens.mean, rel=0.05)
    assert "EEVEE and Workbench do not" in lens.message


def test_a_lens_of_blenders_is_found_again():
    settings = {"resolution_x": 400, "resolution_y": 300, "fisheye_fov": 3.0, "shift_x": 0.02,
             "fisheye_polynomial_k0": 0.0, "fisheye_polynomial_k1": -0.08, "fisheye_polynomial_k2": 0.0,
             "fisheye_polynomial_k3": 2e-5, "fisheye_polynomial_k4": 0.0}  # fmt: skip
    lens = blender_lens(camera("FISHEYE_LENS_POLYNOMIAL", settings))
    assert lens.worst < 1e-3
    assert lens.settings["fisheye_polynomial_k1"] == pytest.approx(-0.08, rel=1e-5)


@pytest.mark.parametrize("fit", ["AUTO", "VERTICAL"])
def test_parallel_rays_are_blenders_orthographic(fit):
    """The rays of three corners, 6 by 3 units around (0.5, -0.25), on 96 x 54 pixels."""
    three = {f"ray_{k}": (x, y, x, y) for k, (x, y) in enumerate(((-2.5, -1.75), (3.5, -1.75), (-2.5, 1.25)), 1)}
    cam = camera("GENERAL_LINEAR", {"sensor_fit": fit} | three)
    lens = blender_lens(cam)
    assert lens.camera.model.key == "ORTHO"
    assert lens.worst < 1e-4  # settings of float32
    assert lens.camera.project([(3.5, 1.25, -7.0)])[0] == pytest.approx((96, 54), abs=1e-4)
    assert "EEVEE and Workbench render it" in lens.message


@pytest.mark.parametrize(
    ("key", "settings", "angle"),
    [
        ("DOME_MASTER", {"fov": 3.6, "tilt": 0.3, "shift_x": 0.05}, np.pi / 2 - 0.3),
        ("DOME_MASTER", {"pixel_aspect_y": 1.3, "resolution_x": 60, "resolution_y": 90}, np.pi / 2),
        ("STEREOGRAPHIC_PANORAMA", {"fov": 1.0, "elevation": 0.4}, 0.4),
        ("OMNIMAX", {"tilt": 0.5}, 0.5),
    ],
)
def test_the_lens_of_a_dome_is_blenders_turned_up(key, settings, angle):
    """A dome master is an equidistant fisheye: k1 alone, in float32, to the last pixel of its rim."""
    cam = camera(key, settings)
    nearest = blender_lens(cam)
    assert nearest.elevation == pytest.approx(angle, abs=1e-12)
    rays, lens = cam.rays(), nearest.camera.rays()
    assert lens.valid[rays.valid].all()
    pixel = 2 * np.pi / min(cam.raster.size)  # radians, at most
    apart = np.linalg.norm(lens.directions - rays.directions, axis=-1)[rays.valid].max()
    assert apart <= nearest.worst * pixel + 1e-6
    assert nearest.beyond == pytest.approx((lens.valid & ~rays.valid).mean(), abs=1e-12)
    if key == "DOME_MASTER":
        assert (nearest.worst < 1e-4, nearest.beyond, apart < 1e-6) == (True, 0, True)


@pytest.mark.parametrize(
    ("key", "says"),
    [("PUSHBROOM", "whose rays have no eye: use Use in Cycles"), ("EQUIRECTANGULAR", "no Blender camera type")],
)
def test_a_camera_that_is_like_no_lens_of_blender_is_refused(key, says):
    with pytest.raises(InputError, match=says):
        blender_lens(camera(key))
