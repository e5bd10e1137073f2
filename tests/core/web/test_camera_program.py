"""Programs of cameras: the rays of any settings are those of a camera with these settings, in numpy and in node."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.errors.ray_errors import world_rays
from camera_ray_caster.core.maths.recording import NUMPY
from camera_ray_caster.core.shaders.javascript import RUNTIME
from camera_ray_caster.core.web.camera_program import holds
from camera_ray_caster.core.web.formula_values import values_of
from camera_ray_caster.core.web.page import example
from camera_ray_caster.core.web.split import RAY, functions

from ..shaders.javascript import NUMBERS, node
from .programs import KEYS, program, settings

PIXELS = 40


def pixels(camera):
    """Pixel coordinates all over the frame."""
    generator = np.random.default_rng(3)
    return tuple(generator.uniform(0.0, side, PIXELS) for side in camera.raster.size)


def variant_of(key, values):
    """The variant whose conditions hold."""
    chosen = program(key).choices
    for variant in program(key).variants:
        if all(variant.choices[name] == values[name] for name in chosen) and holds(variant.parts, values):
            return variant
    raise AssertionError(f"no variant for {values}")


def check(camera, x, y, rays):
    """Compare rays, (6, n), with a camera's: both may have the error that its bound allows."""
    with np.errstate(all="ignore"):  # pixels without a ray
        expected = np.array([np.broadcast_to(value, x.shape) for vector in camera.model.rays(x, y) for value in vector])
        bounds = world_rays(camera, x, y)
    assert np.array_equal(np.isnan(rays[3]), np.isnan(expected[3]))
    for rows, error in ((slice(0, 3), bounds.origin_error), (slice(3, 6), bounds.direction_error)):
        assert not (np.linalg.norm(rays[rows] - expected[rows], axis=0) > 2 * error).any()


@pytest.mark.cases(1)
@pytest.mark.parametrize("key", KEYS)
def test_rays_of_any_settings_are_the_cameras(key):
    count = 0
    for values, camera in settings(key):
        parts, (x, y) = variant_of(key, values).parts, pixels(camera)
        arithmetic = NUMPY | {"parameter": lambda value, name, values=values: values[name]}
        with np.errstate(all="ignore"):
            kept = parts.first.evaluate(arithmetic, ())[parts.conditions :]
            rays = parts.second.evaluate(arithmetic, (x, y, *kept))
        check(camera, x, y, np.array([np.broadcast_to(values, x.shape) for values in rays[:RAY]], float))
        count += 1
    assert count


@pytest.mark.full
@pytest.mark.parametrize("key", KEYS)
def test_javascript_gives_the_same_rays(key):
    cases = list(settings(key))
    variants = [variant_of(key, values) for values, _ in cases]
    places = [np.transpose(pixels(camera)).tolist() for _, camera in cases]
    calls = ",\n".join(
        f"run({', '.join(functions(variant.parts).values())}, {json.dumps(values)}, {json.dumps(place)})"
        for variant, (values, _), place in zip(variants, cases, places, strict=True)
    )
    run = "function run(prepare, rays, values, s, places) { const k = prepare(s); "
    run += "return places.map(([x, y]) => rays(k, x, y)); }"
    results = node(f"{RUNTIME}\n{run}\nconsole.log(JSON.stringify([{calls}], {NUMBERS}));")
    for (_, camera), rays in zip(cases, results, strict=True):
        check(camera, *pixels(camera), np.array([[float(str(value)) for value in ray] for ray in rays]).T)


def test_the_matrix_in_a_formula_is_of_the_frame_s_pixels_not_of_the_calibrated_picture_s():
    size = {"calibration_width": 1920, "calibration_height": 1080}
    camera = crc.camera("OPENCV_FISHEYE", (640, 360), fx=1500.0, fy=1200.0, cx=929.5, cy=539.5, **size)
    values = values_of(camera.model, camera.record, camera.raster, 100.0, 300.0)
    assert [values[name][0] for name in ("fx", "fy", "cx", "cy")] == pytest.approx([500, 400, 309.5, 179.5])


@pytest.mark.parametrize(("key", "size"), [
    ("PERSP", (640, 360)), ("FISHEYE_EQUIDISTANT", (360, 360)), ("EQUIRECTANGULAR", (640, 320)), ("SCANNER", (512, 64)),
])  # fmt: skip
def test_a_camera_of_the_page_has_a_frame_that_stretches_nothing(key, size):
    assert example(next(model for model in MODELS if model.key == key)).raster.size == size


def test_the_angle_in_a_fisheye_s_formula_is_its_own():
    lens, fisheye = crc.camera("PERSP", (64, 48)), crc.camera("FISHEYE_EQUIDISTANT", (64, 48), fisheye_fov=2.0)
    assert values_of(lens.model, lens.record, lens.raster, 1.0, 2.0)["fov"][0] == pytest.approx(2 * np.arctan(18 / 50))
    assert "fov" not in values_of(fisheye.model, fisheye.record, fisheye.raster, 1.0, 2.0)


@pytest.mark.parametrize(
    ("key", "names"),
    [
        ("STRIP", {"x_A", "x_B", "A", "B", "n_A", "n_B"}), ("FTHETA", {"x_0", "s_y", "k1", "theta"}),
        ("RAY_TABLE", {"a", "g", "i", "j", "m", "n"}),
        ("REAL_LENS", {"h", "z", "q", "unit", "pitch"}),
    ],
)  # fmt: skip
def test_what_a_table_or_an_iteration_gives_to_a_formula_is_that_of_the_camera(key, names):
    values, camera = next(iter(settings(key)))
    variant, x, y = variant_of(key, values), 0.3 * camera.raster.width, 0.4 * camera.raster.height
    assert names <= {name for name, _ in variant.names}
    inputs, parts = NUMPY | {"parameter": lambda value, name: values[name]}, variant.parts
    kept = parts.first.evaluate(inputs, ())[parts.conditions :]
    numbers, at = parts.second.evaluate(inputs, (x, y, *kept))[RAY:], 0
    expected = values_of(camera.model, camera.record, camera.raster, x, y)
    for name, count in variant.names:
        np.testing.assert_allclose(numbers[at : at + count], expected[name], rtol=1e-12, atol=1e-14, err_msg=name)
        at += count


def test_a_scanner_has_the_knobs_that_turn_its_rays():
    assert [knob.name for knob in program("SCANNER").knobs] == ["scanner_start", "scanner_sweep"]
