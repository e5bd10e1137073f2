"""Rays given as arrays, by processor time on one thread: beside filling these arrays, and beside Open3D where it is
installed; and by the clock on one thread and on all.

The scenes are a closed room of 150,000 triangles, and two example scenes. Open3D is asked with all its threads; its
tree and that of ``cast_rays`` are there before.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from time import perf_counter, process_time

import numpy as np

import camera_ray_caster as crc
from camera_ray_caster.core.records import Shapes

from . import contenders as c
from .mesh_contest import merged

WIDTH = 724
"""Directions of a panorama of 2 : 1 with this width are 262,088 rays."""

BUMPS = 112
"""Cells along a side of each wall of the room: six walls of two triangles a cell, 150,528 in all."""


def run(rounds: int, quick: bool) -> list[dict]:
    """Print and return the least times of a cast of distances and shape indices, in milliseconds."""
    scenes: dict[str, tuple[Shapes, np.ndarray]] = {"room": (_room(), np.zeros(3))}
    if c.has("bpy"):
        from .redraws import _stored

        for name in ("street", "living_room"):
            pose, shapes = _stored(name)
            scenes[name] = shapes, pose.eye
    print(f"\nms of processor time, least of {rounds}; distance and shape_index; by the clock: one thread and all")
    print(f"  {'':34}{'rays':>10}{'fill':>8}{'cast_rays':>11}{'rays/s':>12}{'clock 1':>9}{'all':>8}{'Open3D':>9}")
    rows = []
    for scene, (shapes, eye) in scenes.items():
        contender = _open3d(shapes) if c.has("open3d") else None
        for kind, (origins, directions) in _rays(eye, WIDTH // 8 if quick else WIDTH).items():
            cast = partial(crc.cast_rays, origins, directions, shapes, passes=("distance", "shape_index"))
            timed: dict[str, Callable] = {
                "fill": partial(_filled, directions.shape), "cast": partial(cast, threads=1), "shared": cast
            }  # fmt: skip
            if contender is not None:
                timed["open3d"] = partial(contender, np.concatenate((origins, directions), 1).astype(np.float32))
            row: dict = {"scene": scene, "rays": kind, "count": len(directions)}
            row |= _least(timed, rounds)
            rows.append(row)
            rate = 1e3 * len(directions) / row["cast_ms"]
            print(f"  {scene:12}{kind:22}{len(directions):10,}{row['fill_ms']:8.1f}{row['cast_ms']:11.1f}{rate:12,.0f}"
                  f"{row['cast_clock_ms']:9.1f}{row['shared_clock_ms']:8.1f}{row.get('open3d_ms', np.nan):9.1f}",
                  flush=True)  # fmt: skip
    return rows


def _filled(shape: tuple[int, ...]) -> list[np.ndarray]:
    """Return new arrays as large as those of origins, directions, distances and indices."""
    return [np.full(shape, 1.0), np.full(shape, 1.0), np.full(shape[:1], 1.0), np.full(shape[:1], 1, np.int32)]


def _least(timed: dict[str, Callable], rounds: int) -> dict[str, float]:
    """Return the least processor time and time by the clock of functions that are called in turns."""
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in timed}
    for _ in range(rounds + 1):  # the first one makes the tree
        for name, function in timed.items():
            began, clock = process_time(), perf_counter()
            function()
            times[name].append((process_time() - began, perf_counter() - clock))
    row = {}
    for name, every in times.items():
        row[f"{name}_ms"], row[f"{name}_clock_ms"] = (1e3 * np.array(every[1:]).min(axis=0)).tolist()
    return row


def _rays(eye: np.ndarray, width: int) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    rng = np.random.default_rng(1)
    pose = crc.look_at(eye, eye + np.array((1.0, 0.0, 0.0)))
    picture = crc.camera("EQUIRECTANGULAR", (width, width // 2), pose)
    ahead = picture.rays().directions.reshape(-1, 3)
    near = eye + rng.uniform(-0.0075, 0.0075, ahead.shape)
    mixed = rng.permutation(len(ahead))
    sweep = crc.camera("SCANNER", (1024 * width // WIDTH, 128), pose, scanner_device="OS1_128").rays()
    anywhere = rng.normal(size=ahead.shape)
    return {
        "one point": (np.broadcast_to(eye, ahead.shape), ahead),
        "15 mm apart": (near, ahead),
        "15 mm apart, mixed": (near[mixed], ahead[mixed]),
        "OS1-128": (sweep.origins.reshape(-1, 3), sweep.directions.reshape(-1, 3)),
        "random": (eye + rng.uniform(-0.8, 0.8, anywhere.shape), anywhere),
    }


def _room() -> Shapes:
    """Return a cube of wrinkled walls around the origin."""
    u, v = np.meshgrid(*2 * [np.linspace(-3, 3, BUMPS + 1)])
    first = (np.arange(BUMPS)[:, None] * (BUMPS + 1) + np.arange(BUMPS)).ravel()
    faces = np.concatenate([np.stack((first, first + 1, first + BUMPS + 2), 1),
                            np.stack((first, first + BUMPS + 2, first + BUMPS + 1), 1)])  # fmt: skip
    walls = []
    for axis in range(3):
        for side in (-3, 3):
            away = side + 0.1 * np.sin(9 * u) * np.cos(7 * v)
            corners = np.roll(np.stack((away, u, v), axis=-1), axis, axis=-1)
            walls.append(crc.mesh(corners.reshape(-1, 3), faces))
    return crc.join(*walls)


def _open3d(shapes: Shapes) -> Callable:
    """Return a function that casts rays at the triangles of shapes with Open3D's RaycastingScene."""
    import open3d as o3d

    places, corners = merged(shapes)
    world = o3d.t.geometry.RaycastingScene()
    world.add_triangles(o3d.core.Tensor(places), o3d.core.Tensor(corners.astype(np.uint32)))
    return lambda rays: world.cast_rays(o3d.core.Tensor(rays))
