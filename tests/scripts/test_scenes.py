"""--scene: a scene of the file by its name, where the file opens with another one."""

import re

import numpy as np
import pytest

from .running import refused

WORDS = {
    "cast": ["--passes", "depth", "--format", "NPZ", "--output", "out"],
    "verify": [],
    "explain": ["--pixel", "16,12"],
    "export": ["--format", "json", "--output", "out"],
    "to_cycles": ["--output", "out/copy.blend"],
    "dataset": ["--frames", "1:1", "--passes", "depth", "--output", "out"],
}


@pytest.fixture
def file(blender, scene, monkeypatch):
    """The small .blend, whose first scene has lost its camera; in its scene "Second" the camera "Top" is 7 above."""
    first = blender.context.scene
    blender.ops.scene.new(type="LINK_COPY")
    second = blender.context.scene
    second.name = "Second"
    top = second.camera = second.camera.copy()
    top.name, top.animation_data.action = "Above", None
    top.location = 0, 0, 8
    second.collection.objects.link(top)
    first.camera, blender.context.window.scene = None, first
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    (scene.parent / "out").mkdir()
    monkeypatch.chdir(scene.parent)
    return scene


@pytest.mark.parametrize("name", WORDS)
def test_every_command_takes_a_scene(command, file, name):
    done = command(name, file, "--scene", "Second", *WORDS[name])
    assert (done.stderr, done.returncode) == ("", 0)


def test_the_picture_is_of_that_scene(command, file):
    assert command("cast", file, "--scene", "Second", *WORDS["cast"]).returncode == 0
    [path] = (file.parent / "out").glob("*.npz")
    with np.load(path) as passes:
        nearest = passes["depth"].min()
    assert nearest == pytest.approx(7, abs=0.01)  # the picture's middle lies between pixel centers


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ([], "scene 'Scene' has no active camera: .* scene 'Second' has one (--scene)"),
        (["--scene", "Third"], "the file has no scene 'Third'; its scenes are: 'Scene', 'Second'"),
    ],
)
def test_what_is_refused_names_the_scenes(command, file, words, line):
    message = refused(command("cast", file, *words, *WORDS["cast"]))
    assert all(re.search(re.escape(words), message) for words in line.split(".*"))
    assert not list((file.parent / "out").iterdir())
