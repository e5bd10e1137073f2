"""Fits of one model to another: the least squares of scipy, and lenses that two models share."""

import re

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.camera.fit import SAMPLED
from camera_ray_caster.core.cameras.parts.parameters import with_parameters
from camera_ray_caster.core.records import InputError

SIZE = 61, 46
LENSES = {
    "TUM VI": ("DOUBLE_SPHERE", {"fx": 15.0, "fy": 14.9, "unified_xi": -0.18, "unified_alpha": 0.59}),
    "drone": ("DOUBLE_SPHERE", {"fx": 21.0, "fy": 21.0, "cy": 23.0, "unified_xi": -0.25, "unified_alpha": 0.55}),
    "EuRoC": ("OPENCV_PINHOLE", {"fx": 43.6, "fy": 43.5, "k1": -0.283, "k2": 0.074, "p1": 2e-4, "p2": 2e-5}),
    "action camera": ("OPENCV_FISHEYE", {"fx": 24.0, "fy": 24.0, "k1": 0.05, "k2": 0.01, "k3": -0.005, "k4": 4e-4}),
    "car": ("OPENCV_FISHEYE", {"fx": 18.0, "fy": 18.1, "cx": 31.0, "k1": -0.02, "k2": 0.002}),
    "KITTI-360": ("UCM", {"fx": 82.0, "fy": 82.0, "unified_xi": 2.2, "k1": 0.01, "k2": 0.4}),
}
"""Six lenses like those of data sets, for small pictures, all of whose pixels count."""

MODELS = "DOUBLE_SPHERE", "OPENCV_FISHEYE", "UCM", "OPENCV_PINHOLE"
PAIRS = [(lens, model) for lens in LENSES for model in MODELS]
NARROW = 0.9
"""Radians: the region of fits with a pinhole."""


def lens(name):
    model, settings = LENSES[name]
    return crc.camera(model, SIZE, **settings)


def region_of(name, model):
    return NARROW if "OPENCV_PINHOLE" in (model, LENSES[name][0]) else 1.5


def scipy_s(cam, fitted):
    """The residuals of scipy's least squares, from a lens beside the fitted one, with its own derivatives."""
    from scipy.optimize import least_squares

    there = np.isfinite(fitted.residual).all(axis=-1)
    rows, columns = np.nonzero(there)
    rays = np.stack(np.broadcast_arrays(*cam.model.rays(columns + 0.5, rows + 0.5)[1]), axis=-1)
    names, kind, record = list(fitted.parameters), type(fitted.camera.model), fitted.camera.record

    def residuals(values):
        known = fitted.camera.parameters | dict(zip(names, values, strict=True))
        try:
            model = kind.from_blender(with_parameters(kind.SETTINGS, record, known.values()), cam.raster)
        except InputError:  # beyond the range of a setting
            return np.full(2 * len(rays), 1e3)
        return np.nan_to_num(model.project(rays) - np.stack((columns, rows), axis=-1) - 0.5, nan=1e3).ravel()

    start = np.array(list(fitted.parameters.values())) * (1 + 1e-4 * np.cos(np.arange(len(names))))
    solution = least_squares(residuals, start, x_scale="jac", xtol=1e-12, ftol=1e-12, gtol=1e-12, max_nfev=300)
    return solution.fun.reshape(-1, 2)


@pytest.mark.full
@pytest.mark.parametrize(("name", "model"), PAIRS)
def test_residuals_are_scipy_s_least_squares(name, model):
    assert max(SIZE) <= SAMPLED
    cam = lens(name)
    fitted = crc.fit(cam, model, within=region_of(name, model))
    ours = fitted.residual[np.isfinite(fitted.residual).all(axis=-1)]
    theirs = scipy_s(cam, fitted)
    sums = (ours**2).sum(), (theirs**2).sum()
    assert np.sqrt(sums[0]) <= np.sqrt(sums[1]) * (1 + 1e-6) + 1e-8, (fitted.summary, sums)
    assert fitted.converged
    assert fitted.worst == np.hypot(*ours.T).max()
    assert fitted.mean == pytest.approx(np.hypot(*ours.T).mean(), rel=1e-12)


@pytest.mark.parametrize("name", LENSES)
def test_a_lens_of_the_same_model_is_found_again(name):
    model, settings = LENSES[name]
    fitted = crc.fit(lens(name), model)
    assert fitted.worst < 1e-6
    assert fitted.unseen == 0
    for key, value in settings.items():
        assert fitted.parameters[key] == pytest.approx(value, abs=1e-4), key


def test_what_two_models_both_say_is_found_exactly():
    """A unified camera without distortion is an enhanced one; its focal length over 1 + xi, alpha xi over 1 + xi."""
    cam = crc.camera("UCM", (640, 480), fx=400.0, fy=410.0, unified_xi=0.6)
    fitted = crc.fit(cam, "EUCM")
    assert fitted.worst < 1e-8
    expected = {"fx": 400 / 1.6, "fy": 410 / 1.6, "unified_alpha": 0.6 / 1.6, "unified_beta": 1.0}
    for name, value in expected.items():
        assert fitted.parameters[name] == pytest.approx(value, rel=1e-6)
    assert fitted.camera.raster.size == (640, 480)
    assert fitted.summary.startswith("Enhanced Unified (EUCM), at most ")


def test_a_perspective_is_found_in_millimeters_and_what_is_given_is_held():
    cam = crc.camera("OPENCV_PINHOLE", (96, 54), fx=80.0, fy=80.0, cx=40.0, cy=26.0)
    fitted = crc.fit(cam, "PERSP")
    assert fitted.worst < 1e-9
    assert fitted.camera.settings["lens"] == pytest.approx(80 * 36 / 96)
    assert fitted.camera.settings["shift_x"] == pytest.approx((48 - 40.5) / 96)
    held = crc.fit(cam, "OPENCV_FISHEYE", k2=0.125)
    assert held.camera.settings["k2"] == 0.125
    assert "k2" not in held.parameters
    assert set(crc.fit(cam, "OPENCV_FISHEYE", free=("k1", "k2")).parameters) == {"k1", "k2"}


def test_the_covariance_is_that_of_a_straight_line():
    """fx and cx of a pinhole are the slope and the offset of a line, with the textbook's variances."""
    cam = crc.camera("OPENCV_PINHOLE", (60, 40), fx=50.0, fy=50.0, k1=-0.05)
    fitted = crc.fit(cam, "OPENCV_PINHOLE", free=("fx", "cx"), k1=0.0)
    x = np.stack(np.broadcast_arrays(*cam.model.rays(*(np.mgrid[:40, :60][::-1] + 0.5))[1]))[0]
    left = (fitted.residual**2).sum() / (2 * x.size - 2)
    spread = ((x - x.mean()) ** 2).sum()
    expected = left / spread, left * (1 / x.size + x.mean() ** 2 / spread)
    np.testing.assert_allclose(np.diag(fitted.covariance), expected, rtol=1e-6)


def test_regions():
    cam = crc.camera("OPENCV_FISHEYE", (64, 48), fx=20.0, fy=20.0, k1=0.02)
    angle = crc.fit(cam, "OPENCV_PINHOLE", within=0.5)
    x, y, z = np.stack(np.broadcast_arrays(*cam.model.rays(*(np.mgrid[:48, :64][::-1] + 0.5))[1]))
    np.testing.assert_array_equal(np.isfinite(angle.residual[..., 0]), np.hypot(x, y) <= np.tan(0.5) * -z)
    mask = np.zeros((48, 64), bool)
    mask[20:30, 24:40] = True
    by_mask, other = (
        crc.fit(cam, "OPENCV_PINHOLE", within=mask),
        crc.fit(cam, "OPENCV_PINHOLE", within=(24, 20, 40, 30)),
    )
    np.testing.assert_array_equal(by_mask.residual, other.residual)
    np.testing.assert_array_equal(np.isfinite(by_mask.residual[..., 0]), mask)
    wide = crc.fit(crc.camera("EQUIRECTANGULAR", (64, 32)), "OPENCV_FISHEYE", free=("k1",))
    assert wide.unseen == 0


def test_a_search_that_ends_before_all_rays_count_has_not_converged(monkeypatch):
    """Rays come into view as the lens gets nearer: a minimum of those of the first round is none of the sum that is
    reported.
    """
    cam = crc.camera("UCM", (64, 48), fx=20.0, unified_xi=1.5)
    assert crc.fit(cam, "DIVISION").converged
    monkeypatch.setattr("camera_ray_caster.core.camera.fit_search.MOST_ROUNDS", 1)
    assert not crc.fit(cam, "DIVISION").converged


@pytest.mark.full
def test_a_wide_fisheye_is_no_pinhole_but_in_its_middle():
    """The region that is proposed can be fitted; what a pinhole shows beyond it is farther away than the picture."""
    cam = crc.camera("OPENCV_FISHEYE", (160, 120), fx=40.0, fy=40.0, k1=0.02, k2=-0.004)
    with pytest.raises(InputError, match=r"OpenCV Pinhole sees fewer than half of the rays: .*within=1.3") as caught:
        crc.fit(cam, "OPENCV_PINHOLE")
    region = float(re.search(r"within=([\d.]+)", str(caught.value))[1])
    assert crc.fit(cam, "OPENCV_PINHOLE", within=region).mean < 0.5


@pytest.mark.parametrize(
    ("fitted", "message"),
    [
        (("FISHEYE", None, None), "unknown model 'FISHEYE'"),
        (("UCM", 4.0, None), "as an angle it must be above 0, up to pi"),
        (("UCM", (0, 0, 65, 10), None), "it must be \\(x0, y0, x1, y1\\) within the frame of 64 x 48 pixels"),
        (("UCM", [[1, 2], [3]], None), "it must be"),
        (("UCM", np.zeros((48, 64), bool), None), "no ray in the region: there is nothing to fit"),
        (("UCM", None, ("f",)), "unknown parameter of UCM 'f'"),
        (("UCM", None, ()), "has no parameter to fit"),
        (("UCM", None, 3), "free is 3: it must be names of parameters of UCM"),
        (("RAY_TABLE", None, None), "Ray Table lists its rays and has no formula to fit: choose another model"),
        (("SCANNER", None, None), "Scanner lists its beams and has no formula to fit"),
        (("STRIP", None, None), "the rays of Strip have no eye in common"),
        (("FOV", (32, 24, 33, 25), None), "sees 1 of 1 rays, too few to fit"),
    ],
)
def test_what_cannot_be_fitted_is_refused_in_one_line(fitted, message):
    cam = crc.camera("OPENCV_FISHEYE", (64, 48), fx=20.0, fy=20.0)
    model, region, free = fitted
    with pytest.raises(InputError, match=message) as caught:
        crc.fit(cam, model, within=region, free=free)
    assert "\n" not in str(caught.value)


def test_cameras_that_cannot_be_fitted_to_are_refused_in_one_line():
    rows = {"time_mode": "ROWS", "time_start": 1.0, "time_end": 2.0}
    behind = crc.camera("FISHEYE_EQUIDISTANT", (64, 48), shift_x=2.0)
    for cam, words in (
        (crc.camera("ORTHO", (64, 48)), "have no eye in common"),
        (crc.camera("PERSP", (64, 48), **rows), "pixels of camera 'Camera' have their own times"),
        (behind, "has no ray in the region"),
        (crc.camera("PERSP", (64, 48), shift_x=1e5), "no ray|viewing direction|too few"),
    ):
        with pytest.raises(InputError, match=words) as caught:
            crc.fit(cam, "UCM")
        assert "\n" not in str(caught.value)
    with pytest.raises(InputError, match="unknown setting of UCM 'xi': did you mean unified_xi"):
        crc.fit(crc.camera("PERSP", (64, 48)), "UCM", xi=1.0)
    with pytest.raises(InputError, match=r"^fx of camera 'Camera' is nan: it must be"):
        crc.fit(crc.camera("PERSP", (64, 48)), "UCM", fx=np.nan)
