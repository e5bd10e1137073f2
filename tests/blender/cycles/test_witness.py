"""Cycles as a witness of every model: a shader's rays are the camera's own, between pixel centers and on them."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.blender.verification import cycles_witness
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.conventions import EPS32

from ...core.cameras.model_examples import EXAMPLES, SHIFTED, camera

CASES = [pytest.param(model.key, example) for model in MODELS for example in EXAMPLES[model.key]]

ORDINARY = 2e-6
"""Radians: what float32 makes of rays where no number is lost, with sines and cosines of Cycles' own precision."""

LOST = 10 * ORDINARY
"""Radians: of rays in which float32 loses numbers, at the rims of mirror balls, fisheyes and some calibrated lenses."""

pytestmark = pytest.mark.usefixtures("osl")


@pytest.mark.parametrize(("key", "settings"), CASES)
def test_every_example_is_what_cycles_renders(key, settings):
    finding = cycles_witness.cycles_finding(camera(key, settings))
    assert finding.passed, finding
    assert finding.points > 1000
    assert finding.median_radians <= ORDINARY / 2
    assert finding.worst_radians <= ORDINARY or finding.bound_radians > LOST


FAULTS = {
    "rows from the top": ("(place[1]) * frame_height", "(1 - place[1]) * frame_height"),
    "half a pixel": ("* frame_width,", "* frame_width + 0.5,"),
    "a thousandth of a pixel": ("* frame_width,", "* frame_width + 0.001,"),
    "shift twice": ("point(frame_shift_x,", "point(2 * frame_shift_x,"),
    "no end of the picture": ("throughput = 0;", "direction = vector(0, 0, 1);"),
    "a mirrored direction": ("normalize(vector(", "normalize(vector(-"),
    "an origin that is off": ("position = point(", "position = point(0.001 + "),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_in_the_shader_is_found(fault, monkeypatch):
    text, wrong = FAULTS[fault]
    set_shader = cycles_witness.set_shader

    def set_wrong(data, shader):
        assert text in shader.source
        set_shader(data, replace(shader, source=shader.source.replace(text, wrong)))

    monkeypatch.setattr(cycles_witness, "set_shader", set_wrong)
    assert not cycles_witness.cycles_finding(camera("FISHEYE_EQUIDISTANT", SHIFTED)).passed


def test_nothing_is_left_behind(blender):
    def names():
        return {item.name for kind in kinds for item in getattr(blender.data, kind)} - {"Render Result"}

    kinds = "scenes", "objects", "meshes", "materials", "cameras", "texts", "images"
    before = names()
    cycles_witness.cycles_finding(camera("OMNIMAX"))
    assert names() == before


def test_the_bound_is_float32s_own():
    """At the center of a plain camera: a few roundings of a unit; where a fisheye ends it grows with the slope."""
    middle = cycles_witness.ray_bounds(camera("PERSP"), np.array(48.0), np.array(27.0), (0.0, 0.0))
    assert 8 * EPS32 < middle.direction < 40 * EPS32
    rim = cycles_witness.ray_bounds(camera("FISHEYE_ORTHOGRAPHIC"), np.array(48 + 26.99), np.array(27.0), (0.0, 0.0))
    assert rim.direction > 10 * middle.direction


SHEARED = [[0.5, 0.2, -0.1, 1.0], [0.1, -1.5, 0.3, 2.0], [0.0, 0.4, 2.0, -3.0], [0, 0, 0, 1]]


@pytest.mark.parametrize("key", ["PERSP", "OMNIMAX", "EQUIRECTANGULAR", "CROSS_SLIT"])
def test_a_sheared_and_mirrored_camera_is_what_cycles_renders(key):
    finding = cycles_witness.cycles_finding(camera(key, EXAMPLES[key][0] | {"matrix_world": SHEARED}))
    assert finding.passed, finding
