"""The readers of other programs, in an environment of their own."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
PYTHON = ROOT / ".venv" / "peers" / "bin" / "python"


@pytest.fixture
def read(tmp_path):
    """Return a function of a kind of file and its path, which returns the arrays that the other program reads."""
    if not PYTHON.exists():
        pytest.skip("there are no readers of other programs: make .venv/peers/ready")

    def reading(kind, path):
        output = tmp_path / "read.npz"
        words = PYTHON, Path(__file__).with_name("reader.py"), kind, path, output
        done = subprocess.run(words, stderr=subprocess.PIPE, text=True)
        if done.stderr.startswith("MISSING "):
            pytest.skip(f"could not import {done.stderr.split()[1]!r}, which pip could not install")
        assert done.returncode == 0, done.stderr
        with np.load(output) as arrays:
            return dict(arrays)

    return reading
