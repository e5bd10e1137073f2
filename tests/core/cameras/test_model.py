"""The contract that every camera model keeps, and the facts that geometry by hand supplies."""

import copy
import pickle
from functools import partial

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.model import Model
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.records import InputError

from .model_examples import BORDER, EXAMPLES, FACTS, IDENTITY, REFUSED, TURNED, UNSEEN, camera

KEYS = [model.key for model in MODELS]
pytestmark = pytest.mark.one_for_each("key")


def rows_of(table, default=()):
    return [pytest.param(key, row, id=f"{key}-{i}") for key in KEYS for i, row in enumerate(table.get(key, default))]


each_example = pytest.mark.parametrize(("key", "settings"), rows_of(EXAMPLES, [{}]))
each_model = pytest.mark.parametrize("key", KEYS)


@pytest.mark.parametrize("table", [EXAMPLES, FACTS, UNSEEN, REFUSED])
def test_the_tables_name_models_that_there_are(table):
    assert set(table) <= set(KEYS)


@each_example
def test_cameras_can_be_copied_and_sent_to_other_processes(key, settings):
    cam = camera(key, settings)
    cam.project((0.1, 0.1, -3.0))
    for other in (pickle.loads(pickle.dumps(cam)), copy.copy(cam), copy.deepcopy(cam)):
        assert other == cam
        np.testing.assert_array_equal(other.rays().directions, cam.rays().directions)


@each_example
def test_the_numerical_inverse_finds_what_the_closed_form_does(key, settings):
    """It is the default of a model that has no closed form."""
    cam = camera(key, settings | {"matrix_world": IDENTITY})
    x, y = inner_pixels(cam)
    rays = cam.rays_at(x, y)
    points = rays.origins + 10 ** np.random.default_rng(8).uniform(-0.5, 2, (len(x), 1)) * rays.directions
    pixels = Model.project(cam.model, points)
    assert not np.isnan(pixels).any()
    off = np.linalg.norm(pixels - np.stack((x, y), axis=1), axis=1)
    assert np.median(off) < 1e-12
    elsewhere = off > 1e-9  # another pixel that sees the point
    assert not (cam.model.smooth and elsewhere.any())
    other_rays = cam.rays_at(*pixels[elsewhere].T)
    beside = np.cross(points[elsewhere] - other_rays.origins, other_rays.directions)
    assert (np.abs(beside) <= 1e-12 * np.linalg.norm(points[elsewhere], axis=1, keepdims=True)).all()


def inner_pixels(cam, count=200):
    """Pixel coordinates all over the frame that have a ray; not on its very edges, where a panorama has its seam."""
    x, y = (np.random.default_rng(7).uniform(0.001, 0.999, (count, 2)) * (cam.raster.width, cam.raster.height)).T
    valid = cam.rays_at(x, y).valid
    return x[valid], y[valid]


def points_between(cam, count=500):
    """World points halfway between points on two rays each: most of them in the picture, however narrow it is."""
    x, y = inner_pixels(cam, 2 * count)
    rays = cam.rays_at(x, y)
    points = rays.origins + 10 ** np.random.default_rng(8).uniform(-1, 2, (len(x), 1)) * rays.directions
    half = len(points) // 2
    return (points[:half] + points[half : 2 * half]) / 2


@each_example
def test_rays_have_unit_length_and_are_as_valid_as_they_say(key, settings):
    rays = camera(key, settings).rays()
    assert rays.directions.shape == rays.origins.shape == (*rays.valid.shape, 3)
    assert rays.directions.dtype == np.float64
    assert rays.valid.any()
    assert (rays.valid == ~np.isnan(rays.directions).any(axis=-1)).all()
    length = np.linalg.norm(rays.directions[rays.valid], axis=-1)
    assert np.abs(length - 1).max() <= 8 * EPS  # 4 of the unit vector, 4 of the length taken here


@each_example
def test_a_place_that_is_not_finite_has_no_ray(key, settings):
    """Nor do numbers too large warn: a warning would fail."""
    cam = camera(key, settings)
    x, y = np.array([(np.inf, 1), (1, -np.inf), (np.inf, np.inf), (np.nan, 1), (1e300, 1e300), (1e160, -1e200)]).T
    for across, up in ((x, y), (x[:, None], y)):
        rays = cam.rays_at(across, up)
        finite = np.isfinite(across) & np.isfinite(up)
        assert not rays.valid[~finite].any()
        assert np.isnan(rays.directions[~rays.valid]).all()
        assert np.linalg.norm(rays.directions[rays.valid], axis=-1) == pytest.approx(1.0, rel=8 * EPS)


@each_example
def test_a_place_far_out_takes_no_ray_from_the_others(key, settings):
    """Which may change by the roundings of an iteration that begins elsewhere."""
    cam = camera(key, settings)
    x, y = np.random.default_rng(1).uniform(0, cam.raster.width, (2, 2000))
    alone, among = cam.rays_at(x, y), cam.rays_at(np.append(x, np.nan), np.append(y, 1e300))
    np.testing.assert_array_equal(among.valid, [*alone.valid, False])
    np.testing.assert_allclose(among.directions[:-1], alone.directions, rtol=0, atol=8 * EPS)


@each_example
def test_a_point_that_is_not_finite_has_no_pixel(key, settings):
    """Nor do numbers too large warn: a warning would fail. One point gives what it gives among others."""
    cam = camera(key, settings)
    infinite = [(np.inf, 0, -5), (0, -np.inf, -5), (0, 0, -np.inf), (np.nan, 0, -5), (-np.inf, -np.inf, -np.inf)]
    points = np.array([*infinite, (1e300, 1, -5), (1, 1e200, -1e200), (0, 0, -1e300), (0.1, 0.2, -5)])
    pixels = cam.project(points)
    assert np.isnan(pixels[: len(infinite)]).all()
    assert (np.isnan(pixels).any(axis=1) == np.isnan(pixels).all(axis=1)).all()
    assert not np.isinf(pixels).any()
    for point, pixel in zip(points, pixels, strict=True):
        assert np.allclose(cam.project(point), pixel, rtol=1e-9, atol=1e-9, equal_nan=True)


@each_example
def test_rays_are_those_through_pixel_centers(key, settings):
    cam = camera(key, settings)
    rays = cam.rays()
    height, width = rays.valid.shape
    x, y = np.meshgrid(cam.raster.x0 + np.arange(width) + 0.5, cam.raster.y0 + np.arange(height) + 0.5)
    one_by_one = cam.rays_at(x.ravel(), y.ravel())
    np.testing.assert_array_equal(rays.directions.reshape(-1, 3), one_by_one.directions)
    np.testing.assert_array_equal(rays.origins.reshape(-1, 3), one_by_one.origins)


@each_model
def test_a_border_cuts_and_moves_nothing(key):
    full, cut = camera(key), camera(key, BORDER)
    window = np.s_[cut.raster.y0 : cut.raster.y1, cut.raster.x0 : cut.raster.x1]
    np.testing.assert_array_equal(cut.rays().directions, full.rays().directions[window])
    np.testing.assert_array_equal(cut.rays().origins, full.rays().origins[window])


@each_example
def test_from_pixel_to_ray_to_pixel(key, settings):
    """At three distances; from several eyes, the farthest point itself keeps less of its place in the picture."""
    cam = camera(key, settings)
    x, y = inner_pixels(cam)
    rays = cam.rays_at(x, y)
    for distance in (1.0, 1e3, 1e9) if cam.model.central else (1.0, 1e3):
        back = cam.project(rays.origins + distance * rays.directions)
        assert np.abs(back - np.stack((x, y), axis=-1)).max() <= 1e-9


@each_example
def test_from_point_to_pixel_to_a_ray_through_the_point(key, settings):
    cam = camera(key, settings)
    points = points_between(cam)
    pixels = cam.project(points)
    seen = on_frame(cam, pixels)
    assert seen.sum() > 50
    points, pixels = points[seen], pixels[seen]
    rays = cam.rays_at(pixels[:, 0], pixels[:, 1])
    beside = np.cross(points - rays.origins, rays.directions)
    # the distance of neighboring pixels at the point turns a length into pixels
    next_rays = cam.rays_at(pixels[:, 0] + 1e-3, pixels[:, 1])
    pixel = np.linalg.norm(np.cross(points - next_rays.origins, next_rays.directions), axis=-1) * 1e3
    assert (np.linalg.norm(beside, axis=-1) / pixel).max() <= 1e-9


def on_frame(cam, pixels):
    """Whether pixel coordinates lie on the full frame."""
    return ((pixels >= 0) & (pixels <= (cam.raster.width, cam.raster.height))).all(axis=-1)


@pytest.mark.parametrize(("key", "fact"), rows_of(FACTS))
def test_geometry_by_hand(key, fact):
    settings, pixel, origin, direction = fact
    for pose in (IDENTITY, TURNED):
        cam = camera(key, settings | {"matrix_world": pose})
        world = np.array(pose)
        ray = cam.rays_at(*pixel)
        expected = world[:3, :3] @ direction
        np.testing.assert_allclose(ray.directions, expected / np.linalg.norm(expected), rtol=0, atol=16 * EPS)
        np.testing.assert_allclose(ray.origins, world[:3, :3] @ origin + world[:3, 3], rtol=8 * EPS, atol=8 * EPS)


@pytest.mark.parametrize("key", ["PERSP", "ORTHO"])
def test_the_pose_is_each_axis_normalized_for_itself(key):
    """Before a model is asked: one eye, and many."""
    plain = camera(key).rays()
    for linear in (np.diag([3.0, 0.5, 7.0]), np.diag([-2.0, 1.0, -1e-3]), [[1, 0.5, 0], [0, 2, 0.3], [0.1, 0, -1]]):
        matrix = np.array(TURNED)
        matrix[:3, :3] = matrix[:3, :3] @ linear
        axes = matrix[:3, :3] / np.sqrt((matrix[:3, :3] ** 2).sum(axis=0))
        rays = camera(key, {"matrix_world": matrix}).rays()
        expected = plain.directions @ axes.T
        expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
        reach = np.abs(plain.origins).max() + np.abs(matrix[:3, 3]).max()
        np.testing.assert_allclose(rays.directions, expected, rtol=0, atol=16 * EPS)
        np.testing.assert_allclose(rays.origins, plain.origins @ axes.T + matrix[:3, 3], rtol=0, atol=16 * EPS * reach)


@pytest.mark.parametrize(("key", "point"), rows_of(UNSEEN))
def test_what_no_pixel_sees_has_none(key, point):
    assert np.isnan(camera(key).project(point)).all()


@each_example
def test_bounds_hold_all_that_is_seen_of_a_sphere(key, settings):
    cam = camera(key, settings)
    rng = np.random.default_rng(3)
    anywhere = rng.normal(size=(100, 3)) * 10 ** rng.uniform(-1, 2, size=(100, 1))
    centers = np.concatenate((anywhere, (points_between(cam, 100) - cam.pose.eye) @ np.linalg.inv(cam.pose.basis).T))
    radii = np.linalg.norm(centers, axis=1) * 10 ** rng.uniform(-3, 0.5, size=len(centers))
    on_sphere = rng.normal(size=(100, 3))
    on_sphere /= np.linalg.norm(on_sphere, axis=1, keepdims=True)
    local = centers[:, None] + radii[:, None, None] * on_sphere
    points = local @ cam.pose.basis.T + cam.pose.eye
    pixels = cam.project(points)
    rays = cam.rays_at(pixels[..., 0], pixels[..., 1])
    seen = on_frame(cam, pixels) & (((points - rays.origins) * rays.directions).sum(axis=-1) > 0)
    assert seen.any(axis=1).sum() > 10
    for bounds in (cam.model.bounds, partial(Model.bounds, cam.model)):  # its own, and those of any formula
        x0, x1, y0, y1 = bounds(centers, radii).T[:, :, None]
        inside = (x0 <= pixels[..., 0]) & (pixels[..., 0] <= x1) & (y0 <= pixels[..., 1]) & (pixels[..., 1] <= y1)
        assert inside[seen].all()


@pytest.mark.parametrize(("key", "refusal"), rows_of(REFUSED))
def test_settings_without_meaning_are_refused_by_name(key, refusal):
    settings, word = refusal
    with pytest.raises(InputError, match=word):
        camera(key, settings)


@pytest.mark.parametrize(
    ("settings", "word"),
    [
        ({"resolution_x": 40, "resolution_percentage": 2}, "no pixels"),
        (BORDER | {"border_max_x": 0.2}, "border"),
        ({"pixel_aspect_x": 0.0}, "pixel_aspect_x"),
        ({"shift_x": np.nan}, "shift_x"),
        ({"shift_y": np.inf}, "shift_y"),
        (BORDER | {"border_max_x": np.nan}, "border_max_x"),
        ({"clip_start": 5.0, "clip_end": 5.0}, "leave no range of depths"),
        ({"matrix_world": np.diag([1.0, 0.0, 1.0, 1.0])}, "scale of zero"),
        ({"matrix_world": np.diag([1.0, np.nan, 1.0, 1.0])}, "not finite"),
        ({"matrix_world": [[1, 1, 0, 0], [0, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}, "one plane"),
    ],
)
def test_what_no_camera_can_be_is_refused_by_name(settings, word):
    """Before a model is asked."""
    with pytest.raises(InputError, match=word) as caught:
        camera("PERSP", settings)
    assert "\n" not in str(caught.value)


def test_a_type_without_a_model_is_refused_with_those_that_have_one():
    with pytest.raises(InputError, match=", ".join(KEYS)):
        camera("TELEPATHY")


def test_the_lecture_writes_the_same_perspective_rays():
    """r = x u + aspect y v + d w over [-1, 1]^2 with d = 1 / tan(fov / 2)."""
    fov = 1.1
    cam = camera("PERSP", {"lens": 18 / np.tan(fov / 2), "matrix_world": TURNED})
    u, v, w = np.array(TURNED)[:3, :3].T * ((1,), (1,), (-1,))
    x, y = np.random.default_rng(5).uniform(-1, 1, size=(2, 100, 1))
    expected = x * u + 54 / 96 * y * v + w / np.tan(fov / 2)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    rays = cam.rays_at((x[:, 0] + 1) * 48, (y[:, 0] + 1) * 27)
    np.testing.assert_allclose(rays.directions, expected, rtol=0, atol=16 * EPS)


def test_the_lecture_writes_the_same_orthographic_rays():
    """Origin e + x size u + aspect y size v over [-1, 1]^2, direction w; size is half the orthographic scale."""
    cam = camera("ORTHO", {"ortho_scale": 6.0, "matrix_world": TURNED})
    matrix = np.array(TURNED)
    x, y = np.random.default_rng(6).uniform(-1, 1, size=(2, 100, 1))
    expected = matrix[:3, 3] + 3 * x * matrix[:3, 0] + 54 / 96 * 3 * y * matrix[:3, 1]
    rays = cam.rays_at((x[:, 0] + 1) * 48, (y[:, 0] + 1) * 27)
    np.testing.assert_allclose(rays.origins, expected, rtol=0, atol=16 * EPS * 10)
    np.testing.assert_allclose(rays.directions, np.broadcast_to(-matrix[:3, 2], (100, 3)), rtol=0, atol=4 * EPS)


def test_the_frame_is_truncated_and_the_border_rounded_to_float32():
    raster = camera("PERSP", {"resolution_x": 1001, "resolution_y": 667, "resolution_percentage": 33}).raster
    assert (raster.width, raster.height) == (330, 220)
    border = {"use_border": True, "border_min_x": 0.7, "resolution_x": 10, "resolution_y": 10}
    assert camera("PERSP", border).raster.x0 == 7  # 0.7 * 10 is 6.999999 in float64, 7 in float32


@each_model
@pytest.mark.parametrize("size", [(1, 1), (65536, 1), (3, 5000)])
def test_frames_of_any_size_have_their_rays(key, size):
    rays = camera(key, {"resolution_x": size[0], "resolution_y": size[1]}).rays()
    assert rays.valid.shape == size[::-1]
    assert rays.valid.any()
