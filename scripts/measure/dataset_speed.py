"""The benchmark of a data set: the cost of a picture compared with writing it, and the gain by two Dask processes.

Processor seconds count only a process and its children, so that other load on the machine matters less. The startup
time (Python, Blender, the cluster) is excluded: the difference between a long and a short run is divided by the
difference of their pictures.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from time import perf_counter, process_time

import numpy as np

from camera_ray_caster.core.casting.passes import PASSES

SCRIPT = Path(__file__).parents[1] / "dataset.py"
CAMERAS, SIZE = 3, (640, 480)
PASSES_CAST = [name for name in PASSES if not name.endswith("_bound") and not name.startswith("flow_")]
FEW = 2
"""Frames of the short run: enough work for each worker."""


def run(frames: int) -> list[dict]:
    """Print and return the figures of a scene of meshes: ``frames`` frames of three cameras, the passes PASSES_CAST."""
    with tempfile.TemporaryDirectory() as folder:
        scene = _scene(Path(folder) / "scene.blend")
        cores = sorted(os.sched_getaffinity(0))[:2]
        rows = [
            _measured(scene, Path(folder) / "one", "one process, one core", frames, cores[:1]),
            _measured(scene, Path(folder) / "two", "one process, two cores", frames, cores),
            _measured(scene, Path(folder) / "dask", "two workers, a core each", frames, cores, "--workers", "2"),
        ]
        single, two, dask = rows
        writing = _writing(sorted((Path(folder) / "one").glob("*_0*.npz")))
    print(f"\n{frames} frames x {CAMERAS} cameras, {SIZE[0]} x {SIZE[1]}, {len(PASSES_CAST)} passes; seconds a picture")
    for row in rows:
        print(f"  {row['name']:28}{row['wall']:8.3f} by the clock{row['cpu']:8.3f} of processors")
    print(f"  {'writing alone':28}{'':21}{writing:8.3f} of processors")
    print(f"  all beside writing alone, processor time: {single['cpu'] / writing:.2f} x")
    print(f"  two workers beside one process on one core: {single['wall'] / dask['wall']:.2f} x as fast by the clock, "
          f"{2 * single['cpu'] / dask['cpu']:.2f} x by processor time")  # fmt: skip
    print(f"  two workers beside one process on the same two cores: {dask['wall'] / two['wall']:.2f} x the time")
    print(f"  a worker's overhead: {1e3 * (dask['cpu'] - single['cpu']):.0f} ms of processors a picture")
    return [*rows, {"name": "writing alone", "cpu": writing}]


def _scene(path: Path) -> Path:
    """Save a scene of monkeys, a ring and a floor, with moving cameras."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_plane_add(size=30)
    bpy.ops.mesh.primitive_torus_add(location=(0, 0, 1), major_radius=3)
    for turn in np.linspace(0, 2 * np.pi, 6, endpoint=False):
        location = 2 * np.cos(turn), 2 * np.sin(turn), 1
        bpy.ops.mesh.primitive_monkey_add(size=1.5, location=location, rotation=(0, 0, turn))
        bpy.ops.object.modifier_add(type="SUBSURF")
    for number in range(CAMERAS):
        bpy.ops.object.camera_add()
        camera = bpy.context.object
        turn = 2 * np.pi * number / CAMERAS
        for frame, height in (1, 3), (100, 6):
            camera.location = 8 * np.cos(turn), 8 * np.sin(turn), height
            camera.rotation_euler = 1.1, 0, turn + np.pi / 2
            camera.keyframe_insert("location", frame=frame)
    scene = bpy.context.scene
    scene.camera, scene.render.resolution_percentage = camera, 100
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def _measured(scene: Path, out: Path, name: str, frames: int, cores: list[int], *words: str) -> dict:
    """Run the script on the given cores; return the seconds per picture: elapsed time and processor time."""
    spent: list[tuple[float, float]] = []
    for last in FEW, FEW + frames:  # the second run skips the first run's pictures
        began, used = perf_counter(), getrusage(RUSAGE_CHILDREN)
        subprocess.run(
            [sys.executable, SCRIPT, scene, "--cameras", "ALL", "--frames", f"1:{last}", "--passes",
             ",".join(PASSES_CAST), "--output", out, *words],
            check=True, stdout=subprocess.DEVNULL, preexec_fn=lambda: os.sched_setaffinity(0, cores),
        )  # fmt: skip
        now = getrusage(RUSAGE_CHILDREN)
        spent.append((perf_counter() - began, now.ru_utime + now.ru_stime - used.ru_utime - used.ru_stime))
    (few_wall, few_cpu), (wall, cpu) = spent
    pictures = CAMERAS * (frames - FEW)
    return {"name": name, "wall": (wall - few_wall) / pictures, "cpu": (cpu - few_cpu) / pictures}


def _writing(files: list[Path]) -> float:
    """Return the processor seconds for writing the arrays and the picture of a frame; the median over ``files``."""
    import bpy

    from camera_ray_caster.blender.output import arrays
    from camera_ray_caster.blender.terminal.frame_files import PICTURE

    spent = []
    for file in files:
        images = dict(np.load(file))
        height, width = images["depth"].shape
        picture = bpy.data.images.new("picture", width, height, alpha=True, float_buffer=True)
        picture.pixels.foreach_set(images["combined"].ravel())
        settings = bpy.context.scene.render.image_settings
        settings.file_format = PICTURE["file_format"]
        began = process_time()
        arrays.save(file, {("", ""): images}, {}, half=False)
        picture.save_render(str(file.with_suffix(".png")))
        spent.append(process_time() - began)
        bpy.data.images.remove(picture)
    return float(np.median(spent))
