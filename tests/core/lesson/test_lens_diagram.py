"""A real lens drawn and explained: paths against the camera's own rays, and the sine law by geometry."""

import re

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.lesson.lens_diagram import chief_path, fan_of, lens_drawing, refraction_lines
from camera_ray_caster.core.lesson.lesson import GLASS, lesson
from camera_ray_caster.core.lesson.section import FILM, SIDE, section
from camera_ray_caster.core.records import no_shapes

SIZE = 96, 64
PIXEL = 20.5, 56.5
LINE = re.compile(r"surface (\d+), (plane|radius (\S+) mm): (\S+) sin (\S+)° = (\S+) sin (\S+)° = (\S+)")


def lens(name="double_gauss_50mm", **settings):
    return crc.camera("REAL_LENS", SIZE, lens_file=name, focus_distance=3.0, **settings)


@pytest.mark.parametrize("tilt", [0.0, 0.4])
@pytest.mark.parametrize("name", ["double_gauss_50mm", "retrofocus_22mm", "tessar_100mm", "singlet_100mm"])
def test_the_chief_path_ends_as_the_camera_s_ray(name, tilt):
    """From the film backwards, it leaves the front surface where the polynomials of the chief rays say."""
    model = lens(name, tau_x=tilt).model
    for x, y in (PIXEL, (48.0, 32.0), (70.25, 10.0)):
        path, (origin, direction) = chief_path(model, x, y), model.rays(x, y)
        np.testing.assert_allclose(path.points[-1], origin, rtol=0, atol=1e-11 * model.unit)
        np.testing.assert_allclose(path.direction, direction, rtol=0, atol=1e-11)
        beside = model.window.plane_from_pixels(x, y)[1] * np.sin(tilt)
        assert path.points[0][2] == pytest.approx((model.film - beside - model.pupil) * model.unit, rel=1e-9)
        stop = path.points[len(model.optics.surfaces) - model.optics.stop]
        assert np.hypot(*stop[:2]) < 1e-11 * model.unit  # through the middle of the stop


def test_each_line_has_the_sine_law_of_the_ray_that_is_drawn():
    """Angles from the drawn points: between the path's legs and the line to the center of a sphere."""
    model = lens().model
    path, lines = chief_path(model, *PIXEL), list(refraction_lines(model, *PIXEL))
    assert len(lines) == 10  # the stop does not refract
    points = np.concatenate((path.points, [path.points[-1] + path.direction]))[::-1]  # as light goes
    for line in lines:
        number, _, radius, before, in_front, behind, at_back, product = LINE.fullmatch(line).groups()
        k, surface = int(number), model.optics.surfaces[int(number) - 1]
        center = np.array((0, 0, (surface.z + float(radius) - model.pupil) * model.unit))
        normal = (points[k] - center) / np.linalg.norm(points[k] - center)
        for end, angle in ((k - 1, in_front), (k + 1, at_back)):
            leg = points[end] - points[k]
            sine = np.linalg.norm(np.cross(leg / np.linalg.norm(leg), normal))
            assert np.degrees(np.arcsin(sine)) == pytest.approx(float(angle), rel=2e-4)
        for index, angle in ((before, in_front), (behind, at_back)):
            assert float(index) * np.sin(np.radians(float(angle))) == pytest.approx(float(product), rel=2e-4)


def test_a_fan_fills_the_stop_and_rims_stop_the_rays_of_the_corner():
    """On the axis all pass, symmetric; at the corner, where the lens vignettes, some do not."""
    model = lens().model
    on_axis = fan_of(model, 48.0, 32.0)
    heights = [path.points[len(model.optics.surfaces) - model.optics.stop][1] for path in on_axis]
    assert all(path.direction is not None for path in on_axis)
    np.testing.assert_allclose(heights, -np.array(heights[::-1]), rtol=0, atol=1e-12)
    assert max(heights) == pytest.approx(0.95 * model.radius * model.unit, rel=0.05)
    corner = [path.direction is None for path in fan_of(model, 2.0, 62.0)]
    assert any(corner)
    assert not all(corner)


def test_the_drawing_stands_before_the_film_and_is_as_wide_as_the_glass():
    model = lens().model
    drawing = lens_drawing(model)
    rim = max(surface.rim for surface in model.optics.surfaces) * model.unit
    glass = drawing.glass.reshape(-1, 3)
    assert np.hypot(*glass[:, :2].T).max() == pytest.approx(rim)
    assert glass[:, 2].max() < drawing.film[..., 2].min()
    wide, high = np.ptp(drawing.film.reshape(-1, 3)[:, :2], axis=0)
    assert (wide, high) == pytest.approx((0.036, 0.024))
    assert np.ptp(drawing.pupils[:48].reshape(-1, 3)[:, 0]) == pytest.approx(
        2 * model.radius * model.unit * abs(model.optics.entrance_pupil[1])
    )


def test_steps_have_the_glass_only_of_a_real_lens_and_say_what_stops_a_ray():
    steps = dict(lesson(lens(), no_shapes(), 20, 56).steps)
    assert len(steps[GLASS]) == 10
    outside = dict(lesson(lens("fisheye_170_5mm"), no_shapes(), 0, 0).steps)
    assert "no chief ray" in outside[GLASS][-1]
    assert GLASS not in dict(lesson(crc.camera("PERSP", SIZE), no_shapes(), 20, 56).steps)


def test_the_section_shows_the_film_on_the_right():
    image = section(lens().model, *PIXEL)
    assert image.shape == (SIDE, SIDE, 4)
    assert np.isfinite(image).all()
    film = np.abs(image[..., :3] - FILM).max(axis=-1) < 0.01
    assert film.any()
    assert np.argwhere(film)[:, 1].min() > 0.9 * SIDE
