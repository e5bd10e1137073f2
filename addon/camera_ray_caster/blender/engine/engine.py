"""The render engine: Blender asks for a picture, ``job`` casts it, Blender stores, shows and writes it."""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial, reduce
from operator import add
from time import perf_counter

import bpy
import numpy as np

from ...core.camera.stereo import eye_record
from ...core.cast import Images
from ...core.motion.evaluations import UNRESOLVED
from ...core.records import BlenderCamera, Cancelled, InputError
from ...core.report.report import Report
from ..cycles.picture import Picture
from ..output import reports
from ..properties.declared import ENGINE
from ..terminal import signals
from .job import run
from .passes import stored, ticked
from .viewport import Viewport

BAND_PIXELS = 1 << 18
"""Pixels that are handed over to Blender at once, whose copies take the memory of those before. 18 passes of 3840 x
2160 pixels take 1.5 to 2 s of processor time; all at once 4.5 to 7.2 s, 2**16 1.2 to 1.9 s.
"""


class CameraRayCaster(Viewport, bpy.types.RenderEngine):
    """Rays of the scene's camera, cast at meshes, spheres and planes."""

    bl_idname = ENGINE
    bl_label = "Camera Ray Caster"
    bl_use_eevee_viewport = True
    done: Mapping[str, Report] = {}
    """The reports of this frame's view layers."""
    stopped = False
    """Whether a render was stopped since whoever asks has set it False."""
    picture: Picture | None = None
    """Another engine's picture, which takes the place of the combined pass; None for our own."""
    images: dict[tuple[str, str], Images] | None = None
    """Keeps what a render casts, by layer and view; None keeps nothing."""

    def update_render_passes(self, scene=None, renderlayer=None):
        """Tell the compositor which sockets a view layer has."""
        for entry in ticked(scene, renderlayer):
            self.register_pass(scene, renderlayer, entry.label, len(entry.channels), entry.channels, entry.kind)

    def render(self, depsgraph):
        """Render one view layer."""
        try:
            with signals.heard(self.test_break):
                report = self.render_layer(depsgraph)
        except InputError as error:
            self.report({"ERROR"}, str(error))
        except (Cancelled, KeyboardInterrupt):
            type(self).stopped = True
        else:
            self.keep(report, depsgraph.view_layer_eval.name)

    def render_layer(self, depsgraph) -> Report:
        """Cast the ticked passes of a view layer, for every eye, and store them in Blender's result."""
        layer = depsgraph.view_layer_eval
        wanted = ticked(depsgraph.scene_eval, layer)
        for entry in wanted:
            if entry.key != "combined":  # Blender adds that one
                self.add_pass(entry.label, len(entry.channels), entry.channels, layer=layer.name)
        eyes = [self.render_eye(depsgraph, wanted, view.name) for view in self.get_result().views]
        return reduce(add, eyes)

    def render_eye(self, depsgraph, wanted, view: str) -> Report:
        """Cast and store one eye; the view is empty where the scene is not a stereo one."""
        layer = depsgraph.view_layer_eval.name
        self.active_view_set(view)
        self.update_stats(layer, f"Casting rays {view}".rstrip())
        keys = [entry.key for entry in wanted]
        given, made_by = {}, {"engine": self.bl_idname, "samples": depsgraph.scene_eval.camera_ray_caster.samples}
        if self.picture is not None and "combined" in keys:
            given, made_by = {"combined": self.picture.pixels[layer, view]}, self.picture.made_by
        images, report = run(
            depsgraph, self.camera_override, [key for key in keys if key not in given], self.advance,
            visit=partial(self.visit, depsgraph), view=view, eye=partial(self.eye, view=view),
        )  # fmt: skip
        images |= given
        if self.images is not None:
            self.images[layer, view] = images
        report = replace(report, passes=tuple(keys), combined=made_by)
        started = perf_counter()
        self.store({entry.label: (entry.key, images[entry.key]) for entry in wanted}, layer, view)
        return report.with_seconds(write=perf_counter() - started)

    def store(self, passes: Mapping[str, tuple[str, np.ndarray]], layer: str, view: str) -> None:
        """Hand passes, their keys and images by their labels in Blender, over to Blender's result, in bands of rows."""
        height, width = next(iter(passes.values()))[1].shape[:2]
        step = max(1, BAND_PIXELS // width)
        for first in range(0, height, step):
            rows = slice(first, min(first + step, height))
            result = self.begin_result(0, first, width, rows.stop - first, layer=layer, view=view)
            for label, (key, image) in passes.items():
                found = result.layers[0].passes.find_by_name(label, view)
                found.rect.foreach_set(stored(key, image[rows]))
            self.end_result(result)

    def visit(self, depsgraph, frame: float):
        """Evaluate the scene at another frame."""
        self.frame_set(math.floor(frame), frame - math.floor(frame))
        return depsgraph

    def eye(self, raw: BlenderCamera, view: str) -> BlenderCamera:
        """Return the record of a stereo eye with the matrix and the shift that Blender hands over for it."""
        ours = eye_record(raw, view)  # which refuses what has no model, and keeps the matrix where nothing moves
        if ours.matrix_world is raw.matrix_world:
            return ours
        camera = self.camera_override
        shift_x = raw.shift_x if raw.type == "PANO" else self.camera_shift_x(camera)
        return replace(raw, matrix_world=np.array(self.camera_model_matrix(camera), np.float64), shift_x=shift_x)

    def keep(self, report: Report, layer: str) -> None:
        """Warn of what was left out, and add the report to those of this frame's other view layers.

        With Persistent Data an engine renders one frame after the other: a layer that comes again begins a new one.
        """
        if report.left_out:
            self.report({"WARNING"}, f"{reports.left_out_line(report.left_out)}; the report says why")
        for line in report.motion:
            if line.startswith(UNRESOLVED):
                self.report({"WARNING"}, line)
        for finding in report.findings:
            if not finding.passed:
                self.report({"WARNING"}, f"{finding.witness} disagrees with the rays: see the report")
        self.done = {layer: report} if layer in self.done else {**self.done, layer: report}
        reports.keep(reduce(add, self.done.values()))

    def advance(self, fraction: float) -> bool:
        """Show how far the cast is; return whether to go on."""
        self.update_progress(fraction)
        return not signals.is_stopping()


CLASSES = (CameraRayCaster,)
