"""Facts about cameras without one eye that no formula of theirs supplies: slits that are met, planes, tangents."""

import numpy as np
import pytest

from camera_ray_caster.core.cameras.general_linear import classify
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS

from ..casting.test_cast import random_shapes
from ..still import STILL, passes_of
from .example_frames import TURNED
from .model_examples import camera
from .multiperspective_examples import BEND, EXAMPLES, LEANING

LEVEL = {"slit_1": ((0.1, 0.2, 0.3), (1.1, 0.7, 0.3)), "slit_2": ((-0.3, 0.1, 1.5), (-0.2, 1.2, 1.5))}
"""Slits parallel to the image plane, askew in it."""


def in_world(points):
    """Points of the frame of a camera at TURNED, in the world."""
    return np.asarray(points) @ np.array(TURNED)[:3, :3].T + np.array(TURNED)[:3, 3]


def assert_meets(rays, first, second):
    """Every ray meets the line through two points: the gap between the two is rounding.

    Origins and lines are right to some EPS of their places; a direction turns them by its own over the way to the line.
    """
    along = np.subtract(second, first) / np.linalg.norm(np.subtract(second, first))
    beside = rays.origins[rays.valid] - first
    across = np.cross(rays.directions[rays.valid], along)
    sine = np.linalg.norm(across, axis=1)
    gap = np.abs((beside * across).sum(axis=1)) / sine
    reach = np.linalg.norm(beside, axis=1) + np.abs(first).max() + np.abs(rays.origins[rays.valid]).max()
    assert (gap <= 32 * EPS * reach / sine).all()


def corner_rays(cam):
    """The rays (s, t, u, v) of a camera at rest, at the frame's bottom left, bottom right and top left corners."""
    rays = cam.rays_at(np.array([0.0, cam.raster.width, 0.0]), np.array([0.0, 0.0, cam.raster.height]))
    slopes = rays.directions[:, :2] / -rays.directions[:, 2:]
    at_zero = rays.origins[:, :2] + slopes * rays.origins[:, 2:]
    return np.concatenate((at_zero, at_zero + slopes), axis=1)


def assert_same_rays(left, right, reach=1.0):
    """The same lines in the same directions, though their origins may lie elsewhere on them."""
    np.testing.assert_allclose(left.directions, right.directions, rtol=0, atol=32 * EPS)
    gap = np.cross(left.origins - right.origins, right.directions)
    assert np.abs(gap).max() <= 64 * EPS * reach


@pytest.mark.parametrize("slits", [LEVEL, LEANING], ids=["level", "leaning"])
def test_every_ray_of_a_cross_slit_meets_both_slits(slits):
    cam = camera("CROSS_SLIT", slits | {"lens": 12.0, "matrix_world": TURNED})
    for name in ("slit_1", "slit_2"):
        assert_meets(cam.rays(), *in_world(slits[name]))


@pytest.mark.parametrize("key", ["PUSHBROOM", "PENCIL"])
@pytest.mark.parametrize("slits", [LEVEL, LEANING], ids=["level", "leaning"])
def test_every_ray_with_an_eye_on_a_slit_meets_it(key, slits):
    rays = camera(key, slits | {"lens": 12.0, "matrix_world": TURNED}).rays()
    assert_meets(rays, *in_world(slits["slit_1"]))
    first, second = in_world(slits["slit_1"])
    along = (second - first) / np.linalg.norm(second - first)
    beside = np.cross(rays.origins - first, along)
    assert np.abs(beside).max() <= 32 * EPS * (np.abs(rays.origins).max() + np.abs(first).max())


@pytest.mark.parametrize(
    ("key", "kind"),
    [
        ("CROSS_SLIT", "cross-slit"),
        ("PUSHBROOM", "pushbroom"),
        ("PENCIL", "pencil"),
        ("TWISTED_ORTHOGRAPHIC", "twisted orthographic"),
        ("PERSP", "pinhole"),
        ("ORTHO", "orthographic"),
    ],
)
def test_a_general_linear_camera_has_all_rays_of_the_camera_that_three_are_from(key, kind):
    settings = LEVEL | {"shift_x": 0.2, "shift_y": -0.1, "lens": 20.0, "pencil_slide": 0.8, "twist": 0.3}
    named = camera(key, settings)
    three = corner_rays(named)
    assert classify(three) == kind
    general = camera("GENERAL_LINEAR", {f"ray_{k + 1}": tuple(ray) for k, ray in enumerate(three.tolist())})
    assert general.model.kind == kind
    assert_same_rays(general.rays(), named.rays(), np.abs(named.rays().origins).max() + 8)
    points = np.random.default_rng(1).normal(size=(200, 3)) * (3, 2, 1) - (0, 0, 9)
    assert np.abs(general.project(points) - named.project(points)).max() <= 1e-9


@pytest.mark.parametrize(
    ("kind", "three"),
    [
        ("pinhole", [(1, 2, 1, 2), (1, 2, 5, 2), (1, 2, 1, 9)]),
        ("pinhole", [(-3, 0, 0, 0), (0, 0, 1.5, 0), (0, 6, 1.5, 3)]),
        ("orthographic", [(0, 0, 1, 1), (2, 0, 3, 1), (0, 3, 1, 4)]),
        ("pushbroom", [(0, 0, 0, 0), (1, 0, 1, 0), (0, 0, 0, 1)]),
        ("cross-slit", [(0, 0, 0, 0), (0, 0, 1, 0), (0, 1, 0, 1.5)]),
        ("pencil", [(0, 0, 0, 0), (0, 0, 1, 0), (1, 0, 1, 1)]),
        ("twisted orthographic", [(0, 0, 0, 0), (1, 0, 1, 1), (0, 1, 0, 1)]),
        ("bilinear", [(0, 0, 0, 0), (1, 0, 1, 1), (0, 1, -1, 1)]),
        ("EPI", [(0, 0, 0, 0), (1, 0, 3, 0), (0, 0, 1, 0)]),
    ],
)
@pytest.mark.parametrize("stored", [np.float64, np.float32])
def test_three_rays_tell_their_kind(kind, three, stored):
    turn = np.array([[0.8, -0.6], [0.6, 0.8]])
    for scale in (1.0, 1e-3, 1e3):
        points = np.array(three).reshape(3, 2, 2) @ turn.T * scale
        assert classify(points.reshape(3, 4).astype(stored).astype(float)) == kind


def test_rays_in_one_plane_see_no_point_beside_it():
    cam = camera("GENERAL_LINEAR", {"ray_1": (0, 0, 0, 0), "ray_2": (1, 0, 3, 0), "ray_3": (0, 0, 1, 0)})
    assert cam.rays().valid.all()
    assert np.isnan(cam.project([(0.3, 0.1, -2), (0, 0, -1), (1, -5, -9)])).all()


def test_a_pushbroom_is_perspective_across_and_orthographic_along():
    cam = camera("PUSHBROOM", {"slit_1": ((0, 0.5, 0), (3, 0.5, 0)), "ortho_scale": 8.0, "lens": 18.0})
    along, across = cam.project([(x, 1.5, -d) for d in (1, 2, 4, 8) for x in (-1, 0, 3)]).reshape(4, 3, 2).T
    assert along == pytest.approx(np.tile([[36.0], [48], [84]], 4), abs=1e-11)  # 12 pixels a unit, at any depth
    assert across - 27 == pytest.approx(np.tile([48.0, 24, 12, 6], (3, 1)), abs=1e-11)  # halved at twice the depth


def test_rays_of_a_pencil_in_one_plane_through_the_slit_meet_in_one_point_of_it():
    cam = camera("PENCIL", {"slit_1": ((0, 0, 1), (1, 0, 1)), "pencil_slide": 2.0})
    rays = cam.rays()
    eyes = rays.origins[:, 0]
    assert np.array_equal(rays.origins, np.broadcast_to(eyes[:, None], rays.origins.shape))
    assert (np.diff(eyes[:, 0]) > 0).all()  # and those of another plane in another
    normals = np.cross(rays.directions, (1.0, 0, 0))
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    assert np.abs(normals - normals[:, :1]).max() <= 8 * EPS


def test_a_pencil_that_does_not_slide_is_the_pinhole_at_the_point():
    pose = np.array(TURNED)
    pose[:3, 3] = in_world(LEANING["slit_1"][0])
    pinhole = camera("PERSP", {"matrix_world": pose}).rays()
    assert_same_rays(camera("PENCIL", LEANING | {"pencil_slide": 0.0, "matrix_world": TURNED}).rays(), pinhole, 10)


@pytest.mark.parametrize("slide", [0.0, 1.0])
def test_a_pencil_sees_no_point_in_the_plane_of_its_slit_and_the_direction_across(slide):
    """There m is infinite: no ray, and no warning about it."""
    model = camera("PENCIL", {"slit_1": ((0, 0, 0), (1, 0, 0)), "pencil_slide": slide}).model
    with np.errstate(all="raise"):
        assert np.isnan(model.project([(0.0, 2.0, 0.0), (0.5, -1.0, 0.0), (3.0, 0.0, 0.0)])).all()


def test_slits_that_cross_make_the_pinhole_where_they_do():
    slits = {"slit_1": ((-1, 0, 0), (1, 0, 0)), "slit_2": ((0, -1, 0), (0, 1, 0))}
    assert_same_rays(camera("CROSS_SLIT", slits).rays(), camera("PERSP").rays())


def test_rays_of_a_twisted_orthographic_camera_fill_parallel_planes_and_never_meet():
    settings = {"slit_1": ((1, 0, 0), (1, 5, 0)), "twist": 0.5, "ortho_scale": 8.0}
    rays = camera("TWISTED_ORTHOGRAPHIC", settings).rays()
    assert np.abs(rays.directions[..., 1]).max() <= EPS  # planes of constant y, in each of them one direction
    assert np.abs(rays.directions - rays.directions[:, :1]).max() == 0
    slope = -rays.directions[:, 0, 0] / rays.directions[:, 0, 2]
    assert slope == pytest.approx(-0.5 * rays.origins[:, 0, 1], rel=8 * EPS)  # across is a quarter turn left of up
    assert len(np.unique(slope)) == 54
    assert_same_rays(camera("TWISTED_ORTHOGRAPHIC", settings | {"twist": 0.0}).rays(), camera("ORTHO", settings).rays())


@pytest.mark.parametrize("follow", [False, True])
def test_a_strip_along_a_straight_path_is_the_pushbroom(follow):
    path = ((-3, 0.2, 0.4), (-1, 0.2, 0.4), (0, 0.2, 0.4), (3, 0.2, 0.4))
    frame = {"lens": 24.0, "matrix_world": TURNED}
    strip = camera("STRIP", frame | {"path": path, "follow_path": follow})
    broom = camera("PUSHBROOM", frame | {"slit_1": path[:2], "ortho_scale": 6.0})
    assert_same_rays(strip.rays(), broom.rays(), 20)
    np.testing.assert_allclose(strip.rays().origins, broom.rays().origins, rtol=0, atol=64 * EPS * 10)
    points = in_world(np.random.default_rng(2).uniform((-2.9, -5, -9), (2.9, 5, -1), (300, 3)))
    assert np.abs(strip.project(points) - broom.project(points)).max() <= 1e-9


def test_a_strip_around_a_point_looks_inwards_when_it_goes_to_the_left():
    angle = np.linspace(0, 2 * np.pi, 721)
    path = np.stack((np.sin(angle), 0 * angle, np.cos(angle)), axis=1)
    rays = camera("STRIP", {"path": path, "follow_path": True}).rays()
    ahead = rays.directions[26] + rays.directions[27]  # the rows beside the middle one: their sum is level
    turned = np.cross(ahead, -rays.origins[27]) / np.linalg.norm(ahead, axis=1, keepdims=True)
    assert np.abs(turned).max() <= 1e-5  # the chord's own sagitta: (2 pi / 720)^2 / 8
    assert ((ahead * rays.origins[27]).sum(axis=1) < 0).all()


def test_a_strip_around_a_point_has_what_is_beyond_in_few_columns():
    """Columns with their backs to it do not count."""
    angle = np.linspace(0, 2 * np.pi, 129)
    path = np.stack((np.sin(angle), 0 * angle, np.cos(angle)), axis=1)
    around, away = np.random.default_rng(3).uniform((-3, 3), (3, 9), (500, 2)).T
    centers = np.stack((away * np.sin(around), 0 * around, away * np.cos(around)), axis=1)
    bounds = camera("STRIP", {"path": path, "follow_path": True}).model.bounds(centers, np.full(500, 0.01))
    column = 48 + 96 * around / (2 * np.pi)  # straight across the circle
    assert (bounds[:, 1] - bounds[:, 0] <= 3).all()
    assert ((bounds[:, 0] <= column) & (column <= bounds[:, 1])).all()


@pytest.mark.parametrize("eye", ["LEFT", "RIGHT"])
def test_omnistereo_rays_are_tangents_of_the_circle(eye):
    rays = camera("OMNIDIRECTIONAL_STEREO", {"eye": eye, "interocular_distance": 0.5}).rays()
    assert np.linalg.norm(rays.origins, axis=-1) == pytest.approx(np.full((54, 96), 0.25), rel=4 * EPS)
    assert not rays.origins[..., 1].any()
    assert np.abs((rays.origins * rays.directions).sum(axis=-1)).max() <= 4 * EPS
    # the left eye is on the left of where it looks
    left_of = np.cross((0.0, 1.0, 0.0), rays.directions)
    assert (((rays.origins * left_of).sum(axis=-1) > 0) == (eye == "LEFT")).all()


@pytest.mark.parametrize("eye", ["LEFT", "RIGHT"])
def test_omnistereo_is_spherical_stereo_without_convergence_and_pole_merge(eye):
    """Blender's: e = -+ distance / 2, side = normalize(D x up), origin + e side."""
    rays = camera("OMNIDIRECTIONAL_STEREO", {"eye": eye, "interocular_distance": 0.5}).rays()
    mono = camera("EQUIRECTANGULAR").rays()
    np.testing.assert_allclose(rays.directions, mono.directions, rtol=0, atol=4 * EPS)
    side = np.cross(mono.directions, (0.0, 1.0, 0.0))
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    expected = {"LEFT": -0.25, "RIGHT": 0.25}[eye] * side
    np.testing.assert_allclose(rays.origins, expected, rtol=0, atol=64 * EPS)  # side loses digits towards the poles


def test_disparity_of_omnistereo_is_what_the_triangle_says():
    pixels = {eye: {"eye": eye, "interocular_distance": 0.5} for eye in ("LEFT", "RIGHT")}
    for distance in (0.3, 1.0, 7.0):
        point = distance * np.sin(0.7), 0.0, -distance * np.cos(0.7)
        left, right = (camera("OMNIDIRECTIONAL_STEREO", settings).project(point) for settings in pixels.values())
        assert (left - right)[0] == pytest.approx(2 * np.arcsin(0.25 / distance) * 96 / (2 * np.pi), rel=1e-12)
        assert (left + right)[0] / 2 == pytest.approx(48 + 0.7 * 96 / (2 * np.pi), rel=1e-12)


def test_omnistereo_of_one_eye_is_the_equirectangular_panorama():
    flat, mono = camera("OMNIDIRECTIONAL_STEREO", {"interocular_distance": 0.0}), camera("EQUIRECTANGULAR")
    np.testing.assert_allclose(flat.rays().directions, mono.rays().directions, rtol=0, atol=4 * EPS)
    assert not flat.rays().origins.any()
    points = np.random.default_rng(4).normal(size=(200, 3))
    np.testing.assert_allclose(flat.project(points), mono.project(points), rtol=0, atol=1e-12)


@pytest.mark.parametrize("layout", ["TOP_BOTTOM", "SIDE_BY_SIDE"])
def test_both_eyes_share_the_frame(layout):
    both = camera("OMNIDIRECTIONAL_STEREO", {"eye": layout, "interocular_distance": 0.5, "matrix_world": TURNED})
    half = {"resolution_y": 27} if layout == "TOP_BOTTOM" else {"resolution_x": 48}
    frame = {"interocular_distance": 0.5, "matrix_world": TURNED} | half
    left, right = (camera("OMNIDIRECTIONAL_STEREO", frame | {"eye": eye}) for eye in ("LEFT", "RIGHT"))
    rays = [left.rays(), right.rays()]
    axis = 0 if layout == "TOP_BOTTOM" else 1
    order = rays[::-1] if layout == "TOP_BOTTOM" else rays  # row 0 is the bottom one
    for name in ("origins", "directions"):
        stacked = np.concatenate([getattr(vectors, name) for vectors in order], axis=axis)
        np.testing.assert_allclose(getattr(both.rays(), name), stacked, rtol=0, atol=4 * EPS * 10)
    points = np.random.default_rng(5).normal(size=(100, 3)) * 4 + np.array(TURNED)[:3, 3]
    expected = left.project(points) + ((0, 27) if layout == "TOP_BOTTOM" else (0, 0))
    np.testing.assert_allclose(both.project(points), expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("key", EXAMPLES)
def test_culling_changes_no_bit_and_leaves_something_out(key):
    settings = [*EXAMPLES[key], {"eye": "SIDE_BY_SIDE"}, {"eye": "TOP_BOTTOM"}, {"path": BEND, "follow_path": True}]
    unseen = hit = 0
    for seed, row in enumerate(settings):
        cam = camera(key, row)
        shapes = random_shapes(np.random.default_rng(seed), 40)
        passes = passes_of(cam.model, STILL)
        culled, unculled = (cast(cam, shapes, passes=passes, dtype=np.float64, cull=cull) for cull in (True, False))
        for name in passes:
            assert np.array_equal(culled[name], unculled[name]), (row, name)
        hit += (culled["shape_index"] >= 0).any()
        unseen += culled.plan.unseen
    assert hit >= len(settings) - 2
    assert unseen > 0 or key == "OMNIDIRECTIONAL_STEREO"  # which looks everywhere


@pytest.mark.parametrize("key", EXAMPLES)
def test_a_small_sphere_covers_a_small_part_of_the_picture(key):
    cam = camera(key, {"resolution_x": 960, "resolution_y": 540})
    x, y = np.random.default_rng(6).uniform((100, 100), (860, 440), (100, 2)).T
    rays = cam.rays_at(x, y)
    bounds = cam.model.bounds(rays.origins + 5 * rays.directions, np.full(100, 1e-4))
    wide, high = bounds[:, 1] - bounds[:, 0], bounds[:, 3] - bounds[:, 2]
    pieces = key == "STRIP"  # it is looked at in 64 parts of the path
    assert (wide <= (2 + 960 / 64 if pieces else 3)).all()
    assert (high <= (5 if pieces else 3)).all()
