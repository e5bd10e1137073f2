"""Where shaders of cameras do not run, that is said before anything is rendered."""

from types import SimpleNamespace

import pytest

from camera_ray_caster.blender.cycles import device, to_cycles
from camera_ray_caster.core.records import InputError


@pytest.mark.parametrize(("kind", "works"), [("NONE", True), ("CUDA", False), ("HIP", False), ("OPTIX", True)])
def test_a_device_that_runs_no_shaders_of_cameras_is_named(osl, camera_scene, monkeypatch, kind, works):
    chosen = {"cycles": SimpleNamespace(preferences=SimpleNamespace(compute_device_type=kind))}
    context = SimpleNamespace(context=SimpleNamespace(preferences=SimpleNamespace(addons=chosen)))
    monkeypatch.setattr(device, "bpy", context)
    camera_scene.render.engine, camera_scene.cycles.device = "CAMERA_RAY_CASTER", "GPU"
    warnings = to_cycles(camera_scene)
    assert [line.partition(",")[0] for line in warnings] == ([] if works else [f"Cycles renders on {kind}"])
    camera_scene.cycles.device = "CPU"
    assert device.device_notes(camera_scene) == []


def test_a_device_that_is_not_there_is_refused_with_those_that_are(camera_scene, monkeypatch):
    card = SimpleNamespace(type="OPTIX", use=False)
    preferences = SimpleNamespace(
        compute_device_type="NONE", get_device_types=lambda context: [("NONE",), ("OPTIX",), ("HIP",)],
        get_devices_for_type=lambda kind: [card, SimpleNamespace(type="CPU")] if kind == "OPTIX" else [],
    )  # fmt: skip
    chosen = {"cycles": SimpleNamespace(preferences=preferences)}
    context = SimpleNamespace(context=SimpleNamespace(preferences=SimpleNamespace(addons=chosen)))
    monkeypatch.setattr(device, "bpy", context)
    with pytest.raises(InputError, match="no device HIP on this machine: choose one of CPU, OPTIX"):
        device.use_device(camera_scene, "HIP")
    assert (camera_scene.cycles.device, card.use) == ("CPU", False)
    device.use_device(camera_scene, "OPTIX")
    assert (camera_scene.cycles.device, card.use, preferences.compute_device_type) == ("GPU", True, "OPTIX")
    device.use_device(camera_scene, "CPU")
    assert camera_scene.cycles.device == "CPU"
