"""Blender's panoramas: facts of hand geometry, the inverse, what has no ray, where a sphere can be seen, refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras.parts.silhouette import PIXEL_MARGIN as MARGIN
from camera_ray_caster.core.records import BlenderCamera, InputError

from .model_examples import ONLY_SOME, camera

PI = math.pi


def polynomial(*k, **changes):
    return "FISHEYE_LENS_POLYNOMIAL", changes | {f"fisheye_polynomial_k{i}": value for i, value in enumerate(k)}


def tube(u_max, v_max, radius):
    ends = {f"central_cylindrical_range_{name}": value for name, value in (("u_max", u_max), ("v_max", v_max))}
    return "CENTRAL_CYLINDRICAL", {**ends, "central_cylindrical_radius": radius}


CASES = {
    "equirectangular": ("EQUIRECTANGULAR", {}),
    "equirectangular, a part": ("EQUIRECTANGULAR", {"latitude_min": -0.3, "latitude_max": 1.2, "longitude_min": 1.0}),
    "equirectangular, shifted": ("EQUIRECTANGULAR", {"shift_x": 0.3, "latitude_min": -1.0, "shift_y": -0.1}),
    "equirectangular, beyond a pole": ("EQUIRECTANGULAR", {"shift_y": -0.2}),
    "equirectangular, mirrored": ("EQUIRECTANGULAR", {"longitude_min": 1.0, "longitude_max": -2.0}),
    "cube face": ("EQUIANGULAR_CUBEMAP_FACE", {}),
    "cube face, shifted": ("EQUIANGULAR_CUBEMAP_FACE", {"shift_x": 0.2, "shift_y": -0.4}),
    "mirror ball": ("MIRRORBALL", {}),
    "mirror ball, shifted": ("MIRRORBALL", {"shift_x": 0.25, "shift_y": 0.1}),
    "equidistant": ("FISHEYE_EQUIDISTANT", {}),
    "equidistant, all around": ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 2 * PI}),
    "equidistant, all around in float32": ("FISHEYE_EQUIDISTANT", {"fisheye_fov": float(np.float32(2 * PI))}),
    "equidistant, beyond": ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 2.3 * PI}),
    "equidistant, shifted": ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 1.0, "shift_x": -0.3}),
    "equisolid": ("FISHEYE_EQUISOLID", {}),
    "equisolid, all around": ("FISHEYE_EQUISOLID", {"fisheye_fov": 2 * PI, "fisheye_lens": 4.0}),
    "equisolid, beyond": ("FISHEYE_EQUISOLID", {"fisheye_fov": 3 * PI, "fisheye_lens": 6.0}),
    "equisolid, vertical fit": ("FISHEYE_EQUISOLID", {"sensor_fit": "VERTICAL", "pixel_aspect_x": 2.0, "shift_y": 0.1}),
    "polynomial": ("FISHEYE_LENS_POLYNOMIAL", {}),
    "polynomial, as Blender has it": polynomial(-1.17351e-5, -0.01998874, -3.3525e-6, 3.0993e-6, -2.61e-8),
    "polynomial, k1 = 0": polynomial(0.0, 0.0, -3e-3, -1e-5),
    "polynomial, upside down": polynomial(0.0, 0.06, shift_x=0.1),
    "polynomial, across the axis": polynomial(0.3, -0.06),
    "cylinder": ("CENTRAL_CYLINDRICAL", {}),
    "cylinder, a part": tube(u_max=0.5, v_max=4.0, radius=0.7),
}
# what these see twice has two pixels: the inverse can take one only
FOLDED = {"equirectangular, beyond a pole", "equidistant, beyond", "polynomial, across the axis"}
each_case = pytest.mark.parametrize("case", CASES)


def camera_of(key, width=36, height=24, **changes):
    return camera(key, {"resolution_x": width, "resolution_y": height, "fisheye_polynomial_k1": -0.05, **changes})


def ray(cam, x, y):
    return cam.rays_at(x, y).directions


def on_sphere(longitude, latitude):
    """The direction at degrees of longitude (right of ahead) and latitude (above the horizon)."""
    lon, lat = math.radians(longitude), math.radians(latitude)
    return np.array([math.cos(lat) * math.sin(lon), math.sin(lat), -math.cos(lat) * math.cos(lon)])


def from_axis(angle, azimuth):
    """The direction at an angle from ahead, its azimuth counted from right to up, degrees."""
    theta, phi = math.radians(angle), math.radians(azimuth)
    return np.array([math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), -math.cos(theta)])


NEAR = {"rtol": 0, "atol": 1e-15 * 8}  # a few roundings of a unit vector


@pytest.mark.parametrize(
    ("x", "y", "longitude", "latitude"),
    [(18, 12, 0, 0), (27, 12, 90, 0), (9, 18, -90, 45), (21, 8, 30, -30), (24, 20, 60, 60), (36, 12, 180, 0)],
)
def test_equirectangular_is_a_grid_of_degrees(x, y, longitude, latitude):
    np.testing.assert_allclose(ray(camera_of("EQUIRECTANGULAR"), x, y), on_sphere(longitude, latitude), **NEAR)


@pytest.mark.parametrize("azimuth", [0, 45, 90, 200])
@pytest.mark.parametrize("angle", [0, 30, 45, 60, 90])
@pytest.mark.parametrize(
    ("key", "radius"),
    [
        ("FISHEYE_EQUIDISTANT", lambda theta: 18 * theta / (PI / 2)),
        ("FISHEYE_EQUISOLID", lambda theta: 2 * 10.5 * math.sin(theta / 2)),  # a pixel is a millimeter here
        ("FISHEYE_LENS_POLYNOMIAL", lambda theta: theta / 0.05),
        ("MIRRORBALL", lambda theta: 18 * math.sin(theta / 2)),
    ],
)
def test_radius_tells_the_angle_and_azimuth_is_kept(key, radius, angle, azimuth):
    cam = camera_of(key, 36, 36)
    r = radius(math.radians(angle)) * (1 - 1e-15)  # 90 degrees is the rim of three of them
    x, y = 18 + r * math.cos(math.radians(azimuth)), 18 + r * math.sin(math.radians(azimuth))
    np.testing.assert_allclose(ray(cam, x, y), from_axis(angle, azimuth), **NEAR)


def test_mirror_ball_reflects():
    cam = camera_of("MIRRORBALL", 20, 20)
    seen = cam.rays()
    x, y = np.broadcast_arrays((cam.raster.columns() - 10) / 10, (cam.raster.rows() - 10) / 10)
    with np.errstate(invalid="ignore"):
        normal = np.stack((x, y, -np.sqrt(1 - x * x - y * y)), axis=-1)
    incoming = np.array([0.0, 0.0, 1.0])
    reflected = incoming - 2 * (normal @ incoming)[..., None] * normal
    np.testing.assert_allclose(seen.directions, reflected, **NEAR)
    assert (seen.valid == (np.hypot(x, y) < 1)).all()


def test_a_squeezed_fisheye_is_an_ellipse():
    cam = camera_of("FISHEYE_EQUIDISTANT", 40, 10)
    np.testing.assert_allclose(ray(cam, 40, 5), [1, 0, 0], **NEAR)
    np.testing.assert_allclose(ray(cam, 20, 10), [0, 1, 0], **NEAR)


def test_cube_face_is_even_in_angle():
    cam = camera_of("EQUIANGULAR_CUBEMAP_FACE", 90, 90)
    for degrees in (0, 30, 45):
        direction = ray(cam, 45 + degrees, 45)
        np.testing.assert_allclose(direction, from_axis(degrees, 0), **NEAR)
    np.testing.assert_allclose(ray(cam, 90, 0), np.array([1, -1, -1]) / math.sqrt(3), **NEAR)


def test_cylinder_is_even_in_longitude_and_in_the_tangent_of_latitude():
    cam = camera_of("CENTRAL_CYLINDRICAL", 36, 20)
    np.testing.assert_allclose(ray(cam, 18, 20), on_sphere(0, 45), **NEAR)
    np.testing.assert_allclose(ray(cam, 27, 0), on_sphere(90, -45), **NEAR)
    np.testing.assert_allclose(ray(cam, 21, 10 + 10 * math.tan(PI / 6)), on_sphere(30, 30), **NEAR)


@pytest.mark.parametrize("key", sorted({key for key, _ in CASES.values()}))
def test_shift_moves_by_fractions_of_each_side_of_the_frame(key):
    plain, moved = camera_of(key), camera_of(key, shift_x=0.25, shift_y=-0.25)
    x, y = np.array([3.3, 9.1, 13.0]), np.array([15.0, 16.2, 17.9])
    np.testing.assert_allclose(ray(moved, x, y), ray(plain, x + 9, y - 6), rtol=0, atol=1e-14)


@pytest.mark.parametrize("fov", [2.5 * PI, 10 * PI])
def test_a_fisheye_wider_than_a_turn_goes_around_and_its_inverse_takes_the_nearest_to_the_axis(fov):
    cam = camera_of("FISHEYE_EQUIDISTANT", 200, 200, fisheye_fov=fov)
    turn = 200 * PI / fov * 2  # pixels from the axis to the axis again, 360 degrees on
    np.testing.assert_allclose(ray(cam, 100 + turn / 4, 100), [1, 0, 0], atol=1e-14)
    np.testing.assert_allclose(ray(cam, 100 - turn / 2 - 1e-9, 100), [0, 0, 1], atol=1e-9)
    if turn < 100:
        np.testing.assert_allclose(ray(cam, 100 + turn, 100), [0, 0, -1], atol=1e-14)
    np.testing.assert_allclose(cam.project([[1.0, 0, 0]]), [[100 + turn / 4, 100]], rtol=1e-14)


@each_case
def test_pixel_to_ray_to_pixel_and_point_to_pixel_to_ray(case):
    key, changes = CASES[case]
    cam = camera_of(key, **changes)
    rays = cam.rays()
    assert rays.valid.any()
    np.testing.assert_allclose(np.linalg.norm(rays.directions[rays.valid], axis=-1), 1, rtol=0, atol=1e-15)
    assert (np.isnan(rays.directions).any(axis=-1) == ~rays.valid).all()
    assert (np.isnan(rays.directions).all(axis=-1) == ~rays.valid).all()
    back = cam.project(7.0 * rays.directions)
    pixels = np.stack(np.broadcast_arrays(cam.raster.columns(), cam.raster.rows()), axis=-1)
    if case not in FOLDED:
        np.testing.assert_allclose(back[rays.valid], pixels[rays.valid], rtol=0, atol=1e-9)
    points = np.random.default_rng(1).normal(size=(500, 3))
    where = cam.project(points)
    seen = ~np.isnan(where).any(axis=-1)
    assert seen.any()
    towards = points / np.linalg.norm(points, axis=-1, keepdims=True)
    returned = ray(cam, where[seen, 0], where[seen, 1])
    np.testing.assert_allclose(returned, towards[seen], rtol=0, atol=1e-13)


@each_case
def test_a_great_circle_stays_on_its_plane(case):
    key, changes = CASES[case]
    cam = camera_of(key, **changes)
    normal, along = np.array([6.0, -3.0, 2.0]) / 7, np.array([1.0, 2.0, 0.0]) / math.sqrt(5)
    angle = np.linspace(0, 2 * PI, 400)[:, None] + 0.1  # the horizon, where some rims are, lies between two points
    pixels = cam.project(np.cos(angle) * along + np.sin(angle) * np.cross(normal, along))
    pixels = pixels[~np.isnan(pixels).any(axis=-1)]
    assert len(pixels)
    assert np.abs(ray(cam, pixels[:, 0], pixels[:, 1]) @ normal).max() < 1e-13


@each_case
def test_the_point_behind_a_rim_and_the_eye_have_no_pixel_or_one_that_sees_them(case):
    key, changes = CASES[case]
    cam = camera_of(key, **changes)
    points = np.array([[0.0, 0, 0], [0, 0, 1], [0, 0, -1], [0, 1, 0], [0, -1, 0], [1, 0, 0], [-1, 0, 0]])
    pixels = cam.project(points)
    assert np.isnan(pixels[0]).all()
    seen = ~np.isnan(pixels).any(axis=-1)
    np.testing.assert_allclose(ray(cam, *pixels[seen].T), points[seen], rtol=0, atol=1e-13)


@each_case
def test_no_pixel_outside_of_its_bounds_sees_a_sphere(case):
    key, changes = CASES[case]
    cam = camera_of(key, **changes)
    random = np.random.default_rng(2)
    centers = random.normal(size=(300, 3))
    centers[:40, 2] = -np.abs(centers[:40, 2])
    centers[:5, :2] = 0
    centers[5:8, ::2] = 0
    radii = random.uniform(0.01, 1.2, 300) * np.linalg.norm(centers, axis=-1) ** 2
    bounds = cam.model.bounds(centers, radii)
    assert bounds.shape == (300, 4)
    rays = cam.rays()
    x, y = np.broadcast_arrays(cam.raster.columns(), cam.raster.rows())
    hidden = 0
    for center, radius, (x0, x1, y0, y1) in zip(centers, radii, bounds, strict=True):
        off_axis = np.linalg.norm(np.cross(rays.directions, center), axis=-1)
        hit = (np.linalg.norm(center) <= radius) | ((off_axis <= radius) & (rays.directions @ center > 0))
        hit &= rays.valid
        inside = (x >= x0) & (x <= x1) & (y >= y0) & (y <= y1)
        assert not (hit & ~inside).any()
        hidden += int((~inside).sum())
    some = case not in {"polynomial, across the axis", "polynomial, upside down"}
    assert hidden > 300 * x.size / 4 or not some  # they do leave something out


def test_bounds_touch_the_silhouette():
    cam = camera_of("FISHEYE_EQUIDISTANT", 1800, 1800)
    # a disc of 10 degrees, 45 degrees to the right: 10 pixels a degree, and as wide in azimuth as asin(sin 10 / sin 45)
    bounds = cam.model.bounds(np.array([[1.0, 0, -1]]), np.array([math.sqrt(2) * math.sin(math.radians(10))]))
    half = 550 * math.sin(math.radians(10)) / math.sin(math.radians(45))
    left = 900 + 350 * math.sqrt(1 - (half / 550) ** 2)
    np.testing.assert_allclose(bounds, [[left - MARGIN, 1450 + MARGIN, 900 - half - MARGIN, 900 + half + MARGIN]])
    cam = camera_of("EQUIRECTANGULAR", 360, 180)
    bounds = cam.model.bounds(np.array([[0, 1.0, -1]]), np.array([math.sqrt(2) * math.sin(math.radians(30))]))
    np.testing.assert_allclose(bounds, [[135 - MARGIN, 225 + MARGIN, 105 - MARGIN, 165 + MARGIN]])


def test_nothing_is_seen_of_what_lies_outside_the_field_of_view():
    behind = np.array([[0.0, 0, 1]]), np.array([0.1])
    for key, changes in [
        ("FISHEYE_EQUIDISTANT", {}),
        ("FISHEYE_EQUISOLID", {}),
        ("FISHEYE_LENS_POLYNOMIAL", {}),
        ("EQUIANGULAR_CUBEMAP_FACE", {}),
        ("EQUIRECTANGULAR", {"longitude_min": -1.0, "longitude_max": 1.0}),
    ]:
        assert np.isnan(camera_of(key, **changes).model.bounds(*behind)).any()


@pytest.mark.parametrize(
    ("key", "changes", "says"),
    [
        (
            "FISHEYE_EQUIDISTANT",
            {"fisheye_fov": 0.0},
            "fisheye_fov of camera 'Camera' is 0 degrees .0 radians.: it must be above 0",
        ),
        ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 40.0}, "up to 1800 degrees"),
        ("FISHEYE_EQUISOLID", {"fisheye_lens": -1.0}, "fisheye_lens"),
        ("FISHEYE_EQUISOLID", {"sensor_width": 0.0}, "sensor"),
        ("FISHEYE_LENS_POLYNOMIAL", {"fisheye_polynomial_k3": math.nan}, "fisheye_polynomial_k3 .* nan"),
        ("FISHEYE_LENS_POLYNOMIAL", {"fisheye_polynomial_k1": 0.0}, "turns back 0 mm"),
        ("FISHEYE_LENS_POLYNOMIAL", {"fisheye_polynomial_k2": 0.003}, "turns back 8.3333. mm .* corner at 21.6333"),
        ("EQUIRECTANGULAR", {"latitude_max": 2.0}, "latitude_max"),
        ("EQUIRECTANGULAR", {"longitude_min": PI}, "longitude_min and longitude_max"),
        ("CENTRAL_CYLINDRICAL", {"central_cylindrical_radius": 0.0}, "central_cylindrical_radius"),
    ],
)
def test_what_has_no_meaning_is_refused_by_name(key, changes, says):
    with pytest.raises(InputError, match=says) as refusal:
        camera_of(key, **changes)
    assert "\n" not in str(refusal.value)


def test_a_panorama_is_of_its_panorama_type_and_another_model_may_be_chosen():
    raw = BlenderCamera("c", "PANO", np.eye(4), settings={**ONLY_SOME, "panorama_type": "MIRRORBALL"})
    assert camera_from(raw).model.key == "MIRRORBALL"
    assert camera_from(replace(raw, model="ORTHO")).model.key == "ORTHO"
    with pytest.raises(InputError, match="OSL"):
        camera_from(replace(raw, type="CUSTOM"))


def test_a_polynomial_may_turn_back_where_nothing_is_seen():
    # it turns at 8.33 mm, where theta is 0.2083, and comes down to -0.1 at the corner of a sensor that is small enough
    cam = camera_of(
        "FISHEYE_LENS_POLYNOMIAL", fisheye_polynomial_k2=0.003, fisheye_fov=0.2, sensor_width=36 * 10 / 21.7
    )
    rays = cam.rays()
    assert rays.valid.any()
    assert not rays.valid.all()
    pixels = cam.project(rays.directions)[rays.valid]
    np.testing.assert_allclose(ray(cam, *pixels.T), rays.directions[rays.valid], rtol=0, atol=1e-14)
