"""Cameras behind glass. Snell's law with 60 digits is in truth.ports, and the contract's tests hold rays against it."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.behind_port import BehindPort, takes_port
from camera_ray_caster.core.cameras.parts.port import DomePort, FlatPort
from camera_ray_caster.core.casting.pixel_bounds import CameraPixelBounds
from camera_ray_caster.core.conventions import EPS

from ..truth import truth
from ..truth.ports import behind
from .model_examples import IN_DOME, IN_TANK, raw_of

SIZE = 640, 480
EYE = 0.0, 0.0, 0.0
AHEAD = 0.0, 0.0, -1.0


def unit_directions(count=200, seed=1):
    directions = np.random.default_rng(seed).normal(size=(3, count))
    directions[2] = -np.abs(directions[2]) - 0.1
    return directions / np.linalg.norm(directions, axis=0)


@pytest.mark.parametrize("model", [model for model in MODELS if takes_port(model)], ids=lambda model: model.key)
def test_air_gives_the_bits_of_every_model_alone(model):
    tables = {"RAY_TABLE": {"ray_directions": crc.camera("PERSP", (8, 6)).rays().directions}}
    settings = tables.get(model.key, {})
    alone = crc.camera(model.key, SIZE, **settings)
    air = crc.camera(model.key, SIZE, port="FLAT", port_distance=0.0, port_glass=1.0, port_medium=1.0, **settings)
    np.testing.assert_array_equal(air.rays().directions, alone.rays().directions)
    np.testing.assert_array_equal(air.rays().origins, alone.rays().origins)


@pytest.mark.parametrize(
    "port", [FlatPort((0.6, 0.0, -0.8), 0.05, 0.01, 1.0, 1.0), DomePort((0.01, 0.0, 0.03), 0.1, 0.02, 1.0, 1.0)]
)
def test_an_index_of_1_bends_nothing(port):
    directions = unit_directions()
    origin, bent = port.bent(EYE, directions)
    passes = ~np.isnan(bent[0])
    assert passes.sum() > 100
    np.testing.assert_allclose(np.array(bent)[:, passes], directions[:, passes], rtol=0, atol=32 * EPS)
    beside = np.cross(np.array(origin)[:, passes], directions[:, passes], axis=0)
    assert np.abs(beside).max() <= 64 * EPS


def test_a_plate_without_thickness_is_one_surface_and_a_plate_in_air_only_shifts():
    directions = unit_directions()
    water = np.array(FlatPort(AHEAD, 0.1, 0.0, 1.7, 1.333).bent(EYE, directions)[1])
    sines = np.hypot(*directions[:2]), np.hypot(*water[:2])
    np.testing.assert_allclose(sines[0], 1.333 * sines[1], rtol=0, atol=8 * EPS)
    in_air = FlatPort(AHEAD, 0.1, 0.02, 1.5, 1.0).bent(EYE, directions)[1]
    np.testing.assert_allclose(in_air, directions, rtol=0, atol=8 * EPS)


def test_a_dome_around_the_eye_turns_no_ray():
    directions = unit_directions()
    origin, bent = DomePort(EYE, 0.09, 0.01, 1.49, 1.333).bent(EYE, directions)
    np.testing.assert_allclose(bent, directions, rtol=0, atol=8 * EPS)
    np.testing.assert_allclose(origin, 0.1 * directions, rtol=0, atol=EPS)


@pytest.mark.parametrize("seed", range(6))
def test_a_point_has_its_pixel_again(seed):
    """From 1 mm to 1 km behind glass of any kind; a plate at the eye is left out: see below."""
    rng = np.random.default_rng(seed)
    indices = {"port_glass": rng.uniform(1, 2), "port_medium": rng.uniform(1, 2), "port_thickness": rng.uniform(0, 30)}
    indices["port_inside"] = (1.0, rng.uniform(1, 2))[seed % 2]
    tilt_x, tilt_y = rng.uniform(-0.7, 0.7, 2)
    flat = {"port": "FLAT", "port_distance": 10 ** rng.uniform(0, 3), "port_tilt_x": tilt_x, "port_tilt_y": tilt_y}
    dome = {"port": "DOME", "port_radius": 100.0, "port_decenter": tuple(rng.uniform(-1, 1, 3) * (39, 14)[seed % 2])}
    for port in (flat, dome):
        for model, settings in (("PERSP", {"lens": 18.0}), ("OPENCV_FISHEYE", {"fx": 250.0, "k1": 0.02})):
            cam = crc.camera(model, (160, 120), **settings, **port, **indices)
            rays = cam.rays()
            x, y = np.meshgrid(np.arange(160) + 0.5, np.arange(120) + 0.5)
            points = rays.origins + 10 ** rng.uniform(-3, 3, x.shape)[..., None] * rays.directions
            off = np.hypot(*np.moveaxis(cam.project(points) - np.stack((x, y), axis=-1), -1, 0))
            assert (np.isfinite(off) == rays.valid).all()
            assert np.nanmax(off) <= 1e-9


def test_what_is_before_the_glass_and_beyond_the_last_ray_has_no_pixel():
    """Water that a lens at the plate sees ends at the angle of total reflection."""
    tank = crc.camera("PERSP", SIZE, lens=5.0, port="FLAT", port_distance=50.0, port_thickness=10.0)
    assert np.isnan(tank.project([(0.0, 0.0, -0.059), (0.0, 0.0, 0.1)])).all()
    assert not np.isnan(tank.project((0.0, 0.0, -0.061))).any()
    at_eye = {"port": "FLAT", "port_distance": 0.0, "port_thickness": 0.0, "port_medium": 1.333}
    fisheye = crc.camera("FISHEYE_EQUIDISTANT", SIZE, fisheye_fov=np.pi, **at_eye)
    critical = np.arcsin(1 / 1.333)
    for angle, seen in ((critical - 1e-6, True), (critical + 1e-6, False)):
        assert np.isfinite(fisheye.project((np.sin(angle), 0.0, -np.cos(angle)))).all() == seen
    behind_plate = crc.camera("EQUIRECTANGULAR", (64, 32), port="FLAT").rays().valid
    assert behind_plate.mean() == 0.5  # the half before it


def test_a_plate_reflects_beyond_the_critical_angle_and_equal_indices_bend_nothing():
    """From oil into air by Snell's law, at the middle row of an equidistant fisheye."""
    oil = {"port": "FLAT", "port_inside": 1.5, "port_medium": 1.0, "port_thickness": 0.0, "port_distance": 50.0}
    cam = crc.camera("FISHEYE_EQUIDISTANT", (400, 400), fisheye_fov=2.0, **oil)
    critical = np.arcsin(1 / 1.5)
    angles = np.array((0.3, critical - 1e-6, critical + 1e-6))
    rays = cam.rays_at(200 + 200 * angles, np.full(3, 200.0))
    assert list(rays.valid) == [True, True, False]
    np.testing.assert_allclose(rays.directions[:2, 0], 1.5 * np.sin(angles[:2]), rtol=0, atol=1e-15)
    assert "more than 41.81 degrees from its normal" in cam.model.remark(cam.record)
    image = crc.cast(cam, crc.spheres([(0.0, 0.0, 0.0)], 9.0), passes=("shape_index",))["shape_index"]
    seen = np.hypot(*(np.mgrid[:400, :400] + 0.5 - 200)) < 200 * critical
    np.testing.assert_array_equal(image >= 0, seen)
    same = crc.camera("PERSP", SIZE, port="DOME", port_inside=1.4, port_glass=1.4, port_medium=1.4)
    assert not isinstance(same.model, BehindPort)


def test_rays_of_a_lens_s_aperture_are_refracted_too():
    raw = raw_of("PERSP", IN_TANK | {"use_dof": True, "focus_distance": 2.0, "aperture_fstop": 1.4})
    cam = crc.camera("PERSP", (96, 54), use_dof=True, focus_distance=2.0, aperture_fstop=1.4, **IN_TANK)
    x, y, point = 20.5, 31.5, (0.004, -0.003)
    origin, direction = cam.model.through(cam.aperture, None, x, y, point)
    in_air = cam.model.lens.rays(x, y)[1]
    focus = [2.0 * float(number) for number in in_air]
    lens = [point[0], point[1], 0.0]
    exact = behind(raw, (truth.exact(lens), truth.exact([f - o for f, o in zip(focus, lens, strict=True)])))
    np.testing.assert_allclose(np.array(origin, float), np.array(exact[0], float), rtol=0, atol=8 * EPS)
    np.testing.assert_allclose(np.array(direction, float), np.array(exact[1], float), rtol=0, atol=8 * EPS)


@pytest.mark.parametrize("port", [IN_TANK, IN_DOME])
def test_a_picture_is_that_of_its_rays(port):
    """Bounds cull nothing."""
    shapes = crc.spheres(np.random.default_rng(2).uniform((-2, -2, -4), (2, 2, 1), (60, 3)), 0.15)
    cam = crc.camera("PERSP", (96, 64), lens=16.0, **port)
    rays = cam.rays()
    images = crc.cast(cam, shapes, passes=("shape_index", "distance"))
    alone = crc.cast_rays(rays.origins, rays.directions, shapes, passes=("shape_index", "distance"))
    assert (images["shape_index"] >= 0).mean() > 0.05
    np.testing.assert_array_equal(images["shape_index"], alone["shape_index"])


def test_a_pinhole_in_a_fish_tank_is_far_off_and_a_fit_is_not():
    """A point seen 1 m behind 10 mm of acrylic, by hand, at the edge of a 24 mm lens's picture."""
    water = crc.camera("PERSP", (1920, 1080), lens=24.0, port="FLAT")
    pinhole = crc.camera("PERSP", (1920, 1080), lens=24.0)
    ray = water.rays_at(1919.5, 540.0)
    off = np.linalg.norm(pinhole.project(ray.origins + ray.directions) - (1919.5, 540.0))
    edge = 959.5 * 36 / 1920 / 24
    sine = np.sin(np.arctan(edge))
    across = 0.05 * edge + 0.01 * np.tan(np.arcsin(sine / 1.49)) + sine / 1.333
    seen = 960 + across / (0.06 + np.cos(np.arcsin(sine / 1.333))) * 24 * 1920 / 36
    assert off == pytest.approx(1919.5 - seen, abs=1e-9)
    assert off > 250
    fit = crc.fit(crc.camera("PERSP", (96, 54), lens=24.0, port="FLAT", focus_distance=1.0), "OPENCV_PINHOLE")
    assert fit.camera.settings.get("port") is None
    assert fit.worst < 0.01


@pytest.mark.parametrize(
    ("model", "settings", "message"),
    [
        ("PERSP", {"port": "FLAT", "port_glass": 0.9}, "port_glass of camera 'Camera' is 0.9: it must be from 1 to 10"),
        ("PERSP", {"port": "FLAT", "port_medium": np.nan}, "port_medium .* is nan"),
        ("PERSP", {"port": "FLAT", "port_tilt_x": 1.6}, "port_tilt_x .* 91.6732 degrees"),
        ("PERSP", {"port": "FLAT", "port_thickness": -1.0}, "port_thickness .* 0 or more"),
        ("PERSP", {"port": "DOME", "port_thickness": 100.0}, "port_thickness .* below port_radius, 100"),
        ("PERSP", {"port": "DOME", "port_decenter": (0.0, 0.0, 95.0)}, "port_decenter .* below 90, the inner radius"),
        (
            "PERSP",
            {"port": "DOME", "port_inside": 1.5, "port_glass": 1.5, "port_medium": 1.0, "port_decenter": (0, 0, 47.0)},
            "port_decenter .* below 46.6667, so that no light is totally reflected",
        ),
        ("PERSP", {"port": "FLAT", "port_radius": 50.0}, "port_radius of PERSP has no effect unless port is 'DOME'"),
        ("PERSP", {"port_distance": 50.0}, "port_distance of PERSP has no effect unless port is 'FLAT'"),
        ("PERSP", {"port": "PLATE"}, "unknown port 'PLATE'"),
        ("ORTHO", {"port": "FLAT"}, "Orthographic has no port: choose a model whose rays leave one eye"),
        ("REAL_LENS", {"port": "DOME"}, "Real Lens has no port"),
    ],
)
def test_what_no_port_can_be_is_refused_in_one_line(model, settings, message):
    with pytest.raises(crc.InputError, match=message) as caught:
        crc.camera(model, SIZE, **settings)
    assert "\n" not in str(caught.value)


def test_no_program_s_file_leaves_the_glass_out(tmp_path):
    cam = crc.camera("OPENCV_PINHOLE", SIZE, fx=500.0, k1=-0.1, port="FLAT")
    assert isinstance(cam.model, BehindPort)
    assert cam.K is None
    with pytest.raises(crc.InputError):
        crc.export(cam, tmp_path, format="colmap")
    crc.export(cam, tmp_path, format="json")
    older = tmp_path / "older.json"
    older.write_text((tmp_path / "camera.json").read_text().replace('"port_inside"', '"unknown"'))
    for path in (tmp_path / "camera.json", older):
        np.testing.assert_array_equal(crc.camera_from_json(path).rays().directions, cam.rays().directions)


TANK, DOME = ({"port": kind} for kind in ("FLAT", "DOME"))


@pytest.mark.parametrize("focus", [0.3, 4.0])
@pytest.mark.parametrize(
    ("model", "settings"),
    [("PERSP", {"lens": 18.0, "port_tilt_x": 0.3, "port_distance": 50.0} | TANK), ("FISHEYE_EQUIDISTANT", IN_DOME),
     ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 2.6} | TANK), ("PERSP", {"lens": 50.0, "port_inside": 1.47} | DOME),
     ("PERSP", {"lens": 18.0, "port_inside": 1.47, "port_medium": 1.0} | TANK)],
)  # fmt: skip
def test_a_ball_is_sought_wherever_its_blur_behind_a_port_shows_it(model, settings, focus):
    """Balls of any size at any distance with a point of a ray of the aperture; the last one reflects totally."""
    camera = crc.camera(model, SIZE, use_dof=True, aperture_fstop=0.7, focus_distance=focus, **settings)
    rng = np.random.default_rng(4)
    x, y = (rng.uniform(0, side, 4000) for side in SIZE)
    with np.errstate(all="ignore"):
        point = camera.aperture.points(*rng.random((2, 4000)))
        ray = camera.model.through(camera.aperture, camera.model.rays(x, y), x, y, point)
    origin, direction = (np.stack(np.broadcast_arrays(*vectors), axis=-1) for vectors in ray)
    there = np.isfinite(direction).all(axis=1) & np.isfinite(origin).all(axis=1)
    origin, direction, x, y = origin[there], direction[there], x[there], y[there]
    count = len(x)
    assert count > 1000
    points = origin + np.exp(rng.uniform(np.log(0.01), np.log(100.0), (count, 1))) * direction
    radii = rng.choice([1e-6, 0.01, 1.0], count)
    bounds, seen = CameraPixelBounds(camera, True).of_balls(points + 0.99 * radii[:, None] * direction, radii)
    assert seen.all()
    assert ((bounds[:, 0] <= np.floor(x)) & (np.floor(x) < bounds[:, 1])).all()
    assert ((bounds[:, 2] <= np.floor(y)) & (np.floor(y) < bounds[:, 3])).all()


def test_what_is_sharp_behind_a_port_is_sought_in_few_pixels():
    """And all over the picture if a plate reflects totally in it."""
    settings = {"use_dof": True, "aperture_fstop": 8.0, "focus_distance": 2.0, "lens": 18.0, "port": "FLAT"}
    ball = np.array([[0.3, 0.2, -2.6]]), np.array([0.05])  # what is at 2 inside
    x0, x1, y0, y1 = CameraPixelBounds(crc.camera("PERSP", SIZE, **settings), True).of_balls(*ball)[0][0]
    assert (x1 - x0) * (y1 - y0) < 0.01 * 640 * 480
    totally = crc.camera("PERSP", SIZE, port_inside=1.47, port_medium=1.0, **settings)
    assert CameraPixelBounds(totally, True).of_balls(*ball)[0][0].tolist() == [0, 640, 0, 480]
