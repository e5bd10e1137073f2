"""What cast.py --engine CYCLES writes: Cycles' picture, and our passes beside it, in one file."""

import json
import signal
import sys
import time

import numpy as np
import pytest

from ..exr import read_exr
from .running import ROOT, left, refused, script, small, start

WORDS = "--engine", "cycles", "--samples", "2"


def test_cycles_picture_stands_beside_our_passes(blender, tmp_path):
    path = small(blender, tmp_path / "small.blend")
    blender.context.scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    blender.ops.object.light_add(type="SUN")
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    before = path.read_bytes()
    done = script("cast", path, *WORDS, "--passes", "combined,distance,valid", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert path.read_bytes() == before
    assert left(tmp_path / "out") == ["report.json", "small.exr", "small.png"]
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["combined"] == {"engine": "CYCLES", "device": "CPU", "samples": 2}
    assert report["seconds"]["cycles"] > 0
    assert set(report["passes"]) == {"combined", "distance", "valid"}
    channels = read_exr(tmp_path / "out" / "small.exr")
    lit = channels["ViewLayer.Combined.R"] > 0
    hit = np.isfinite(channels["ViewLayer.Distance.X"])
    assert hit.any()
    assert lit[hit].mean() > 0.9


def test_meshes_are_meshes_beside_cycles_picture(command, blender, tmp_path):
    """Normals are those of the faces that the picture shows. A shape that an object asks for stays exact."""
    path = small(blender, tmp_path / "small.blend")
    blender.ops.mesh.primitive_uv_sphere_add(location=(0, 0, 50))
    blender.context.object.name = "Asked"
    blender.context.object.camera_ray_caster.primitive = "SPHERE"
    blender.ops.object.light_add(type="SUN")
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    kinds, passes = {}, ("--passes", "combined,normal,face_index", "--format", "NPZ")
    for engine, words in (("CYCLES", WORDS), ("CAMERA_RAY_CASTER", ())):
        out = tmp_path / engine
        done = command("cast", path, *words, *passes, "--output", out)
        assert (done.returncode, done.stderr) == (0, "")
        report = json.loads((out / "report.json").read_text())
        kinds[engine] = {run["object"]: run["kind"] for run in report["indices"]["ViewLayer"]["shape_index"]}
    assert kinds["CYCLES"] == {"Sphere": "MESH", "Asked": "SPHERE"}
    assert kinds["CAMERA_RAY_CASTER"] == {"Sphere": "SPHERE", "Asked": "SPHERE"}
    with np.load(tmp_path / "CYCLES" / "small.npz") as faces:
        met = faces["face_index"] >= 0
        polygons = blender.data.objects["Sphere"].data.polygons
        normals = np.array([polygon.normal for polygon in polygons])[faces["face_index"][met]]
        assert met.any()
        np.testing.assert_allclose(np.abs((faces["normal"][met] * normals).sum(axis=-1)), 1, atol=1e-5)


def test_each_frame_has_its_picture(command, blender, tmp_path):
    path = small(blender, tmp_path / "small.blend")
    blender.ops.object.light_add(type="SUN")
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    done = command("cast", path, *WORDS, "--passes", "combined", "--frames", "1:2", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    pictures = [read_exr(tmp_path / "out" / f"small_000{k}.exr")["ViewLayer.Combined.R"] for k in (1, 2)]
    assert all(picture.any() for picture in pictures)
    assert not np.array_equal(*pictures)
    assert json.loads((tmp_path / "out" / "report_0002.json").read_text())["combined"]["engine"] == "CYCLES"


def test_our_own_picture_says_so(command, scene, tmp_path):
    assert command("cast", scene, "--output", tmp_path / "out").returncode == 0
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert report["combined"] == {"engine": "CAMERA_RAY_CASTER", "samples": 1}


WRONG = {
    "no such engine": (["--engine", "LUXCORE"], "CYCLES"),
    "samples of our own": (["--samples", "4"], "--samples applies to --engine CYCLES and EEVEE only"),
    "no samples": (["--engine", "CYCLES", "--samples", "0"], "not a number of samples"),
    "half a sample": (["--engine", "CYCLES", "--samples", "0.5"], "'0.5'"),
}


@pytest.mark.parametrize("case", WRONG)
def test_bad_words_are_refused(command, scene, tmp_path, case):
    words, message = WRONG[case]
    assert message in refused(command("cast", scene, *words, "--output", tmp_path / "out"))
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("lacks", "message"), [("Cycles", "Cycles is disabled"), ("OSL", "Open Shading Language")])
def test_a_blender_that_cannot_is_refused(command, scene, tmp_path, monkeypatch, lacks, message):
    import _cycles
    import addon_utils

    if lacks == "OSL":
        monkeypatch.setattr(_cycles, "with_osl", False)
    else:
        addon_utils.disable("cycles")
    try:
        for name, words in ("cast", WORDS), ("to_cycles", ()):
            output = tmp_path / ("out" if name == "cast" else "copy.blend")
            assert message in refused(command(name, scene, *words, "--output", output))
            assert not output.exists()
    finally:
        addon_utils.enable("cycles")


def test_a_device_without_shaders_is_warned_of(command, scene, tmp_path, monkeypatch):
    from camera_ray_caster.blender.terminal import picture_jobs

    monkeypatch.setattr(picture_jobs, "device_notes", lambda scene: ["Cycles renders on CUDA"])
    done = command("cast", scene, *WORDS, "--output", tmp_path / "out")
    assert done.returncode == 0
    assert "cast.py: warning: Cycles renders on CUDA" in done.stderr.splitlines()


@pytest.mark.cases(1)
@pytest.mark.skipif(sys.platform == "win32", reason="Windows ends a process without telling it")
@pytest.mark.parametrize("unread", [False, True])
def test_a_signal_ends_cycles_at_once_whoever_reads_of_it(blender, tmp_path, unread):
    path = small(blender, tmp_path / "large.blend", resolution_x=4000, resolution_y=4000)
    out, started = tmp_path / "out", tmp_path / "started"
    code = f"""
import sys
sys.argv = ["cast.py", {str(path)!r}, "--engine", "CYCLES", "--samples", "100000", "--output", {str(out)!r}]
sys.path[:0] = [{str(ROOT / "scripts")!r}, {str(ROOT / "addon")!r}]
import bpy
@bpy.app.handlers.persistent
def begun(*_):
    open({str(started)!r}, "w").close()
bpy.app.handlers.render_init.append(begun)
from door import through
sys.exit(through("cast"))
"""
    with start("-c", code) as run:
        end = time.monotonic() + 300
        while not started.exists() and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(0.5)  # it is in Cycles by now
        if unread:
            run.stderr.close()
        run.send_signal(signal.SIGTERM)
        try:
            assert run.wait(300) == 130
        finally:
            run.kill()
        assert unread or run.stderr.read() == "cast.py: stopped; no unfinished files were left behind\n"
    assert not out.exists()
