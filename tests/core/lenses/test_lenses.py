"""Real lenses: the trace and the chief rays with 60 digits, focus and pupils."""

from dataclasses import replace

import numpy as np
import pytest
from mpmath import mpf

import camera_ray_caster as crc
from camera_ray_caster.core.lenses import chief
from camera_ray_caster.core.lenses.chief import chief_rays
from camera_ray_caster.core.lenses.optics import Optics
from camera_ray_caster.core.lenses.prescription import Prescription, Row
from camera_ray_caster.core.lenses.read import library, read_lens
from camera_ray_caster.core.lenses.trace import trace

from .digits import traced

NAMES = sorted(library())
SIZE = 96, 64


def thin(focal=50.0, thickness=1e-6):
    """A lens so thin that it is a plane, with its stop on it."""
    curvature = 1 / (2 * (1.5 - 1) * focal)
    rows = Row(curvature, thickness, 1.5, 20.0), Row(-curvature, thickness, 1.0, 20.0), Row(0.0, 0.0, 1.0, 5.0)
    return Prescription(rows, 2)


@pytest.mark.parametrize("name", NAMES)
def test_rays_are_those_of_snell_s_law_with_60_digits(name):
    optics = Optics.of(read_lens(name))
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-0.3, 0.3, (2, 4)) * optics.surfaces[optics.stop].rim * abs(optics.entrance_pupil[1])
    aim = np.stack((x, y, np.full(4, optics.entrance_pupil[0] + 1000.0)))
    unit = aim / np.linalg.norm(aim, axis=0)
    origin, direction = trace(optics.surfaces, (0 * x, 0 * x, 0 * x - 1000.0), tuple(unit), to_film=True)
    for k in range(4):
        point, ahead = traced(optics.surfaces, (0, 0, -1000), unit[:, k])
        start = [np.broadcast_to(values, 4)[k] for values in origin]
        assert max(abs(mpf(number) - exact) for number, exact in zip(start, point, strict=True)) < 1e-11
        assert max(abs(mpf(values[k]) - exact) for values, exact in zip(direction, ahead, strict=True)) < 1e-13


@pytest.mark.parametrize("name", NAMES)
def test_chief_rays_pass_the_center_of_the_stop(name):
    """The polynomials' ray, sent backwards through the glass with 60 digits, meets the stop's center and the film's
    point, within the errors that they state beside a trace, those of that trace, and what the glass makes of both.
    """
    optics = Optics.of(read_lens(name))
    distance = max(60 * optics.focal_length, 3 * optics.nearest_focus)
    film = optics.sharpest_film(distance, optics.surfaces[optics.stop].rim)
    chief = chief_rays(optics, film)
    for share in (0.2, 0.6, 0.9):
        r = share * chief.rim
        height, z, tangent = (float(number) for number in chief.at(np.float64(r * r)))
        turn = 2 / (1 + (tangent * r) ** 2)
        origin, direction = (height * r, 0.0, z), (-tangent * r * turn, 0.0, turn - 1)
        stop, z = _met(optics, film, origin, direction)
        moved, turned = (mpf(number) * mpf(10) ** -20 for number in (direction[2], -direction[0]))
        beside, above = _met(optics, film, (origin[0] + moved, 0, origin[2] + turned), direction)
        around, along = _met(optics, film, origin, (direction[0] + moved, 0, direction[2] + turned))
        off, angle = chief.errors[0] + 1e-11, chief.errors[1] + 1e-13
        assert abs(stop) < 1e20 * (off * abs(beside - stop) + angle * abs(around - stop))
        assert abs(-r - z) < 1e20 * (off * abs(above - z) + angle * abs(along - z))


def _met(optics, film, origin, direction):
    """Where a ray from the scene meets the plane of the stop and the film: heights with 60 digits."""
    heights = []
    for surfaces, z in (optics.surfaces[: optics.stop], optics.surfaces[optics.stop].z), (optics.surfaces, film):
        point, ahead = traced(surfaces, origin, direction)
        heights.append(point[0] + (z - point[2]) * ahead[0] / ahead[2])
    return heights


@pytest.mark.parametrize("name", NAMES)
def test_a_lens_of_the_library_is_what_its_name_says(name):
    camera = crc.camera("REAL_LENS", SIZE, lens_file=name, focus_distance=50.0)
    facts = camera.model.facts()
    stated = next((word for word in name.split("_") if word.endswith("mm")), None)
    focal = facts["focal_length"]
    assert focal == pytest.approx(float(stated[:-2]), rel=0.05)  # nominal: the fisheye of 5 mm has 5.208
    assert facts["source"] or name == "singlet_100mm"
    # Newton's extension for 50 m; the sharpest film is nearer by spherical aberration, at most 0.021 f of these lenses
    assert facts["film_distance"] == pytest.approx(facts["back_focus"] + focal**2 / 50e3, abs=0.025 * focal)
    assert facts["image_circle"] > 4
    assert camera.rays().valid.any()


def test_a_thin_lens_is_the_thin_lens():
    optics = Optics.of(thin())
    assert optics.focal_length == pytest.approx(50.0, rel=1e-6)
    for distance in (200.0, 1000.0, 1e6):
        assert optics.paraxial_film(distance) == pytest.approx(1 / (1 / 50 - 1 / distance), rel=1e-5)
    assert optics.nearest_focus == pytest.approx(50.0, rel=1e-5)
    assert optics.widest_f_number == pytest.approx(5.0, rel=1e-6)


@pytest.mark.parametrize("name", ["double_gauss_50mm", "telephoto_127mm", "retrofocus_22mm"])
def test_a_nodal_slide_measures_the_focal_length(name):
    """A lens that is turned a little about a point of its axis leaves the image of a star where it is, if that point is
    the focal length before it: the rear nodal point. Where it is found, by rays of a narrow bundle.
    """
    optics, turn = Optics.of(read_lens(name)), 1e-4
    film = optics.rear.z + optics.back_focus
    side = np.array([-1.0, 1.0]) * 1e-3 * optics.focal_length
    start = side - turn * optics.entrance_pupil[0], np.zeros(2)  # through the middle of the pupil
    direction = np.full(2, np.sin(turn)), np.zeros(2), np.full(2, np.cos(turn))
    (x, _, z), (dx, _, dz) = trace(optics.surfaces, (*start, np.zeros(2)), direction, to_film=True)
    height = float((x + (film - z) * dx / dz).mean())
    slid = height / np.tan(turn)  # the image, turned back about the point, is on the first axis again
    assert slid == pytest.approx(optics.focal_length, rel=1e-5)
    assert np.ptp(x + (film - z) * dx / dz) < 1e-4 * abs(side[0])


def test_a_symmetric_lens_at_one_to_one_has_no_distortion():
    """W. Smith, Modern Optical Engineering: the halves' distortions cancel."""
    half = [Row(1 / 40, 4.0, 1.6, 15.0), Row(1 / 90, 5.0, 1.0, 12.0)]
    back = [Row(-1 / 90, 4.0, 1.6, 12.0), Row(-1 / 40, 0.0, 1.0, 15.0)]
    optics = Optics.of(Prescription((*half, Row(0.0, 5.0, 1.0, 4.0), *back), 2))
    (_, _), (c, d) = optics.whole
    away = float(-(1 + d) / c)  # before the front: there 1 / (c s + d), the magnification, is -1
    film = optics.paraxial_film(away + optics.entrance_pupil[0])
    chief = chief_rays(optics, film)
    for r in (1.0, 4.0, 8.0):
        height, z, tangent = (float(number) for number in chief.at(np.float64(r * r)))
        turn = 2 / (1 + (tangent * r) ** 2)
        assert height * r + (-away - z) * (tangent * r * turn) / (1 - turn) == pytest.approx(r, rel=1e-9)


def test_framing_is_that_of_perspective_with_the_same_focal_length():
    real = crc.camera("REAL_LENS", SIZE, lens=50.0, focus_distance=1000.0)
    plain = crc.camera("PERSP", SIZE, lens=50.0)
    point = [(0.02, 0.01, -1.0)]
    np.testing.assert_allclose(real.project(point), plain.project(point), atol=0.01)
    assert real.K[0, 0] == pytest.approx(plain.K[0, 0], rel=1e-3)


def test_without_a_focal_length_the_lens_has_its_own_size_and_with_one_it_is_scaled():
    unscaled, scaled = (crc.camera("REAL_LENS", SIZE, focus_distance=1e4, **lens) for lens in ({}, {"lens": 25.0}))
    assert unscaled.model.facts()["focal_length"] == pytest.approx(50.35816695831366, rel=1e-12)
    assert scaled.model.facts()["focal_length"] == pytest.approx(25.0, rel=1e-12)
    assert scaled.model.facts()["back_focus"] == pytest.approx(
        unscaled.model.facts()["back_focus"] * 25.0 / 50.35816695831366, rel=1e-12
    )


def test_wavelength_changes_rays_only_where_glass_disperses():
    red, blue = (crc.camera("REAL_LENS", SIZE, lens_wavelength=length).rays().directions for length in (656.0, 450.0))
    assert 1e-6 < np.nanmax(np.abs(red - blue)) < 1e-2
    plain = [
        crc.camera("REAL_LENS", SIZE, lens_file="retrofocus_22mm", lens_wavelength=length).rays().directions
        for length in (656.0, 450.0)
    ]
    np.testing.assert_array_equal(*plain)


def test_a_nearer_focus_than_the_lens_allows_is_refused_with_the_nearest():
    with pytest.raises(crc.InputError, match=r"focus_distance .* above 0\.0470689, since nothing nearer has an image"):
        crc.camera("REAL_LENS", SIZE, focus_distance=0.04)


def test_a_zoom_is_interpolated_between_its_configurations():
    rows = (Row(1 / 60, 4.0, 1.6, 15.0), Row(-1 / 60, 10.0, 1.0, 15.0), Row(0.0, 8.0, 1.0, 6.0),
            Row(1 / 70, 4.0, 1.6, 15.0), Row(-1 / 70, 0.0, 1.0, 15.0))  # fmt: skip
    lens = Prescription(rows, 2, states=(("wide", ((1, 10.0),)), ("long", ((1, 30.0),))))
    gaps = [lens.in_state(state).rows[1].gap for state in (0.0, 0.25, 1.0, 5.0)]
    assert gaps == [10.0, 15.0, 30.0, 30.0]
    assert lens.in_state(0.25).rows[2] == replace(rows[2])


@pytest.mark.full
def test_a_calibrated_model_is_fitted_to_a_real_lens():
    """At the plane of focus both see a point at the same pixel, to the residual that the fit states."""
    camera = crc.camera("REAL_LENS", (96, 64), focus_distance=2.0)
    fit = crc.fit(camera, "OPENCV_PINHOLE")
    assert fit.converged
    assert fit.worst < 0.05
    points = [(0.5, 0.3, -2.0), (-0.6, 0.1, -2.0), (0.0, 0.0, -2.0)]
    assert np.abs(fit.camera.project(points) - camera.project(points)).max() <= fit.worst * 1.01


@pytest.mark.parametrize("undefined", [1, 100])
def test_polynomials_without_values_are_not_taken(monkeypatch, undefined, tmp_path):
    """The first of the tried ends, or all of them, have errors that are no numbers."""
    count, made = 0, chief._polynomials

    def polynomials(*arguments):
        nonlocal count
        count += 1
        return replace(made(*arguments), errors=(np.nan, 0.0)) if count <= undefined else made(*arguments)

    monkeypatch.setattr(chief, "_polynomials", polynomials)
    lens = tmp_path / "lens.dat"
    lens.write_bytes(library()["tessar_100mm"].read_bytes())
    chief.chief_rays.cache_clear()
    if undefined == 1:
        camera = crc.camera("REAL_LENS", SIZE, lens_file=str(lens))
        assert max(camera.model.chief.errors) < 1e-10
    else:
        with pytest.raises(crc.InputError, match=r"chief rays cannot be described.*lens\.dat"):
            crc.camera("REAL_LENS", SIZE, lens_file=str(lens))


@pytest.mark.parametrize("stop", [0, 1])
def test_a_stop_on_a_surface_that_refracts_is_a_stop_at_its_vertex(stop):
    """The same rays as with a plane stop there, in the medium before it."""
    rows = [Row(1 / 60, 5.0, 1.6, 8.0), Row(-1 / 90, 3.0, 1.0, 8.0), Row(1 / 80, 2.0, 1.5, 20.0),
            Row(-1 / 70, 0.0, 1.0, 20.0)]  # fmt: skip
    plane = Row(0.0, 0.0, rows[stop - 1].index if stop else 1.0, 8.0)
    on, before = (Optics.of(Prescription(tuple(each), stop)) for each in (rows, (*rows[:stop], plane, *rows[stop:])))
    assert on.exit_pupil == pytest.approx(before.exit_pupil, rel=1e-12)
    assert on.entrance_pupil == pytest.approx(before.entrance_pupil, rel=1e-12)
    film = on.paraxial_film(1000.0)
    ours, theirs = chief_rays(on, film), chief_rays(before, film)
    for r in (2.0, 10.0):
        np.testing.assert_allclose(ours.at(np.float64(r * r)), theirs.at(np.float64(r * r)), rtol=1e-11)
