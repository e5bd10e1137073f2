"""Cycles renders tables of rays: from arrays in the shader's text, and large ones from a texture beside the .blend."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from camera_ray_caster.blender.cycles import shader as cycles_shader
from camera_ray_caster.blender.verification import cycles_witness

from ...core.cameras.model_examples import camera
from ...core.cameras.table_examples import fisheye, stacked, without_eye

pytestmark = pytest.mark.usefixtures("osl")

TEXEL = 4e-7
"""What Cycles' reading of a texel may be off by, of 1: its weights are float32."""

LARGE = [
    pytest.param("no eye", dict(zip(("ray_origins", "ray_directions"), without_eye(240, 150), strict=True))),
    pytest.param("a round picture", {"ray_directions": fisheye(201, 201)}, marks=pytest.mark.full),
    pytest.param("lines", {"ray_directions": fisheye(201, 201), "ray_interpolation": "LINEAR"}, marks=pytest.mark.full),
]


def witnessed(cam, monkeypatch, change=lambda source: source):
    """Return the finding on a camera in Cycles, and the shader."""
    shaders, set_shader = [], cycles_witness.set_shader

    def kept(data, shader):
        shaders.append(shader)
        set_shader(data, replace(shader, source=change(shader.source)))

    monkeypatch.setattr(cycles_witness, "set_shader", kept)
    return cycles_witness.cycles_finding(cam), shaders[0]


@pytest.mark.parametrize(("name", "settings"), LARGE)
def test_a_large_table_is_read_texel_by_texel(name, settings, monkeypatch):
    finding, shader = witnessed(camera("RAY_TABLE", settings), monkeypatch)
    assert shader.textures
    assert all(Path(path).is_file() for path in shader.textures)
    assert len(shader.source) < 100_000
    assert finding.points > 1000
    assert finding.worst_radians < finding.bound_radians + 2 * TEXEL
    assert finding.median_radians < TEXEL


def test_a_file_that_is_missing_gives_no_rays(monkeypatch):
    """Not those of the one color that Cycles gives in its place."""
    table = stacked(np.linspace(-0.5, 0.5, 240)[None], np.linspace(-0.3, 0.3, 150)[:, None], -1.0)
    finding, _ = witnessed(camera("RAY_TABLE", {"ray_directions": table}), monkeypatch,
                           lambda source: source.replace(".exr", "_missing.exr"))  # fmt: skip
    assert not finding.passed
    assert np.isnan(finding.worst_radians)


def test_a_folder_that_cannot_be_written_is_refused(monkeypatch, tmp_path):
    monkeypatch.setattr(cycles_witness, "texture_folder", lambda: f"{tmp_path}/none")
    table = stacked(np.linspace(-0.5, 0.5, 240)[None], np.linspace(-0.3, 0.3, 150)[:, None], -1.0)
    with pytest.raises(cycles_shader.InputError, match=r"rays for Cycles cannot be written.*save the file in another"):
        cycles_witness.cycles_finding(camera("RAY_TABLE", {"ray_directions": table}))
