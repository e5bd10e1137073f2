"""The wheel as a user meets it: laid into an empty folder, imported where there is only numpy, and its command."""

import shutil
import subprocess
import sys
import zipfile
from email.parser import Parser
from importlib.metadata import Distribution

import pytest

from ..core.library.test_program import PROGRAM
from .running import ROOT

BUILD = "import setuptools.build_meta as backend, sys; backend.build_wheel(sys.argv[1])"
pytestmark = pytest.mark.full


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """A folder with what the wheel holds, as an installation lays it there."""
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    shutil.copytree(ROOT / "addon", source / "addon", ignore=shutil.ignore_patterns("__pycache__", "*.egg-info"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source)
    done = subprocess.run(
        [sys.executable, "-c", BUILD, folder], cwd=source, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    (wheel,) = folder.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(folder / "site")
    return folder / "site"


def test_it_says_what_it_is_and_needs_numpy_only(site):
    (folder,) = site.glob("*.dist-info")
    metadata = Parser().parsestr((folder / "METADATA").read_text(encoding="utf-8"))
    assert metadata["Version"] in folder.name
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert "Exact camera models" in metadata.get_payload()
    needed = [line for line in Distribution.at(folder).requires if "extra ==" not in line]
    assert needed == ["numpy"]
    assert "camera-ray-caster = camera_ray_caster.__main__:main" in (folder / "entry_points.txt").read_text()


def test_it_holds_all_files_of_the_package_but_pages(site):
    package = ROOT / "addon" / "camera_ray_caster"
    files = {path.relative_to(package).as_posix() for path in package.rglob("*") if path.is_file()}
    held = {path.relative_to(site / "camera_ray_caster").as_posix() for path in (site / "camera_ray_caster").rglob("*")}
    missing = {name for name in files - held if "__pycache__" not in name}
    assert {name.rpartition("/")[2] for name in missing} <= {"README.md"}


def test_the_program_runs_with_it(site, tmp_path):
    words = [sys.executable, "-P", PROGRAM, tmp_path]
    done = subprocess.run(words, env={"PYTHONPATH": str(site)}, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "['camera.json']"


def test_its_command_is_that_of_the_scripts(site, tmp_path):
    words = [
        sys.executable,
        "-P",
        "-m",
        "camera_ray_caster",
        "cast",
        ROOT / "blend_scenes" / "spheres_and_planes.blend",
    ]
    options = ["--resolution", "32x18", "--output", tmp_path / "out"]
    environment = {"PYTHONPATH": str(site), "BLENDER_USER_RESOURCES": str(tmp_path / "resources")}
    done = subprocess.run([*words, *options], env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert {path.suffix for path in (tmp_path / "out").iterdir()} >= {".png", ".exr", ".json"}
    refused = subprocess.run([*words[:-2], "casts"], env=environment, capture_output=True, text=True, timeout=300)
    assert refused.returncode == 2
    assert refused.stderr.splitlines()[-1].startswith("camera-ray-caster casts: ")
