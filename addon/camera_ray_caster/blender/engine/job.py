"""The steps from an evaluated scene to images and a report. They are the same for panel, F12 and terminal."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

import bpy
import numpy as np

from ...core.camera.camera import Camera
from ...core.camera.stereo import eye_record
from ...core.cast import Images, cast
from ...core.casting.images import reusable
from ...core.casting.pass_needs import frames_of, has_colors, image_bytes
from ...core.casting.previews import Show
from ...core.memory import of_pixels, require
from ...core.records import Finding, Shapes
from ...core.report.accuracy import accuracy
from ...core.report.report import Report, report_cast
from ..read import movie_clips
from ..read.evaluated import Eye, scene_at
from ..read.frames import frame_of, frame_rate, go_to
from ..read.lengths import meters_of
from ..read.motion import with_other_frames
from ..verification.check import findings_of_picture


def host_of(scene) -> dict[str, object]:
    """Return Blender's version, the length of a Blender unit in meters, and the frames of a second: see ``Report``."""
    return {"blender": bpy.app.version_string, "meters": meters_of(scene), "frame_rate": frame_rate(scene)}


@dataclass(frozen=True)
class Job:
    """All data that a cast needs from Blender, read and verified. The cast itself may run in another thread."""

    camera: Camera
    shapes: Shapes
    passes: Sequence[str]
    shading: str
    samples: int
    findings: list[Finding]
    seconds: dict[str, float]
    frame: float
    layer: str
    stored: tuple[int, int]
    """Rows and columns of the picture that Blender stores: the whole frame, unless Blender crops to a border."""
    host: dict[str, object]
    several: bool
    """Whether the layer is one of several that are rendered."""

    @classmethod
    def read(
        cls,
        depsgraph,
        camera_object,
        passes: Sequence[str],
        visit: Callable | None = None,
        view: str = "",
        eye: Eye | None = None,
    ) -> "Job":
        """Read an evaluated scene with one camera, and verify the camera.

        Only the depsgraph is read, so that a render's thread may call this. ``visit(frame)`` evaluates the scene at
        another frame and returns its depsgraph, for pixels with their own times and for flow; the default sets the
        scene's frame, which a render must not do. ``view`` names a multi-view eye, and ``eye(raw)`` returns the record
        of that eye; the default is ``eye_record``. Without passes, the scene is read for all of them. Raises InputError
        if the camera cannot be cast.
        """
        scene = depsgraph.scene_eval
        started = perf_counter()
        eye = eye or partial(eye_record, view=view)
        scene_read = partial(scene_at, eye=eye, has_colors=not passes or has_colors(passes))
        record = scene_read(camera_object, depsgraph)
        read = perf_counter()
        findings = findings_of_picture(record.camera, camera_object, depsgraph, view)
        verified = perf_counter()
        frame, layer = frame_of(scene), depsgraph.view_layer_eval.name
        several = sum(layer.use for layer in scene.view_layers) > 1
        settings = scene.camera_ray_caster
        shading, samples = settings.shading, settings.samples
        if record.camera.pixel_time is not None or frames_of(passes):
            visit = visit or partial(go_to, depsgraph.scene)
            try:
                record = with_other_frames(record, depsgraph, camera_object, frame, passes, visit, scene_read)
            finally:
                visit(frame)
        moved = perf_counter()
        if clips := movie_clips.notes(scene, camera_object, record.camera.model.group):
            record = replace(record, shapes=replace(record.shapes, notes=(*record.shapes.notes, *clips)))
        return cls(
            camera=record.camera,
            shapes=record.shapes,
            passes=passes,
            shading=shading,
            samples=samples,
            findings=findings,
            seconds={"read": read - started + moved - verified, "verify": verified - read},
            frame=frame,
            layer=layer,
            stored=record.camera.raster.picture_size[::-1],
            host=host_of(scene),
            several=several,
        )

    def cast(
        self,
        progress: Callable[[float], bool] | None = None,
        finished: Callable[[Images, slice], None] | None = None,
        spare: Images | None = None,
        preview: Show | None = None,
    ) -> tuple[Images, Report]:
        """Cast the passes; return images and report. ``progress``, ``finished``, ``preview`` and Cancelled are as in
        ``cast``. The
        images are ``spare``, an earlier picture's, if they fit.
        """
        settings = {"shading": self.shading, "samples": self.samples}
        shapes = [self.camera.raster.shape, self.stored]
        needed = sum(image_bytes(shape, self.passes, np.float32) for shape in shapes)
        require(needed, of_pixels("the passes", self.stored))
        into = reusable(spare, tuple(self.passes), self.camera.raster.shape, np.float32)
        images = cast(
            self.camera, self.shapes, passes=self.passes, **settings, progress=progress, finished=finished,
            preview=preview, into=into,
        )  # fmt: skip
        began = perf_counter()
        bounds = accuracy(self.camera, self.shapes, images.plan)
        seconds = {**self.seconds, **images.seconds, "accuracy": perf_counter() - began}
        report = report_cast(
            self.camera, self.shapes, images, seconds, self.findings, self.frame, self.layer, self.several,
            accuracy=bounds, host=self.host,
        )  # fmt: skip
        return images, report
