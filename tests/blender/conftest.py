"""Every test in this folder starts from an empty file with the extension registered."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).resolve().parents[2] / "scripts"))
import make_zip

from ..exr import read_exr
from .processes import blender_command, run


@pytest.fixture(autouse=True)
def empty_file(blender):
    """See ``blender``, which does the work and takes it back."""
    return blender


@pytest.fixture
def camera_scene(blender):
    """The scene, of 8 x 8 pixels, with a camera and nothing else."""
    blender.ops.object.camera_add()
    scene = blender.context.scene
    scene.camera = blender.context.object
    scene.render.resolution_x = scene.render.resolution_y = 8
    return scene


@pytest.fixture
def osl(blender):
    """Cycles with the Open Shading Language, which not every build has."""
    import addon_utils

    addon_utils.enable("cycles", default_set=True)
    import _cycles

    if not _cycles.with_osl:
        pytest.skip("this Blender was built without OSL")


@pytest.fixture(scope="session")
def archive(tmp_path_factory):
    """The extension as a zip."""
    return make_zip.build(tmp_path_factory.mktemp("dist"))


@pytest.fixture
def slow(monkeypatch):
    """A picture counts as one that takes long, and so is cast in many tiles."""
    from camera_ray_caster.core import tuning

    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 16)


@pytest.fixture
def render(blender, tmp_path):
    """A function that renders the current frame by Blender's own operator to an EXR and reads it back.

    elsewhere: in a Blender of its own. In a process that many tests have used Cycles now and then gives no pixels, and
    Blender crashes as it writes them.
    """

    def render(elsewhere=False, **options):
        path = tmp_path / "picture.exr"
        settings = blender.context.scene.render.image_settings
        if hasattr(settings, "media_type"):
            settings.media_type = "MULTI_LAYER_IMAGE"
        settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
        if hasattr(settings, "use_exr_interleave"):
            settings.use_exr_interleave = True
        blender.context.scene.render.filepath = str(path)
        if options.get("animation"):
            blender.context.scene.render.filepath = str(tmp_path / "frame_")
            blender.ops.render.render(animation=True)
            return {int(path.stem[-4:]): read_exr(path) for path in sorted(tmp_path.glob("frame_*.exr"))}
        if elsewhere:
            blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"), copy=True)
            script = Path(__file__).with_name("render_file.py")
            run(*blender_command(str(script)), str(tmp_path / "scene.blend"))
        else:
            blender.ops.render.render(write_still=True)
        return read_exr(path)

    return render
