"""What verify.py prints, and the status of both commands where rays are wrong."""

import json
import subprocess
import sys

import pytest

from .running import ROOT, script


def test_verify_prints_its_verdict(command, scene):
    done = command("verify", scene, "--frame", "1.25")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[0] == "Camera 'Top', Perspective, frame 1.25"
    assert done.stdout.splitlines()[-1] == "All reference checks passed"
    report = json.loads(command("verify", scene, "--json").stdout)
    assert all(finding["passed"] for finding in report["findings"])


FAULT = """
import sys
from dataclasses import replace
sys.argv = ["{command}.py", *{arguments}]
sys.path[:0] = [{scripts!r}, {addon!r}]
import bpy
from camera_ray_caster.core.cameras.perspective import Perspective
right = Perspective.rays
Perspective.rays = lambda self, x, y: right(self, x + 0.5, y)
from door import through
status = through("{command}")
Perspective.rays = right  # Blender 4.5 hangs at its end where a class holds this module
sys.exit(status)
"""


@pytest.mark.cases(1)
@pytest.mark.parametrize("command", ["cast", "verify"])
def test_a_ray_half_a_pixel_off_is_status_1(scene, tmp_path, command):
    arguments = [str(scene), *(["--output", str(tmp_path / "out")] if command == "cast" else [])]
    places = {"scripts": str(ROOT / "scripts"), "addon": str(ROOT / "addon")}
    code = FAULT.format(command=command, arguments=arguments, **places)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
    assert done.returncode == 1, done.stderr
    assert "FAILED" in done.stdout
    if command == "cast":
        assert json.loads((tmp_path / "out" / "report.json").read_text())["passed"] is False


@pytest.mark.cases(1)
@pytest.mark.parametrize("command", ["cast", "verify"])
def test_help_has_an_example(command):
    done = script(command, "--help")
    assert (done.returncode, done.stderr) == (0, "")
    assert f"{command}.py blend_scenes/spheres_and_planes.blend" in done.stdout
    assert "exit status" in done.stdout
