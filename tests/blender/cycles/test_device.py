"""Where shaders of cameras do not run, that is said before anything is rendered."""

from types import SimpleNamespace

import pytest

from camera_ray_caster.blender.cycles import device, to_cycles


@pytest.mark.parametrize(("kind", "works"), [("NONE", True), ("CUDA", False), ("HIP", False), ("OPTIX", True)])
def test_a_device_that_runs_no_shaders_of_cameras_is_named(osl, camera_scene, monkeypatch, kind, works):
    chosen = {"cycles": SimpleNamespace(preferences=SimpleNamespace(compute_device_type=kind))}
    context = SimpleNamespace(context=SimpleNamespace(preferences=SimpleNamespace(addons=chosen)))
    monkeypatch.setattr(device, "bpy", context)
    camera_scene.render.engine, camera_scene.cycles.device = "CAMERA_RAY_CASTER", "GPU"
    said = to_cycles(camera_scene)
    assert [line.partition(",")[0] for line in said] == ([] if works else [f"Cycles renders on {kind}"])
    camera_scene.cycles.device = "CPU"
    assert device.said_of_device(camera_scene) == []
