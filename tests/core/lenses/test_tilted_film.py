"""A tilted film: against geometry by hand, a pinhole with OpenCV's tilt, and the trace with 60 digits."""

import numpy as np
import pytest
from mpmath import cos, matrix, mpf, sin

import camera_ray_caster as crc
from camera_ray_caster.core.cameras.real_lens import RealLens

from .digits import traced

SIZE = 96, 64
THIN = "50 1e-6 1.5 40\n-50 1e-6 1 40\n0 0 0 {}\n"
"""A lens of 50 mm whose stop, of this diameter, is at its glass, as a file of pbrt."""
TILTS = [(0.3, 0.0), (-0.1, 0.5)]


@pytest.fixture
def thin(tmp_path):
    path = tmp_path / "thin.dat"
    path.write_text(THIN.format(0.1))
    return str(path)


@pytest.mark.parametrize("tilt", TILTS)
def test_a_thin_lens_has_the_picture_of_a_pinhole_with_a_tilted_sensor(thin, tilt):
    """To 3e-9, the error of the polynomials of a lens without rims."""
    angles = dict(zip(("tau_x", "tau_y"), tilt, strict=True))
    ours = crc.camera("REAL_LENS", SIZE, lens_file=thin, focus_distance=5.0, shift_x=0.2, **angles)
    (fx, _, cx), (_, fy, cy), _ = ours.K
    theirs = crc.camera("OPENCV_PINHOLE", SIZE, fx=fx, fy=fy, cx=cx, cy=cy, **angles)
    np.testing.assert_allclose(ours.rays().directions, theirs.rays().directions, rtol=0, atol=1e-8)


@pytest.mark.parametrize("tilt", TILTS)
@pytest.mark.parametrize("name", ["double_gauss_50mm", "retrofocus_22mm", "telephoto_127mm"])
def test_chief_rays_meet_the_pixel_s_point_of_the_film_with_60_digits(name, tilt):
    """Sent backwards through the glass; the film's points are those of OpenCV's matrices, by sines and cosines."""
    angles = dict(zip(("tau_x", "tau_y"), tilt, strict=True))
    camera = crc.camera("REAL_LENS", SIZE, lens_file=name, focus_distance=4.0, sensor_width=20.0, **angles)
    model = camera.model
    (cx, sx), (cy, sy) = ((cos(mpf(angle)), sin(mpf(angle))) for angle in tilt)
    turn = matrix([[cy, 0, -sy], [0, 1, 0], [sy, 0, cy]]) * matrix([[1, 0, 0], [0, cx, sx], [0, -sx, cx]])
    for x, y in ((3.25, 60.5), (90.0, 8.0), (40.0, 31.5)):
        origin, direction = model.rays(x, y)
        start = [number / model.unit for number in origin]
        start[2] += model.pupil
        point, ahead = traced(model.optics.surfaces, start, [-number for number in direction])
        u, v = ((mpf(pixel) - center) * 20 / 96 for pixel, center in ((x, 48), (y, 32)))
        across, down, behind = (turn.T * matrix([u, -v, 0]))[:]
        way = (mpf(model.film) + behind - point[2]) / ahead[2]
        met = [point[k] + way * ahead[k] for k in range(2)]
        assert abs(met[0] + across) < 2e-11
        assert abs(met[1] - down) < 2e-11


def test_the_plane_of_focus_is_tilted_by_scheimpflug_s_rule(thin):
    """For a thin lens: film, lens and plane of focus have a line in common, and the focus distance on the axis holds.
    With the film at v on the axis, turned by tau about x, its line with the lens is at v / tan(tau) beside the axis.
    The film is small, since a thin lens has astigmatism: 2 times the square of the angle of its power.
    """
    tau, focus = 1.2, 3.0
    settings = {"lens_file": thin, "focus_distance": focus, "use_dof": True, "sensor_width": 0.1}
    camera = crc.camera("REAL_LENS", SIZE, tau_x=tau, lens_focus="PARAXIAL", **settings)
    line = camera.model.film * 1e-3 / np.tan(tau)
    x, y = np.meshgrid([10.0, 48.0, 80.0], [4.0, 20.0, 32.0, 60.0])
    height = camera.aperture.radius / 2
    rays = [camera.model.through(camera.aperture, None, x, y, (side * height, 0.3 * side * height)) for side in (-1, 1)]
    (start, way), (other, beside) = ((np.stack(np.broadcast_arrays(*vectors)) for vectors in ray) for ray in rays)
    # where two rays come closest
    off, product = other - start, (way * beside).sum(axis=0)
    along = ((off * way).sum(axis=0) - product * (off * beside).sum(axis=0)) / (1 - product**2)
    sharp = start + along * way
    depth = focus * (1 + sharp[1] / line)
    assert np.ptp(depth) > 0.15
    np.testing.assert_allclose(-sharp[2], depth, rtol=2e-4)


def test_light_on_a_tilted_film_is_that_of_its_distance_and_angle():
    """A small stop on a white wall: cos(angle at the pupil) cos(angle at the film) / distance^2, over the middle's."""
    tau = 0.4
    settings = {"use_dof": True, "aperture_fstop": 16.0, "focus_distance": 5.0, "sensor_width": 20.0}
    camera = crc.camera("REAL_LENS", SIZE, tau_x=tau, **settings)
    model, (x, y) = camera.model, (np.array([48.0, 48.0, 5.0]), np.array([32.0, 60.0, 3.0]))
    light = model.light(camera.aperture, x, y, (0.0 * x, 0.0 * x))
    u, v = (x - 48) * 20 / 96, (y - 32) * 20 / 96
    film = np.stack((-u, -v * np.cos(tau), model.film - v * np.sin(tau)))
    exit_pupil = np.array([0.0, 0.0, model.optics.exit_pupil[0]])
    away = exit_pupil[:, None] - film
    normal = np.array([0.0, np.sin(tau), -np.cos(tau)])
    size = np.linalg.norm(away, axis=0)
    expected = (-away[2] / size) * (normal @ away / size) / size**2
    np.testing.assert_allclose(light / light[0], expected / expected[0], rtol=2e-3)  # the pupil wanders


def test_a_film_that_reaches_the_lens_is_refused_with_the_largest_tilt():
    with pytest.raises(
        crc.InputError, match=r"tau_y of camera .* 68\.\d+ degrees: it must be at most (\S+) degrees"
    ) as no:
        crc.camera("REAL_LENS", SIZE, lens=12.0, tau_y=1.2, tau_x=0.1)
    most = float(str(no.value).split("at most ")[1].split()[0])
    share = np.radians(most) / 1.2
    for scale, holds in ((0.999, True), (1.001, False)):
        tilts = {"lens": 12.0, "tau_y": 1.2 * share * scale, "tau_x": 0.1 * share * scale}
        if holds:
            assert crc.camera("REAL_LENS", SIZE, **tilts).rays().valid.any()
        else:
            with pytest.raises(crc.InputError, match="reaches the lens"):
                crc.camera("REAL_LENS", SIZE, **tilts)


def test_chief_rays_of_a_lens_without_rims_are_described_where_films_are(thin):
    """They exist up to kilometers from the axis, grazing the stop's plane; a film has some times the focal length."""
    model = crc.camera("REAL_LENS", SIZE, lens_file=thin, focus_distance=5.0).model
    assert isinstance(model, RealLens)
    assert model.chief.errors[1] < 1e-8
    _, direction = model.rays(96.0, 32.0)
    assert -direction[0] / direction[2] == pytest.approx(18.0 / model.film, rel=1e-7)
