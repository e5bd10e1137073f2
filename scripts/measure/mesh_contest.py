"""The benchmark's contenders for triangle meshes: this caster, Mitsuba, Embree and Open3D with the same triangles.

The scenes are Blender's monkey, subdivided, in front of a wall, and a thousand monkeys that share one mesh. The other
tracers get all triangles in world coordinates as float32; the time to build their scenes is shown separately.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from time import perf_counter

import numpy as np

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.records import MESH, Shapes

from . import contenders as c

LEVELS = (0, 2, 3, 4, 5)
"""Subdivision levels: 1k, 16k, 63k, 252k and 1M triangles."""

CROWD = 1000
PASSES = "depth", "normal", "position", "object_index"
MODELS = "FISHEYE_EQUISOLID", "EQUIRECTANGULAR", "CROSS_SLIT", "PUSHBROOM"
MODELS_LEVEL = 3


def scene(level: int, crowd: bool, width: int, height: int):
    """Return the camera and the shapes of a monkey, or of CROWD monkeys, in front of a wall."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    bpy.ops.mesh.primitive_plane_add(size=80, location=(0, 0, -32))
    bpy.ops.mesh.primitive_monkey_add(size=2, location=(0, 0, -5))
    monkey = bpy.context.object
    bpy.ops.object.shade_smooth()
    if level:
        modifier = monkey.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = modifier.render_levels = level
    if crowd:
        rng = np.random.default_rng(0)
        depth = rng.uniform(8, 30, CROWD)
        across, up = rng.uniform(-1, 1, (2, CROWD)) * depth * [[0.36], [0.2]]
        monkey.hide_render = True
        for k in range(CROWD):
            copy = bpy.data.objects.new(f"Monkey {k}", monkey.data)
            copy.location = across[k], up[k], -depth[k]
            copy.rotation_euler = rng.uniform(0, 6, 3)
            copy.scale = (0.5,) * 3
            scene.collection.objects.link(copy)
    bpy.context.view_layer.update()
    return read_camera(scene), read_shapes(scene)


def triangles(shapes: Shapes) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray | None]]:
    """Yield the vertices, (v, 3) float32, world, triangles, (k, 3), and vertex normals or None of each shape."""
    for row in range(len(shapes)):
        axes, center = shapes.axes[row], shapes.center[row]
        if shapes.kind[row] != MESH:
            square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
            yield np.float32(square @ axes.T + center), np.array([[0, 1, 2], [0, 2, 3]]), None
            continue
        mesh = shapes.meshes[shapes.mesh[row]]
        places = axes @ (mesh.vertices - mesh.middle[:, None]) + center[:, None]
        normals = np.zeros_like(mesh.vertices)
        if mesh.normals is not None:
            for corner, loop in zip(mesh.triangles, mesh.loops, strict=True):
                normals[:, corner] = mesh.normals[loop].T
        yield np.float32(places.T), mesh.triangles.T, np.float32((np.linalg.inv(axes).T @ normals).T)


def mitsubas() -> dict[str, Callable]:
    """Return the contenders of Mitsuba 3; see ``contenders.mitsubas``."""
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb")

    def add(content: dict, shapes: Shapes) -> None:
        for k, (places, corners, normals) in enumerate(triangles(shapes)):
            mesh = mi.Mesh(f"s{k}", len(places), len(corners), has_vertex_normals=normals is not None)
            parameters = mi.traverse(mesh)
            parameters["vertex_positions"] = np.ascontiguousarray(places).ravel()
            parameters["faces"] = np.ascontiguousarray(corners, np.uint32).ravel()
            if normals is not None:
                parameters["vertex_normals"] = np.ascontiguousarray(normals).ravel()
            parameters.update()
            content[f"s{k}"] = mesh

    return c.mitsubas(add)


def merged(shapes: Shapes) -> tuple[np.ndarray, np.ndarray]:
    """Return all vertices, (v, 3) float32, and triangles, (k, 3), of a scene."""
    places, corners, start = [], [], 0
    for vertices, three, _ in triangles(shapes):
        places.append(vertices)
        corners.append(three + start)
        start += len(vertices)
    return np.concatenate(places), np.concatenate(corners)


def embree(camera, shapes) -> Callable:
    """Prepare Embree with embreex: distances along given rays."""
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    places, corners = merged(shapes)
    world = EmbreeScene()
    TriangleMesh(world, np.ascontiguousarray(places[corners]))
    rays = camera.rays()
    origins, directions = (vectors.reshape(-1, 3).astype(np.float32) for vectors in (rays.origins, rays.directions))
    world.run(origins[:1], directions[:1], query="DISTANCE")
    return lambda: world.run(origins, directions, query="DISTANCE")


def open3d(threads: int) -> Callable:
    """Return the contender of Open3D's RaycastingScene: all its outputs for given rays."""

    def prepare(camera, shapes):
        import open3d as o3d

        places, corners = merged(shapes)
        world = o3d.t.geometry.RaycastingScene(nthreads=threads)
        world.add_triangles(o3d.core.Tensor(places), o3d.core.Tensor(corners.astype(np.uint32)))
        rays = camera.rays()
        ray_numbers = np.concatenate((np.broadcast_to(rays.origins, rays.directions.shape), rays.directions), axis=-1)
        tensor = o3d.core.Tensor(ray_numbers.astype(np.float32))
        return lambda: world.cast_rays(tensor, nthreads=threads)

    return prepare


def run(compare: Callable, quick: bool, width: int, height: int, rounds: int, threads: int) -> list[dict]:
    """Print and return the rows of ``compare`` for each scene."""
    rows = []
    for level in LEVELS[:2] if quick else (*LEVELS, None):
        camera, shapes = scene(level or 0, level is None, width, height)
        entries = {
            "ours, 4 passes": c.ours(PASSES, threads),
            "ours, depth + index": c.ours(("depth", "shape_index"), threads),
        }
        if c.has("mitsuba"):
            entries |= mitsubas()
        if c.has("embreex"):
            entries["Embree, distance"] = embree
        if c.has("open3d"):
            entries["Open3D, 4 passes"] = open3d(threads)
        count = sum(len(shapes.meshes[k]) for k in shapes.mesh[shapes.kind == MESH].tolist())
        title = f"{count:,} triangles of {(shapes.kind == MESH).sum():,} monkeys and a wall"
        rows += compare(title, camera, shapes, entries, rounds)
    if not quick:
        rows += _by_model(width, height, rounds, threads)
    return rows


def _by_model(width: int, height: int, rounds: int, threads: int) -> list[dict]:
    """Print and return the times of other camera models of the contract test, in turns with the perspective."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    from tests.core.cameras.model_examples import camera as camera_of

    print("\n  63k triangles, four passes, by camera model, over the perspective")
    camera, shapes = scene(MODELS_LEVEL, False, width, height)
    rows = []
    for key in MODELS:
        size = {"resolution_x": width, "resolution_y": height, "matrix_world": np.eye(4)}
        other = camera_of(key, size)
        times: tuple[list[float], list[float]] = [], []
        for _ in range(rounds + 1):
            for milliseconds, contender in zip(times, (camera, other), strict=True):
                began = perf_counter()
                c.ours(PASSES, threads)(contender, shapes)()
                milliseconds.append(1e3 * (perf_counter() - began))
        plain, median = (float(np.median(milliseconds[1:])) for milliseconds in times)
        rows.append({"model": key, "median_ms": median, "perspective_ms": plain})
        print(f"  {key:28}{median:9.1f} ms{median / plain:10.2f}x")
    return rows
