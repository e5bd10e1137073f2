"""``K`` and ``world_to_opencv`` of cameras in Blender, against Blender's own matrix and OpenCV's projection."""

import itertools

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.conventions import EPS32

from .scene_parts import new_object

FRAMES = [(640, 480, 100), (480, 640, 50), (1001, 333, 37)]
PIXELS = [(1.0, 1.0), (1.5, 1.0), (1.0, 2.0)]
SHIFTS = [(0.0, 0.0), (0.2, -0.35)]
CASES = list(itertools.product(["AUTO", "HORIZONTAL", "VERTICAL"], FRAMES, PIXELS, SHIFTS))
LENSES = {
    "OPENCV_PINHOLE": {"k1": -0.24, "k2": 0.045, "p1": 0.004, "p2": -0.006, "k3": 0.002, "k4": 0.01, "k5": -0.003,
                       "k6": 0.001, "s1": 0.002, "s2": -0.001, "s3": 0.003, "s4": 0.0005},
    "OPENCV_FISHEYE": {"k1": 0.03, "k2": -0.022, "k3": 0.0008, "k4": -0.0002},
}  # fmt: skip
NEAR = 1e-3
"""Pixels: Blender's matrix is a rotation to float32 only, 1e-7 of up to 1000 pixels and of the slopes of a lens."""


@pytest.fixture
def scene(blender):
    """A camera that stands and looks anywhere."""
    scene = blender.context.scene
    scene.camera = new_object("Camera", blender.data.cameras.new("Camera"))
    scene.camera.location, scene.camera.rotation_euler = (2, -3, 1.5), (1.1, 0.2, 0.4)
    return scene


def set_up(scene, case):
    fit, (width, height, percentage), (across, up), shift = case
    render, data = scene.render, scene.camera.data
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, percentage
    render.pixel_aspect_x, render.pixel_aspect_y = across, up
    data.sensor_fit, data.sensor_width, data.sensor_height = fit, 30.0, 20.0
    data.lens, data.shift_x, data.shift_y = 35.0, *shift


def points_ahead(camera, count=50):
    """World points before a camera, within some 30 degrees of its viewing direction."""
    rng = np.random.default_rng(4)
    local = np.concatenate((rng.uniform(-0.6, 0.6, (count, 2)), np.full((count, 1), -1.0)), axis=1)
    return camera.pose.eye + (local * rng.uniform(1, 20, (count, 1))) @ camera.pose.basis.T


def pixels_of_opencv(camera, points, name, coefficients):
    """OpenCV's pixels of world points, as our pixel coordinates."""
    cv2 = pytest.importorskip("cv2")
    project = cv2.fisheye.projectPoints if name == "OPENCV_FISHEYE" else cv2.projectPoints
    turn, shift = cv2.Rodrigues(camera.opencv_from_world[:3, :3])[0], camera.opencv_from_world[:3, 3]
    across, down = project(points[:, None], turn, shift, camera.K, np.array(coefficients))[0][:, 0].T
    return np.stack((across + 0.5, camera.raster.height - 0.5 - down), axis=1)


@pytest.mark.parametrize("case", CASES)
def test_k_is_blenders_projection_matrix(blender, scene, case):
    set_up(scene, case)
    camera = crc.read_camera(scene)
    width, height = camera.raster.size
    depsgraph = blender.context.evaluated_depsgraph_get()
    clip = np.array(
        scene.camera.calc_matrix_camera(
            depsgraph, x=width, y=height, scale_x=scene.render.pixel_aspect_x, scale_y=scene.render.pixel_aspect_y
        )
    )
    # clip is [-1, 1] over the frame, y up, of points whose z is negative ahead
    expected = [
        [clip[0, 0] * width / 2, 0, (1 - clip[0, 2]) * width / 2 - 0.5],
        [0, clip[1, 1] * height / 2, (1 + clip[1, 2]) * height / 2 - 0.5],
        [0, 0, 1],
    ]
    # Blender's matrix is float32, of numbers of up to 4 frames
    np.testing.assert_allclose(camera.K, expected, rtol=0, atol=16 * EPS32 * 4 * max(width, height))


@pytest.mark.parametrize("case", CASES)
def test_opencv_projects_as_blenders_camera_does(scene, case):
    set_up(scene, case)
    camera = crc.read_camera(scene)
    points = points_ahead(camera)
    pixels = pixels_of_opencv(camera, points, "OPENCV_PINHOLE", [0.0] * 4)
    np.testing.assert_allclose(pixels, camera.project(points), rtol=0, atol=NEAR)


@pytest.mark.parametrize("percentage", [100, 25])
@pytest.mark.parametrize("name", LENSES)
def test_opencv_projects_as_its_calibrated_lenses_do(scene, name, percentage):
    """Of a frame of another size than the calibrated picture, too: K is scaled with it."""
    set_up(scene, CASES[0])
    scene.render.resolution_percentage = percentage
    settings = scene.camera.data.camera_ray_caster
    settings.model, settings.calibration_width, settings.calibration_height = name, 640, 480
    settings.fx, settings.fy, settings.cx, settings.cy = 420.0, 415.0, 310.5, 250.25
    for key, value in LENSES[name].items():
        setattr(settings, key, value)
    camera = crc.read_camera(scene)
    points = points_ahead(camera)
    pixels = pixels_of_opencv(camera, points, name, [getattr(settings, key) for key in LENSES[name]])
    np.testing.assert_allclose(pixels, camera.project(points), rtol=0, atol=NEAR)


def test_a_model_without_a_matrix_has_none(scene):
    for scene.camera.data.type in ("ORTHO", "PANO"):
        assert crc.read_camera(scene).K is None


def test_the_world_in_opencvs_frame_is_right_down_ahead(scene):
    matrix = crc.read_camera(scene).opencv_from_world
    right, up, back = np.array(scene.camera.matrix_world)[:3, :3].T
    for point, expected in ((right, (1, 0, 0)), (-up, (0, 1, 0)), (-back, (0, 0, 1)), (0 * up, (0, 0, 0))):
        world_point = np.append(np.array(scene.camera.matrix_world)[:3, 3] + 5 * point, 1)
        np.testing.assert_allclose(matrix @ world_point, [*(5 * np.array(expected)), 1], atol=1e-5)
