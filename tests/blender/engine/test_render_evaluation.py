"""Scenes that are read as a render evaluates them, and are as they were afterwards."""

import pytest

from camera_ray_caster.blender.engine.render_evaluation import read_as_rendered
from camera_ray_caster.core.records import InputError


def state(scene):
    render = scene.render
    return render.engine, render.use_compositing, render.use_multiview, render.use_sequencer, scene.frame_current_final


def test_a_scene_is_read_as_a_render_evaluates_it_and_is_not_changed(blender, camera_scene):
    blender.ops.mesh.primitive_cube_add()
    cube = blender.context.object
    cube.hide_viewport = True
    camera_scene.render.engine = "CYCLES"
    camera_scene.render.use_multiview = True
    camera_scene.frame_set(3, subframe=0.25)
    before = state(camera_scene)
    job = read_as_rendered(camera_scene)
    assert job.shapes.names == ("Cube",)
    assert job.frame == 3.25
    assert state(camera_scene) == before


def test_errors_of_a_reading_are_those_of_a_cast(blender, camera_scene):
    camera_scene.camera.data.camera_ray_caster.model = "PUSHBROOM"
    with pytest.raises(InputError, match=r"slit_1 of camera 'Camera' is not set"):
        read_as_rendered(camera_scene)
    camera_scene.view_layers[0].use = False
    with pytest.raises(InputError, match="no view layer of scene 'Scene' is used for rendering: enable one"):
        read_as_rendered(camera_scene)
    camera_scene.camera = None
    with pytest.raises(InputError, match="camera"):
        read_as_rendered(camera_scene)
