"""Every block of Python in the README runs: without registration, and where the extension is installed."""

from pathlib import Path

import pytest

from .processes import blender_command, run

ROOT = Path(__file__).resolve().parents[2]
README = ROOT / "README.md"


@pytest.mark.parametrize("way", ["beside the package", "with the extension"])
def test_the_blocks_of_the_readme_run(way, archive, tmp_path):
    """In a folder from which the example scenes are found as from the repository."""
    (tmp_path / "blend_scenes").symlink_to(ROOT / "blend_scenes")
    package = archive if way == "with the extension" else ROOT / "addon"
    words = [*blender_command(Path(__file__).with_name("run_readme.py")), README, package]
    said = run(*map(str, words), folder=tmp_path, BLENDER_USER_RESOURCES=str(tmp_path / "resources"))
    assert int(said.rpartition("blocks run:")[2].split()[0]) > 0
