"""The extension is built where there is only Python, and always to the same bytes."""

import subprocess
import sys

from .running import ROOT


def test_it_needs_the_standard_library_only(tmp_path):
    made = []
    for name in "ab":
        words = [sys.executable, "-S", "-E", ROOT / "scripts" / "make_zip.py", tmp_path / name]  # -S: no site-packages
        done = subprocess.run(words, capture_output=True, text=True, timeout=300)
        assert (done.returncode, done.stderr) == (0, "")
        made += (tmp_path / name).iterdir()
    assert made[0].name == made[1].name
    assert made[0].read_bytes() == made[1].read_bytes()
