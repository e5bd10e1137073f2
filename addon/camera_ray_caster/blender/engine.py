"""The render engine: Blender asks for a picture, the walk makes it, Blender stores, shows and writes it."""

from time import perf_counter

import bpy

from ..core.records import Cancelled, InputError
from ..core.report import Report
from . import reports
from .passes import stored, ticked
from .run import run
from .viewport import Viewport

WARNINGS = 10
"""Objects that are warned of by name; the report has them all."""


class CameraRayCaster(Viewport, bpy.types.RenderEngine):
    """Rays of the scene's camera, cast at spheres and planes."""

    bl_idname = "CAMERA_RAY_CASTER"
    bl_label = "Camera Ray Caster"
    bl_use_eevee_viewport = True
    done: Report | None = None
    stopped = False
    """Whether a render was stopped since whoever asks has set it False."""

    def update_render_passes(self, scene=None, renderlayer=None):
        """Tell the compositor which sockets a view layer has."""
        for entry in ticked(scene, renderlayer):
            self.register_pass(scene, renderlayer, entry.label, len(entry.channels), entry.channels, entry.kind)

    def render(self, depsgraph):
        """Render one view layer."""
        try:
            report = self.render_layer(depsgraph)
        except InputError as error:
            self.report({"ERROR"}, str(error))
        except (Cancelled, KeyboardInterrupt):
            type(self).stopped = True
        else:
            self.keep(report)

    def render_layer(self, depsgraph) -> Report:
        """Cast the ticked passes of a view layer and store them in Blender's result."""
        if depsgraph.scene_eval.render.use_multiview:
            raise InputError("several views cannot be cast: switch off Stereoscopy in the Output properties")
        layer = depsgraph.view_layer_eval
        wanted = ticked(depsgraph.scene_eval, layer)
        for entry in wanted:
            if entry.key != "combined":  # Blender adds that one
                self.add_pass(entry.label, len(entry.channels), entry.channels, layer=layer.name)
        self.update_stats(layer.name, "Casting rays")
        images, report = run(depsgraph, self.camera_override, [entry.key for entry in wanted], self.advance)
        started = perf_counter()
        height, width = next(iter(images.values())).shape[:2]
        result = self.begin_result(0, 0, width, height, layer=layer.name)
        for entry in wanted:
            found = result.layers[0].passes.find_by_name(entry.label, "")
            found.rect.foreach_set(stored(entry.key, images[entry.key]))
        self.end_result(result)
        return report.with_seconds(write=perf_counter() - started)

    def keep(self, report: Report) -> None:
        """Warn of what was left out, and add the report to those of this frame's other view layers."""
        for name, reason in report.left_out[:WARNINGS]:
            self.report({"WARNING"}, f"{name!r} is left out: {reason}")
        if len(report.left_out) > WARNINGS:
            self.report({"WARNING"}, f"{len(report.left_out) - WARNINGS} more objects are left out: see the report")
        for finding in report.findings:
            if not finding.passed:
                self.report({"WARNING"}, f"{finding.witness} disagrees with the rays: see the report")
        self.done = report if self.done is None else self.done + report
        reports.keep(self.done)

    def advance(self, fraction: float) -> bool:
        """Show how far the cast is; return whether to go on."""
        self.update_progress(fraction)
        return not self.test_break()


def register() -> None:
    """See ``registration``."""
    bpy.utils.register_class(CameraRayCaster)


def unregister() -> None:
    """See ``registration``."""
    bpy.utils.unregister_class(CameraRayCaster)
