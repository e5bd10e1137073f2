"""A copy of the repository in which a recipe of CONTRIBUTING.md is followed: new files, words, the page's commands."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "CONTRIBUTING.md"
PARTS = (
    "addon", "tests", "scripts", "docs", "blend_scenes", "listing", "pyproject.toml", "Makefile", "LICENSE",
    "README.md", "CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", ".mypy_cache",
)  # fmt: skip
"""What a copy has: all that tests read, and what mypy keeps, where there is any."""
LINT = ("-m", "ruff", "check"), ("-m", "mypy"), ("scripts/make_docs.py", "--check")
"""The words of `make lint` after the name of the Python."""


class Copy:
    """A copy of the repository."""

    def __init__(self, folder):
        """Make the copy in a folder that is there."""
        self.folder = folder
        for name in PARTS:
            if (ROOT / name).is_dir():
                shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
            elif (ROOT / name).exists():
                shutil.copy2(ROOT / name, folder / name)

    def write(self, path, text):
        """Write a new file."""
        assert not (self.folder / path).exists(), f"{path} is there already"
        (self.folder / path).write_text(text, encoding="utf-8")

    def change(self, path, *changes):
        """Replace texts, each of which a file has once: pairs of what it has and what it gets."""
        text = (self.folder / path).read_text(encoding="utf-8")
        for before, after in changes:
            assert text.count(before) == 1, f"{path} has {before!r} {text.count(before)} times"
            text = text.replace(before, after)
        (self.folder / path).write_text(text, encoding="utf-8")

    def follow(self, heading, **words):
        """Run the commands below a heading of the page, with words such as NAME replaced."""
        assert commands(heading), f"{PAGE.name} has no commands below {heading!r}"
        for command in commands(heading):
            for name, word in words.items():
                command = re.sub(rf"\b{name}\b", word, command)
            if command != "make lint":  # once, after all recipes: see ``lint``
                done = self.run(*shlex.split(command)[1:])
                assert done.returncode == 0, f"{command}\n{done.stdout}"

    def lint(self):
        """Run what `make lint` runs."""
        for words in LINT:
            done = self.run(*words)
            assert done.returncode == 0, done.stdout

    def run(self, *arguments):
        """Run Python in the copy, and return how it ended, with all that it printed."""
        environment = os.environ | {"BLENDER_USER_RESOURCES": str(self.folder / "resources"), "PYTEST_ADDOPTS": ""}
        return subprocess.run(
            [sys.executable, *arguments],
            cwd=self.folder,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=500,
        )


def commands(heading):
    """The commands below a heading of the page: what is indented, of Python or make."""
    section = PAGE.read_text(encoding="utf-8").partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    return re.findall(r"^    ((?:python|make) .*?)(?: +#.*)?$", section, re.MULTILINE)


def said_by(copy, *arguments):
    """What a test that has to fail in a copy says."""
    done = copy.run("-m", "pytest", "-q", "-n", "0", "-m", "", "-p", "no:cacheprovider", *arguments)
    assert done.returncode == 1, done.stdout
    return done.stdout
