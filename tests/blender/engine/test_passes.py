"""The passes of a render: what the engine stores comes out of Blender's own files bit for bit."""

import numpy as np
import pytest

from camera_ray_caster.core.casting.passes import PASSES

from ..pictures import FAR, HEIGHT, WIDTH, expected, picture, tick

CONSTANT = "valid", "ray_origin", "face_index"
"""Passes that are the same everywhere in this picture of spheres."""


@pytest.mark.parametrize("name", PASSES)
def test_every_pass_comes_out_of_the_file_as_it_was_cast(blender, scene, render, name):
    tick(scene, [name])
    sphere = blender.data.objects["Sphere"]
    for frame in (0, 2):
        sphere.location.x = 0.25 * frame
        sphere.keyframe_insert("location", frame=frame)
    scene.frame_set(1)
    stored, cast_of_it = picture(render(), name), expected(scene, name)
    assert stored.shape[:2] == (HEIGHT, WIDTH)
    np.testing.assert_array_equal(stored, cast_of_it)
    if name not in CONSTANT:
        assert np.nanmax(stored) > np.nanmin(stored), f"{name} is the same everywhere; if it may be: CONSTANT"


def test_the_file_holds_what_is_ticked_and_nothing_else(scene, render):
    tick(scene, ["combined", "normal", "valid"])
    passes = {name.split(".")[1] for name in render() if name.startswith("ViewLayer.")}
    assert passes == {"Combined", "Normal", "Valid"}


def test_combined_stays_when_nothing_is_ticked(scene, render):
    tick(scene, [])
    assert np.ptp(picture(render(), "combined")) > 0


def test_background_of_depth_and_distance(scene, render):
    channels = render()
    left = np.s_[HEIGHT // 2, 0, 0]
    assert picture(channels, "shape_index")[left] == -1
    assert picture(channels, "depth")[left] == np.float32(FAR)
    assert picture(channels, "distance")[left] == np.inf
    middle = np.s_[HEIGHT // 2, WIDTH // 2, 0]
    assert picture(channels, "object_index")[middle] == 3
    assert picture(channels, "material_index")[middle] == 5
    assert 4 < picture(channels, "depth")[middle] < 4.1, "the sphere's top is 4 below the camera"


def test_each_view_layer_has_its_own_shapes(blender, scene, render):
    collection = blender.data.collections.new("Only here")
    scene.collection.children.link(collection)
    sphere = blender.data.objects["Sphere"]
    scene.collection.objects.unlink(sphere)
    collection.objects.link(sphere)
    other = scene.view_layers.new("Other")
    other.layer_collection.children["Only here"].exclude = True
    tick(scene, ["shape_index", "object_index"])
    channels = render()
    assert 3 in picture(channels, "object_index")
    assert 3 not in picture(channels, "object_index", "Other")
    assert 0 in picture(channels, "shape_index", "Other"), "the plane is in both"
