"""Cameras whose numbers Blender's own float32 hardly carries: no witness disagrees where it is the one that fails."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.blender.verification.check import verified, verify_camera
from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.report.report import as_data, as_lines
from camera_ray_caster.core.report.witness import FRAME, MATRIX, NOT_CARRIED, VIEW

VALUES = [
    sign * value for value in (1e-45, 1e-38, 1e-20, 1e-6, 1e6, 1e20, 1e30, 3.4e38, float("inf")) for sign in (1, -1)
]


@pytest.fixture(params=["PERSP", "ORTHO"])
def scene(request):
    bpy.ops.object.camera_add(rotation=(0.7, 0.1, 0.4))
    made = bpy.context.scene
    made.camera = bpy.context.object
    made.camera.data.type = request.param
    made.render.resolution_x, made.render.resolution_y = 37, 23
    return made


@pytest.mark.parametrize("value", VALUES)
@pytest.mark.parametrize("name", ["lens", "ortho_scale", "sensor_width", "shift_x", "scale", "location"])
def test_a_number_is_carried_or_refused_in_one_line(scene, name, value):
    camera = scene.camera
    if name in ("scale", "location"):
        setattr(camera, name, (value,) * 3)
    else:
        setattr(camera.data, name, value)
    refusal = ""
    try:
        rays = read_camera(scene).rays()
    except InputError as error:
        refusal = str(error)
    else:
        assert np.isfinite(rays.directions).all()
        assert all(finding.passed for finding in verify_camera(scene))
    assert "\n" not in refusal


@pytest.mark.parametrize("scale", [1e-38, 1e-20, 1e20])
def test_a_scale_that_blender_cannot_invert_is_not_compared_by_the_function_that_inverts_it(scene, scale):
    scene.camera.scale = (scale,) * 3
    report = verified(scene)
    not_compared = {finding.witness: finding.not_compared for finding in report.findings}
    assert not_compared == {FRAME: "", MATRIX: "", VIEW: NOT_CARRIED, "round trip": ""}
    assert report.passed
    assert any(VIEW in line and NOT_CARRIED in line for line in as_lines(report))
    assert [finding["not_compared"] for finding in as_data(report)["findings"]] == list(not_compared.values())
