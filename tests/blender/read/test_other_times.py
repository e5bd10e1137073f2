"""Rendered shading of a camera whose pixels have their own times: frames of a copy, and the picture of a render."""

from dataclasses import replace

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from camera_ray_caster.blender.engine import viewport
from camera_ray_caster.blender.read import other_times, scene_cache, shape_cache
from camera_ray_caster.blender.read.scene_reader import read_scene
from camera_ray_caster.core.cast import cast


@pytest.fixture
def slit_scan(camera_scene):
    """A cube that moves to the right and back in frames 1 to 21, by keys, and a camera whose rows have these times."""
    bpy.ops.mesh.primitive_cube_add(size=2)
    cube, scene = bpy.context.object, bpy.context.scene
    for frame, x in ((1, -1.0), (11, 1.0), (21, -1.0)):
        cube.location.x = x
        cube.keyframe_insert("location", frame=frame)
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 48, 32, 100
    scene.camera.matrix_world = Matrix.Translation((0, 0, 9))
    settings = scene.camera.data.camera_ray_caster
    settings.time_mode, settings.time_start, settings.time_end = "ROWS", 1, 21
    scene.frame_set(5)
    cube.location.y = 0.5  # without a key
    bpy.context.view_layer.update()
    yield scene, cube
    other_times.stop()


def read_all():
    """Let the timer read until all is known; return the number of readings and what is known."""
    (window,) = bpy.context.window_manager.windows
    for count in range(1, 500):
        other_times._read(window)
        if other_times._known.is_done or other_times._known.reason:
            return count, other_times._known
    raise AssertionError(other_times._known)


def test_the_picture_in_a_view_is_that_of_a_render_at_all_sizes(slit_scan):
    scene, _ = slit_scan
    _, known = read_all()
    seen = scene_cache.cached_scene(bpy.context)
    target = viewport.Target(0, 0, 96, 64, seen.raw, (0.0, 0.0, 1.0, 1.0), known.motion)
    scene.render.resolution_x, scene.render.resolution_y = 96, 64
    expected = cast(read_scene(scene), passes="combined")["combined"]
    for motion, low, high in ((target.motion, 0.0, 0.01), (None, 0.05, 1.0)):  # of edges, by the tolerance
        images, _ = viewport._cast(replace(target, motion=motion), seen.shapes, {}, 1, None)
        assert low <= np.mean(np.abs(images["combined"] - expected).max(axis=2) > 0.02) < high


def test_a_reading_leaves_no_trace(slit_scan):
    scene, cube = slit_scan
    seen = []
    changed = lambda *_: seen.append("changed")  # noqa: E731
    shown = scene_cache.cached_scene(bpy.context)
    for name in ("frame_change_post", "depsgraph_update_post"):
        getattr(bpy.app.handlers, name).append(changed)
    try:
        read_all()
    finally:
        for name in ("frame_change_post", "depsgraph_update_post"):
            getattr(bpy.app.handlers, name).remove(changed)
    assert not seen, "handlers would take the copy for the scene"
    assert list(bpy.data.scenes) == [scene]
    assert (scene.frame_current, round(cube.location.y, 6)) == (5, 0.5)
    assert bpy.context.view_layer.depsgraph.scene == scene
    evaluated = cube.evaluated_get(bpy.context.view_layer.depsgraph).matrix_world.translation
    assert round(evaluated.y, 6) == 0.5
    assert scene_cache.cached_scene(bpy.context) is shown
    assert shape_cache.COPY not in shape_cache._entries
    other_times.read_on()  # no view shows the picture
    assert not other_times._known.states


def test_frames_with_keys_come_first_and_each_is_evaluated_once(slit_scan, monkeypatch):
    frames, read = [], other_times.scene_at

    def reading(camera, depsgraph):
        frames.append(depsgraph.scene.frame_current + depsgraph.scene.frame_subframe)
        return read(camera, depsgraph)

    monkeypatch.setattr(other_times, "scene_at", reading)
    monkeypatch.setattr(other_times, "BUDGET", -1.0)
    (window,) = bpy.context.window_manager.windows
    other_times._read(window)
    assert frames[2:] == [11]
    assert not other_times._known.is_done
    assert len(other_times._known.motion.states) == 3
    monkeypatch.setattr(other_times, "BUDGET", 0.01)
    count, known = read_all()
    assert count > 1
    assert len(set(frames)) == len(frames) == len(known.states)
    bpy.context.scene.frame_set(9)
    read_all()
    assert len(frames) == len(known.states), "the frame of the scene does not matter"
    other_times.changed()
    assert read_all()[1].motion.is_still is False
    assert len(frames) == 2 * len(known.states)


def test_what_cannot_be_read_is_told(slit_scan):
    slit_scan[0].camera.data.camera_ray_caster.time_end = 1
    _, known = read_all()
    assert known.reason.startswith("Start and End of camera")
    assert known.motion is None
