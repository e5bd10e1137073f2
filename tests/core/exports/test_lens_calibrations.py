"""Cameras as calibrations: whatever a camera is said to be has its rays."""

import numpy as np
import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.exports.lens_calibrations import calibrations
from camera_ray_caster.core.programs.parts.lens import ANGLES

from ..cameras.model_examples import EXAMPLES, IDENTITY, camera
from .shots import CAMERAS


def pixels_of(lens, cam, points):
    """Where a calibration sees points in the camera's frame."""
    frame = dict(zip(("resolution_x", "resolution_y"), cam.model.size, strict=True))
    if lens.model == "EQUIRECTANGULAR":
        x, y, z = points.T
        left, right, bottom, top = (lens.settings[name] for name in ANGLES)
        across = (np.arctan2(x, -z) - left) / (right - left)
        up = (np.arctan2(y, np.hypot(x, z)) - bottom) / (top - bottom)
        return np.stack((across * frame["resolution_x"], up * frame["resolution_y"]), axis=-1)
    size = {"calibration_width": 0, "calibration_height": 0}
    return camera(lens.model, frame | size | lens.settings).model.project(points)


@pytest.mark.parametrize("key", [model.key for model in MODELS])
def test_a_calibration_of_a_camera_has_its_rays(key):
    examples = [*EXAMPLES[key], *(settings for model, settings in CAMERAS.values() if model == key)]
    for settings in examples:
        there = camera(key, {**settings, "matrix_world": IDENTITY})
        width, height = there.model.size
        x, y = np.random.default_rng(5).uniform(0, 1, (2, 300)) * [[width], [height]]
        rays = there.rays_at(x, y)
        seen = there.model.project(rays.directions)
        for lens in calibrations(there):
            apart = pixels_of(lens, there, rays.directions) - seen
            if lens.model == "EQUIRECTANGULAR":  # a whole turn is none
                turn = 2 * np.pi * width / (lens.settings[ANGLES[1]] - lens.settings[ANGLES[0]])
                apart[:, 0] -= turn * np.rint(apart[:, 0] / turn)
            assert np.nanmax(np.abs(apart), initial=0.0) < 1e-9 * width, lens.model


def test_the_models_that_are_calibrations_of_others():
    formats = {
        model.key: [lens.model for lens in calibrations(camera(model.key, EXAMPLES[model.key][0]))] for model in MODELS
    }
    others = {key: models for key, models in formats.items() if models not in ([], [key])}
    assert others == {
        "PERSP": ["OPENCV_PINHOLE"],
        "FISHEYE_EQUIDISTANT": ["OPENCV_FISHEYE"],
        "FISHEYE_STEREOGRAPHIC": ["UCM", "EUCM"],
        "UCM": ["UCM", "EUCM"],
    }
