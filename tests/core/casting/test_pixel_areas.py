"""The passes of what a pixel covers: solid angles by closed forms, areas of surfaces by hand and by their sums."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting import hit_values
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE

from ..camera.test_pixel_time import shapes
from ..cameras.model_examples import EXAMPLES, TURNED, camera
from ..shapes.meshes import grid, mesh_of, shapes_of
from ..still import STILL

BALL = shapes(((0.3, -0.2, -5.0), 1.5))
ROUNDED = 64 * EPS
"""Relative: some dozen operations in the rays and the areas."""

TURN = np.array(TURNED)
SHEARED = TURN @ [[1, 0.5, 0, 0], [0, 2, 0.3, 0], [0.1, 0, -1, 0], [0, 0, 0, 1]]


def area_pass(cam, name, cast_at=BALL):
    return cast(cam, cast_at, passes=name, dtype=np.float64)[name]


def of_one_eye(key):
    """Examples without glass before the camera, which bends the rays of the formulas below."""
    return [settings for settings in EXAMPLES[key] if "port" not in settings]


def solid_angles(key, settings=(), cast_at=BALL):
    """The pass, and the image-plane place of each pixel."""
    cam = camera(key, settings)
    plane = cam.model.window.plane_from_pixels(cam.raster.columns(), cam.raster.rows())
    return cam, area_pass(cam, "solid_angle", cast_at), plane


@pytest.mark.parametrize("settings", of_one_eye("PERSP"))
def test_a_pinhole_s_fall_off_with_the_cube_of_the_cosine(settings):
    cam, angles, (x, y) = solid_angles("PERSP", settings)
    expected = cam.model.window.pitch_x * cam.model.window.pitch_y / (1 + x * x + y * y) ** 1.5
    np.testing.assert_allclose(angles, expected, rtol=ROUNDED)


@pytest.mark.parametrize("settings", EXAMPLES["EQUIRECTANGULAR"])
def test_a_panorama_s_fall_off_with_the_cosine_of_the_latitude(settings):
    cam, angles, (_, latitude) = solid_angles("EQUIRECTANGULAR", settings)
    expected = np.abs(np.cos(latitude)) * cam.model.window.pitch_x * cam.model.window.pitch_y + np.zeros_like(angles)
    np.testing.assert_allclose(angles, expected, rtol=0, atol=ROUNDED * expected.max())


@pytest.mark.parametrize("settings", of_one_eye("FISHEYE_EQUIDISTANT"))
def test_an_equidistant_fisheye_s_are_as_sine_over_angle(settings):
    cam, angles, (a, b) = solid_angles("FISHEYE_EQUIDISTANT", settings)
    theta = cam.model.half_fov * np.hypot(a, b)
    pixel = cam.model.half_fov**2 * cam.model.window.pitch_x * cam.model.window.pitch_y
    expected = np.where(cam.rays().valid, np.abs(np.sinc(theta / np.pi)) * pixel, 0.0)
    np.testing.assert_allclose(angles, expected, rtol=0, atol=ROUNDED * pixel)


def test_a_mirror_ball_s_are_all_alike():
    cam, angles, _ = solid_angles("MIRRORBALL")
    expected = 4 * cam.model.window.pitch_x * cam.model.window.pitch_y
    inner = angles[np.hypot(*cam.model.window.plane_from_pixels(cam.raster.columns(), cam.raster.rows())) < 0.99]
    np.testing.assert_allclose(inner, expected, rtol=16 * ROUNDED)  # the rim is near
    np.testing.assert_array_equal(angles == 0, ~cam.rays().valid)


@pytest.mark.parametrize("key", ["EQUIRECTANGULAR", "OMNIDIRECTIONAL_STEREO"])
def test_a_full_panorama_s_sum_tends_to_the_whole_sphere(key):
    """Of n rows, whose step is s, the middles' cosines sum to 1 / sin(s / 2)."""
    for rows in (30, 60):
        step = np.pi / rows
        _, angles, _ = solid_angles(key, {"resolution_x": 2 * rows, "resolution_y": rows})
        assert angles.sum() == pytest.approx(4 * np.pi * (step / 2) / np.sin(step / 2), rel=ROUNDED)


def test_six_faces_of_a_cube_tend_to_the_whole_sphere():
    off = []
    for side in (32, 64):
        _, angles, _ = solid_angles("EQUIANGULAR_CUBEMAP_FACE", {"resolution_x": side, "resolution_y": side})
        off.append(6 * angles.sum() / (4 * np.pi) - 1)
    assert abs(off[1]) < 1e-4
    assert off[0] / off[1] == pytest.approx(4, rel=1e-2), "as the square of a pixel"


@pytest.mark.parametrize("key", ["PERSP", "EQUIRECTANGULAR", "GENERAL_LINEAR"])
def test_a_sheared_camera_s_are_the_cross_products_of_its_jacobian(key):
    cam = camera(key, {"matrix_world": SHEARED})
    by_x, by_y = np.moveaxis(cam.rays_jacobian().directions, -1, 0)
    areas = area_pass(cam, "solid_angle")
    np.testing.assert_allclose(
        areas, np.linalg.norm(np.cross(by_x, by_y), axis=-1), rtol=0, atol=64 * EPS * areas.max()
    )


def test_what_is_parallel_has_no_solid_angle_and_what_sees_nothing_no_footprint():
    cam = camera("ORTHO")
    assert not area_pass(cam, "solid_angle").any()
    images = cast(cam, BALL, passes=("footprint", "distance"), dtype=np.float32)
    np.testing.assert_array_equal(np.isinf(images["footprint"]), np.isinf(images["distance"]))
    rimmed = camera("FISHEYE_EQUIDISTANT")
    assert (area_pass(rimmed, "footprint")[~rimmed.rays().valid] == np.inf).all()


def plane_hits(point, normal):
    """What meets rays in a plane."""
    return lambda o, d: o + (((point - o) @ normal) / (d @ normal))[..., None] * d


def ball_hits(center, radius):
    """What meets rays in the near side of a ball."""

    def meet(o, d):
        beside = o - center
        along = (beside * d).sum(axis=-1)
        return o - (along + np.sqrt(along**2 - (beside**2).sum(axis=-1) + radius**2))[..., None] * d

    return meet


TILT = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
CORNERS = np.array([(-4.0, -3.0, -6.0), (5.0, -2.0, -7.0), (0.0, 4.0, -4.0)])
BENT = {
    "loops": np.arange(3).reshape(3, 1),
    "normals": np.float32([(0.6, 0.0, 0.8), (0.0, 0.6, 0.8), (-0.6, 0.0, 0.8)]).T,
}
"""Normals of a smooth face, which are not the triangle's."""
FLOOR = TILT @ (0, 0, 1)
SURFACES = {
    "plane": (shapes(((0, 0, -5), 3 * TILT), kind=PLANE), plane_hits(np.array((0, 0, -5.0)), FLOOR)),
    "floor": (shapes(((0, 0, -5), TILT), kind=INFINITE_PLANE), plane_hits(np.array((0, 0, -5.0)), FLOOR)),
    "ball": (BALL, ball_hits(np.array((0.3, -0.2, -5.0)), 1.5)),
    "triangle": (
        shapes_of((mesh_of(CORNERS, [(0, 1, 2)], **BENT), CORNERS.min(axis=0) / 2 + CORNERS.max(axis=0) / 2, 1.0)),
        plane_hits(CORNERS[0], np.cross(CORNERS[1] - CORNERS[0], CORNERS[2] - CORNERS[0])),
    ),
}
APART = 2.0**-12
"""Pixels between rays whose hits are compared: its square is what differences leave beside the derivative."""


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("key", ["PERSP", "ORTHO", "EQUIRECTANGULAR", "FISHEYE_EQUISOLID", "CROSS_SLIT", "STRIP"])
def test_a_footprint_is_what_the_hits_of_rays_beside_span(key, surface):
    things, meet = SURFACES[surface]
    cam = camera(key)
    footprint, distance = (
        cast(cam, things, passes=("footprint", "distance"), dtype=np.float64)[name]
        for name in ("footprint", "distance")
    )
    x, y = cam.raster.columns(), cam.raster.rows()

    def hit(across, up):
        rays = cam.rays_at(x + across, y + up)
        with np.errstate(invalid="ignore"):
            return meet(rays.origins, rays.directions)

    by_x, by_y = (hit(*(APART * way)) - hit(*(-APART * way)) for way in np.eye(2))
    expected = np.linalg.norm(np.cross(by_x, by_y), axis=-1) / (2 * APART) ** 2
    seen = np.isfinite(distance) & np.isfinite(expected)
    assert seen.sum() > 20
    off = np.abs(footprint / expected - 1)[seen]
    assert np.median(off) <= 1e-8
    grazing = surface in ("ball", "floor")  # at silhouette and horizon the hits of rays beside run away
    assert np.quantile(off, 0.9 if grazing else 1.0) <= 1e-6
    assert (footprint[~np.isfinite(distance)] == np.inf).all()


@pytest.mark.parametrize("matrix", [TURN, SHEARED])
def test_footprints_inside_a_ball_sum_to_its_surface(matrix):
    """All around, from a place that is not its middle; by the square of a pixel."""
    things = shapes((matrix[:3, 3] + (0.5, -0.3, 0.4), 2.0))
    rows = 120
    settings = {"resolution_x": 2 * rows, "resolution_y": rows, "matrix_world": matrix}
    whole = area_pass(camera("EQUIRECTANGULAR", settings), "footprint", things).sum()
    assert whole == pytest.approx(4 * np.pi * 2.0**2, rel=3e-3)


def test_footprints_on_a_mesh_sum_to_its_area_and_are_those_of_its_plane():
    """A sheet of many triangles before a camera without perspective, and a parallelogram."""
    sheet = shapes_of((grid(7, 9, lambda u, v: (2 * u - 1, 2 * v - 1, 0 * u)), (0, 0, -5), TILT))
    plane = shapes(((0, 0, -5), TILT), kind=PLANE)
    cam = camera("PERSP", {"lens": 36.0})
    meshed, exact = area_pass(cam, "footprint", sheet), area_pass(cam, "footprint", plane)
    both = np.isfinite(meshed) & np.isfinite(exact)
    assert both.sum() > 500
    np.testing.assert_allclose(meshed[both], exact[both], rtol=1e-6)  # vertices are float32
    assert exact[np.isfinite(exact)].sum() == pytest.approx(4, rel=2e-2)


def test_an_orthographic_camera_s_footprints_grow_with_the_slope():
    cam = camera("ORTHO")
    areas = area_pass(cam, "footprint")
    x, y = cam.model.window.plane_from_pixels(cam.raster.columns(), cam.raster.rows())
    rise = 1 - ((x - 0.3) ** 2 + (y + 0.2) ** 2) / 1.5**2
    seen = rise > 0.01
    expected = cam.model.window.pitch_x * cam.model.window.pitch_y / np.sqrt(np.where(seen, rise, 1))
    np.testing.assert_allclose(areas[seen], expected[seen], rtol=100 * ROUNDED)


def test_pictures_that_do_not_ask_pay_nothing(monkeypatch):
    monkeypatch.setattr(hit_values, "RayDerivatives", None)
    others = tuple(name for name in STILL if name not in ("solid_angle", "footprint"))
    assert set(cast(camera("EQUIRECTANGULAR"), BALL, passes=others)) == set(others)
    with pytest.raises(TypeError, match="NoneType"):
        cast(camera("EQUIRECTANGULAR"), BALL, passes="solid_angle")
