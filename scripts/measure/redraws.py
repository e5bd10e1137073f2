"""The pictures that a moving viewport waits for: every camera model in four scenes of triangles, by processor time.

574 x 287 pixels are a view of 1148 x 574 at half its resolution. The cameras are those of the contract test, with
realistic distortions, at the place of each scene's own camera; the terrain has a million triangles.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from time import process_time

import bpy
import numpy as np

import camera_ray_caster as crc
from camera_ray_caster.core.camera.camera import Camera
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import Pose

from .by_model import LENSES

ROOT = Path(__file__).resolve().parents[2]
SCENES = "street", "living_room", "sculpture_garden"
SIDE = 708
"""Cells along a side of the terrain: two triangles each, a million in all."""


def run(rounds: int, threads: int, size: tuple[int, int]) -> list[dict]:
    """Print and return the least processor time of a picture, in milliseconds, by model and scene."""
    sys.path.insert(0, str(ROOT))
    from tests.core.cameras.model_examples import camera

    frame = dict(zip(("resolution_x", "resolution_y"), size, strict=True))
    scenes = {name: _stored(name) for name in SCENES} | {"terrain": _terrain()}
    print(f"\n{size[0]} x {size[1]}, combined; least of {rounds}, ms of processor time")
    print(f"  {'':28}" + "".join(f"{name:>18}" for name in scenes), flush=True)
    rows = []
    for model in MODELS:
        case = camera(model.key, {**frame, **LENSES.get(model.key, {})})
        times = {name: _least(_at(case, pose), shapes, rounds, threads) for name, (pose, shapes) in scenes.items()}
        rows.append({"model": model.key, **times})
        print(f"  {model.key:28}" + "".join(f"{each:18.0f}" for each in times.values()), flush=True)
    return rows


def _at(camera: Camera, pose: Pose) -> Camera:
    return replace(camera, pose=pose, clip_start=0.1, clip_end=1e3, pixel_time=None)


def _least(camera: Camera, shapes, rounds: int, threads: int) -> float:
    times = []
    for _ in range(rounds):
        began = process_time()
        cast(camera, shapes, passes=("combined",), dtype=np.float32, threads=threads)
        times.append(1e3 * (process_time() - began))
    return min(times)


def _stored(name: str):
    """Return the pose of a stored scene's camera, and its shapes."""
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / f"{name}.blend"))
    return crc.read_camera(bpy.context.scene).pose, crc.read_shapes(bpy.context.scene)


def _terrain():
    """Return a place above a wrinkled ground, looking ahead and down, and the ground."""
    x, y = np.meshgrid(*2 * [np.linspace(-100, 100, SIDE + 1)])
    z = 4 * np.sin(x / 9) * np.cos(y / 7) + 0.5 * np.sin(x) * np.sin(1.3 * y)
    first = (np.arange(SIDE)[:, None] * (SIDE + 1) + np.arange(SIDE)).ravel()
    right, up = first + 1, first + SIDE + 1
    faces = np.concatenate((np.stack((first, right, up + 1), 1), np.stack((first, up + 1, up), 1)))
    tilt = np.radians(75)
    basis = np.array([[1, 0, 0], [0, np.cos(tilt), -np.sin(tilt)], [0, np.sin(tilt), np.cos(tilt)]])
    return Pose(np.array([0.0, -90.0, 12.0]), basis), crc.mesh(np.stack((x, y, z), axis=-1).reshape(-1, 3), faces)
