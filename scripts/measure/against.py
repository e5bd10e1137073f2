"""Time this checkout against another commit: a fixed list of cases, alternately, each in a process of its own.

The time is that of the processor, over all threads, which other programs change less than that of the clock: of each
process the least of CASTS casts, of all rounds the least. The spread of the rounds' ratios tells what can be concluded.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Callable
from contextlib import contextmanager
from functools import partial
from importlib import import_module
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from time import process_time

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
CASTS = 5
DATA_SET = "data set, 8 frames, with the start"
"""The case that runs once a process: it starts one of its own."""
FOUR, TWO = ("depth", "normal", "position", "object_index"), ("depth", "shape_index")
SPHERES = (10, 1_000, 10_000)
SIDES = {"1k": 22, "63k": 178, "1M": 707}
"""Quads along a side of the meshes, which have twice as many triangles as quads."""


def cases() -> dict[str, Callable]:
    """Return the cases by name; each is a function that takes the picture's size and returns what is timed."""
    from camera_ray_caster.core.cameras import MODELS

    by_name: dict[str, Callable] = {
        f"{count:,} spheres, {len(passes)} passes": partial(spheres, count, passes)
        for passes in (FOUR, TWO)
        for count in SPHERES
    }
    by_name |= {f"{name} triangles, 4 passes": partial(mesh, side, FOUR) for name, side in SIDES.items()}
    by_name["F12, spheres and planes, 5 passes"] = _render
    by_name[DATA_SET] = _dataset
    return by_name | {f"rays, {model.key}": partial(_rays, model.key) for model in MODELS}


def run(commit: str, rounds: int, size: tuple[int, int]) -> list[dict]:
    """Print and return the processor time of each case here and at a commit, and their ratios. Raises LookupError if
    there is no such commit.
    """
    rows = []
    with checked_out(commit) as there:
        print(f"\nprocessor time, ms; {size[0]} x {size[1]}; least of {rounds} rounds of {CASTS}")
        print(f"  {'':34}{'there':>9}{'here':>9}{'here over there':>17}{'its rounds':>14}")
        for name in cases():
            times = [[_timed(root, name, size) for root in (there, ROOT)] for _ in range(rounds)]
            if None in times[0]:
                print(f"  {name:34}{'':>9}   one of the two has it not, or refuses it")
                continue
            before, here = np.min(times, axis=0)
            ratios = sorted(ours / theirs for theirs, ours in times)
            rows.append({"name": name, "there_ms": before, "here_ms": here, "ratio": here / before, "ratios": ratios})
            print(f"  {name:34}{before:9.1f}{here:9.1f}{here / before:16.2f}x{ratios[0]:9.2f}-{ratios[-1]:.2f}")
    return rows


@contextmanager
def checked_out(commit: str):
    """Give a folder with the files of a commit of this repository."""
    with tempfile.TemporaryDirectory() as folder:
        packed = subprocess.run(["git", "-C", ROOT, "archive", commit], capture_output=True, check=False)
        if packed.returncode:
            raise LookupError(f"there is no commit {commit!r} here: give one of git log")
        subprocess.run(["tar", "-x", "-C", folder], input=packed.stdout, check=True)
        yield Path(folder)


def _timed(root: Path, name: str, size: tuple[int, int]) -> float | None:
    """Return the milliseconds of a case with the add-on of a folder; None if it does not have it."""
    words = [sys.executable, "-c", "from measure import against; against.tell()", str(root), name, *map(str, size)]
    done = subprocess.run(words, cwd=ROOT / "scripts", capture_output=True, text=True, check=False)
    return float(done.stdout.splitlines()[-1]) if done.returncode == 0 else None


def _camera(size: tuple[int, int], model: str):
    from camera_ray_caster.core.records import BlenderCamera

    if model != "PERSP":
        return import_module("camera_ray_caster").camera(model, size)
    record = BlenderCamera("Camera", model, np.eye(4), resolution_x=size[0], resolution_y=size[1])
    try:
        module = import_module("camera_ray_caster.core.camera.build")
    except ImportError:  # older than the folder camera/
        module = import_module("camera_ray_caster.core.cameras")
    return module.camera_from(record)


def _cast(size, passes, model, **fields) -> Callable:
    """Return a function that casts the shapes with these fields; it takes options of ``cast``."""
    from camera_ray_caster.core.cast import cast
    from camera_ray_caster.core.records import Shapes

    count = len(fields["kind"])
    index = np.arange(count, dtype=np.int32)
    fields |= {"color": np.ones((count, 4), np.float32)}
    if "centre" in Shapes.__dataclass_fields__:  # as older commits spell them
        fields = {{"center": "centre", "color": "colour"}.get(name, name): values for name, values in fields.items()}
    shapes = Shapes(object_index=index, material_index=index, name_index=index, **fields)
    camera = _camera(size, model)
    return lambda **options: cast(camera, shapes, passes=passes, **{"threads": 2} | options)


def spheres(count: int, passes, size, model: str = "PERSP") -> Callable:
    """Equal spheres without a wall, whose discs have 0.6 of the picture's area in sum."""
    from camera_ray_caster.core.records import SPHERE

    chance = np.random.default_rng(count)
    depth, (across, up) = chance.uniform(12, 30, count), chance.uniform(-1, 1, (2, count))
    wide = 18 / 50
    high = wide * size[1] / size[0]
    center = np.stack((across * wide * depth, up * high * depth, -depth), axis=1)
    radius = np.sqrt(0.6 * 4 * wide * high / np.pi / np.sum(1 / depth**2))
    axes = np.broadcast_to(np.eye(3) * radius, (count, 3, 3)).copy()
    return _cast(size, passes, model, kind=np.full(count, SPHERE, np.uint8), center=center, axes=axes)


def plane(passes, size) -> Callable:
    """A plane that fills the picture."""
    from camera_ray_caster.core.records import PLANE

    center, axes = np.array([[0.0, 0.0, -32.0]]), 40 * np.eye(3)[None]
    return _cast(size, passes, "PERSP", kind=np.array([PLANE], np.uint8), center=center, axes=axes)


def mesh(side: int, passes, size, model: str = "PERSP") -> Callable:
    """A sheet of waves that fills the picture."""
    from camera_ray_caster.core.mesh import Mesh
    from camera_ray_caster.core.records import MESH

    x, y = (coordinate.ravel() for coordinate in np.meshgrid(*2 * [np.linspace(-3, 3, side + 1)]))
    vertices = np.stack((x, y, -6 + 0.2 * np.sin(7 * x) * np.cos(5 * y))).astype(np.float32)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    other = corner + side + 1
    triangles = np.concatenate(([corner, corner + 1, other + 1], [corner, other + 1, other]), axis=1).astype(np.int32)
    sheet = Mesh(vertices, triangles, np.arange(2 * len(corner), dtype=np.int32))
    return _cast(
        size, passes, model,
        kind=np.array([MESH], np.uint8), center=sheet.middle[None], axes=np.eye(3)[None], meshes=(sheet,),
        mesh=np.zeros(1, np.int32), shared=np.zeros(1, bool),
    )  # fmt: skip


def _render(size) -> Callable:
    """A render of an example scene in Blender, with all that the engine does."""
    import bpy

    import camera_ray_caster

    camera_ray_caster.register()
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / "spheres_and_planes.blend"))
    scene = bpy.context.scene
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    for name in ("z", *FOUR[1:]):
        setattr(bpy.context.view_layer, f"use_pass_{name}", True)
    return bpy.ops.render.render


def _dataset(size) -> Callable:
    """A data set of an example scene, by the script of the checkout, in a process of its own."""
    import camera_ray_caster

    script = Path(camera_ray_caster.__file__).resolve().parents[2] / "scripts" / "dataset.py"
    scene = ROOT / "blend_scenes" / "animated.blend"

    def made() -> None:
        with tempfile.TemporaryDirectory() as folder:
            words = "--frames", "1:8", "--passes", ",".join(FOUR), "--output", folder
            subprocess.run([sys.executable, script, scene, *words], check=True, stdout=subprocess.DEVNULL)

    return made


def _rays(key: str, size) -> Callable:
    """The rays of the first example of a model in the contract test."""
    from tests.core.cameras.model_examples import camera

    return camera(key, {"resolution_x": size[0], "resolution_y": size[1]}).rays


def tell() -> None:
    """Print the milliseconds of one case with the add-on of a folder."""
    root, name, *size = sys.argv[1:]
    sys.path[:0] = [root, str(Path(root) / "addon")]
    timed = cases()[name](tuple(map(int, size)))
    casts = 1 if name == DATA_SET else CASTS
    if casts > 1:
        timed()
    least = np.inf
    for _ in range(casts):
        began = _spent()
        timed()
        least = min(least, _spent() - began)
    print(f"\n{1e3 * least}")


def _spent() -> float:
    """Return the seconds that processors have spent on this process and on those that it started and that ended."""
    others = getrusage(RUSAGE_CHILDREN)
    return process_time() + others.ru_utime + others.ru_stime
