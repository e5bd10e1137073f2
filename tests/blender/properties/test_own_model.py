"""A model of somebody's own in Blender: in the menu with its setting as soon as it is added."""

from pathlib import Path

import pytest

from ..processes import SOURCE, blender_command, run

USE = """
import sys
sys.path[:0] = [{addon!r}, {folder!r}]
import bpy
import camera_ray_caster as crc
from equal_area import EqualArea

crc.register()
crc.register_model(EqualArea)
bpy.ops.object.camera_add()
scene = bpy.context.scene
scene.camera = bpy.context.object
own = scene.camera.data.camera_ray_caster
own.model, own.equal_area_top = "EQUAL_AREA", 1.25
item = type(own).bl_rna.properties["model"].enum_items["EQUAL_AREA"]
camera = crc.read_camera(scene)
print("seen:", item.value, camera.model.key, camera.settings, camera.rays().valid.all(), len(crc.verify(scene)) > 0)
crc.unregister()
print("without:", crc.read_camera(scene).model.key)
"""


@pytest.mark.full
def test_it_is_in_the_menu_and_is_read_with_its_setting(tmp_path):
    script = tmp_path / "use.py"
    folder = Path(__file__).parents[2] / "core" / "library"
    script.write_text(USE.format(addon=str(SOURCE.parent), folder=str(folder)))
    output = run(*map(str, blender_command(script)), BLENDER_USER_RESOURCES=str(tmp_path / "resources"))
    assert "seen: 1001 EQUAL_AREA {'equal_area_top': 1.25} True True" in output
    assert "without: EQUAL_AREA" in output
