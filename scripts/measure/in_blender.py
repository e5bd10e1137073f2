"""The benchmark's contenders inside Blender: its own ray cast in a Python loop, and Cycles at one sample per pixel."""

from __future__ import annotations

from time import perf_counter, sleep

import bpy
import numpy as np
from mathutils import Vector

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import SPHERE

from . import contenders as c

LOOP_RAYS = 20_000
"""Number of rays in the loops; the time is scaled to the whole picture. The generation of rays is not timed."""


def run(camera, shapes, passes, threads: int, rounds: int) -> list[dict]:
    """Print and return milliseconds per picture; each contender of Blender takes turns with both of ours.

    Ours are timed more often than the others, so compare medians.
    """
    scene = _scene(camera, shapes)
    rays = camera.rays()
    pixels = rays.valid.size
    pick = np.random.default_rng(0).integers(0, pixels, LOOP_RAYS)
    directions = [Vector(d) for d in rays.directions.reshape(-1, 3)[pick]]
    depsgraph = bpy.context.evaluated_depsgraph_get()
    origin = Vector((0, 0, 0))

    def loop():
        began = perf_counter()
        for direction in directions:
            scene.ray_cast(depsgraph, origin, direction)
        return (perf_counter() - began) * pixels / LOOP_RAYS

    def keeping_loop():
        """Collect lists and convert them to arrays at the end, which is faster than writing arrays ray by ray."""
        began = perf_counter()
        depth, normal, position, index = [], [], [], []
        for direction in directions:
            is_hit, hit_point, across, _, thing, _ = scene.ray_cast(depsgraph, origin, direction)
            depth.append(-hit_point.z if is_hit else np.inf)
            normal.extend(across)
            position.extend(hit_point)
            index.append(thing.pass_index if is_hit else 0)
        for values in (depth, normal, position):
            np.array(values, np.float32)
        np.array(index, np.int32)
        return (perf_counter() - began) * pixels / LOOP_RAYS

    def ours(wanted):
        began = perf_counter()
        cast(camera, shapes, passes=wanted, threads=threads)
        return perf_counter() - began

    def cycles():
        began = perf_counter()
        bpy.ops.render.render()
        return perf_counter() - began

    both_of_ours = {
        "ours, 4 passes": lambda: ours(passes),
        "ours, depth + index": lambda: ours(("depth", "shape_index")),
    }
    others = {
        "Cycles, 1 sample, 4 passes": cycles,
        "scene.ray_cast loop": loop,
        "the same, its 4 passes kept": keeping_loop,
    }
    times: dict[str, list[float]] = {name: [] for name in (*both_of_ours, *others)}
    for turn in range(rounds + 1):
        for other_name, entry_of in others.items():
            for name, entry in (*both_of_ours.items(), (other_name, entry_of)):
                if turn:
                    sleep(c.PAUSE)
                seconds = entry()
                if turn:
                    times[name].append(1e3 * seconds)
    print(f"\nBlender {bpy.app.version_string}, {len(shapes) - 1} spheres and a wall, ms a picture")
    print(f"  {'':28}{'least':>10}{'median':>10}{'over our 4':>12}{'over our 2':>12}")
    four, two = (float(np.median(times[name])) for name in both_of_ours)
    rows = []
    for name, milliseconds in times.items():
        median = float(np.median(milliseconds))
        rows.append({"spheres": len(shapes) - 1, "name": name, "least_ms": min(milliseconds), "median_ms": median,
                     "over_ours": median / four, "over_ours_depth": median / two})  # fmt: skip
        print(f"  {name:28}{min(milliseconds):10.1f}{median:10.1f}{median / four:11.1f}x{median / two:11.1f}x")
    return rows


def _scene(camera, shapes):
    """Build the same scene in Blender from icospheres and a quad, with Cycles at one sample and the four passes."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, radius=1)
    ball = bpy.context.object.data
    bpy.ops.mesh.primitive_plane_add(size=2)
    square = bpy.context.object.data
    for made in list(scene.objects):
        bpy.data.objects.remove(made)
    for k in range(len(shapes)):
        thing = bpy.data.objects.new(f"{k}", ball if shapes.kind[k] == SPHERE else square)
        thing.location, thing.scale = shapes.center[k], np.diag(shapes.axes[k])
        thing.pass_index = int(shapes.object_index[k])
        scene.collection.objects.link(thing)
    data = bpy.data.cameras.new("Camera")
    data.lens, data.sensor_width, data.clip_start, data.clip_end = 50.0, 36.0, camera.clip_start, camera.clip_end
    scene.camera = bpy.data.objects.new("Camera", data)
    scene.collection.objects.link(scene.camera)
    scene.render.resolution_y, scene.render.resolution_x = camera.raster.shape
    bpy.ops.preferences.addon_enable(module="cycles")
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 1, False, False
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_position = layer.use_pass_object_index = True
    return scene
