"""The script in this Blender, whichever it is: pip's bpy runs it as a program, Blender as a script behind --python."""

import json
import re
import subprocess

import pytest

from ..processes import ROOT, script_command

SCENE = ROOT / "blend_scenes" / "orthographic.blend"


@pytest.fixture
def cast(blender):
    """A function that runs scripts/cast.py with arguments on the scene to its end."""
    words = script_command("cast.py", SCENE)
    return lambda *arguments: subprocess.run([*words, *arguments], capture_output=True, text=True, timeout=300)


def test_cast_leaves_its_three_files(cast, tmp_path):
    done = cast("--passes", "depth", "--output", str(tmp_path))
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["orthographic.exr", "orthographic.png", "report.json"]
    assert json.loads((tmp_path / "report.json").read_text())["passed"] is True
    assert "Reference check" in done.stdout


def test_no_option_is_one_that_cycles_reads_before_any_script():
    """In Blender its add-on takes the beginning of an option of its own for that option, and ends Blender."""
    folder = ROOT / "addon" / "camera_ray_caster" / "blender" / "terminal"
    names = [name for file in folder.glob("*.py") for name in re.findall(r'"(--[a-z][a-z-]*)"', file.read_text())]
    assert len(names) > 20
    assert not [name for name in names for word in ("--cycles-device", "--cycles-print-stats") if word.startswith(name)]


def test_bad_input_is_status_2(cast, tmp_path):
    done = cast("--camera", "Nobody's", "--output", str(tmp_path))
    assert done.returncode == 2
    assert "has no camera \"Nobody's\"; its cameras are: 'Camera'" in done.stderr
    assert "Traceback" not in done.stderr + done.stdout
