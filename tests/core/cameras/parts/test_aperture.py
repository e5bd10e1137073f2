"""Thin lens and camera obscura: where a blurred point's light falls, by similar triangles."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.camera.sampling import in_opening, sub_pixel
from camera_ray_caster.core.cameras.parts.aperture import Aperture
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import PLANE, SPHERE, BlenderCamera, InputError, Shapes

from ..model_examples import camera as example

LENS = {
    "use_dof": True, "focus_distance": 4.0, "focus_position": None, "aperture_fstop": 0.5, "aperture_blades": 0,
    "aperture_rotation": 0.0, "aperture_ratio": 1.0,
}  # fmt: skip
BOX = {"obscura_depth": 2.0, "obscura_width": 3.0, "obscura_hole": 0.1}


def camera(settings=None, **raw):
    """A small square camera along -Z."""
    raw = {"type": "PERSP", "resolution_x": 65, "resolution_y": 65, "clip_end": 1e4} | raw
    return camera_from(BlenderCamera("Camera", matrix_world=np.eye(4), settings=settings or {}, **raw))


def glowing(center, radius):
    """One sphere that is white from wherever it is lit, in front of black."""
    ones = np.ones(1, np.int32)
    color = np.ones((1, 4), np.float32)
    return Shapes(np.array([SPHERE], np.uint8), np.array([center], float), np.eye(3)[None] * radius, ones, ones, color,
                  ones * 0, ("sphere",))  # fmt: skip


def edges_of_opening(camera, x, y):
    """Rays through pixel (x, y) and 64 points on the opening's edge, as points and directions (64, 3)."""
    turn = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    edge = camera.aperture.radius * np.cos(turn), camera.aperture.radius * np.sin(turn)
    origin, direction = camera.model.rays(np.full(64, x), np.full(64, y))
    rays = camera.aperture.through(origin, direction, camera.model.planar, *edge)
    return (np.stack(np.broadcast_arrays(*vectors), axis=-1) for vectors in rays)


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_planar_cameras_are_sharp_on_the_plane_of_focus(kind):
    origins, directions = edges_of_opening(camera(LENS, type=kind), 50.0, 11.0)
    at_focus = origins + 4.0 * directions
    assert np.ptp(at_focus, axis=0).max() < 1e-14
    assert np.ptp(origins, axis=0)[:2] == pytest.approx(
        [0.1, 0.1] if kind == "PERSP" else [2.0, 2.0], rel=1e-9
    )  # 50 mm at f/0.5 opens 10 cm; an orthographic lens 1 / fstop


def test_a_tilted_sensor_tilts_the_plane_of_focus():
    """By the thin lens: 50 mm, 65 pixels of 0.45 mm; a point (x, y) of the sensor, y down, is farther from the lens by
    the third row of the transpose of OpenCV's rotation. If K's image plane is at the sensor's distance, all points of
    focus are on one plane.
    """
    far = 1 / (1 / 50 - 1 / 3000)
    for focal in (111.0, far / 0.45):
        settings = {"fx": focal, "fy": focal, "cx": 32.0, "cy": 32.0, "calibration_width": 65, "calibration_height": 65,
                    "tau_x": 0.2, "tau_y": -0.1, "focus_distance": 3.0}  # fmt: skip
        size = {"resolution_x": 65, "resolution_y": 65, "sensor_width": 29.25}
        cam = example("OPENCV_PINHOLE", LENS | settings | size)
        depths = []
        for x, y in ((32.5, 32.5), (32.5, 20.5), (50.5, 14.5), (20.5, 60.5)):
            across, down = 0.45 * (x - 32.5), 0.45 * (32.5 - y)
            distance = far + np.sin(0.2) * down - np.sin(-0.1) * np.cos(0.2) * across
            origins, directions = edges_of_opening(cam, x, y)
            meet = origins + directions / (1 / 50 - 1 / distance) / 1000
            assert np.ptp(meet, axis=0).max() < 1e-9
            depths.append(meet[0])
        assert depths[0] == pytest.approx((0, 0, -3), abs=1e-12)
    corners = np.array(depths) - depths[0]
    assert abs(np.linalg.det(corners[1:])) < 1e-9


def test_panoramas_are_sharp_on_the_sphere_of_focus():
    settings = LENS | {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 3.0}
    origins, directions = edges_of_opening(camera(settings, type="PANO"), 50.0, 20.0)
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(64), rel=1e-15)
    chief = camera(settings, type="PANO").rays_at(50.0, 20.0).directions
    to_focus = 4.0 * chief - origins
    assert np.linalg.norm(np.cross(to_focus, directions), axis=1).max() < 1e-14
    assert np.abs(origins @ chief).max() < 1e-16


def test_focus_object_counts_by_its_depth():
    turned = LENS | {"focus_position": np.array([3.0, -1.0, -7.0])}
    assert camera(turned).aperture.focus == 7.0
    assert camera(LENS | {"use_dof": False}).aperture is None
    assert camera(LENS | {"aperture_fstop": 0.0, "focus_distance": 0.0}).aperture.focus == 1e-5


def test_the_opening_is_filled_evenly():
    k = np.arange(20000)
    u, v = (k * 0.7548776662466927) % 1, (k * 0.5698402909980532) % 1
    x, y = Aperture(2.0, 1.0).points(u, v)
    assert np.hypot(x, y).max() <= 2.0
    assert np.mean(np.hypot(x, y) < 1.0) == pytest.approx(0.25, abs=0.005)  # area of half the radius
    x, y = Aperture(1.0, 1.0, blades=6).points(u, v)
    apothem = np.cos(np.pi / 6)
    sides = np.arange(6) * np.pi / 3
    reach = x[:, None] * np.cos(sides) + y[:, None] * np.sin(sides)
    assert reach.max() == pytest.approx(apothem, abs=1e-3)
    assert np.mean(reach.max(axis=1) < apothem / 2) == pytest.approx(0.25, abs=0.005)
    wide = Aperture(1.0, 1.0, ratio=0.5).points(u, v)
    assert np.ptp(wide[0]) == pytest.approx(2 * np.ptp(wide[1]), rel=1e-2)


def test_samples_spread_over_pixel_and_opening():
    offsets = np.array([sub_pixel(k) for k in range(256)])
    assert np.abs(offsets).max() <= 0.5
    assert np.histogram2d(*offsets.T, bins=4, range=[[-0.5, 0.5]] * 2)[0] == pytest.approx(np.full((4, 4), 16), abs=3)
    x, y = np.arange(64)[None] + 0.5, np.arange(64)[:, None] + 0.5
    u, v = in_opening(0, x, y)
    assert abs(np.corrcoef(u.ravel(), v.ravel())[0, 1]) < 0.05
    assert np.histogram(u, bins=8, range=(0, 1))[0] == pytest.approx(np.full(8, 512), rel=0.15)


def test_the_box_turns_the_picture_by_half_a_turn():
    box = camera(BOX, model="CAMERA_OBSCURA")
    wall = camera(type="PERSP", lens=24.0, sensor_width=36.0)  # 24 mm before 36 mm is 2 behind 3
    assert np.allclose(box.rays().directions, wall.rays().directions[::-1, ::-1], atol=1e-15)
    assert box.project(np.array([0.5, 0.25, -4.0])) == pytest.approx([65 / 2 - 65 / 3 * 0.25, 65 / 2 - 65 / 3 * 0.125])


@pytest.mark.parametrize("distance", [1.0, 4.0, 1e9])
def test_a_point_is_blurred_to_the_hole_as_seen_from_it(distance):
    """Similar triangles: the light of a point at distance s through a hole h falls on h (1 + depth / s) of the wall."""
    box = camera(BOX, model="CAMERA_OBSCURA")
    pitch = 3.0 / 65
    # light from the point through the hole's edge reaches the wall here; that wall point's ray meets the point again
    lit = 0.05 * (1 + 2.0 / distance)
    pixel = 65 / 2 + lit / pitch
    origins, directions = edges_of_opening(box, pixel, 65 / 2)
    meets = origins + distance * directions
    assert np.hypot(meets[:, 0], meets[:, 1]).min() <= 1e-15 * distance + 1e-15
    beyond, away = edges_of_opening(box, 65 / 2 + 1.01 * lit / pitch, 65 / 2)
    assert np.hypot(*(beyond + distance * away)[:, :2].T).min() > 1e-4


def test_the_blur_shrinks_with_the_hole_to_the_pinhole_picture():
    """The blurred edge of a wall is as wide as the hole's image: its light spills in proportion to the hole."""
    scene = replace(glowing((0, 0, -6), 2.0), kind=np.array([PLANE], np.uint8))
    sharp = cast(camera(BOX | {"obscura_hole": 1e-9}, model="CAMERA_OBSCURA"), scene, passes=("combined",), samples=64)
    errors = []
    for hole in (0.4, 0.2, 0.1):
        box = camera(BOX | {"obscura_hole": hole}, model="CAMERA_OBSCURA")
        blurred = cast(box, scene, passes=("combined",), samples=64)["combined"]
        errors.append(float(np.abs(blurred - sharp["combined"])[..., 0].mean()))
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert rates == pytest.approx([1.0, 1.0], abs=0.25)  # first order: a band of width h around the edge


def test_samples_of_a_sharp_camera_only_smooth_its_edges():
    scene = glowing((0, 0, -6), 1.0)
    single, many = (cast(camera(lens=50.0), scene, passes=("combined", "depth"), samples=n) for n in (1, 16))
    assert np.array_equal(single["depth"], many["depth"])
    inside = np.isfinite(single["depth"])
    grown = inside | np.roll(inside, 1, 0) | np.roll(inside, -1, 0) | np.roll(inside, 1, 1) | np.roll(inside, -1, 1)
    assert np.array_equal(many["combined"][~grown][:, 0], np.zeros(np.count_nonzero(~grown), np.float32))
    assert ((many["combined"][..., 0] > 0) & (many["combined"][..., 0] < 0.2)).any()


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO", "PANO", "TILTED"])
def test_culling_loses_nothing_that_a_blurred_camera_sees(kind):
    rng = np.random.default_rng(3)
    n = 30
    center = rng.uniform(-3, 3, (n, 3)) - (0, 0, 4)
    ones = np.ones(n, np.int32)
    scene = Shapes(np.zeros(n, np.uint8), center, np.eye(3) * rng.uniform(0.05, 0.4, (n, 1, 1)), ones, ones,
                   rng.uniform(0, 1, (n, 4)).astype(np.float32), ones * 0, ("s",))  # fmt: skip
    settings = LENS | {"panorama_type": "EQUIRECTANGULAR", "longitude_min": -2.0, "longitude_max": 2.0,
                       "latitude_min": -1.0, "latitude_max": 1.0, "aperture_fstop": 0.08}  # fmt: skip
    if kind == "TILTED":
        tilted = {"resolution_x": 65, "resolution_y": 65, "fx": 50.0, "fy": 50.0, "tau_x": 0.2, "clip_start": 0.01}
        blurred = example("OPENCV_PINHOLE", settings | tilted)
    else:
        blurred = camera(settings, type=kind, clip_start=0.01)
    pictures = [cast(blurred, scene, passes=("combined",), samples=4, cull=cull)["combined"] for cull in (True, False)]
    assert np.array_equal(*pictures)


@pytest.mark.parametrize(
    ("name", "value"), [("obscura_hole", 0.0), ("obscura_depth", -1.0), ("obscura_width", float("nan"))]
)
def test_a_box_without_meaning_is_refused_by_name(name, value):
    with pytest.raises(InputError, match=f"{name}.*{value:g}.*or more"):
        camera(BOX | {name: value}, model="CAMERA_OBSCURA")


def test_bad_aperture_and_samples_are_refused():
    with pytest.raises(InputError, match="aperture_ratio"):
        camera(LENS | {"aperture_ratio": 0.0})
    with pytest.raises(InputError, match="samples is 0"):
        cast(camera(), glowing((0, 0, -5), 1.0), passes=("combined",), samples=0)
