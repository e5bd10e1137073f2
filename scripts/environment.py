"""Find the bpy that fits this Python, or run the tests with every supported bpy that this machine has a Python for.

    python scripts/environment.py               print the newest bpy for this Python, or the reason why there is none
    python scripts/environment.py prepare       make the environment of each bpy, one after the other
    python scripts/environment.py test-all      run the tests with each bpy, all of them with the newest; print results
    python scripts/environment.py test-tiers    the same without hostile inputs
    python scripts/environment.py test-hostile [K/N]    hostile inputs alone, all or the K-th of N parts

Standard library only, and no syntax newer than Python 3.6, so that it can report that a Python is too old.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import glob
import importlib.util
import os
import shutil
import subprocess
import sys
import time

# A bpy wheel works with one Python version only.
PYTHON_OF_BPY = {"4.5": (3, 11), "5.0": (3, 11), "5.2": (3, 13)}


def bpy_for(python):
    """Return the newest bpy, "major.minor", that a Python (major, minor) can load, or the reason why there is none."""
    fitting = [bpy for bpy, needed in PYTHON_OF_BPY.items() if needed == python]
    if fitting:
        return fitting[-1]
    needed = " or ".join(sorted({dotted(version) for version in PYTHON_OF_BPY.values()}))
    return f"needs Python {needed}, found {dotted(python)}"


def dotted(version):
    """Return a version such as (3, 11) as "3.11"."""
    return ".".join(map(str, version))


def find_python(version):
    """Return the path of a working Python (major, minor) with pip, or None. A name on PATH may be an empty shim."""
    name = "python" + dotted(version)
    pyenv = os.path.expanduser(f"~/.pyenv/versions/{dotted(version)}*/bin/python")
    probe = f"import pip, sys; sys.exit(sys.version_info[:2] != {version})"
    for path in [sys.executable, shutil.which(name), *sorted(glob.glob(pyenv))]:
        if path and subprocess.run([path, "-c", probe], stderr=subprocess.DEVNULL).returncode == 0:
            return path
    return None


PARTS = {"prepare": set(), "test-all": {"tiers", "hostile"}, "test-tiers": {"tiers"}, "test-hostile": {"hostile"}}
"""What is run, by command."""


def test_all(parts, share):
    """Run parts of the tests for each supported bpy in turn, since each run uses all cores.

    "tiers" is `make test`, and for the newest `make test-full`; where a newer bpy has the same Python and numpy,
    tests/core, which has no bpy, is left to it. "hostile" is `make test-hostile` for the newest; ``share`` is "K/N",
    or "" for all. Return the exit status: 0 if at least one bpy passed and none failed.
    """
    results, pythons, numpys = {}, {}, {}
    for bpy, version in PYTHON_OF_BPY.items():
        python = find_python(version)
        if python is None:
            results[bpy] = f"not run, no Python {dotted(version)} with pip found"
            continue
        print(f"== bpy {bpy} on {python}", flush=True)
        results[bpy] = in_words(make(f".venv/bpy-{bpy}/ready", bpy, python))
        if results[bpy] == "passed":
            pythons[bpy], numpys[bpy] = python, numpy_of(bpy)
    for bpy, python in pythons.items():
        newer = list(numpys.values())[list(numpys).index(bpy) + 1 :]
        if "tiers" in parts:
            began, left_out = time.time(), ["tests/core"] if numpys[bpy] in newer else []
            status = make("test" if newer else "test-full", bpy, python, left_out)
            results[bpy] = f"{in_words(status)} in {time.time() - began:.0f} s"
        if "hostile" in parts and not newer:
            results[f"{bpy}, hostile inputs"] = in_words(make("test-hostile", bpy, python, share=share))
    for bpy, result in results.items():
        print(f"bpy {bpy}: {result}")
    words = [result.split()[0] for result in results.values()]
    return int("FAILED" in words or "passed" not in words)


def in_words(status):
    """Return an exit status in words."""
    return "FAILED" if status else "passed"


def numpy_of(bpy):
    """Return the versions of Python and numpy in the environment of a bpy, as one text."""
    words = [f".venv/bpy-{bpy}/bin/python", "-c", "import numpy, sys; print(sys.version, numpy.__version__)"]
    return subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout


def make(target, bpy, python, left_out=(), share=""):
    """Run a make target with a bpy and a Python, without the tests in a window; return the exit status."""
    # drop the settings of the calling make; the tests in a window use the same Blender with every bpy
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    ignored = "".join(f" --ignore={folder}" for folder in ("tests/gui", *left_out))
    environment["PYTEST_ADDOPTS"] = environment.get("PYTEST_ADDOPTS", "") + ignored
    words = ["make", target, f"PYTHON={python}", f"BPY={bpy}", f"PART={share}"]
    return subprocess.run(words, env=environment).returncode


def main():
    """Print the fitting bpy, or run the tests that a command of PARTS names; return the exit status."""
    if len(sys.argv) > 1 and sys.argv[1] in PARTS:
        return test_all(PARTS[sys.argv[1]], "".join(sys.argv[2:3]))
    bpy = bpy_for(sys.version_info[:2])
    is_ready = os.path.exists(os.path.join(os.path.dirname(__file__), "..", ".venv", "bpy-" + bpy, "ready"))
    print(bpy if is_ready or importlib.util.find_spec("pip") else f"needs pip: {sys.executable} has none")
    return 0


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
