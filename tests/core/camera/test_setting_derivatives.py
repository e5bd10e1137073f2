"""Derivatives of pixels by the settings, against differences of cameras whose settings are changed."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.parts.parameters import with_parameters
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import EXAMPLES, camera

CASES = [(model, k) for model in MODELS if model.differentiable for k in range(len(EXAMPLES[model.key]))]
STEP = 2.0**-9
"""Change of a number over its size: the difference errs by about STEP^4 of it, and by EPS of a pixel over STEP."""


def moved(cam, index, step):
    """The pixels' function of the camera whose parameter at an index is changed by a step."""
    values = list(cam.parameters.values())
    values[index] += step
    return camera_from(with_parameters(cam.model.SETTINGS, cam.record, values)).project


def slope(cam, index, size, points):
    """The derivative of pixels by a number, from four cameras, or on one side from five where there are no others; 0 if
    the number cannot be another.
    """
    central, after = [(-2, 1), (-1, -8), (1, 8), (2, -1)], [(0, -25), (1, 48), (2, -36), (3, 16), (4, -3)]
    for weights in (central, after, [(-k, -w) for k, w in after]):
        try:
            parts = [weight * moved(cam, index, k * size)(points) for k, weight in weights]
        except InputError:
            continue
        return sum(parts) / (12 * size)
    return np.zeros((len(points), 2))


@pytest.mark.one_for_each("model")
@pytest.mark.parametrize(("model", "k"), CASES, ids=[f"{model.key}-{k}" for model, k in CASES])
def test_they_are_the_limits_of_differences(model, k):
    cam = camera(model.key, EXAMPLES[model.key][k])
    rng = np.random.default_rng(k)
    x, y = (rng.uniform(0.1, 0.9, 40) * side for side in cam.raster.size)
    rays = cam.rays_at(x, y)
    points = (rays.origins + rng.uniform(1, 9, (40, 1)) * rays.directions)[rays.valid]
    pixels, derivatives = cam.project(points, jacobian="settings")
    np.testing.assert_array_equal(pixels, cam.project(points))
    names = list(cam.parameters)
    assert derivatives.shape == (len(points), 2, len(names))
    for column, name in enumerate(names):
        size = STEP * min(max(abs(cam.parameters[name]), 1e-3), 1.0)
        size = min(size, 0.02 / max(np.nanmax(np.abs(derivatives[..., column]), initial=0.0), 1e-9))
        expected = slope(cam, column, size, points)
        kept = np.isfinite(expected)
        assert kept.mean() > 0.5, name
        error = np.abs(derivatives[..., column] - expected)[kept]
        assert error.max() <= 1e-7 * (1 + np.abs(expected[kept]).max()) + 1e-11 / size, (name, error.max(), size)


def test_they_are_opencv_s_where_no_distortion_is_left_out_for_being_0():
    lens = {"fx": 80.0, "fy": 82.0, "cx": 47.0, "cy": 25.0, "calibration_width": 96, "calibration_height": 54}
    cam = camera("OPENCV_PINHOLE", lens)
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, 9), np.linspace(-0.3, 0.3, 7))
    points = np.stack((x, y, np.ones_like(x)), axis=-1).reshape(-1, 3)
    some = np.array([0.1, -0.05, 1e-3, -2e-3, 0.02, 0.01, 0, -0.01, 1e-3, 0, 2e-3, 0, 0.05, 0])
    for distortion in (np.zeros(14), some):
        names = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y")
        cam = camera("OPENCV_PINHOLE", lens | dict(zip(names, distortion.tolist(), strict=True)))
        theirs = cv2.projectPoints(points, np.zeros(3), np.zeros(3), cam.K, distortion)[1]
        derivatives = cam.project(points * (1, -1, -1), jacobian="settings")[1]
        columns = [list(cam.parameters).index(name) for name in ("fx", "fy", "cx", "cy", *names)]
        ours = derivatives[..., columns] * np.array((1, -1))[:, None]  # y down
        np.testing.assert_allclose(ours, theirs[:, 6:].reshape(-1, 2, 18), atol=1e-12 * 80)


def test_a_file_s_numbers_count_and_words_and_whole_numbers_do_not():
    cam = camera("FTHETA", {"ftheta_angle_to_radius": "0 28 0.5"})
    names = list(cam.parameters)
    assert [name for name in names if "[" in name] == [
        "ftheta_angle_to_radius[0]", "ftheta_angle_to_radius[1]", "ftheta_angle_to_radius[2]",
        "ftheta_radius_to_angle[0]", "ftheta_radius_to_angle[1]",
    ]  # fmt: skip
    assert names[-4:] == ["ftheta_c", "ftheta_d", "ftheta_e", "ftheta_max_angle"]
    assert "calibration_width" not in names
    assert "ftheta_reference" not in names


def test_what_has_no_pixel_has_no_derivatives_and_what_cannot_be_asked_is_refused_in_one_line():
    cam = camera("PERSP")
    pixel, derivatives = cam.project([[0.0, 0.0, 1.0], [np.nan, 0.0, -1.0], [0.1, 0.0, -1.0]], jacobian="settings")
    assert np.isnan(pixel[:2]).all()
    assert np.isnan(derivatives[:2]).all()
    assert np.isfinite(derivatives[2]).all()
    between = replace(cam, model=replace(cam.model, window=replace(cam.model.window, pitch_x=0.01)))
    for other, jacobian, words in (
        (cam, "setting", "jacobian is 'setting': it must be True, False or 'settings'"),
        (between, "settings", "lies between two that were read"),
    ):
        with pytest.raises(InputError, match=words) as caught:
            other.project([0.0, 0.0, -1.0], jacobian=jacobian)
        assert "\n" not in str(caught.value)
