"""A camera model is added in one file: found in Blender, cast, rendered, held to the contract, and taken away again."""

import json
import shutil
import sys
from pathlib import Path

import bpy
import pytest

from ..processes import blender_command, run

HERE = Path(__file__).parent
ROOT = HERE.parents[2]
MODEL = HERE / "mercator.py"
CONTRACT = (
    "cameras/test_model.py",
    "cameras/test_declarations.py",
    "truth/test_recorded.py",
    "errors/test_tightness.py",
)
CAMERAS = Path("addon", "camera_ray_caster", "core", "cameras")


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of package and tests with the model: its file, its import, and its name in MODELS."""
    folder = tmp_path_factory.mktemp("copy")
    for name in ("addon", "tests/core", "scripts"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    for file in ("pyproject.toml", "tests/conftest.py", "tests/tiers.py"):
        shutil.copy(ROOT / file, folder / file)
    shutil.copy(MODEL, folder / CAMERAS)
    listed = folder / CAMERAS / "__init__.py"
    text = listed.read_text(encoding="utf-8")
    imported = text.replace("\nfrom .mirrorball import", "\nfrom .mercator import Mercator\nfrom .mirrorball import")
    added = imported.replace("\n]  # fmt: skip", " Mercator,\n]  # fmt: skip")
    assert text != imported != added
    listed.write_text(added, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def report(copy):
    """What a user saw: with the model, and of the same file after it was taken away."""

    def used(addon, mode):
        words = [*blender_command(HERE / "use.py"), addon, copy / "mercator.blend", copy / f"{mode}.json", mode]
        run(*map(str, words), BLENDER_USER_RESOURCES=str(copy / "resources"))
        return json.loads((copy / f"{mode}.json").read_text())

    return used(copy / "addon", "with") | used(ROOT / "addon", "without")


def test_the_file_is_short():
    text = MODEL.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 25
    assert "def project" not in text
    assert "def bounds" not in text


def test_the_page_for_who_changes_the_code_shows_this_file():
    assert f"```python\n{MODEL.read_text(encoding='utf-8')}```\n" in (ROOT / "CONTRIBUTING.md").read_text("utf-8")


def test_it_is_in_blenders_menu_with_its_setting(report):
    description = "All around, with angles kept: small shapes are not distorted"
    assert report["item"] == ["Mercator", description, 1000]
    name, subtype, *numbers = report["setting"]
    assert (name, subtype) == ("Top Latitude", "ANGLE")
    assert numbers == pytest.approx([1.4, 0.1, 1.5])
    assert report["settings"] == {"mercator_top": 1.25}


def test_it_is_cast_and_projects(report):
    assert report["latitude"] == pytest.approx(1.25, abs=1e-7)  # the pose is float32
    assert report["off"] < 1e-9
    assert 0.2 < report["hit"] <= 1


def test_blender_renders_what_is_cast(report):
    assert report["same"]


def test_it_leaves_nothing_behind(report):
    assert report["nothing left"]


def test_its_file_is_refused_in_one_line_once_it_is_taken_away(report):
    """By script, by F12, in the panel, and without registration. What else is in the file is read, and works."""
    for refusal in report["said"]:
        assert "odel of camera 'Camera' is '1000': it must be one of BLENDER, OPENCV_PINHOLE" in refusal
        assert "\n" not in refusal
    assert len(report["said"]) == 4
    assert report["shapes"] == 2
    assert report["chosen again"] == "OMNIMAX"


@pytest.mark.full
@pytest.mark.skipif(bool(bpy.app.binary_path), reason="needs what the tests of core need, which Blender does not have")
def test_it_keeps_the_contract_of_camera_models(copy):
    """All that is asked of a model, and that its error bounds hold against its own formula with 60 digits."""
    tests = [f"tests/core/{name}" for name in CONTRACT]
    words = "-q", "-m", "", "-k", "MERCATOR", "-p", "no:cacheprovider"
    output = run(sys.executable, "-m", "pytest", *tests, *words, folder=copy)
    assert int(output.split(" passed")[0].split()[-1]) > 12
