"""`make` with a Python that cannot be used: one line, and nothing made."""

import importlib.util
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
specification = importlib.util.spec_from_file_location("environment", ROOT / "scripts" / "environment.py")
environment = importlib.util.module_from_spec(specification)
specification.loader.exec_module(environment)


@pytest.mark.parametrize(("python", "bpy"), [((3, 11), "5.0"), ((3, 13), "5.2")])
def test_the_newest_bpy_of_a_python(python, bpy):
    assert environment.bpy_for(python) == bpy


@pytest.mark.parametrize("python", [(2, 7), (3, 6), (3, 10), (3, 12), (3, 14)])
def test_another_python_is_named_with_those_that_fit(python):
    version = ".".join(map(str, python))
    assert environment.bpy_for(python) == f"needs Python 3.11 or 3.13, found {version}"


def test_each_bpy_is_tested_and_the_newest_by_all_tests_and_hostile_inputs(monkeypatch, capsys):
    ran = []

    def make(target, bpy, _, left_out=(), share=""):
        ran.append((target, bpy, *left_out, share))
        return "test-" in target

    monkeypatch.setattr(environment, "find_python", lambda version: "python" if version == (3, 11) else None)
    monkeypatch.setattr(environment, "numpy_of", lambda bpy: b"3.11 1.26")
    monkeypatch.setattr(environment, "make", make)
    assert environment.test_all(environment.PARTS["test-all"], "") == 1
    made = [(f".venv/bpy-{bpy}/ready", bpy, "") for bpy in ("4.5", "5.0")]
    tests = [("test", "4.5", "tests/core", ""), ("test-full", "5.0", "")]
    assert ran == [*made, *tests, ("test-hostile", "5.0", "")]
    assert "bpy 5.0, hostile inputs: FAILED" in capsys.readouterr().out
    for words, targets in (
        (["prepare"], made),
        (["test-tiers"], [*made, *tests]),
        (["test-hostile", "2/4"], [*made, ("test-hostile", "5.0", "2/4")]),
    ):
        ran.clear()
        monkeypatch.setattr("sys.argv", ["environment.py", *words])
        assert environment.main() == (words != ["prepare"])
        assert ran == targets


@pytest.mark.parametrize("target", ["cast", "test"])
@pytest.mark.parametrize(
    ("says", "message"),
    [
        ("echo needs Python 3.11 or 3.13, found 3.12", "found 3.12"),  # as environment.py answers on 3.12
        ("exit 1", "cannot run"),  # as a Python 2 or an empty shim does
    ],
)
def test_make_stops_in_one_line(tmp_path, target, says, message):
    python = tmp_path / "python"
    python.write_text(f"#!/bin/sh\n{says}\n")
    python.chmod(0o755)
    # its own folder: only what make would make is there afterwards
    (tmp_path / "Makefile").write_text((ROOT / "Makefile").read_text())
    (tmp_path / "pyproject.toml").touch()
    settings = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    run = subprocess.run(
        ["make", target, f"PYTHON={python}"], cwd=tmp_path, env=settings, capture_output=True, text=True, timeout=300
    )
    assert run.returncode == 2
    assert run.stdout == ""
    assert len(run.stderr.splitlines()) == 1
    assert message in run.stderr
    assert f"make PYTHON=/path/to/python3.13 {target}" in run.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"python", "Makefile", "pyproject.toml"}
