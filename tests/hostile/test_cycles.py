"""Registering, rendering and unregistering again and again keeps nothing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
STATUS = Path("/proc/self/status")

CYCLES = """
import sys
import bpy
import camera_ray_caster
from tests.hostile.inputs.parts import small_scene

def resident():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))

camera_ray_caster.register()
small_scene().render.engine = "CAMERA_RAY_CASTER"
for cycle in range(int(sys.argv[1])):
    camera_ray_caster.register()
    bpy.ops.render.render()
    camera_ray_caster.unregister()
    if cycle in (int(sys.argv[1]) // 5, int(sys.argv[1]) - 1):
        print("RSS", resident(), flush=True)
camera_ray_caster.register()
"""


@pytest.mark.hostile
@pytest.mark.skipif(not STATUS.exists(), reason="this system does not say how much memory is resident")
def test_a_thousand_cycles_keep_no_memory():
    places = os.environ | {"PYTHONPATH": os.pathsep.join((str(ROOT / "addon"), str(ROOT)))}
    words = [sys.executable, "-c", CYCLES, "1000"]
    done = subprocess.run(words, env=places, capture_output=True, text=True, timeout=600)
    warm, last = (int(line.split()[1]) for line in done.stdout.splitlines() if line.startswith("RSS"))
    assert last <= 1.02 * warm, f"{warm} kB after 200 cycles, {last} kB after 1,000"
