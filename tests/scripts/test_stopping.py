"""Runs that are ended before they are done leave nothing, and say so in one line."""

import signal
import sys
import time

import pytest

from .running import ROOT, left, small, start


@pytest.mark.cases(1)
@pytest.mark.skipif(sys.platform == "win32", reason="Windows ends a process without telling it")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_run_that_is_ended_leaves_good_files_and_nothing_else(blender, tmp_path, name):
    path = small(blender, tmp_path / "large.blend", resolution_x=4000, resolution_y=4000)
    out = tmp_path / "out"
    out.mkdir()
    (out / "large.exr").write_text("good")
    with start(ROOT / "scripts" / "cast.py", path, "--output", out) as run:
        end = time.monotonic() + 300
        while len(left(out)) == 1 and time.monotonic() < end:
            time.sleep(0.05)
        assert len(left(out)) == 2  # the folder in which the new files are being made
        run.send_signal(getattr(signal, name))
        assert run.wait(300) == 130
        assert len(run.stderr.read().splitlines()) == 1
    assert left(out) == ["large.exr"]
    assert (out / "large.exr").read_text() == "good"


@pytest.mark.parametrize("callback", ["load_post", "depsgraph_update_post", "render_init", "render_post"])
def test_a_signal_within_a_callback_of_blenders_ends_the_run_in_one_line(blender, tmp_path, capfd, callback):
    """Python runs a signal's handler where it next runs at all, and Blender prints and drops what a callback raises."""
    from camera_ray_caster.blender.process import signals
    from camera_ray_caster.blender.terminal import commands

    path = small(blender, tmp_path / "small.blend")
    handlers = getattr(blender.app.handlers, callback)
    called = []

    @blender.app.handlers.persistent
    def interrupted(*_):
        if not called:
            signals.stop()
        called.append(True)

    handlers.append(interrupted)
    try:
        status = commands.main("cast", [str(path), "--output", str(tmp_path / "out")], "cast.py")
    finally:
        handlers.remove(interrupted)
    assert called
    assert status == 130
    assert capfd.readouterr().err == "cast.py: stopped; no unfinished files were left behind\n"
    assert not (tmp_path / "out").exists()
    assert not signals.is_stopping()


@pytest.mark.parametrize("command", ["cast", "verify"])
def test_a_signal_ends_the_reading_of_a_camera_that_moves(blender, tmp_path, capfd, command):
    from camera_ray_caster.blender.process import signals
    from camera_ray_caster.blender.terminal import commands

    visited = []

    @blender.app.handlers.persistent
    def interrupted(*_):
        visited.append(True)
        if len(visited) == 1:
            signals.stop()

    blender.app.handlers.frame_change_post.append(interrupted)
    output = ("--output", str(tmp_path / "out")) if command == "cast" else ()
    try:
        status = commands.main(command, [str(ROOT / "blend_scenes" / "rolling_shutter.blend"), *output], "it")
    finally:
        blender.app.handlers.frame_change_post.remove(interrupted)
    assert status == 130
    assert capfd.readouterr().err == "it: stopped; no unfinished files were left behind\n"
    assert len(visited) <= 3  # the file's frame, the first of the motion, and the file's frame again
    assert not (tmp_path / "out").exists()


def test_a_signal_after_the_render_ends_the_run_before_files_are_written(blender, tmp_path, monkeypatch):
    from camera_ray_caster.blender.process import signals
    from camera_ray_caster.blender.terminal import commands, frame_files

    path = small(blender, tmp_path / "small.blend")
    rendered, save, saved = frame_files._rendered, frame_files._save, []

    def interrupted(*arguments):
        report = rendered(*arguments)
        signals.stop()
        return report

    monkeypatch.setattr(frame_files, "_rendered", interrupted)
    monkeypatch.setattr(frame_files, "_save", lambda *arguments: save(*arguments) or saved.append(arguments))
    assert commands.main("cast", [str(path), "--output", str(tmp_path / "out")], "cast.py") == 130
    assert saved == []
    assert not (tmp_path / "out").exists()


def test_a_second_signal_is_not_waited_for():
    from camera_ray_caster.blender.process import signals

    try:
        signals.stop()
        with pytest.raises(KeyboardInterrupt):
            signals.stop()
    finally:
        signals.reset()


@pytest.mark.cases(1)
@pytest.mark.parametrize("moment", [0, 300, 700])
def test_a_stop_is_heard_while_many_objects_are_read(blender, moment, monkeypatch):
    """At once, not when all have been read: of the instances of each block only some are looked at."""
    from camera_ray_caster.blender.process import signals
    from camera_ray_caster.blender.read import depsgraph_shapes, instance_groups
    from camera_ray_caster.core.records import Cancelled

    blender.ops.mesh.primitive_plane_add()
    plane = blender.context.object
    for _ in range(999):
        blender.context.collection.objects.link(plane.copy())
    seen, add = [], depsgraph_shapes._Scene.add

    def counting(*arguments):
        seen.append(True)
        return add(*arguments)

    monkeypatch.setattr(depsgraph_shapes._Scene, "add", counting)
    depsgraph = blender.context.evaluated_depsgraph_get()
    with pytest.raises(Cancelled), signals.heard(lambda: len(seen) >= moment):
        depsgraph_shapes.shapes_record(depsgraph)
    assert moment <= len(seen) < moment + instance_groups.LISTEN
    assert len(depsgraph_shapes.shapes_record(depsgraph)) == 1000  # it was asked for that one reading only


def test_what_a_thread_asks_is_not_asked_in_another():
    from threading import Thread

    from camera_ray_caster.blender.process import signals

    answers = []
    with signals.heard(lambda: True):
        other = Thread(target=lambda: answers.append(signals.is_stopping()))
        other.start()
        other.join()
        assert signals.is_stopping()
    assert answers == [False]
    assert not signals.is_stopping()
