"""Every block of Python in the README and in docs/ runs: without registration, and where the extension is installed."""

from pathlib import Path

import pytest

from .processes import blender_command, run

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("README.md", "docs/python.md")
PROGRAM = ROOT / "tests" / "core" / "library" / "program.py"


def test_the_readme_is_short_and_the_page_shows_the_program_that_is_tested():
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= 130
    shown = f"```python no-run\n{PROGRAM.read_text(encoding='utf-8')}```\n"
    assert shown in (ROOT / "docs" / "python.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("way", "page"),
    [("beside the package", PAGES[0]), ("with the extension", PAGES[1])]
    + [
        pytest.param(way, page, marks=pytest.mark.full)
        for way, page in (("with the extension", PAGES[0]), ("beside the package", PAGES[1]))
    ],
)
def test_the_blocks_of_a_page_run(way, page, archive, tmp_path):
    """In a folder from which the example scenes are found as from the repository."""
    (tmp_path / "blend_scenes").symlink_to(ROOT / "blend_scenes")
    package = archive if way == "with the extension" else ROOT / "addon"
    words = [*blender_command(Path(__file__).with_name("run_readme.py")), ROOT / page, package]
    output = run(*map(str, words), folder=tmp_path, BLENDER_USER_RESOURCES=str(tmp_path / "resources"))
    assert int(output.rpartition("blocks run:")[2].split()[0]) > 0
