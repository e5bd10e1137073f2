"""What dataset.py makes, what of it a second run takes, and what it refuses."""

import errno
import json
import subprocess
import sys

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.sets import read_set

from .running import ROOT, complaints, left, refused, script

WORDS = "--cameras", "ALL", "--frames", "1:2", "--passes", "depth,ray_origin,ray_direction"


@pytest.fixture
def out(tmp_path):
    """The folder of the data set."""
    return tmp_path / "out"


def read(out, stem):
    """All arrays of a frame, from every file that its report lists."""
    files = json.loads((out / f"{stem}.json").read_text())["made"]["files"]
    return {name: array for file in files for name, array in np.load(out / file).items()}


def test_rays_of_a_camera_that_stands_still_are_written_once(command, scene, out, tmp_path):
    done = command("dataset", scene, *WORDS, "--output", out)
    assert (done.returncode, done.stderr) == (0, "")
    wrote, note = done.stdout.splitlines()
    assert wrote == f"Wrote 4 pictures into {out}"
    assert note.startswith("'Sphere': the exact shape is up to 0.96% of its radius away from the mesh")
    stems = [f"{camera}_{of}" for camera in ("Side", "Top") for of in ("0001", "0002", "rays")]
    assert left(out) == [*(f"{stem}.{kind}" for stem in stems for kind in ("json", "npz")), "dataset.json",
                         "preview.png", "reader.py"]  # fmt: skip
    output = subprocess.run([sys.executable, out / "reader.py"], capture_output=True, text=True, check=True).stdout
    assert [line.split()[0] for line in output.splitlines()] == stems
    assert [view.name for view in read_set(out)] == [stem for stem in stems if "rays" not in stem]
    has_rays = {stem: "ray_origin" in np.load(out / f"{stem}.npz") for stem in stems}
    assert [stem for stem in stems if has_rays[stem]] == ["Side_rays", "Top_0002", "Top_rays"]
    rays = crc.camera_from_json(out / "Side_0002.json").rays()
    for name in "ray_origin", "ray_direction":
        assert (np.load(out / "Side_rays.npz")[name] == getattr(rays, f"{name[4:]}s").astype(np.float32)).all()
    command("cast", scene, *WORDS, "--format", "npz", "--output", tmp_path / "cast")
    for stem in stems:
        if "rays" not in stem:
            passes, expected = read(out, stem), dict(np.load(tmp_path / "cast" / f"{stem}.npz"))
            assert passes.keys() == expected.keys()
            assert all((passes[name] == expected[name]).all() for name in expected)


def test_a_map_that_has_gone_is_made_again_with_the_frames_that_need_it(command, scene, out):
    command("dataset", scene, *WORDS, "--output", out)
    (out / "Side_rays.npz").unlink()
    assert command("dataset", scene, *WORDS, "--output", out).stdout.startswith("Wrote 0 of 4 pictures")
    assert "ray_direction" in read(out, "Side_0001")
    later = command("dataset", scene, *WORDS[:3], "2:3", *WORDS[4:], "--output", out)
    assert later.stdout.startswith("Wrote 2 of 4 pictures")
    assert [len(np.load(out / f"Side_{of}.npz")) for of in ("0001", "0002", "0003", "rays")] == [1, 1, 1, 2]


def test_cameras_and_frames_are_the_file_s_where_none_are_named(command, blender, scene, out):
    blender.context.scene.frame_start, blender.context.scene.frame_end = 2, 6
    blender.context.scene.frame_step = 2
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert command("dataset", scene, "--format", "exr", "--output", out).returncode == 0
    stems = [f"Top_{frame}" for frame in ("0002", "0004", "0006")]
    assert left(out) == [*(f"{stem}.{kind}" for stem in stems for kind in ("exr", "json", "png")), "dataset.json",
                         "preview.png", "reader.py"]  # fmt: skip


@pytest.mark.parametrize("case", ["passes", "sha256", "a word", "a list"])
def test_the_folder_of_another_data_set_is_refused(command, blender, scene, out, case):
    command("dataset", scene, *WORDS, "--output", out)
    words, message = WORDS, "not the file of a data set"
    if case == "passes":
        words, message = (*WORDS[:-1], "depth"), "a data set that differs in passes:"
    elif case == "sha256":
        blender.data.objects["Sphere"].location.x = 0.25
        blender.ops.wm.save_as_mainfile(filepath=str(scene))
        message = "a data set that differs in sha256:"
    else:
        (out / "dataset.json").write_text({"a word": "word", "a list": "[1]"}[case])
    before = {path.name: path.stat().st_mtime_ns for path in out.iterdir()}
    assert message in refused(command("dataset", scene, *words, "--output", out))
    assert {path.name: path.stat().st_mtime_ns for path in out.iterdir()} == before


CALIBRATION = "width: 32\nheight: 24\nK: [{0}, 0, 16, 0, {0}, 12, 0, 0, 1]\nD: []\n"
GLASS = "# a singlet\n{0} 5 1.5 20\n0 1 1 8\n-{0} 48 1 20\n"


@pytest.mark.parametrize(
    ("model", "file", "text"),
    [("OPENCV_PINHOLE", "calibration_file", CALIBRATION), ("REAL_LENS", "lens_file", GLASS)],
    ids=["calibration", "lens"],
)
def test_a_file_that_the_camera_names_is_part_of_the_set(command, blender, scene, out, model, file, text):
    """A changed lens made frames of both lenses, with status 0."""
    lens = scene.with_name("lens.dat")
    lens.write_text(text.format(30))
    settings = blender.data.objects["Top"].data.camera_ray_caster
    settings.model = model
    setattr(settings, file, "//lens.dat")
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert command("dataset", scene, *WORDS, "--output", out).returncode == 0
    assert command("dataset", scene, *WORDS, "--output", out).stdout.startswith("Wrote 0 of 4")
    lens.write_text(text.format(31))
    assert "a data set that differs in uses:" in refused(command("dataset", scene, *WORDS, "--output", out))


def test_of_two_sets_that_begin_at_once_one_has_the_folder(out, monkeypatch):
    """The other one comes between the moment at which the first sees no set there and that at which it writes."""
    from camera_ray_caster.blender.terminal import dataset
    from camera_ray_caster.core.records import InputError

    stamps = [{"settings": {"passes": name}} for name in ("depth", "normal")]
    begun = dataset.json.dumps

    def between(*words, **options):
        monkeypatch.undo()
        dataset._claim(out, stamps[1])
        return begun(*words, **options)

    monkeypatch.setattr(dataset.json, "dumps", between)
    with pytest.raises(InputError, match="a data set that differs in passes:"):
        dataset._claim(out, stamps[0])
    assert json.loads((out / "dataset.json").read_text()) == stamps[1]


def test_no_space_leaves_whole_frames(command, scene, out, monkeypatch):
    from camera_ray_caster.blender.output import arrays

    save = arrays.save

    def full(path, *arguments):
        if path.stem == "Top_0001":
            path.write_bytes(b"cut off")
            raise OSError(errno.ENOSPC, "No space left on device")
        save(path, *arguments)

    monkeypatch.setattr(arrays, "save", full)
    assert "No space left on device" in refused(command("dataset", scene, *WORDS, "--output", out))
    assert [name for name in left(out) if name.startswith(("Top_0", "."))] == []
    monkeypatch.undo()
    assert command("dataset", scene, *WORDS, "--output", out).stdout.startswith("Wrote 3 of 4 pictures")


def test_a_camera_that_cannot_be_cast_is_refused_before_anything_is_made(command, blender, scene, out):
    blender.data.objects["Side"].scale.y = 0
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert "scale of zero" in refused(command("dataset", scene, *WORDS, "--output", out))
    assert not out.exists()


def test_a_scene_without_a_view_layer_is_refused_before_anything_is_made(command, blender, scene, out):
    blender.context.view_layer.use = False
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    assert "view layer" in refused(command("dataset", scene, *WORDS, "--output", out))
    assert not out.exists()


REFUSED = {
    "--workers 0": "give 1 or more",
    "--workers 2 --scheduler tcp://127.0.0.1:1": "not allowed with",
    "--scheduler tcp://127.0.0.1:1": "no Dask scheduler answers at 'tcp://127.0.0.1:1'",
    "--scheduler nothing://x": "'nothing://x' is not an address: give an address such as tcp://HOST:PORT",
    "--frame 1": "not allowed with",
}


@pytest.mark.parametrize("words", REFUSED)
def test_a_farm_that_is_not_there_is_refused(command, scene, out, monkeypatch, words):
    from camera_ray_caster.blender.terminal import farm

    monkeypatch.setattr(farm, "ANSWER", "1s")
    assert REFUSED[words] in refused(command("dataset", scene, *WORDS, *words.split(), "--output", out))
    assert not out.exists()


def test_a_python_without_dask_is_told_what_it_needs(command, scene, out, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert "need Dask" in refused(command("dataset", scene, *WORDS, "--workers", "2", "--output", out))
    assert command("dataset", scene, *WORDS, "--output", out).returncode == 0


IN_A_THREAD = """
from argparse import Namespace
from contextlib import suppress
from threading import Thread
from camera_ray_caster.blender.terminal import farm

def use():
    with suppress(AttributeError):  # it is registered by then
        farm.work(Namespace(), {}, {}, [])

worker = Thread(target=use)
worker.start()
worker.join()
"""


@pytest.mark.full
def test_a_worker_whose_thread_has_used_blender_ends_well():
    done = subprocess.run([sys.executable, "-c", IN_A_THREAD], capture_output=True, text=True, timeout=300, check=False)
    assert (done.returncode, complaints(done.stderr)) == (0, [])


@pytest.mark.full
def test_two_workers_make_what_one_process_makes(scene, out, tmp_path):
    done = script("dataset", scene, *WORDS, "--workers", "2", "--output", out)
    assert (done.returncode, complaints(done.stderr)) == (0, [])
    alone = script("dataset", scene, *WORDS, "--output", tmp_path / "one")
    summary, *notes = done.stdout.splitlines()
    assert summary == f"Wrote 4 pictures into {out}"
    assert notes == alone.stdout.splitlines()[1:]
    assert left(out) == left(tmp_path / "one")
    for path in out.glob("*.npz"):
        assert path.read_bytes() == (tmp_path / "one" / path.name).read_bytes()


@pytest.mark.full
def test_a_cast_by_workers_is_one_by_this_process(scene, tmp_path):
    single, two = tmp_path / "one", tmp_path / "two"
    alone = script("cast", scene, *WORDS, "--format", "npz", "--output", single)
    done = script("cast", scene, *WORDS, "--format", "npz", "--workers", "2", "--output", two)
    assert (done.returncode, complaints(done.stderr)) == (0, [])
    assert done.stdout == alone.stdout.replace(str(single), str(two))
    assert left(single) == left(two)
    for path in two.glob("*.npz"):
        assert path.read_bytes() == (single / path.name).read_bytes()


@pytest.fixture
def scheduler(tmp_path):
    """The address of a Dask cluster that others have started: a scheduler, and one worker."""
    known = tmp_path / "scheduler.json"
    started = [
        subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{name}", "--no-dashboard", "--scheduler-file", known, *words],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        for name, words in (("dask_scheduler", ["--port", "0"]), ("dask_worker", ["--nthreads", "1"]))
    ]  # fmt: skip
    while not (known.exists() and known.read_text()):
        assert started[0].poll() is None
    yield json.loads(known.read_text())["address"]
    for process in reversed(started):
        process.terminate()
        process.wait(30)


@pytest.mark.full
def test_any_cluster_of_dask_makes_them_and_what_its_workers_refuse_is_one_line(blender, scene, out, scheduler):
    side = blender.data.objects["Side"]
    for frame, scale in (2, 1), (3, 0):
        side.scale.y = scale
        side.keyframe_insert("scale", frame=frame)
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    words = ("--passes", "depth", "--scheduler", scheduler, "--output", out)
    done = script("dataset", scene, *WORDS[:3], "1:2", *words)
    assert (done.returncode, complaints(done.stderr)) == (0, [])
    summary, note = done.stdout.splitlines()
    assert summary == f"Wrote 4 pictures into {out}"
    assert note.startswith("'Sphere': the exact shape is up to 0.96% of its radius away from the mesh")
    bad = script("dataset", scene, *WORDS[:3], "1:3", *words)
    (line,) = complaints(bad.stderr)
    assert (bad.returncode, bad.stdout) == (2, "")
    assert "scale of zero" in line
    assert [name for name in left(out) if name.startswith((".", "Side_0003"))] == []


def test_cameras_whose_time_is_an_image_have_a_preview_too(blender, command, scene, out):
    """A report has no record of them."""
    settings = blender.data.objects["Side"].data.camera_ray_caster
    settings.time_mode, settings.time_image = "IMAGE", blender.data.images.new("Time", 2, 2)
    blender.ops.wm.save_as_mainfile(filepath=str(scene))
    done = command("dataset", scene, "--cameras", "Side", "--frames", "1:1", "--passes", "normal", "--output", out)
    assert (done.returncode, done.stderr) == (0, "")
    assert (out / "preview.png").is_file()


def test_flow_of_a_scanner_is_refused_before_anything_is_made(command, tmp_path):
    scene = ROOT / "blend_scenes" / "street_scanner.blend"
    words = ["--frames", "1:1", "--passes", "depth,flow_hidden", "--output", tmp_path / "out"]
    line = refused(command("dataset", scene, *words))
    assert "has no flow_hidden: its pixels are single beams" in line
    assert not (tmp_path / "out").exists()
