"""How the scripts end where they are stopped early, or where nobody takes what they print: without a traceback."""

import os
import re
import signal
import subprocess
import sys
import time
from random import Random

import pytest

from .running import ROOT
from .running import start as start_python

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows ends a process without telling it")
SCENE = str(ROOT / "blend_scenes" / "empty.blend")
WORDS = {
    "cast": [SCENE, "--passes", "depth"],
    "environment": [],
    "export": ["--help"],
    "make_docs": ["--help"],
}
"""A script of each kind, and what lets it print something soon: with Blender or without, with options or none."""
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}


def start(name, folder, stdout=subprocess.PIPE, action=signal.SIG_DFL):
    """Start a script in a folder, with what lets it print something soon."""
    script = ROOT / "scripts" / f"{name}.py"
    return start_python(script, *WORDS[name], action=action, stdout=stdout, cwd=folder, env=ENVIRONMENT)


def test_every_script_begins_and_ends_the_same_way():
    """Before the first slow import it hears signals, and its last line gives its status: so a few stand for all."""
    texts = {path.name: path.read_text(encoding="utf-8") for path in (ROOT / "scripts").glob("*.py")}
    scripts = {name: text for name, text in texts.items() if '__name__ == "__main__"' in text}
    assert {f"{name}.py" for name in WORDS} < set(scripts)
    for name, text in scripts.items():
        before, begin, _ = text.partition("    ends.begin(__file__)\n")
        assert begin, name
        assert set(re.findall(r"^ *(?:import|from) (\w+)", before, re.MULTILINE)) <= {"__future__", "ends", "os", "sys"}
        assert text.rstrip().splitlines()[-1].startswith("    sys.exit(ends.run(__file__, "), name


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", WORDS)
def test_full_standard_output_is_one_line_and_status_2(name, tmp_path):
    with open("/dev/full", "w") as full, start(name, tmp_path, stdout=full) as run:
        (line,) = run.stderr.read().splitlines()
    assert run.returncode == 2
    assert line == f"{name}.py: cannot use standard output: No space left on device; choose another place"


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", WORDS)
def test_a_pipe_that_nobody_reads_needs_no_words(name, tmp_path):
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w") as pipe, start(name, tmp_path, stdout=pipe) as run:
        assert run.stderr.read() == ""
    assert run.returncode == 141


@pytest.mark.cases(1)
@pytest.mark.parametrize("closed", [">&-", ">&- 2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize("name", ["cast", "environment"])
def test_closed_standard_output_is_refused_before_anything_is_made(name, closed, tmp_path):
    words = [
        "sh",
        "-c",
        f'exec "$@" {closed}',
        "sh",
        sys.executable,
        str(ROOT / "scripts" / f"{name}.py"),
        *WORDS[name],
    ]
    done = subprocess.run(words, capture_output=True, text=True, cwd=tmp_path, timeout=300)
    assert done.returncode == 2
    assert list(tmp_path.iterdir()) == []
    if "2>" not in closed:
        assert done.stderr == f"{name}.py: standard output is closed: send it to a file, or to /dev/null\n"


@pytest.mark.full
def test_what_blender_says_on_closed_standard_error_reaches_no_file(tmp_path):
    words = ["sh", "-c", 'exec "$@" <&- 2>&-', "sh", sys.executable, str(ROOT / "scripts" / "cast.py"), *WORDS["cast"]]
    assert subprocess.run(words, capture_output=True, cwd=tmp_path, timeout=300).returncode == 0
    assert (tmp_path / "out" / "empty.exr").read_bytes()[:4] == b"\x76\x2f\x31\x01"


def hears(pid, number):
    """Whether a process has a handler for a signal. Source: proc(5)."""
    with open(f"/proc/{pid}/status") as lines:
        (mask,) = (int(line.split()[1], 16) for line in lines if line.startswith("SigCgt"))
    return mask >> (number - 1) & 1


@pytest.mark.cases(1)
@pytest.mark.skipif(sys.platform != "linux", reason="asks the system which signals a process hears")
@pytest.mark.parametrize("name", WORDS)
def test_a_stop_during_the_imports_is_one_line(name, tmp_path):
    """From the first moment on that a script can hear it; before that Python itself has only begun."""
    random = Random(name)
    for _ in range(8 if name == "cast" else 2):
        with start(name, tmp_path) as run:
            while run.poll() is None and not hears(run.pid, signal.SIGTERM):
                time.sleep(0.001)
            time.sleep(random.uniform(0, 0.35))
            run.send_signal(random.choice((signal.SIGINT, signal.SIGTERM, signal.SIGHUP)))
            errors = run.stderr.read()
        # -n: at its very end, when Python has given the signals back
        assert run.returncode == 130 or (run.returncode <= 0 and name != "cast"), errors
        if run.returncode == 130:
            assert errors == f"{name}.py: stopped; no unfinished files were left behind\n"
    assert name != "cast" or list(tmp_path.iterdir()) == []


@pytest.mark.full
def test_what_is_told_to_ignore_a_hangup_goes_on(tmp_path):
    with start("cast", tmp_path, action=signal.SIG_IGN) as run:
        time.sleep(0.3)
        run.send_signal(signal.SIGHUP)
        assert "Wrote" in run.stdout.read()
    assert run.returncode == 0


FLUID = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_cube_add()
domain = bpy.context.object.modifiers.new("Fluid", "FLUID")
domain.fluid_type = "DOMAIN"
domain.domain_settings.resolution_max = 8
domain.domain_settings.cache_directory = sys.argv[2]
bpy.ops.mesh.primitive_ico_sphere_add(radius=0.3)
bpy.context.object.modifiers.new("Fluid", "FLUID").fluid_type = "FLOW"
bpy.ops.object.camera_add(location=(0, 0, 8))
bpy.context.scene.camera = bpy.context.object
bpy.context.scene.render.resolution_x = bpy.context.scene.render.resolution_y = 8
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
"""Blender's fluids abort a process at its exit."""


@pytest.mark.full
def test_the_status_is_the_script_s_own_after_fluids(tmp_path):
    path, temporary = tmp_path / "fluid.blend", tmp_path / "temporary"
    temporary.mkdir()
    words = [sys.executable, "-c", FLUID, path, tmp_path / "cache"]
    made = subprocess.run(words, capture_output=True, timeout=300)
    assert made.returncode != 0, "Blender ends well by itself: this test is no longer needed"
    words = [sys.executable, ROOT / "scripts" / "cast.py", path, "--frames", "1:2", "--output", tmp_path / "out"]
    environment = {**os.environ, "TMPDIR": str(temporary)}
    done = subprocess.run(words, capture_output=True, text=True, timeout=300, env=environment)
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith(f"Wrote 2 pictures into {tmp_path / 'out'}\n")
    assert len(list((tmp_path / "out").iterdir())) == 6
    assert list(temporary.iterdir()) == []
