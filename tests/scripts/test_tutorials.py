"""The tutorials that need Blender: their commands and their code run, block after block, in a folder of their own."""

import os
import re
import subprocess
import sys

import pytest

from .running import ROOT

pytestmark = pytest.mark.full
RUN = """
import re, subprocess, sys
for kind, block in re.findall(r"^```(python|bash)\\n(.*?)^```$", open(sys.argv[1]).read(), re.MULTILINE | re.DOTALL):
    if kind == "bash":
        subprocess.run(["bash", "-ec", block], check=True)
    else:
        exec(compile(block, sys.argv[1], "exec"))
"""


def run(page, folder):
    """Run a page's blocks in a folder from which the repository is seen as from itself; return what they print."""
    for name in ("blend_scenes", "scripts"):
        (folder / name).symlink_to(ROOT / name)
    programs = folder / "bin"
    programs.mkdir()
    (programs / "python").write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    (programs / "python").chmod(0o755)
    environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT / "addon")}
    words = [sys.executable, "-c", RUN, str(ROOT / "docs" / "tutorials" / page)]
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_data_set_in_ten_minutes(tmp_path):
    output = run("data_set.md", tmp_path)
    off, share, points = re.search(r"back within (\S+) pixels; (\d+)% of (\d+) points", output).groups()
    assert float(off) < 1e-6
    assert int(share) > 90
    assert int(points) > 10_000
    assert "5 OpenCV Fisheye" in output
    for name in ("toys/annotations.json", "toys/reader.py", "nerfstudio/transforms.json", "colmap/sparse"):
        assert (tmp_path / "out" / name).exists(), name


def test_a_strange_camera_in_cycles(tmp_path):
    output = run("strange_camera_in_cycles.md", tmp_path)
    assert output.rstrip().endswith("CUSTOM Cross-Slit")
    for name in ("cycles/toys_cross_slit.exr", "toys_in_cycles.blend"):
        assert (tmp_path / "out" / name).is_file(), name
