"""The tests of beside_cycles.py, each kind in its own process: Cycles, EEVEE and Workbench render in turn."""

import subprocess
import sys
from pathlib import Path

import bpy
import pytest

from ..processes import ROOT


@pytest.mark.full
@pytest.mark.skipif(bool(bpy.app.binary_path), reason="a Blender of its own has no pytest to start")
@pytest.mark.parametrize("kind", ["edges and WORKBENCH", "edges and EEVEE", "checker"])
def test_in_a_process_of_its_own(kind):
    words = "-q", "--numprocesses", "0", "-m", "", "-p", "no:cacheprovider", "--timeout", "550", "-k", kind
    path = Path(__file__).with_name("beside_cycles.py")
    process = subprocess.run(
        [sys.executable, "-m", "pytest", *words, str(path)], cwd=ROOT, capture_output=True, text=True, timeout=580
    )
    assert process.returncode == 0, process.stdout[-3000:]
