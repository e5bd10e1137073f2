"""The zip as a user meets it: built, validated, installed in a fresh profile, rendered with, and taken away again."""

import json
import zipfile
from pathlib import Path

import bpy
import numpy as np
import pytest

from .processes import SOURCE, blender_command, extension_tool, run

SCENES = SOURCE.parents[1] / "blend_scenes"
INSTALL_AND_RENDER = Path(__file__).parent / "install_and_render.py"


@pytest.fixture(scope="module")
def installed(archive, tmp_path_factory):
    """(seen, picture): what a Blender with a fresh profile saw, and the pixels that it rendered, (48, 64, 4)."""
    folder = tmp_path_factory.mktemp("profile")
    picture, report = folder / "picture.png", folder / "seen.json"
    words = [*blender_command(INSTALL_AND_RENDER), archive, picture, report]
    run(*map(str, words), BLENDER_USER_RESOURCES=str(folder / "resources"))
    image = bpy.data.images.load(str(picture))
    pixels = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(pixels)
    return json.loads(report.read_text()), pixels.reshape(48, 64, 4)


def test_source_and_zip_are_valid(archive):
    for path in (SOURCE, archive):
        assert "error" not in extension_tool("validate", path).lower()


def test_the_zip_is_that_of_blenders_own_builder(archive, tmp_path):
    """The same names, the same contents."""
    with zipfile.ZipFile(archive) as ours:
        ours.extractall(tmp_path / "extension")
        extension_tool("build", "--source-dir", tmp_path / "extension", "--output-dir", tmp_path)
        with zipfile.ZipFile(tmp_path / archive.name) as theirs:
            files = {name for name in theirs.namelist() if not name.endswith("/")}
            assert files == set(ours.namelist())
            assert all(theirs.read(name) == ours.read(name) for name in files)


def test_the_zip_holds_the_package_its_license_and_the_gallery(archive):
    held = {name for name in zipfile.ZipFile(archive).namelist() if not name.endswith("/")}
    files = [path for path in SOURCE.rglob("*") if path.is_file() and path.parent.name != "__pycache__"]
    scenes = {path.stem for path in SCENES.glob("*.blend")}
    pictures = scenes & {path.stem for path in (SCENES / "pictures").glob("*.png")}
    assert held == {
        "LICENSE",
        *(path.relative_to(SOURCE).as_posix() for path in files),
        *(f"gallery/{name}.blend" for name in scenes),
        *(f"gallery/{path.name}" for path in SCENES.glob("*.npz")),
        *(f"gallery/pictures/{name}.png" for name in pictures),
    }


def test_every_model_of_the_menu_has_a_picture_and_a_scene(blender):
    from camera_ray_caster.blender import gallery
    from camera_ray_caster.core.cameras import MODELS

    for model in MODELS:
        name = gallery.scene_name(model.key)
        assert (gallery.folder() / f"{name}.blend").is_file()
        assert (gallery.folder() / "pictures" / f"{name}.png").is_file()


def test_the_installed_engine_shows_the_sphere(installed):
    _, picture = installed
    assert np.isfinite(picture).all()
    assert np.ptp(picture[..., :3]) > 0
    # A sphere of radius 1 at distance 5 fills the middle of the 64 x 48 film and leaves the corners to the world.
    corners = picture[[0, 0, -1, -1], [0, -1, 0, -1]]
    assert (picture[24, 32] != corners).any(axis=1).all()


def test_the_installed_package_never_imports_itself_by_name(installed):
    seen, _ = installed
    names = {name for name in seen["modules"] if not name.startswith("bl_ext.user_default.camera_ray_caster")}
    assert names == set()


def test_the_installed_extension_leaves_the_allocator_of_its_host_alone(installed):
    seen, _ = installed
    assert "mallopt" not in seen["C functions"]


def test_ten_times_disabled_and_enabled_leaves_what_once_does(installed):
    seen, _ = installed
    assert seen["enabled"] != seen["before"]
    assert seen["enabled"]["counted"] == {"draw callbacks": 9, "commands": 1}
    assert seen["enabled again"] == seen["enabled"]


def test_disabled_leaves_nothing(installed):
    seen, _ = installed
    assert seen["disabled"] == seen["before"]
