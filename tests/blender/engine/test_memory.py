"""Frames and triangles that no memory holds: F12, the sidebar and the files refuse them in one line; a border of such a
frame is rendered.
"""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.blender.terminal import frame_files
from camera_ray_caster.core import memory
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import InputError

from ..pictures import picture

SAID = r"the passes of {0} x {0} pixels take [\d.]+ GiB of memory and 1 GiB are available: render a border"


@pytest.fixture
def huge(scene, monkeypatch):
    """The scene with 65,536 x 65,536 pixels, on a machine that has 1 GiB left."""
    monkeypatch.setattr(memory, "available", lambda: 1 << 30)
    scene.render.resolution_x = scene.render.resolution_y = 1 << 16
    scene.render.resolution_percentage = 100
    return scene


def bordered(scene, crop):
    render = scene.render
    render.use_border, render.use_crop_to_border = True, crop
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.5, 0.501, 0.5, 0.5005


@pytest.mark.parametrize("border", [False, True])
def test_a_frame_that_does_not_fit_is_refused_before_it_is_begun(blender, huge, tmp_path, border):
    if border:
        bordered(huge, crop=False)  # Blender puts the border into a whole frame
    with pytest.raises(InputError, match=SAID.format(1 << 16)):
        frame_files.render(huge, tmp_path / "out", "frame")
    huge.render.resolution_x = huge.render.resolution_y = 1 << 13  # Blender itself makes a frame before it asks
    with pytest.raises(RuntimeError, match=SAID.format(1 << 13)) as refused:
        blender.ops.render.render()
    assert str(refused.value).strip().count("\n") == 0
    assert not list(tmp_path.rglob("*"))


def test_a_cropped_border_of_such_a_frame_is_rendered(huge, render):
    bordered(huge, crop=True)
    layers = render()
    expected = cast(read_camera(huge), read_shapes(huge), passes=("position", "ray_direction"))
    assert expected["position"].shape == (32, 65, 3)
    for name, image in expected.items():
        np.testing.assert_array_equal(picture(layers, name), image)


def test_more_triangles_than_the_memory_holds_are_refused_in_one_line(blender, scene, monkeypatch, tmp_path):
    """A hundred million: instances of a mesh of 62,976."""
    blender.ops.mesh.primitive_monkey_add()
    monkey = blender.context.object
    monkey.modifiers.new("Subdivision", "SUBSURF").levels = monkey.modifiers[0].render_levels = 3
    cloud = blender.data.meshes.new("Points")
    cloud.from_pydata(np.random.default_rng(0).uniform(-1, 1, (1_600, 3)).tolist(), [], [])
    points = blender.data.objects.new("Points", cloud)
    scene.collection.objects.link(points)
    points.instance_type, monkey.parent = "VERTS", points
    monkeypatch.setattr(memory, "available", lambda: 4 << 30)
    refusal = r"100,\d\d\d,\d\d\d triangles in view take [\d.]+ GiB of memory and 4 GiB are available: show "
    with pytest.raises(InputError, match=refusal):
        frame_files.render(scene, tmp_path / "out", "frame")
    with pytest.raises(RuntimeError, match=refusal) as refused:
        blender.ops.render.render()
    assert str(refused.value).strip().count("\n") == 0
    assert not list(tmp_path.rglob("*"))
