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
        subprocess.run([PYTHON, Path(__file__).with_name("reader.py"), kind, path, output], check=True)
        with np.load(output) as arrays:
            return dict(arrays)

    return reading
