"""Renders under which Blender frees the engine, its result or the scene: they end in silence."""

import threading
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.engine import engine
from camera_ray_caster.blender.engine.engine import CameraRayCaster, RenderCall
from camera_ray_caster.blender.output import reports


@pytest.fixture
def ended(capfd):
    """A function that renders and checks that nothing is said, kept or left running."""

    def ended():
        with RenderCall().handed() as call:
            bpy.ops.render.render()
        assert call.stopped
        assert reports.latest() is None
        assert "Error" not in "".join(capfd.readouterr())

    return ended


@pytest.mark.parametrize("more", [(0, 1), (1, 0), (-1, 0), (40, 40)])
def test_a_result_of_another_size_is_left_alone(scene, monkeypatch, ended, more):
    """As after a change of the resolution: TypeError: expected sequence size 9216, got 57600."""

    def store(self, depsgraph):
        height, width = scene.render.resolution_y + more[0], scene.render.resolution_x + more[1]
        image = np.zeros((height, width, 4), np.float32)
        self.store({"Combined": ("combined", image)}, slice(0, height), depsgraph.view_layer_eval.name, "")

    monkeypatch.setattr(CameraRayCaster, "render_layer", store)
    if more == (-1, 0):  # some rows of the result
        bpy.ops.render.render()
        return
    ended()


@pytest.mark.cases(1)
@pytest.mark.parametrize("method", ["render_eye", "store", "keep"])
def test_an_engine_that_blender_has_freed_is_not_touched_again(scene, slow, monkeypatch, ended, method):
    """Blender raises that of every method then; threads end before the render does."""
    scene.render.resolution_x = scene.render.resolution_y = 1000
    before, calls = set(threading.enumerate()), []

    def freed(self, *words, **more):
        calls.append(method)
        raise ReferenceError("StructRNA of type CameraRayCaster has been removed")

    monkeypatch.setattr(CameraRayCaster, method, freed)
    ended()
    assert len(calls) == 1
    assert set(threading.enumerate()) <= before


@pytest.mark.parametrize("method", ["update_stats", "update_progress", "test_break"])
def test_progress_of_an_engine_that_blender_has_freed_stops_the_cast(method):
    def freed(*words):
        raise ReferenceError("StructRNA of type CameraRayCaster has been removed")

    stand_in = SimpleNamespace(doing=("", ""), update_stats=print, update_progress=print)
    setattr(stand_in, method, freed)
    if method == "test_break":
        assert CameraRayCaster.has_ended(stand_in) is True
    else:
        assert CameraRayCaster.advance(stand_in, 0.5) is False


def test_an_engine_that_blender_has_freed_has_no_words_for_its_progress():
    class Freed:
        @property
        def doing(self):
            raise ReferenceError("StructRNA of type CameraRayCaster has been removed")

    assert CameraRayCaster.advance(Freed(), 0.5) is False


@pytest.mark.full
def test_disabled_during_a_render_the_add_on_waits_until_that_has_ended(scene, slow, ended):
    """Blender frees the engine's class then; in a window the render is on a thread of its own."""
    scene.render.resolution_x = scene.render.resolution_y = 1000
    waited = []

    def disable():
        while not engine._rendering:
            pass
        engine.stop()
        waited.append(not engine._rendering)

    disabling = threading.Thread(target=disable)
    disabling.start()
    ended()
    disabling.join()
    assert waited == [True]
