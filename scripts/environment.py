"""Which bpy goes with which Python, and the tests on every such pair that this machine has.

    python scripts/environment.py             the newest bpy for this Python, or a sentence why there is none
    python scripts/environment.py test-all    `make test` on each supported bpy, and which of them passed

Standard library only, and no syntax newer than Python 3.6: it has to be able to say that a Python is too old.
"""

import glob
import importlib.util
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

# Two runs that together are all the tests: the last bpy's would otherwise leave a core idle.
HALVES = "--ignore=tests/core", "tests/core"

# A bpy wheel is built for one Python.
PYTHON_OF_BPY = {"4.5": (3, 11), "5.0": (3, 11), "5.2": (3, 13)}


def bpy_for(python):
    """The newest bpy, "major.minor", that a Python (major, minor) can load; a sentence that says why not otherwise."""
    fitting = [bpy for bpy, needed in PYTHON_OF_BPY.items() if needed == python]
    if fitting:
        return fitting[-1]
    needed = " or ".join(sorted({dotted(version) for version in PYTHON_OF_BPY.values()}))
    return f"needs Python {needed}, found {dotted(python)}"


def dotted(version):
    """(3, 11) as "3.11"."""
    return ".".join(map(str, version))


def find_python(version):
    """The path of a Python (major, minor) that runs and has pip, or None: a name on PATH may be an empty shim."""
    name = "python" + dotted(version)
    pyenv = os.path.expanduser(f"~/.pyenv/versions/{dotted(version)}*/bin/python")
    probe = f"import pip, sys; sys.exit(sys.version_info[:2] != {version})"
    for path in [sys.executable, shutil.which(name), *sorted(glob.glob(pyenv))]:
        if path and subprocess.run([path, "-c", probe], stderr=subprocess.DEVNULL).returncode == 0:
            return path
    return None


def test_all():
    """Run `make test` in HALVES for each supported bpy, as many at a time as there are cores; the exit status is 0 when
    at least one bpy ran and none failed.
    """
    pythons = {bpy: find_python(version) for bpy, version in PYTHON_OF_BPY.items()}
    found = {bpy: python for bpy, python in pythons.items() if python}
    # the environments one after another, since each installs from this folder
    passed = {bpy: make(f".venv/bpy-{bpy}/ready", bpy, python).returncode == 0 for bpy, python in found.items()}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        ready = [bpy for bpy in found if passed[bpy]]
        running = [
            (bpy, pool.submit(make, "test", bpy, found[bpy], half, subprocess.PIPE)) for half in HALVES for bpy in ready
        ]
        for bpy, run in running:
            print(f"== bpy {bpy} on {found[bpy]}")
            print(run.result().stdout, flush=True)
            passed[bpy] = passed[bpy] and run.result().returncode == 0
    for bpy, version in PYTHON_OF_BPY.items():
        missing = f"not run, no Python {dotted(version)} with pip found"
        print(f"bpy {bpy}: " + {True: "passed", False: "FAILED"}.get(passed.get(bpy), missing))
    return int(not passed or not all(passed.values()))


def make(target, bpy, python, options="", output=None):
    """Run make for a bpy on a Python, with options of pytest; ``output`` takes what it says on both channels."""
    # it gets its own settings, not those of the make that called; the window's Blender is the same with every bpy
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    environment["PYTEST_ADDOPTS"] = " ".join((os.environ.get("PYTEST_ADDOPTS", ""), "--ignore=tests/gui", options))
    command = ["make", target, f"PYTHON={python}", f"BPY={bpy}"]
    errors = output and subprocess.STDOUT
    return subprocess.run(command, env=environment, stdout=output, stderr=errors, encoding="utf-8", errors="replace")


if __name__ == "__main__":
    if sys.argv[1:] == ["test-all"]:
        sys.exit(test_all())
    print(bpy_for(sys.version_info[:2]) if importlib.util.find_spec("pip") else f"needs pip: {sys.executable} has none")
