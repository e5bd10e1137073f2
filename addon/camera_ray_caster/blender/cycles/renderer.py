"""Cycles as a function: a render that returns its float pixels before Blender processes them."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

import bpy
import numpy as np

from ...core.records import Raster
from ..process.opening import refused_as_input
from ..process.signals import raise_if_stopping
from ..read.changes import changed

INSIDE = 0.25
"""Offset of a border from a pixel's edge, in pixels, so that rounding cannot move it to the next pixel."""


@dataclass(frozen=True)
class EnginePicture:
    """The combined pass of every view layer and view, by another engine."""

    step: str
    """Name of its seconds in the report."""
    pixels: Mapping[tuple[str, str], np.ndarray]
    """Pixels (rows, columns, 4) float32 of the render window, row 0 at the bottom, by names of view layer and view."""
    made_by: Mapping[str, object]
    """Engine, and how it rendered, for the report."""
    seconds: float
    warnings: tuple[str, ...] = ()


Render = Callable[[], Mapping[str, np.ndarray]]
"""Function that renders the scene with Cycles and returns the pixels by view layer."""


@contextmanager
def cycles_engine(scene) -> Iterator[Render]:
    """Yield a function that renders the scene with Cycles, without compositor, sequencer and Freestyle.

    The function may be called several times. It raises InputError if Blender cannot render, and Cancelled if the user
    has asked to stop.
    """
    from cycles import CyclesRender, engine

    pictures: dict[str, np.ndarray] = {}

    class Pixels(CyclesRender):
        bl_idname = "CAMERA_RAY_CASTER_CYCLES"
        bl_label = "Cycles for Camera Ray Caster"

        def render(self, depsgraph):
            layer = depsgraph.view_layer_eval.name  # read before Cycles frees the depsgraph
            super().render(depsgraph)
            result = self.get_result()
            (view,) = result.views
            rect = result.layers[layer].passes.find_by_name("Combined", view.name).rect
            pictures[layer] = np.empty((result.resolution_y, result.resolution_x, 4), np.float32)
            rect.foreach_get(pictures[layer].reshape(-1))

        def render_frame_finish(self):
            super().render_frame_finish()
            engine.free(self)

        def __del__(self):
            """Do nothing: Cycles' method would access its session after Blender has freed the engine."""

    def render() -> Mapping[str, np.ndarray]:
        pictures.clear()
        with refused_as_input(), ExitStack() as stack:
            changed(stack, scene.render, engine=Pixels.bl_idname)  # not before: Blender would compile shaders, too
            bpy.ops.render.render(scene=scene.name)
        raise_if_stopping()
        if not pictures:
            raise RuntimeError("Cycles returned no pixels: see the messages in the terminal")
        return dict(pictures)

    with ExitStack() as stack:
        stack.callback(bpy.utils.register_class, CyclesRender)  # Blender loses it with its subclass, and would crash
        stack.callback(bpy.utils.unregister_class, CyclesRender)
        bpy.utils.register_class(Pixels)
        stack.callback(bpy.utils.unregister_class, Pixels)
        only_engine(stack, scene)
        yield render


def only_engine(stack: ExitStack, scene) -> None:
    """Leave out of renders all but the engine, and keep nothing of them, until the stack is closed."""
    off = ("use_compositing", "use_sequencer", "use_freestyle", "use_persistent_data", "use_render_cache")
    off = {name: False for name in off if hasattr(scene.render, name)}  # use_render_cache: before 5.2
    changed(stack, scene.render, **off)


def border(window: Raster) -> dict[str, object]:
    """Return the render settings with which Blender renders only a window of the frame."""
    (width, height), within = window.size, INSIDE
    return {
        "use_border": True,
        "use_crop_to_border": True,
        "border_min_x": (window.x0 + within) / width,
        "border_max_x": (window.x1 + within) / width,
        "border_min_y": (window.y0 + within) / height,
        "border_max_y": (window.y1 + within) / height,
    }
