"""Spherical stereo: where its rays begin and meet by hand geometry and 50 digits, and the contract of a model."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest
from mpmath import mp, mpf

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.camera.spherical_stereo import SphericalStereo
from camera_ray_caster.core.camera.stereo import eye_record
from camera_ray_caster.core.cameras.model import Model
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.motion.interpolation import TimeInterval
from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.report.verification import verify

from ..cameras.model_examples import IDENTITY, TURNED, raw_of
from ..cameras.test_model import inner_pixels, on_frame, points_between

DISTANCE, CONVERGENCE = 0.5, 4.0
STEREO = {
    "views_format": "STEREO_3D", "use_spherical_stereo": True, "convergence_mode": "OFFAXIS", "pivot": "CENTER",
    "interocular_distance": DISTANCE, "convergence_distance": CONVERGENCE,
    "use_pole_merge": False, "pole_merge_angle_from": 0.4, "pole_merge_angle_to": 1.2,
}  # fmt: skip
MERGED = {"use_pole_merge": True}
FADING = {"pole_merge_angle_from": pi / 3, "pole_merge_angle_to": pi * 5 / 12}
PARALLEL = {"convergence_mode": "PARALLEL"}
MODES = [
    {},
    MERGED,
    PARALLEL,
    PARALLEL | MERGED,
    MERGED | FADING,
    MERGED | {"pole_merge_angle_from": 0.0, "pole_merge_angle_to": pi / 2},
]
KINDS = (
    "PERSP", "EQUIRECTANGULAR", "EQUIANGULAR_CUBEMAP_FACE", "MIRRORBALL", "FISHEYE_EQUIDISTANT", "FISHEYE_EQUISOLID",
    "FISHEYE_LENS_POLYNOMIAL", "CENTRAL_CYLINDRICAL",
)  # fmt: skip
SHEARED = (np.array(TURNED) @ [[1, 0.5, 0, 0], [0, 1, 0.3, 0], [0, 0, -1, 0], [0, 0, 0, 1]]).tolist()

each_kind = pytest.mark.parametrize("key", KINDS)
each_mode = pytest.mark.parametrize("mode", MODES)


def eye(key, view="left", matrix=TURNED, **settings):
    """An eye of one of Blender's own cameras."""
    raw = raw_of(key, STEREO | {"lens": 14.0, "matrix_world": matrix} | settings)
    kind = {"type": "PERSP"} if key == "PERSP" else {"type": "PANO"}
    raw = replace(raw, model="", settings={**raw.settings, "panorama_type": key}, **kind)
    return camera_from(eye_record(raw, view))


@each_kind
@each_mode
@pytest.mark.parametrize("matrix", [TURNED, SHEARED], ids=["turned", "sheared"])
def test_rays_are_those_of_the_formula_with_50_digits_within_their_bound(key, mode, matrix):
    """Written anew, from the lens's own directions, which other tests hold."""
    for view, side in (("left", -1), ("right", 1)):
        cam = eye(key, view, matrix, **mode)
        x, y = inner_pixels(cam, 12)
        rays = world_rays(cam, x, y)
        origin, direction = (
            np.stack(np.broadcast_arrays(*vectors, x)[:3], axis=-1) for vectors in (rays.origin, rays.direction)
        )
        bounds = np.broadcast_arrays(rays.origin_error, rays.direction_error, x)
        plain = np.stack(np.broadcast_arrays(*cam.model.lens.rays(x, y)[1], x)[:3], axis=-1)
        for k in range(len(x)):
            with mp.workdps(50):
                expected = anew(key, mode, cam, plain[k], -side if key == "MIRRORBALL" else side)
                scale = mp.norm(mp.matrix(direction[k].tolist())) / mp.norm(expected[1])
                off = [
                    float(mp.norm(mp.matrix(ours[k].tolist()) - theirs))
                    for ours, theirs in ((origin, expected[0]), (direction, expected[1] * scale))
                ]
            # the places of the pixels are taken to be exact: only what comes after the lens may differ
            assert off[0] <= bounds[0][k]
            assert off[1] <= bounds[1][k]


def anew(key, mode, cam, lens, side):
    """Origin and direction in the world, the eye apart, with mpmath."""
    basis = mp.matrix(cam.pose.basis.tolist())
    up = mp.matrix([0, 0, 1] if key == "PERSP" else [0, 1, 0])
    ahead = mp.matrix(lens.tolist())
    ahead = basis * ahead if key == "PERSP" else ahead
    height = (ahead.T * up)[0]
    ahead /= mp.sqrt(mp.norm(ahead) ** 2 - height**2) if key == "CENTRAL_CYLINDRICAL" else mp.norm(ahead)
    settings = STEREO | mode
    offset = side * mpf(settings["interocular_distance"]) / 2
    if settings["use_pole_merge"]:
        begin, end = (mpf(settings[f"pole_merge_angle_{word}"]) for word in ("from", "to"))
        altitude = mp.asin(min(abs((ahead.T * up)[0]), mpf(1)))
        if altitude > end:
            offset = mpf(0)
        elif altitude > begin:
            offset *= mp.cos(mpf(pi) / 2 * (altitude - begin) / (end - begin))
    across = mp.matrix([ahead[1] * up[2] - ahead[2] * up[1], ahead[2] * up[0] - ahead[0] * up[2],
                        ahead[0] * up[1] - ahead[1] * up[0]])  # fmt: skip
    origin = across * (offset / mp.norm(across))
    if settings["convergence_mode"] != "PARALLEL":
        ahead = settings["convergence_distance"] * ahead - origin
    return (origin, ahead) if key == "PERSP" else (basis * origin, basis * ahead)


@each_kind
@each_mode
@pytest.mark.parametrize("matrix", [TURNED, SHEARED], ids=["turned", "sheared"])
def test_from_pixel_to_ray_to_pixel(key, mode, matrix):
    for view, distance in (("left", 0.7), ("right", 30.0), ("left", 1e3)):
        cam = eye(key, view, matrix, **mode)
        x, y = inner_pixels(cam, 300)
        rays = cam.rays_at(x, y)
        assert np.linalg.norm(rays.directions, axis=-1) == pytest.approx(1.0, rel=8 * EPS)
        back = cam.project(rays.origins + distance * rays.directions)
        away = np.abs(back - np.stack((x, y), axis=-1)).max(axis=1)
        if key == "CENTRAL_CYLINDRICAL" and distance < 1:
            away = away[~np.isnan(away)]  # within the offset of the axis
        assert away.max() <= 1e-9


@each_kind
@each_mode
def test_from_point_to_pixel_to_a_ray_through_the_point(key, mode):
    cam = eye(key, **mode)
    points = points_between(cam)
    pixels = cam.project(points)
    far = np.linalg.norm(points - cam.pose.eye, axis=-1) > DISTANCE / 2  # nearer, a ray may graze the eye's own circle
    seen = far & on_frame(cam, pixels)
    assert seen.sum() > 50
    points, pixels = points[seen], pixels[seen]
    rays = cam.rays_at(*pixels.T)
    beside = np.linalg.norm(np.cross(points - rays.origins, rays.directions), axis=-1)
    ahead = ((points - rays.origins) * rays.directions).sum(axis=-1)
    assert (beside <= 1e-11 * np.linalg.norm(points - cam.pose.eye, axis=-1) + 1e-13).all()
    assert (ahead > 0).all()


@each_kind
@pytest.mark.parametrize("mode", [{}, PARALLEL | MERGED])
def test_the_numerical_inverse_finds_the_same(key, mode):
    cam = eye(key, matrix=IDENTITY, **mode)
    x, y = inner_pixels(cam, 60)
    rays = cam.rays_at(x, y)
    points = rays.origins + 5.0 * rays.directions
    off = np.abs(Model.project(cam.model, points) - cam.project(points)).max(axis=1)
    assert np.median(off) < 1e-10


@each_kind
@each_mode
def test_bounds_hold_all_that_is_seen_of_a_sphere(key, mode):
    for matrix in (TURNED, SHEARED):
        cam = eye(key, "right", matrix, **mode)
        rng = np.random.default_rng(3)
        places = points_between(cam, 150)
        centers = (places - cam.pose.eye) @ np.linalg.inv(cam.pose.basis).T
        radii = np.linalg.norm(centers, axis=1) * 10 ** rng.uniform(-3, -0.3, size=len(centers))
        x0, x1, y0, y1 = cam.model.bounds(centers, radii).T[:, :, None]
        assert not np.isinf(x0).all()
        on_sphere = rng.normal(size=(40, 3))
        on_sphere /= np.linalg.norm(on_sphere, axis=1, keepdims=True)
        points = (centers[:, None] + radii[:, None, None] * on_sphere) @ cam.pose.basis.T + cam.pose.eye
        pixels = cam.project(points)
        seen = on_frame(cam, pixels)
        assert seen.sum() > 200
        inside = (x0 <= pixels[..., 0]) & (pixels[..., 0] <= x1) & (y0 <= pixels[..., 1]) & (pixels[..., 1] <= y1)
        assert inside[seen].all()


@each_kind
def test_both_eyes_are_beside_each_other_and_meet_at_the_convergence_distance(key):
    """On a sphere, or of the central cylindrical panorama on a cylinder, about the camera; on no side up or down."""
    left, right = (eye(key, view) for view in ("left", "right"))
    x, y = inner_pixels(left)
    left_rays, two = left.rays_at(x, y), right.rays_at(x, y)
    apart = two.origins - left_rays.origins
    up = (0.0, 0.0, 1.0) if key == "PERSP" else left.pose.basis[:, 1]
    assert np.linalg.norm(apart, axis=-1) == pytest.approx(DISTANCE, rel=64 * EPS)
    assert apart @ up == pytest.approx(0.0, abs=64 * EPS)
    plain = left.model.lens.rays(x, y)[1]
    plain = np.stack(np.broadcast_arrays(*plain, x)[:3], axis=-1) @ left.pose.basis.T
    plain /= np.linalg.norm(plain, axis=-1, keepdims=True)
    if key == "CENTRAL_CYLINDRICAL":
        plain /= np.linalg.norm(np.cross(plain, up), axis=-1, keepdims=True)
    met = left.pose.eye + CONVERGENCE * plain
    for rays in (left_rays, two):
        assert np.cross(met - rays.origins, rays.directions) == pytest.approx(np.zeros((len(x), 3)), abs=1e-13)
    rightward = (np.cross(plain, up) * apart).sum(axis=-1)
    assert ((rightward > 0) == (key != "MIRRORBALL")).all()  # which has the eyes swapped, as in Cycles


def test_up_is_the_world_s_for_perspective_and_the_camera_s_for_panoramas():
    """A camera rolled by a quarter turn about its axis, which lies along the world's y."""
    rolled = [[0, -1.0, 0, 0], [0, 0, -1, 0], [1, 0, 0, 0], [0, 0, 0, 1]]
    for key, expected in (("PERSP", [0.25, 0, 0]), ("EQUIRECTANGULAR", [0, 0, 0.25])):
        rays = eye(key, "right", rolled, **PARALLEL).rays_at(48.0, 27.0)
        assert rays.directions == pytest.approx([0, 1, 0], abs=4 * EPS)
        assert rays.origins == pytest.approx(expected, abs=4 * EPS)


def test_the_pole_merge_fades_the_offset():
    """By the cosine of a quarter turn between its angles; nothing of it is left above."""
    cam = eye("EQUIRECTANGULAR", matrix=IDENTITY, **PARALLEL | MERGED)
    altitude = np.array([0.0, 0.39, 0.4, 0.8, 1.1, 1.2 + 1e-9, 1.5])
    for sign in (1, -1):
        origins = cam.rays_at(np.full(7, 48.0), 27 + sign * altitude * 54 / pi).origins
        expected = DISTANCE / 2 * np.array([1, 1, 1, np.cos(pi / 4), np.cos(0.875 * pi / 2), 0, 0])
        assert np.linalg.norm(origins, axis=-1) == pytest.approx(expected, abs=64 * EPS)
        assert not origins[-2:].any()


def test_straight_up_and_down_no_ray_begins_beside_another():
    """Nor is there a warning: it would fail."""
    cam = eye("PERSP", matrix=IDENTITY)
    assert not cam.rays_at(48.0, 27.0).valid
    assert cam.rays_at(48.0, 27.1).valid
    assert np.isnan(cam.project(np.zeros(3))).all()


@each_kind
def test_what_no_eye_sees_has_no_pixel(key):
    """The place of the camera itself, and what lies within the circle of parallel eyes."""
    cam = eye(key, matrix=IDENTITY, **PARALLEL)
    points = np.array([(0.0, 0, 0), (0.1, 0, -0.1), (inf, 0, 0), (np.nan, 0, -1), (0, 1e300, -1e300)])
    assert np.isnan(cam.project(points)[:4]).all()


def test_without_a_distance_there_is_one_eye():
    assert not isinstance(eye("PERSP", interocular_distance=0.0).model, SphericalStereo)


def test_a_merge_that_ends_where_it_begins_jumps():
    cam = eye("EQUIRECTANGULAR", matrix=IDENTITY, **MERGED | {"pole_merge_angle_from": 1.2, "pole_merge_angle_to": 0.5})
    up = 27 + np.array([0.499, 0.501]) * 54 / pi
    assert np.linalg.norm(cam.rays_at(np.full(2, 48.0), up).origins, axis=-1) == pytest.approx([0.25, 0.0], abs=EPS)


@pytest.mark.parametrize("key", ["MIRRORBALL", "FISHEYE_EQUISOLID"])
def test_a_merge_left_out_where_no_ray_fades_changes_no_bit(key):
    """Of a few rows at a time, most of which it leaves out, and of all rays at once, some of which fade."""
    cam = eye(key, **MERGED, **FADING)
    x, y = cam.raster.columns(), cam.raster.rows()
    whole = cam.rays_at(x, y)
    for number, row in enumerate(y[:, 0]):
        alone = cam.rays_at(x[0], row)
        np.testing.assert_array_equal(alone.origins, whole.origins[number])
        np.testing.assert_array_equal(alone.directions, whole.directions[number])


def test_pivot_and_shift_of_an_eye_do_not_count():
    for key in ("PERSP", "EQUIRECTANGULAR"):
        first, *others = (
            eye(key, convergence_mode=mode, pivot=pivot).rays()
            for mode, pivot in (("OFFAXIS", "CENTER"), ("TOE", "CENTER"), ("OFFAXIS", "LEFT"), ("TOE", "RIGHT"))
        )
        for other in others:
            np.testing.assert_array_equal(other.directions, first.directions)
            np.testing.assert_array_equal(other.origins, first.origins)


def test_the_world_s_up_stays_up_while_a_camera_turns():
    """Between two evaluations of a perspective camera that rolls by a quarter turn."""
    rolled = np.array([[0, -1.0, 0, 0], [0, 0, -1, 0], [1, 0, 0, 0], [0, 0, 0, 1]])
    upright = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    cameras = {
        frame: (eye("PERSP", "right", matrix, **PARALLEL), None) for frame, matrix in ((0.0, upright), (1.0, rolled))
    }
    between = TimeInterval.of(cameras, (0.0, 1.0)).camera_at(0.5)
    assert between.rays_at(48.0, 27.0).origins == pytest.approx([0.25, 0, 0], abs=16 * EPS)


def test_a_model_that_blender_does_not_have_is_refused():
    raw = replace(raw_of("OPENCV_PINHOLE", STEREO), type="PERSP")
    with pytest.raises(InputError, match="only Blender's own cameras have"):
        eye_record(raw, "left")


@each_kind
@pytest.mark.parametrize("merge", [{}, MERGED | FADING], ids=["", "merged"])
@pytest.mark.parametrize("convergence", [1e-3, 1e-5])
def test_eyes_that_converge_within_their_offset_go_there_and_back(key, merge, convergence):
    """1e-5 is Blender's least convergence distance: D is 1/15,000 of such a ray."""
    cam = eye(key, interocular_distance=0.3, convergence_distance=convergence, **merge)
    (finding,) = verify(cam)
    assert finding.passed
    assert finding.points > 40
