"""The shader of every camera: what its text depends on, and what its first line says."""

from dataclasses import replace

import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.shaders.camera_shader import camera_shader, read_mark

from ..cameras.model_examples import EXAMPLES, camera

CASES = [pytest.param(model.key, example) for model in MODELS for example in EXAMPLES[model.key]]


def shader(key, settings=(), **changes):
    return camera_shader(camera(key, dict(settings) | changes), "PERSP", (0.0, 0.0))


@pytest.mark.parametrize(("key", "settings"), CASES)
def test_every_example_has_a_shader_that_knows_itself(key, settings):
    written = shader(key, settings)
    mark = read_mark(written.source)
    assert mark is not None
    assert (mark.blender_type, mark.places) == ("PERSP", written.places)
    assert (written.values["frame_width"], written.values["frame_height"]) == camera(key, settings).raster.size


def test_settings_change_the_values_and_not_the_text():
    narrow, other = shader("PERSP", lens=30.0, shift_x=0.0), shader("PERSP", lens=70.0, shift_x=0.3)
    assert narrow.source == other.source
    assert narrow.values["window_center_x"] == 48 != other.values["window_center_x"]
    assert narrow.values["window_pitch_x"] * 30 == pytest.approx(other.values["window_pitch_x"] * 70)


def test_inputs_by_place_can_be_those_of_another_camera():
    """A field of view of 4 in place of 2 turns a constant of the formula into one that has to be an input."""
    plain, wide = shader("OMNIMAX"), shader("CROSS_SLIT", EXAMPLES["CROSS_SLIT"][0])
    assert plain.places
    both = camera_shader(camera("CROSS_SLIT", EXAMPLES["CROSS_SLIT"][0]), "PERSP", (0, 0), wide.places | {1})
    assert both.places == wide.places | {1}


def test_a_text_that_was_edited_is_not_ours():
    source = shader("OMNIMAX").source
    assert read_mark(source.replace("sqrt", "fabs")) is None
    assert read_mark("shader camera() {}") is None


def test_a_lens_opens_the_shader_and_a_pinhole_does_not():
    assert "cam:aperture_position" not in shader("PERSP").source
    assert 'noise("hash"' in shader("CAMERA_OBSCURA").source
    closed = replace(camera("CAMERA_OBSCURA"), aperture=None)
    assert "noise" not in camera_shader(closed, "PERSP", (0, 0)).source
