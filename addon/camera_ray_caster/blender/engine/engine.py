"""The render engine: Blender requests a picture, ``job`` casts it, and Blender stores, shows and writes it."""

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial, reduce
from operator import add
from time import perf_counter, sleep
from typing import Self

import bpy
import numpy as np

from ...core.camera.asked_size import asked_size
from ...core.camera.stereo import eye_record
from ...core.cast import Images
from ...core.memory import limits_as_input
from ...core.motion.evaluations import UNRESOLVED
from ...core.records import BlenderCamera, Cancelled, InputError
from ...core.report.report import Report
from ..cycles.renderer import EnginePicture
from ..output import reports
from ..process import signals
from ..properties.declared import ENGINE
from ..properties.pass_properties import PASSES, stored, ticked
from ..properties.setting_labels import in_labels
from ..read import physics
from ..read.camera_fields import camera_record
from ..read.frames import frame_of
from .after import warnings
from .job import Job
from .viewport import Viewport

BAND_PIXELS = 1 << 18
"""Number of pixels passed to Blender at once. The copies of a band reuse the memory of the band before. 18 passes of
3840 x 2160 pixels take 1.5 to 2 s of processor time; all at once 4.5 to 7.2 s, in bands of 2**16 pixels 1.2 to 1.9 s.
"""

LONGEST_WAIT, POLL_INTERVAL = 5.0, 0.01
"""Seconds that an unregistration waits for a render at most, and between two looks at it."""
_rendering: list[bool] = []
"""One item for each render that is running."""
_ending: list[bool] = []
"""Not empty while renders are stopped."""


@dataclass(eq=False)
class RenderCall:
    """Input and result of one render that the add-on starts."""

    picture: EnginePicture | None = None
    """Another engine's picture, which replaces the combined pass; None for our own."""
    images: dict[tuple[str, str], Images] | None = None
    """Images of the render, by layer and view; None if they are not kept."""
    spare: dict[tuple[str, str], Images] = field(default_factory=dict)
    """Images of an earlier render, whose memory this one takes."""
    report: Report | None = None
    """The report of all view layers; None if the render failed."""
    stopped: bool = False
    """Whether the render was stopped."""

    @contextmanager
    def handed(self) -> Iterator[Self]:
        """Let the engine have this call inside the context."""
        CameraRayCaster.call = self
        try:
            yield self
        finally:
            CameraRayCaster.call = None


class CameraRayCaster(Viewport, bpy.types.RenderEngine):
    """Rays of the scene's camera, cast at meshes, spheres and planes."""

    bl_idname = ENGINE
    bl_label = "Camera Ray Caster"
    bl_use_eevee_viewport = True
    doing = "", ""
    """The view layer that is cast, and words for it."""
    done: Mapping[str, Report] = {}
    """Reports of this frame's view layers, by name."""
    call: RenderCall | None = None

    def update_render_passes(self, scene=None, renderlayer=None):
        """Tell the compositor which sockets a view layer has."""
        for entry in ticked(scene, renderlayer):
            self.register_pass(scene, renderlayer, entry.label, len(entry.channels), entry.channels, entry.kind)

    def render(self, depsgraph):
        """Render one view layer.

        Blender may free the engine, its result or the scene meanwhile: another render begins, or another file is
        opened. The cast then ends without a word, and nothing of Blender's is touched after that.
        """
        call = self.call
        _rendering.append(True)
        try:
            self.render_or_report(depsgraph)
        except (Cancelled, KeyboardInterrupt, ReferenceError):
            if call is not None:
                call.stopped = True
        finally:
            _rendering.pop()

    def render_or_report(self, depsgraph):
        """Render one view layer, or report why not."""
        try:
            with limits_as_input(), signals.heard(self.has_ended):
                source = reports.Source.read(depsgraph.scene, depsgraph)
                report = self.render_layer(depsgraph)
        except InputError as error:
            self.report({"ERROR"}, str(error) if bpy.app.background else in_labels(str(error)))
        else:
            self.keep(report, depsgraph.view_layer_eval.name, source)

    def has_ended(self) -> bool:
        """Whether the user has stopped the render, or Blender has freed the engine."""
        try:
            return self.test_break()
        except ReferenceError:
            return True

    def render_layer(self, depsgraph) -> Report:
        """Cast the enabled passes of a view layer, for every eye, and store them in Blender's result."""
        layer = depsgraph.view_layer_eval
        wanted = ticked(depsgraph.scene_eval, layer)
        for entry in wanted:
            if entry.key != "combined":  # Blender adds combined itself
                self.add_pass(entry.label, len(entry.channels), entry.channels, layer=layer.name)
        eyes = [self.render_eye(depsgraph, wanted, view.name) for view in self.get_result().views]
        report = reduce(add, eyes)
        after = warnings(depsgraph, report.camera["model"], wanted)
        self.tell_stretched(depsgraph)
        jumped = physics.warning(depsgraph, frame_of(depsgraph.scene)) if bpy.app.background else ()
        return replace(report, warnings=(*after, *jumped))

    def tell_stretched(self, depsgraph) -> None:
        """Warn, in a window, of a frame in which the camera's picture is stretched: a terminal's user has given it."""
        asked = None if bpy.app.background else asked_size(camera_record(self.camera_override, depsgraph))
        if asked is not None:
            self.report({"WARNING"}, f"{asked.sentence[:1].upper()}{asked.sentence[1:]}. Set Frame is in the sidebar")

    def render_eye(self, depsgraph, wanted, view: str) -> Report:
        """Cast and store one eye; the view's name is empty if the scene is not multi-view."""
        layer = depsgraph.view_layer_eval.name
        self.active_view_set(view)
        self.doing = layer, f"Casting rays {view}".rstrip()
        self.update_stats(*self.doing)
        keys = [entry.key for entry in wanted]
        rendered, made_by = {}, {"engine": self.bl_idname, "samples": depsgraph.scene_eval.camera_ray_caster.samples}
        call = self.call or RenderCall()
        if call.picture is not None and "combined" in keys:
            rendered, made_by = {"combined": call.picture.pixels[layer, view]}, call.picture.made_by

        def store(images: Images, rows: slice) -> None:
            pictures = images | rendered
            self.store({entry.label: (entry.key, pictures[entry.key]) for entry in wanted}, rows, layer, view)

        def show(combined: np.ndarray, rows: slice, _: int) -> None:
            self.store({PASSES[0].label: ("combined", combined)}, rows, layer, view)

        cast_keys, visit = [key for key in keys if key not in rendered], partial(self.visit, depsgraph)
        job = Job.read(depsgraph, self.camera_override, cast_keys, visit, view, partial(self.eye, view=view))
        spare = call.spare.pop((layer, view), None)
        images, report = job.cast(self.advance, store, spare, None if bpy.app.background else show)
        images |= rendered
        if call.images is not None:
            call.images[layer, view] = images
        views = {}
        if view:
            suffix = depsgraph.scene_eval.render.views[view].file_suffix
            views[view] = {"suffix": suffix, "camera": report.camera, **(report.record or {})}
        return replace(report, passes=tuple(keys), combined=made_by, views=views)

    def store(self, passes: Mapping[str, tuple[str, np.ndarray]], rows: slice, layer: str, view: str) -> None:
        """Store some rows of passes, given as (key, image) by Blender's labels, in Blender's result, in bands. Raises
        Cancelled if the result is of another size: the resolution was changed during the render.
        """
        width = next(iter(passes.values()))[1].shape[1]
        step = max(1, BAND_PIXELS // width)
        for first in range(rows.start, rows.stop, step):
            band = slice(first, min(first + step, rows.stop))
            size = width, band.stop - first
            result = self.begin_result(0, first, *size, layer=layer, view=view)
            if (result.resolution_x, result.resolution_y) != size:
                self.end_result(result, cancel=True)
                raise Cancelled
            for label, (key, image) in passes.items():
                render_pass = result.layers[0].passes.find_by_name(label, view)
                render_pass.rect.foreach_set(stored(key, image[band]))
            self.end_result(result)

    def visit(self, depsgraph, frame: float):
        """Evaluate the scene at another frame; return the depsgraph."""
        self.frame_set(math.floor(frame), frame - math.floor(frame))
        return depsgraph

    def eye(self, raw: BlenderCamera, view: str) -> BlenderCamera:
        """Return the record of a stereo eye with the matrix and the shift that Blender provides for it."""
        ours = eye_record(raw, view)  # raises for eyes without a model; keeps the matrix of eyes that are not moved
        if ours.matrix_world is raw.matrix_world:
            return ours
        camera = self.camera_override
        shift_x = ours.shift_x if raw.model or raw.type == "PANO" else self.camera_shift_x(camera)
        return replace(ours, matrix_world=np.array(self.camera_model_matrix(camera), np.float64), shift_x=shift_x)

    def keep(self, report: Report, layer: str, source: reports.Source) -> None:
        """Warn of omissions and failures, and add the report to those of this frame's other view layers.

        With Persistent Data an engine renders several frames in succession: a repeated layer starts a new frame.
        """
        failed = [finding.witness for finding in report.findings if not finding.passed]
        for line in (
            *[f"{reports.left_out_line(report.left_out)}; the report gives the reasons"] * bool(report.left_out),
            *(line for line in report.motion if line.startswith(UNRESOLVED)),
            *report.warnings,
            *(f"the reference check {witness} failed: see the report" for witness in failed),
        ):
            self.report({"WARNING"}, line)
        self.done = {layer: report} if layer in self.done else {**self.done, layer: report}
        whole = reduce(add, self.done.values())
        if self.call is not None:
            self.call.report = whole
            if self.call.picture is not None:
                whole = whole.with_seconds(**{self.call.picture.step: self.call.picture.seconds})
        reports.keep(whole, source)

    def advance(self, fraction: float) -> bool:
        """Show the progress of the cast and the time; return whether to continue."""
        try:
            layer, words = self.doing
            self.update_stats(layer, f"{words} {fraction:.0%}")
            self.update_progress(fraction)
        except ReferenceError:
            return False
        return not (signals.is_stopping() or _ending)


def stop() -> None:
    """Stop every render and wait until it has ended: Blender frees the engine when its class is unregistered."""
    _ending.append(True)
    end = perf_counter() + LONGEST_WAIT
    while _rendering and perf_counter() < end:
        sleep(POLL_INTERVAL)
    _ending.clear()


CLASSES = (CameraRayCaster,)


def register(undo) -> None:
    undo.callback(stop)
