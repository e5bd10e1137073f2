"""The camera's picture in space, held against the rays and the cast of the whole picture."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.lesson.diagram import diagram, probe
from camera_ray_caster.core.records import SPHERE, BlenderCamera, Shapes

FISHEYE = {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 3.0}
CAMERAS = {
    "perspective": {},
    "orthographic": {"type": "ORTHO"},
    "fisheye": {"type": "PANO", "settings": FISHEYE},
    "border": {"use_border": True, "border_min_x": 0.5, "border_max_y": 0.5},
}
TURNED = np.array([[0, 0, 1, 8.0], [1, 0, 0, 0.5], [0, 1, 0, -0.25], [0, 0, 0, 1]])
"""At x = 8, looking along -x."""


def camera(name):
    size = {"resolution_x": 48, "resolution_y": 32}
    return camera_from(BlenderCamera("Camera", matrix_world=TURNED, **({"type": "PERSP"} | size | CAMERAS[name])))


def spheres(*places):
    count = len(places)
    column = np.arange(count, dtype=np.int32)
    return Shapes(
        kind=np.full(count, SPHERE, np.uint8),
        center=np.array(places, float).reshape(-1, 3),
        axes=np.tile(np.eye(3), (count, 1, 1)),
        object_index=column,
        material_index=column,
        color=np.ones((count, 4), np.float32),
        name_index=column,
        names=tuple(f"Ball {k}" for k in range(count)),
    )


BALLS = spheres((0, 0, 0), (-3, 1, 1))
names = pytest.mark.parametrize("name", CAMERAS)


@names
def test_the_rays_are_rays_of_the_picture_and_end_where_it_says(name):
    eye = camera(name)
    images = cast(eye, BALLS, passes=["position", "shape_index", "ray_origin", "normal"], dtype=np.float64)
    known = {tuple(point.astype(np.float32)): k for k, point in enumerate(images["position"].reshape(-1, 3))}
    parts = diagram(eye, BALLS, 1.0, 24)
    assert len(parts.hit_rays) >= 4
    for start, end in parts.hit_rays:
        k = known[tuple(end)]
        assert start == pytest.approx(images["ray_origin"].reshape(-1, 3)[k], abs=1e-5)
    for (start, end), (_, hit) in zip(parts.normals, parts.hit_rays, strict=True):
        normal = images["normal"].reshape(-1, 3)[known[tuple(hit)]]
        assert start == pytest.approx(hit)
        assert (end - start) / np.linalg.norm(end - start) == pytest.approx(normal, abs=1e-4)


@names
def test_as_many_rays_as_are_asked_for_within_the_window(name):
    eye = camera(name)
    across, up = 12, max(1, round(12 * eye.raster.shape[0] / eye.raster.shape[1]))
    parts = diagram(eye, BALLS, 1.0, across)
    count = len(parts.hit_rays) + len(parts.missed_rays)
    assert count == across * up if name != "fisheye" else 0 < count < across * up
    assert (
        len(diagram(eye, BALLS, 1.0, 1000).hit_rays) == np.isfinite(cast(eye, BALLS, passes=["depth"])["depth"]).sum()
    )


def test_the_frustum_is_the_lectures_pyramid():
    """50 mm before 36 mm: at distance 2 the frame is 1.44 wide and 0.96 high, and looks along -x."""
    parts = diagram(camera("perspective"), BALLS, 2.0, 4)
    edges = parts.border[-4:]
    assert edges[:, 0] == pytest.approx(np.tile([8.0, 0.5, -0.25], (4, 1)))
    corners = {(6.0, y, z) for y in (-0.22, 1.22) for z in (-0.73, 0.23)}  # about (0.5, -0.25)
    assert {tuple(np.round(corner.astype(float), 5)) for corner in edges[:, 1]} == corners
    u, v, w = parts.basis[:, 1] - parts.basis[:, 0]
    assert (u, v, w) == (pytest.approx([0, 2, 0]), pytest.approx([0, 0, 2]), pytest.approx([-2, 0, 0]))


def test_a_fisheyes_image_is_on_a_sphere_and_ends_where_its_rays_do():
    eye = camera("fisheye")
    parts = diagram(eye, BALLS, 2.0, 4)
    assert np.isfinite(parts.grid).all()
    assert np.linalg.norm(parts.grid.astype(float) - eye.pose.eye, axis=-1) == pytest.approx(2.0, rel=1e-6)


def test_nothing_to_hit_leaves_rays_that_miss():
    parts = diagram(camera("perspective"), spheres(), 1.0, 4)
    assert (len(parts.hit_rays), len(parts.hits), len(parts.normals)) == (0, 0, 0)
    assert np.linalg.norm(parts.missed_rays[:, 1] - parts.missed_rays[:, 0], axis=1) == pytest.approx(12.5, rel=1e-6)


@names
def test_a_probe_says_what_the_picture_says(name):
    eye = camera(name)
    passes = ("distance", "shape_index", "ray_direction", "valid")
    images = cast(eye, BALLS, passes=passes, dtype=np.float64)
    raster = eye.raster
    for column, row in ((raster.x0, raster.y0), (25, 15), (raster.x1 - 1, 3), (30, 9)):
        at = row - raster.y0, column - raster.x0
        probed = probe(eye, BALLS, column, row)
        assert probed.pixel == (column, row)
        assert probed.view == pytest.approx(((column + 0.5) / 24 - 1, (row + 0.5) / 16 - 1))
        assert probed.distance == images["distance"][at]
        assert probed.shape_index == images["shape_index"][at]
        assert probed.name == (f"Ball {probed.shape_index}" if probed.shape_index >= 0 else "")
        assert np.isnan(probed.direction).all() == (not images["valid"][at])
        if images["valid"][at]:
            assert np.array_equal(probed.direction, images["ray_direction"][at])


def test_a_clock_is_left_out():
    """The picture in space is that of one time."""
    eye = camera("perspective")
    timed = replace(eye, pixel_time=object())
    assert np.array_equal(diagram(timed, BALLS, 1.0, 4).hits, diagram(eye, BALLS, 1.0, 4).hits)
