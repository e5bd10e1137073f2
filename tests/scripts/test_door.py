"""How scripts step into the add-on: which package an engine is of."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "scripts"))

import door


def test_the_package_of_an_engine_is_the_add_on_that_blender_has_enabled(blender):
    from camera_ray_caster.blender.engine.engine import CameraRayCaster

    assert door.package_of(CameraRayCaster) == "camera_ray_caster"
    installed = type("Engine", (), {"__module__": "bl_ext.user_default." + CameraRayCaster.__module__})
    assert door.package_of(installed) == "bl_ext.user_default.camera_ray_caster"
