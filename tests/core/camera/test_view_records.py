"""A window's matrices as a camera, and a camera's frame at other sizes: held against OpenGL's matrices themselves."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.camera.view_records import frame_record, view_record
from camera_ray_caster.core.records import BlenderCamera

WIDTH, HEIGHT = 640, 360
VIEW = np.array([[0.6, 0.8, 0, 1], [-0.48, 0.36, 0.8, -2], [0.64, -0.48, 0.6, -9], [0, 0, 0, 1]])


def perspective(left, right, bottom, top, near, far):
    """glFrustum."""
    return np.array(
        [
            [2 * near / (right - left), 0, (right + left) / (right - left), 0],
            [0, 2 * near / (top - bottom), (top + bottom) / (top - bottom), 0],
            [0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)],
            [0, 0, -1, 0],
        ]
    )


def parallel(left, right, bottom, top, near, far):
    """glOrtho."""
    return np.array(
        [
            [2 / (right - left), 0, 0, -(right + left) / (right - left)],
            [0, 2 / (top - bottom), 0, -(top + bottom) / (top - bottom)],
            [0, 0, -2 / (far - near), -(far + near) / (far - near)],
            [0, 0, 0, 1],
        ]
    )


MATRICES = {
    "perspective": perspective(-0.2, 0.2, -0.1125, 0.1125, 0.3, 100),
    "perspective off the axis": perspective(-0.1, 0.3, -0.2, 0.05, 0.3, 100),
    "parallel": parallel(-4, 4, -2.25, 2.25, 0.5, 50),
    "parallel off the axis, from behind": parallel(-1, 7, -4, 1, -30, 40),
}


@pytest.mark.parametrize("window", MATRICES.values(), ids=MATRICES)
def test_rays_of_a_view_lie_on_the_pixels_that_its_matrices_give_their_points(window):
    camera = camera_from(view_record(VIEW, window, WIDTH, HEIGHT))
    x, y = np.array([0.5, 100.5, 639.5]), np.array([0.5, 200.5, 359.5])
    rays = camera.rays_at(x[None, :], y[:, None])
    for t in (3.0, 20.0):
        points = rays.origins + t * rays.directions
        clip = np.append(points, np.ones((3, 3, 1)), axis=-1) @ (window @ VIEW).T
        view = clip[..., :2] / clip[..., 3:]
        expected_pixels = (view + 1) / 2 * (WIDTH, HEIGHT)
        assert expected_pixels[..., 0] == pytest.approx(np.broadcast_to(x, (3, 3)), abs=1e-9)
        assert expected_pixels[..., 1] == pytest.approx(np.broadcast_to(y[:, None], (3, 3)), abs=1e-9)


@pytest.mark.parametrize("window", MATRICES.values(), ids=MATRICES)
def test_the_clip_range_is_the_windows(window):
    camera = camera_from(view_record(VIEW, window, WIDTH, HEIGHT))
    origin, direction = camera.camera_rays(WIDTH / 2, HEIGHT / 2)
    for t, depth in ((camera.clip_start, -1), (camera.clip_end, 1)):
        point = camera.pose.eye + camera.pose.basis @ (np.array(origin) + t * np.array(direction))
        clip = window @ VIEW @ (*point, 1)
        assert clip[2] / clip[3] == pytest.approx(depth, abs=1e-9)


RAW = BlenderCamera(
    "Camera", "PERSP", np.eye(4), resolution_x=1001, resolution_y=700, resolution_percentage=50,
    pixel_aspect_x=1.5, shift_x=0.2, shift_y=-0.1,
)  # fmt: skip


@pytest.mark.parametrize("size", [(375, 175), (125, 58), (50, 23)])
@pytest.mark.parametrize("raw", [RAW, replace(RAW, type="ORTHO")], ids=["perspective", "orthographic"])
def test_the_frame_stays_where_it_is_at_every_size(raw, size):
    """Its corners are the frame's before it is truncated to whole pixels, which is the one that a window draws."""
    frame = replace(raw, resolution_percentage=100)
    corners = []
    for record, (width, height) in ((frame, (1001, 700)), (frame_record(raw, *size, (0, 0, 1, 1)), size)):
        rays = camera_from(record).rays_at(np.array([0.0, width]), np.array([0.0, height]))
        corners.append((rays.origins, rays.directions))
    for corner, other in zip(*corners, strict=True):
        assert corner == pytest.approx(other, abs=1e-14)


def test_only_what_is_seen_and_within_the_border_is_cast():
    border = replace(RAW, use_border=True, border_min_x=0.25, border_max_x=0.75, border_min_y=0.0, border_max_y=1.0)
    raster = camera_from(frame_record(border, 100, 80, (-0.5, 0.25, 0.5, 2.0))).raster
    assert (raster.x0, raster.x1, raster.y0, raster.y1) == (25, 50, 20, 80)
