"""What the tests of the scripts share: a small scene, commands in this process, and scripts that are quick."""

import subprocess
import sys
from types import SimpleNamespace

import pytest

from .running import ROOT, small


@pytest.fixture
def scene(blender, tmp_path):
    """A small .blend."""
    return small(blender, tmp_path / "small.blend")


@pytest.fixture
def command(blender, capsys):
    """A function that runs a script's command in this process, as far as Python goes, and returns how it ended."""
    from camera_ray_caster.blender.terminal import commands

    def run(name, *words):
        capsys.readouterr()
        status = commands.main(name, [str(word) for word in words], f"{name}.py")
        return subprocess.CompletedProcess(words, status, *capsys.readouterr())

    return run


@pytest.fixture(scope="module")
def precision():
    """The modules of scripts/measure/precision, told to be quick: a run each, small pictures, few samples."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "path", [str(ROOT / "scripts"), str(ROOT), *sys.path])
        from measure.precision import arithmetic, comparison, effort, points

        patch.setattr(points, "REPEATS", 1)
        patch.setattr(arithmetic, "SIDE", 24)
        patch.setattr(arithmetic, "COMPARED", 16)
        for name, value in {"SAMPLES": (1, 16), "REFERENCE": 256, "TOLERANCES": (1.0, 0.01)}.items():
            patch.setattr(effort, name, value)
        yield SimpleNamespace(arithmetic=arithmetic, comparison=comparison, effort=effort)
