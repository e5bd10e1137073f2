"""F12 beside the cast alone, and beside an engine that hands Blender zeros: what of a render is Blender's own."""

from __future__ import annotations

from collections.abc import Callable
from time import process_time

import bpy
import numpy as np

import camera_ray_caster as crc
from camera_ray_caster.blender.engine.engine import BAND_PIXELS
from camera_ray_caster.blender.properties.pass_properties import tick, ticked

from .against import ROOT
from .dataset_speed import PASSES_CAST

SCENES = "spheres_and_planes", "living_room"


class Zeros(bpy.types.RenderEngine):
    """An engine whose passes are 0, in arrays that exist, as Blender stores them."""

    bl_idname, bl_label = "CAMERA_RAY_CASTER_ZEROS", "Zeros"

    def render(self, depsgraph):
        """Render one view layer."""
        scene, layer = depsgraph.scene_eval, depsgraph.view_layer_eval
        wanted = ticked(scene, layer)
        for entry in wanted:
            if entry.key != "combined":
                self.add_pass(entry.label, len(entry.channels), entry.channels, layer=layer.name)
        width, height = scene.render.resolution_x, scene.render.resolution_y
        step = max(1, BAND_PIXELS // width)
        zeros = np.zeros(4 * step * width, np.float32)
        for first in range(0, height, step):
            size = width, min(step, height - first)
            result = self.begin_result(0, first, *size, layer=layer.name)
            for entry in wanted:
                render_pass = result.layers[0].passes.find_by_name(entry.label, "")
                render_pass.rect.foreach_set(zeros[: size[0] * size[1] * len(entry.channels)])
            self.end_result(result)


def run(size: tuple[int, int], rounds: int) -> list[dict]:
    """Print and return the processor time of each scene's cast, into new and into existing arrays, and of its F12."""
    crc.register()
    bpy.utils.register_class(Zeros)
    print(f"\nprocessor time, ms; {size[0]} x {size[1]}, {len(PASSES_CAST)} passes; least of {rounds} rounds")
    print(f"  {'':24}{'cast':>10}{'into':>10}{'F12':>10}{'zeros':>10}{'F12 / cast':>12}{'(F12 - zeros) / cast':>22}")
    return [_row(name, size, rounds) for name in SCENES]


def _row(name: str, size: tuple[int, int], rounds: int) -> dict:
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / f"{name}.blend"))
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.camera_ray_caster.samples = 1
    tick(scene, bpy.context.view_layer, PASSES_CAST)
    read = crc.read_scene(scene, passes=PASSES_CAST)
    images = crc.cast(read, passes=PASSES_CAST)

    def rendered(engine: str) -> Callable:
        def render() -> None:
            scene.render.engine = engine
            bpy.ops.render.render()

        return render

    timed = {
        "cast": lambda: crc.cast(read, passes=PASSES_CAST),
        "into": lambda: crc.cast(read, passes=PASSES_CAST, into=images),
        "F12": rendered("CAMERA_RAY_CASTER"),
        "zeros": rendered(Zeros.bl_idname),
    }
    least = dict.fromkeys(timed, np.inf)
    for _ in range(rounds):
        for key, call in timed.items():
            began = process_time()
            call()
            least[key] = min(least[key], 1e3 * (process_time() - began))
    engine_seconds = least["F12"] - least["zeros"]
    print(f"  {name:24}" + "".join(f"{time:10.0f}" for time in least.values())
          + f"{least['F12'] / least['cast']:10.2f} x{engine_seconds / least['cast']:20.2f} x")  # fmt: skip
    return {"name": name, **{f"{key}_ms": time for key, time in least.items()}}
