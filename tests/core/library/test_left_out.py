"""Settings that only make sense together, of every model: each pair by the rule beside its declaration."""

import re

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.parts.left_out import DECLARED, MIDDLE, NEEDED, OF_FRAME, SAME
from camera_ray_caster.core.cameras.parts.settings import Coefficients

SIZE = 80, 48
"""Of another shape than the declared calibrated picture, 16 : 9."""

ENDS = [("x", "y"), ("min", "max"), ("low", "high"), ("bottom", "top"), ("width", "height")]
ALONE = {
    "shift_x": "an offset on one axis", "tau_x": "a tilt about one axis", "sensor_width": "sensor_fit says which",
    "longitude_min": "the other end is that of the sphere", "latitude_min": "the other end is that of the sphere",
    "pan_min": "the other end is that of the full turn",
    "central_cylindrical_range_u_min": "the other end is that of the full turn",
}  # fmt: skip
"""Pairs by their names of which each setting makes sense alone, and why."""
FULL = {"fx": 50.0, "fy": 60.0, "cx": 30.0, "cy": 20.0, "calibration_width": 160, "calibration_height": 96}


def pairs_by_name(model):
    """The pairs of settings whose names differ only by the words of two ends."""
    names = {setting.name for setting in model.SETTINGS}
    for first, second in ENDS:
        for name in sorted(names):
            for other in {re.sub(rf"(^|_){first}($|_)", rf"\g<1>{second}\g<2>", name), f"{name[:-1]}{second}"}:
                if other != name and other in names and (name.endswith(first) or f"_{first}" in name):
                    yield name, other


@pytest.mark.one_for_each("model")
@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_every_pair_has_a_rule(model):
    declared = {setting.name: setting for setting in model.SETTINGS}
    for name, other in pairs_by_name(model):
        ruled = declared[name].partner == other or declared[name].left_out == MIDDLE
        assert ruled or name in ALONE, f"{name} and {other}: say what is left out, or add {name} to ALONE"
    for setting in declared.values():
        if setting.partner:
            assert declared[setting.partner].partner == setting.name
            assert declared[setting.partner].left_out == setting.left_out


RULED = [
    (model, setting)
    for model in MODELS
    for setting in model.SETTINGS
    if setting.partner or setting.left_out != DECLARED
]


def given_with(model, setting):
    """Settings of a model with a calibration, or all that the others of a pair need, without ``setting``."""
    names = {item.name for item in model.SETTINGS}
    full = {name: value for name, value in FULL.items() if name in names}
    full |= {item.name: item.default for item in model.SETTINGS if item.left_out == NEEDED and not item.used_with}
    if "ftheta_angle_to_radius" in names:
        full["ftheta_angle_to_radius"] = "0 50"
    if setting.partner in names and setting.partner not in full:
        other = next(item for item in model.SETTINGS if item.name == setting.partner)
        full[other.name] = other.default
    if setting.name == "ftheta_radius_to_angle":
        full["ftheta_reference"] = "RADIUS_TO_ANGLE"
        del full["ftheta_angle_to_radius"]
    full.pop(setting.name, None)
    return full


@pytest.mark.parametrize(("model", "setting"), RULED, ids=[f"{model.key}-{setting.name}" for model, setting in RULED])
def test_what_is_left_out_follows_or_is_refused(model, setting):
    explicit = given_with(model, setting)
    if setting.left_out == SAME:
        cam = crc.camera(model.key, SIZE, **explicit)
        assert cam.settings[setting.name] == explicit[setting.partner]
    elif setting.left_out == MIDDLE:
        cam = crc.camera(model.key, SIZE, **explicit)
        side = explicit["calibration_width" if setting.name == "cx" else "calibration_height"]
        assert cam.settings[setting.name] == (side - 1) / 2
    else:
        assert setting.left_out in (DECLARED, NEEDED, OF_FRAME)
        with pytest.raises(crc.InputError, match=setting.name):
            crc.camera(model.key, SIZE, **explicit)


def test_nothing_belongs_to_a_picture_of_another_size():
    fisheye = crc.camera("OPENCV_FISHEYE", (848, 800), fx=285.0)
    np.testing.assert_array_equal(fisheye.K, [[285, 0, 423.5], [0, 285, 399.5], [0, 0, 1]])
    half = crc.camera("OPENCV_PINHOLE", (640, 480), fy=250.0, calibration_width=320, calibration_height=240)
    np.testing.assert_allclose(half.K, [[500, 0, 319.5], [0, 500, 239.5], [0, 0, 1]], rtol=1e-15)
    with pytest.raises(crc.InputError, match="cx without fx"):
        crc.camera("UCM", (640, 480), cx=300.0)


CALIBRATED = [model for model in MODELS if any(setting.name == "calibration_unit" for setting in model.SETTINGS)]


@pytest.mark.one_for_each("model")
@pytest.mark.parametrize("model", CALIBRATED, ids=lambda model: model.key)
@pytest.mark.parametrize("size", [(64, 48), (48, 64)])
def test_the_declared_lens_has_square_pixels_in_any_frame(model, size):
    """A point as far to the right as another is above the axis lies as many pixels away; the field of view of the
    longer side is that of the declared picture.
    """
    cam = crc.camera(model.key, size)
    right, up = cam.project([(0.1, 0.0, -1.0), (0.0, 0.1, -1.0)]) - np.divide(size, 2)
    assert right[0] == pytest.approx(up[1], rel=1e-12)
    wide = crc.camera(model.key, (1920, 1080)).project([(0.1, 0.0, -1.0)])[0, 0] - 960
    assert right[0] == pytest.approx(wide * 64 / 1920, rel=1e-9)
    again = crc.camera(model.key, size, **cam.settings)
    np.testing.assert_array_equal(again.rays().directions, cam.rays().directions)


@pytest.mark.parametrize(
    ("key", "settings", "message"),
    [
        ("OPENCV_PINHOLE", {"lens": 35.0}, "lens of OPENCV_PINHOLE has no effect unless calibration_unit is"),
        ("OPENCV_PINHOLE", {"fx": 50.0, "shift_x": 0.1}, "shift_x of OPENCV_PINHOLE has no effect"),
        ("UCM", {"fx": 50.0, "calibration_unit": "MILLIMETERS"}, "fx of UCM has no effect"),
        ("FTHETA", {"ftheta_radius_to_angle": "0 0.01"}, "unless ftheta_reference is 'RADIUS_TO_ANGLE'"),
        ("SCANNER", {"scanner_device": "VLP_16", "scanner_sweep": 1.0}, "unless scanner_device is 'CUSTOM'"),
        ("SCANNER", {"scanner_low": 0.0, "scanner_high": 0.1, "scanner_elevations": "1 2"}, "scanner_elevations is ''"),
    ],
)
def test_a_setting_without_effect_is_refused(key, settings, message):
    with pytest.raises(crc.InputError, match=message):
        crc.camera(key, SIZE, **settings)


def test_coefficients_grow_with_the_picture_by_their_declaration():
    """The rays of a lens in a frame twice as large, whose polynomials are declared by ``grows``."""
    for model in MODELS:
        for setting in (
            setting for setting in model.SETTINGS if isinstance(setting, Coefficients) and setting.left_out == NEEDED
        ):
            reference = dict(setting.used_with)
            rays = [crc.camera(model.key, (side, side), **reference).rays() for side in (9, 27)]
            np.testing.assert_allclose(rays[0].directions, rays[1].directions[1::3, 1::3], rtol=0, atol=1e-12)
