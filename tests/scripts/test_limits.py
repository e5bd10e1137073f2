"""Processes that may have few open files, little memory or few threads: one line says so."""

import errno
import os
import sys
from types import SimpleNamespace

import pytest

from .running import ROOT, refused, start

LIMIT = "resource.setrlimit(resource.{}, ({}, {})); os.execv(sys.executable, [sys.executable, *sys.argv[1:]])"


@pytest.mark.full
@pytest.mark.cases(1)
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such limits")
@pytest.mark.parametrize("files", [16, 36, pytest.param(44, marks=pytest.mark.full)])
def test_workers_that_may_not_open_enough_files_are_refused_in_one_line(scene, tmp_path, files):
    pytest.importorskip("distributed")
    limit = LIMIT.format("RLIMIT_NOFILE", files, files)
    words = [ROOT / "scripts" / "dataset.py", scene, "--frames", "1:2", "--workers", "2", "--output", tmp_path / "out"]
    run = start("-c", f"import os, resource, sys; {limit}", *words)
    out, errors = run.communicate(timeout=300)
    assert (run.returncode, out) == (2, ""), errors
    (line,) = errors.splitlines()
    assert "oo many open files" in line


ERRORS = {
    "memory": MemoryError(),
    "threads": RuntimeError("can't start new thread"),
    "open files": OSError(errno.EMFILE, os.strerror(errno.EMFILE)),
}


PLACES = "engine.job.cast", "output.reports.camera_at", "terminal.picture_jobs.frame_files.render"


@pytest.mark.parametrize("what", ERRORS)
@pytest.mark.parametrize("place", PLACES)
def test_what_a_cast_has_run_out_of_is_said_in_one_line(command, scene, tmp_path, monkeypatch, what, place):
    def fail(*words, **more):
        raise ERRORS[what]

    monkeypatch.setattr(f"camera_ray_caster.blender.{place}", fail)
    line = refused(command("cast", scene, "--output", tmp_path / "out"))
    assert line == f"cast.py: not enough {what}: raise the limits of this process (ulimit), or end other programs"
    assert not (tmp_path / "out").exists()


def test_a_data_set_of_which_no_picture_could_be_made_is_not_begun(command, scene, tmp_path, monkeypatch):
    def fail(*words, **more):
        raise MemoryError

    monkeypatch.setattr("camera_ray_caster.blender.engine.job.cast", fail)
    words = "--cameras", "Side", "--frames", "1:1", "--output", tmp_path / "out"
    assert "not enough memory" in refused(command("dataset", scene, *words))
    assert not (tmp_path / "out").exists()


def test_an_error_of_another_kind_is_none_of_these(command, scene, tmp_path, monkeypatch):
    def fail(*words, **more):
        raise RuntimeError("another")

    monkeypatch.setattr("camera_ray_caster.blender.terminal.picture_jobs.frame_files.render", fail)
    with pytest.raises(RuntimeError, match="another"):
        command("cast", scene, "--output", tmp_path / "out")


def test_workers_that_have_all_ended_are_not_waited_for(monkeypatch):
    """Under little memory they end as they import Blender, and Dask gives up to start them again."""
    from camera_ray_caster.blender.terminal import tasks
    from camera_ray_caster.core.records import InputError

    waiting = type("Task", (), {"done": lambda self: False})()
    nobody = {"nthreads": dict, "scheduler_info": lambda: {"workers": {}}}
    client = SimpleNamespace(submit=lambda *words, **more: waiting, **nobody)
    monkeypatch.setattr(tasks, "CHECK", 0)
    made = tasks.Tasks(client, list, iter(["a job"]), lambda job: None)
    with pytest.raises(InputError, match=r"all workers have ended; .*give fewer --workers"):
        list(made.outcomes())
