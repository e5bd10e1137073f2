"""The module with which Cycles reads a shader's inputs: found where Blender keeps it, with its own OpenImageIO."""

import pytest

from ..processes import SOURCE, blender_command, run

CONVERT = """
import sys

import bpy

sys.path[:0] = sys.argv[-2:]
import addon_utils

addon_utils.enable("cycles", default_set=True)
{before}
import camera_ray_caster as crc
from camera_ray_caster.blender.cycles import to_cycles

crc.register()
bpy.context.scene.render.engine = "CYCLES"  # Blender compiles by itself, too, as soon as a camera has a shader
try:
    to_cycles(bpy.context.scene)
except crc.InputError as error:
    print(error)
else:
    print("made of", len(bpy.context.scene.camera.data.cycles_custom.keys()) > 4)
crc.unregister()
"""


OTHER = "Blender's own OpenImageIO is needed"


@pytest.mark.cases(1)
@pytest.mark.parametrize(("before", "message"), [("", "made of True"), ("import OpenImageIO", OTHER)])
def test_another_openimageio_is_not_taken(osl, tmp_path, before, message):
    package = tmp_path / "OpenImageIO"
    package.mkdir()
    (package / "__init__.py").touch()
    script = tmp_path / "convert.py"
    script.write_text(CONVERT.format(before=before))
    output = run(*blender_command(script), str(tmp_path), str(SOURCE.parent))
    assert "Traceback" not in output
    assert any(line.startswith(message) for line in output.splitlines()), output
