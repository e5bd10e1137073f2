"""Rendered shading of a 3D View whose pictures take long: a redraw waits for none of them."""

from time import perf_counter, sleep
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from camera_ray_caster.blender.engine import viewport

PICTURE = 1.0
"""Seconds that each picture takes here, many times as long as a redraw may wait."""


@pytest.fixture
def view(camera_scene, monkeypatch):
    """A view whose pictures are made and shown without a graphics card; ``shown`` has their steps, in order,
    and ``arrays`` the pictures.
    """
    cast = viewport._cast
    view = viewport.Viewport()
    view.shown, view.arrays, view.seconds = [], [], 0.0

    def slow_cast(target, shapes, shown, step, spare, progress=None):
        sleep(view.seconds)
        images, rectangle = cast(target, shapes, shown, step, spare, progress)
        return images, (step, rectangle)

    def show(self, picture):
        images, (step, self._picture) = picture if len(picture[1]) == 2 else (picture[0], ("mean", picture[1]))
        self.shown.append(step)
        self.arrays.append(images["combined"])

    monkeypatch.setattr(viewport, "_cast", slow_cast)
    monkeypatch.setattr(viewport.Viewport, "_show", show)
    monkeypatch.setattr(viewport.Viewport, "_draw", lambda self, scene: None)
    monkeypatch.setattr(viewport.Viewport, "update_stats", lambda *_: None, raising=False)
    yield view
    viewport.stop()


def drawn(view, away=6):
    """Draw the view from a distance; return the seconds that it took."""
    projection = bpy.context.scene.camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=96, y=64)
    looking = SimpleNamespace(
        view_perspective="PERSP", view_matrix=Matrix.Translation((0, 0, -away)), window_matrix=projection
    )
    names = ("scene", "view_layer", "evaluated_depsgraph_get")
    context = SimpleNamespace(
        region=SimpleNamespace(width=96, height=64), region_data=looking,
        **{name: getattr(bpy.context, name) for name in names},
    )  # fmt: skip
    started = perf_counter()
    view.view_draw(context, bpy.context.evaluated_depsgraph_get())
    return perf_counter() - started


def finished(view):
    """Wait for the picture that is being cast."""
    assert view._worker.wait(300)


def test_a_quick_picture_is_shown_at_once_and_the_last_one_follows(view):
    drawn(view)
    if view.shown != [8]:  # on a busy machine
        finished(view)
        drawn(view)
    assert view.shown == [8]
    while view._worker is not None:
        finished(view)
        drawn(view)
    assert view.shown[-1] == 1


def test_a_redraw_does_not_wait_for_a_slow_picture_and_the_next_one_is_coarser(view):
    drawn(view)  # what is read and compiled once is not counted
    while view._worker is not None:
        finished(view)
        drawn(view)
    view.seconds, view._first = PICTURE, viewport.FIRST
    assert drawn(view, 7) < PICTURE / 2
    first = view._worker
    assert drawn(view, 8) < PICTURE / 2
    assert view._worker is first, "it is shown though the view has changed: a picture that is late is one"
    finished(view)
    count = len(view.shown)
    assert drawn(view, 9) < PICTURE / 2
    assert view.shown[count:] == [8]
    finished(view)
    drawn(view, 9)
    assert view.shown[count:] == [8, 32]
    finished(view)
    drawn(view, 9)
    assert view.shown[count:] == [8, 32, 8], "then it becomes finer"


def test_a_picture_takes_the_memory_of_the_last_one_of_its_size(view):
    for away in (6, 7):
        drawn(view, away)
        while view._worker is not None:
            finished(view)
            drawn(view, away)
    for step in (8, 1):
        first, second = (array for array, shown in zip(view.arrays, view.shown, strict=True) if shown == step)
        assert first is second


def test_means_of_samples_follow_and_the_last_picture_is_that_of_all_samples(view, monkeypatch):
    """With the bits of a render: of ``cast`` with these samples. Each mean is shown as soon as it is there."""
    bpy.context.scene.camera_ray_caster.samples = 5
    bpy.ops.mesh.primitive_monkey_add()
    means, keep = [], viewport._keep

    def kept(pictures, target, combined, rows, samples):
        keep(pictures, target, combined, rows, samples)
        means.append((samples, combined.copy()))
        while pictures and samples:  # until the view has shown it
            sleep(0.01)

    monkeypatch.setattr(viewport, "_keep", kept)
    drawn(view)
    while view._worker is not None:
        if viewport._news.is_set() or view._worker.done:
            viewport.redraw_if_finished()
            drawn(view)
        sleep(0.01)
    assert view.shown[-5:] == [1, *["mean"] * 3, 1], view.shown
    assert [samples for samples, _ in means if samples] == [1, 2, 4]
    camera, shapes = view._target.camera(1), viewport.cached_scene(bpy.context).shapes
    for count, array in zip((1, 2, 4, 5), view.arrays[-4:], strict=True):
        wanted = viewport.cast(camera, shapes, passes="combined", samples=count)["combined"]
        assert (array == wanted).all(), count
    assert not (view.arrays[-1] == view.arrays[-5]).all()


def test_a_mean_of_more_samples_takes_the_place_of_one_that_was_not_shown():
    target, means = SimpleNamespace(camera=lambda step: SimpleNamespace(raster=None), rectangle=lambda raster: 0), []
    for samples in (0, 1, 2):
        viewport._keep(means, target, np.full((1, 1, 4), samples), slice(0, 1), samples)
    viewport._news.clear()
    assert [image["combined"].max() for image, _ in means] == [2]
