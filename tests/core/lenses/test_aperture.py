"""The aperture of real lenses: the stop, the light of a white wall, and where what is blurred is sought."""

from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.casting.pixel_bounds import CameraPixelBounds
from camera_ray_caster.core.lenses.optics import Optics
from camera_ray_caster.core.lenses.read import read_lens
from camera_ray_caster.core.lenses.trace import trace
from camera_ray_caster.core.report.accuracy import Accuracy
from camera_ray_caster.core.report.report import report_cast

SIZE = 96, 64
SAMPLES = 64
WALL = crc.planes((0, 0, -5), [[1, 0], [0, 1], [0, 0]], infinite=True, color=(1, 1, 1))


def test_an_f_stop_opens_the_stop_up_to_the_lens_s_own():
    wide, closed = (crc.camera("REAL_LENS", SIZE, aperture_fstop=stop).model.facts() for stop in (1.2, 8.0))
    assert wide["f_number"] == pytest.approx(wide["widest_f_number"])
    assert closed["f_number"] == pytest.approx(8.0)
    assert wide["stop"] == pytest.approx(17.1)


@pytest.mark.parametrize(("stop", "use_dof", "has_note"), [(1.2, True, True), (2.0, True, False), (1.2, False, False)])
def test_a_stop_that_is_wider_than_the_lens_is_told_in_one_line(stop, use_dof, has_note):
    camera = crc.camera("REAL_LENS", SIZE, aperture_fstop=stop, use_dof=use_dof)
    images = crc.cast(camera, WALL, passes=("depth",))
    report = report_cast(camera, WALL, images, {}, (), 1.0, "Layer", accuracy=Accuracy())
    line = "the lens opens to f/2.03: it is cast with that stop in place of f/1.2"
    assert [note for _, note in report.notes] == ([line] if has_note else [])


def light_of_a_wall(samples=SAMPLES, **settings):
    """A camera, and the colors of a white wall, (3, 33), over those of a pinhole."""
    camera = crc.camera("REAL_LENS", (33, 3), use_dof=True, focus_distance=5.0, **settings)
    image = crc.cast(camera, WALL, passes=("combined",), samples=samples)["combined"]
    assert (image[..., 3] == 1).all()
    plain = crc.cast(crc.camera("PERSP", (33, 3)), WALL, passes=("combined",))["combined"]
    return camera, image[..., 0] / plain[..., 0]


def noise(passing, samples):
    """Three standard errors of the mean of samples of a disc, of which a share passes."""
    return 3 * ((1 / passing - 1) / samples) ** 0.5


@pytest.mark.full
@pytest.mark.parametrize("falloff", [True, False])
@pytest.mark.parametrize("vignetting", [True, False])
def test_the_light_of_a_picture_is_what_passes_the_rims_and_falls_off(vignetting, falloff):
    """A white wall at f/2: 1 in the middle; at the edges the share of the exit pupil through which rays of a grid
    pass, times cos^4.
    """
    camera, light = light_of_a_wall(aperture_fstop=2.0, lens_vignetting=vignetting, lens_falloff=falloff)
    optics, film = camera.model.optics, camera.model.film
    plane, side = optics.exit_pupil[0], np.linspace(-15.0, 15.0, 301)  # rays pass up to 13.8 mm from the axis
    middle, edge = (passing(optics, (x, 0.0, film), (side[:, None], side, plane), falloff) for x in (0.0, -17.45))
    assert light[:, 15:18].mean() == pytest.approx(1.0, abs=noise(0.91, 9 * SAMPLES))
    fall = edge.sum() / middle.sum()
    if not vignetting:
        fall = edge[edge > 0].mean() / middle[middle > 0].mean()
    assert light[:, [0, -1]].mean() == pytest.approx(fall, rel=noise(0.35, 6 * SAMPLES))


def passing(optics, origin, target, falloff):
    """cos^4 (or 1) of rays from the film to places of the exit pupil that pass all rims; 0 for the others."""
    ahead = np.broadcast_arrays(*(there - here for there, here in zip(target, origin, strict=True)))
    length = np.sqrt(sum(values * values for values in ahead))
    with np.errstate(invalid="ignore"):
        _, (dx, _, _) = trace(optics.surfaces[::-1], origin, tuple(values / length for values in ahead), to_film=False)
    return np.isfinite(dx) * (np.abs(ahead[2]) / length) ** (4 if falloff else 0)


@pytest.mark.full
def test_light_beyond_the_last_chief_ray_is_that_of_the_rays_that_pass():
    """Chief rays of the Petzval lens end 20.8 mm from the axis, their polynomials at 21.0; a tenth of the light
    of the middle comes to 21.3.
    """
    camera, light = light_of_a_wall(512, lens_file="petzval_50mm", aperture_fstop=1.0, sensor_width=21.3 * 33 / 16)
    optics, film = camera.model.optics, camera.model.film
    assert camera.model.chief.end < 21.2
    side = np.linspace(-20.0, 20.0, 401)
    middle, *edge = (
        passing(optics, (x, 0.0, film), (side[:, None], side, optics.exit_pupil[0]), True).sum()
        for x in (0.0, *(-21.3 + camera.model.window.pitch_x * np.linspace(-0.4, 0.4, 5)))
    )
    assert light[:, [0, -1]].mean() == pytest.approx(np.mean(edge) / middle, rel=noise(0.06, 6 * 512))


@pytest.mark.full
@pytest.mark.parametrize(("blades", "ratio", "share"), [(0, 2.0, 0.99), (0, 0.5, 0.5), (5, 1.0, 0.99), (6, 0.7, 0.7)])
def test_the_middle_of_a_white_wall_is_1_for_any_shape_of_the_stop(blades, ratio, share):
    """With ratio 0.5 the stop is twice as wide as the lens at f/2.8, whose rims then stop half of the light."""
    for vignetting in (True, False):
        _, light = light_of_a_wall(
            aperture_fstop=2.8, aperture_blades=blades, aperture_ratio=ratio, lens_vignetting=vignetting
        )
        assert light[:, 15:18].mean() == pytest.approx(1.0, abs=noise(share, 9 * SAMPLES))


def test_rays_of_the_aperture_meet_at_the_plane_of_focus_and_pass_the_stop():
    camera = crc.camera("REAL_LENS", SIZE, use_dof=True, aperture_fstop=8.0, focus_distance=2.0)
    x, y = np.full(64, 48.0), np.full(64, 32.0)
    rng = np.random.default_rng(0)
    point = camera.aperture.points(*rng.random((2, 64)))
    origin, direction = camera.model.through(camera.aperture, None, x, y, point)
    passes = np.isfinite(direction[0])
    assert 40 < passes.sum() < 64
    at = [(o + (-2.0 - origin[2]) / direction[2] * d)[passes] for o, d in zip(origin[:2], direction[:2], strict=True)]
    assert np.hypot(*at).max() < 2e-4  # aberrations of f/8, Blender units
    pupil = [(o + (0.0 - origin[2]) / direction[2] * d)[passes] for o, d in zip(origin[:2], direction[:2], strict=True)]
    assert np.hypot(*pupil).max() < camera.aperture.radius * 1.02


@pytest.mark.parametrize("focus", [0.5, 10.0])
@pytest.mark.parametrize(
    ("name", "tilt"),
    [("double_gauss_50mm", 0.0), ("fisheye_170_5mm", 0.0), ("petzval_50mm", 0.0), ("retrofocus_22mm", 0.0),
     ("double_gauss_50mm", 0.3), ("retrofocus_22mm", -0.4)],
)  # fmt: skip
def test_a_ball_is_sought_wherever_the_blur_shows_it(name, tilt, focus):
    """Balls of any size at any distance, and at the plane of focus, with a point of a ray of the aperture."""
    settings = {"use_dof": True, "aperture_fstop": 0.5, "focus_distance": focus, "sensor_width": 30.0, "tau_y": tilt}
    size = 3840, 2560
    camera = crc.camera("REAL_LENS", size, lens_file=name, **settings)
    rng = np.random.default_rng(2)
    x, y = rng.uniform(0, size[0], 3000), rng.uniform(0, size[1], 3000)
    with np.errstate(all="ignore"):
        point = camera.aperture.points(*rng.random((2, 3000)))
        origin, direction = camera.model.through(camera.aperture, None, x, y, point)
    ray = np.isfinite(direction[0])
    origin, direction = (np.stack(vectors, axis=-1)[ray] for vectors in (origin, direction))
    count = len(origin)
    assert count > 300
    for nearest, farthest in ((0.01, 100.0), (0.9 * focus, 1.1 * focus)):
        points = origin + np.exp(rng.uniform(np.log(nearest), np.log(farthest), (count, 1))) * direction
        radii = rng.choice([1e-6, 0.01, 1.0], count)
        bounds, seen = CameraPixelBounds(camera, True).of_balls(points + 0.99 * radii[:, None] * direction, radii)
        assert seen.all()
        column, row = np.floor(x[ray]), np.floor(y[ray])
        assert ((bounds[:, 0] <= column) & (column < bounds[:, 1])).all()
        assert ((bounds[:, 2] <= row) & (row < bounds[:, 3])).all()


def test_what_is_sharp_is_sought_in_as_few_pixels_as_with_a_thin_lens():
    settings = {"use_dof": True, "aperture_fstop": 2.1, "focus_distance": 10.0, "lens": 500.0, "sensor_width": 360.0}
    real, thin = (crc.camera(model, SIZE, **settings).aperture for model in ("REAL_LENS", "PERSP"))
    ball = np.array([[0.0, 0.0, -10.0]]), np.array([0.1])
    assert real.blur(*ball, False) < thin.blur(*ball, True)


@pytest.mark.full
def test_red_green_and_blue_pass_the_glass_with_their_own_indices():
    """Each ray is that of a lens for its wavelength, with the film where it stands."""
    settings = {"use_dof": True, "aperture_fstop": 4.0, "focus_distance": 5.0}
    camera, plain = (crc.camera("REAL_LENS", SIZE, lens_color=color, **settings) for color in (True, False))
    rng = np.random.default_rng(3)
    x, y = rng.uniform(0, SIZE[0], 300), rng.uniform(0, SIZE[1], 300)
    point = camera.aperture.points(*rng.random((2, 300)))
    with np.errstate(invalid="ignore"):
        _, ours = camera.model.through(camera.aperture, None, x, y, point)
    light = np.stack(np.broadcast_arrays(*camera.model.light(camera.aperture, x, y, point)))
    model, lens = plain.model, read_lens("double_gauss_50mm")
    total = plain.model.light(plain.aperture, x, y, point)
    np.testing.assert_allclose(light.sum(axis=0), 3 * total, rtol=1e-15)
    for k, wavelength in enumerate((610.0, 546.0, 450.0)):
        mine = light[k] > 0
        assert 85 < mine.sum() < 115  # a third of them
        colored = replace(model, optics=Optics.of(lens, wavelength))
        with np.errstate(invalid="ignore"):
            _, theirs = colored.through(plain.aperture, None, x[mine], y[mine], tuple(values[mine] for values in point))
        # the disc stands in the plane of the pupil for the d line in both
        np.testing.assert_allclose(np.stack(ours)[:, mine], np.stack(theirs), rtol=0, atol=1e-15)


@pytest.mark.full
def test_colors_of_a_white_wall_are_white_and_files_without_dispersion_have_none():
    settings = {"use_dof": True, "focus_distance": 5.0, "lens_color": True}
    tessar = {"lens_file": "tessar_100mm", "aperture_fstop": 8.0, "sensor_width": 18.0}
    camera = crc.camera("REAL_LENS", (9, 9), **tessar, **settings)
    image = crc.cast(camera, WALL, passes=("combined",), samples=96)["combined"]
    plain = crc.cast(crc.camera("PERSP", (9, 9), lens=100.0, sensor_width=18.0), WALL, passes=("combined",))["combined"]
    # n samples of which a third counts three times: a standard error of sqrt(2 / n)
    np.testing.assert_allclose((image / plain)[..., :3].mean(axis=(0, 1)), 1.0, atol=0.02 + 3 * (2 / (96 * 81)) ** 0.5)
    assert crc.camera("REAL_LENS", SIZE, lens_file="retrofocus_22mm", **settings).aperture.colors == ()
